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


def plain(hint: Any) -> Any:
    """The type itself, without annotations and without being optional."""
    if get_origin(hint) is Annotated:
        return plain(get_args(hint)[0])
    if get_origin(hint) in (Union, UnionType):
        return plain(next(k for k in get_args(hint) if k is not NoneType))
    return hint


def annotation(hint: Any, kind: type) -> Any:
    """The annotation of that kind, of the hint or of what it may also be; None if there is none."""
    if get_origin(hint) is Annotated:
        inner, *notes = get_args(hint)
        return next((n for n in notes if isinstance(n, kind)), None) or annotation(inner, kind)
    if get_origin(hint) in (Union, UnionType):
        return next((found for k in get_args(hint) if (found := annotation(k, kind))), None)
    return None
