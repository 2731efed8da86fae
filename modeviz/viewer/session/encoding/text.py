"""A state as JSON text with the version of its form, and back."""

from typing import Any, TypeVar

import msgspec

from modeviz.errors import ModevizError, of_file
from modeviz.files.schema.decoding import unreadable
from modeviz.viewer.session.encoding.plain import plain_of, value_of

T = TypeVar("T")

VERSION = 1
"""Of the form of a text. It rises when a text of before is to be read otherwise; a field that is added
with a default needs nothing."""

LONGEST = 4_000_000
"""Bytes of a text that is read: a hundred mount groups and as many variants take a tenth of it."""


def text_of(value: Any) -> str:
    """Return a state, or any dataclass that `plain_of` takes, as JSON text."""
    return msgspec.json.encode({"version": VERSION, "content": plain_of(value)}).decode()


def value_of_text(text: str | bytes, kind: type[T], what: str) -> T:
    """Return what a text of `text_of` stands for, whoever wrote it.

    Args:
        text: JSON.
        kind: of what it stands for.
        what: it is, for errors: "state link".

    Raises:
        ModevizError: it is no such text, too long, or of a later modeviz.
    """
    if len(text) > LONGEST:
        raise ModevizError(f"{what}: found {len(text):,} letters, expected at most {LONGEST:,}")
    try:
        data = msgspec.json.decode(text)
    except (ValueError, RecursionError) as error:
        raise ModevizError(f"{what}: not JSON: {unreadable(error)}") from None
    with of_file(what):
        return value_of(_content(data), kind)


def _content(data: Any) -> Any:
    """The content of a text; raises ModevizError for one of another version."""
    version = data.get("version") if isinstance(data, dict) else None
    if type(version) is not int or version < 1 or "content" not in data:
        raise ModevizError("found no version and content, expected a text that modeviz has written")
    if version > VERSION:
        raise ModevizError(
            f"written by a later modeviz: found version {version} of its form, expected at most "
            f"{VERSION}; a later modeviz would read it"
        )
    return data["content"]
