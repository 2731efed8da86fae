"""Plain data walked table by table, beside the types that say what they should be."""

from collections.abc import Iterator
from typing import Any, get_args

import msgspec

from modeviz.files.schema.hints import alternatives, fields_of, is_record, joined, plain


def each_table(value: Any, where: str = "") -> Iterator[tuple[str, dict[str, Any]]]:
    """Every table in a value with its path."""
    waiting = [(where, value)]
    while waiting:
        path, at = waiting.pop()
        if isinstance(at, dict):
            yield path, at
        items = at.items() if isinstance(at, dict) else enumerate(at) if isinstance(at, list) else ()
        waiting += reversed([(joined(path, key), inner) for key, inner in items])


def place_of(items: list[Any], item: Any) -> int:
    """The number of an item of a list, which may be equal to others."""
    return next(i for i, other in enumerate(items) if other is item)


def type_at(hint: Any, key: Any) -> Any:
    """The type of what a table or a list has at a key."""
    if is_record(hint):
        kinds = [plain(kind) for kind in alternatives(fields_of(hint).get(key, Any))]
        return next(filter(is_record, kinds), kinds[0])
    return plain((get_args(hint) or (Any,))[-1])


def required_keys(hint: Any) -> set[str]:
    """The keys that a table has to have."""
    if not is_record(hint):
        return set()
    required = {field.encode_name for field in msgspec.structs.fields(hint) if field.required}
    return required | hint.depending
