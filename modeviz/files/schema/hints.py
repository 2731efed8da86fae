"""What the type hints of records say of a key."""

from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, Union, get_args, get_origin, get_type_hints

import msgspec


@cache
def fields_of(record: type) -> dict[str, Any]:
    """The hints of a record's keys, with their annotations, by their names in the file."""
    hints = get_type_hints(record, include_extras=True)
    return {field.encode_name: hints[field.name] for field in msgspec.structs.fields(record)}


def is_record(kind: Any) -> bool:
    """Whether a type is a table with keys of its own."""
    return hasattr(kind, "__struct_fields__")


def alternatives(hint: Any) -> list[Any]:
    """What a value that is there may be, each with its annotations."""
    if get_origin(hint) in (Union, UnionType):
        return [inner for kind in get_args(hint) for inner in alternatives(kind)]
    if get_origin(hint) is Annotated and len(inner := alternatives(get_args(hint)[0])) > 1:
        return inner
    return [] if hint is NoneType else [hint]


def plain(hint: Any) -> Any:
    """The type itself, without annotations and without being optional."""
    if get_origin(hint) is Annotated:
        return plain(get_args(hint)[0])
    if get_origin(hint) in (Union, UnionType):
        return plain(alternatives(hint)[0])
    return hint


def annotation(hint: Any, kind: type) -> Any:
    """The annotation of that kind, of the hint or of what it may also be; None if there is none."""
    if get_origin(hint) is Annotated:
        inner, *notes = get_args(hint)
        return next((n for n in notes if isinstance(n, kind)), None) or annotation(inner, kind)
    if get_origin(hint) in (Union, UnionType):
        return next((found for k in get_args(hint) if (found := annotation(k, kind))), None)
    return None


def joined(where: str, key: str | int) -> str:
    """The key path one step further in."""
    if isinstance(key, int):
        return f"{where}[{key}]"
    return f"{where}.{key}" if where else key
