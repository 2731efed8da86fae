"""TOML files in declared units as records in SI."""

import re
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from modeviz.errors import VehicleError, located
from modeviz.files.disk import read_text
from modeviz.files.records.record import FileRecord
from modeviz.files.schema.decoding import decode, unreadable
from modeviz.files.schema.scaling import to_si

R = TypeVar("R", bound=FileRecord)

MOST_PARTS = 32
"""Of a dotted key; to read one takes time that rises with their square."""

_DOTTED = re.compile(
    r"""(?:^[ \t]*\[{{0,2}}|[{{,])[ \t]*{part}(?:[ \t]*\.[ \t]*{part}){{{most}}}""".format(
        part=r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')""", most=MOST_PARTS
    ),
    re.MULTILINE,
)


def read_toml(path: Path, kind: type[R]) -> R:
    """A file's content, in SI.

    Raises:
        VehicleError: the file is missing, not TOML, or not of that kind; the text names it and the key.
    """
    tables = read_tables(path)
    with located(path):
        return in_si(tables, kind)


def in_si(tables: Mapping[str, Any], kind: type[R]) -> R:
    """The tables of a file as a record in SI.

    Raises:
        FaultsError: they are not of that kind.
    """
    record = decode(tables, kind)  # before scaling, so that errors show the file's own numbers
    return msgspec.convert(to_si(tables, kind, record.units), kind)


def read_tables(path: Path) -> dict[str, Any]:
    """A file's tables as they stand.

    Raises:
        VehicleError: the file is missing or not TOML; the text names it.
    """
    text = read_text(path)
    with located(path):
        return tables_of(text)


def tables_of(text: str) -> dict[str, Any]:
    """The tables of a text.

    Raises:
        VehicleError: it is not TOML.
    """
    _check_depth(text)
    try:
        return tomllib.loads(text)
    except (ValueError, RecursionError) as error:
        raise VehicleError(f"not TOML: {unreadable(error)}") from None


def _check_depth(text: str) -> None:
    """Raises VehicleError for a key of very many parts."""
    found = _DOTTED.search(text)
    if found:
        line = text.count("\n", 0, found.start()) + 1
        raise VehicleError(f"line {line}: found a key of more than {MOST_PARTS} parts, expected a few")
