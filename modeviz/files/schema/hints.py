"""Type hints of records, read key by key, and data changed by what they say."""

from collections.abc import Callable, Mapping
from functools import cache
from types import NoneType, UnionType
from typing import Annotated, Any, TypeVar, Union, get_args, get_origin, get_type_hints

import msgspec

N = TypeVar("N")


@cache
def fields_of(record: type) -> dict[str, Any]:
    """The hints of a record's keys, with their annotations, by their names in the file."""
    hints = get_type_hints(record, include_extras=True)
    return {field.encode_name: hints[field.name] for field in msgspec.structs.fields(record)}


def is_record(kind: Any) -> bool:
    """Whether a type is a table with keys of its own."""
    return hasattr(kind, "__struct_fields__")


def alternatives(hint: Any) -> list[Any]:
    """The types that a value that is there may have, each with its annotations."""
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


def annotation(hint: Any, kind: type[N]) -> N | None:
    """The annotation of that kind, of the hint or of what it may also be; None if there is none."""
    if get_origin(hint) is Annotated:
        inner, *notes = get_args(hint)
        return next((n for n in notes if isinstance(n, kind)), None) or annotation(inner, kind)
    if get_origin(hint) in (Union, UnionType):
        return next((found for k in get_args(hint) if (found := annotation(k, kind))), None)
    return None


@cache
def annotations_of(record: type, kind: type[N]) -> dict[str, N | None]:
    """The annotation of that kind of each of a record's keys."""
    return {key: annotation(hint, kind) for key, hint in fields_of(record).items()}


def joined(where: str, key: str | int) -> str:
    """The key path one step further in."""
    if isinstance(key, int):
        return f"{where}[{key}]"
    return f"{where}.{key}" if where else key


def each_annotated(
    data: Any,
    hint: Any,
    kind: type[N],
    change: Callable[[Any, N, Mapping[str, Any], str], Any],
    where: str = "",
) -> Any:
    """The data with what `change` makes of each value with an annotation of a kind in its place.

    Args:
        data: plain data that `decode` accepts as what the hint says.
        hint: a record, or a container of records.
        kind: of annotation.
        change: given the value, its annotation, the table that it is in, and its key path.
        where: the key path of the data.
    """
    hint = _table_kind(hint) if isinstance(data, dict) else plain(hint)
    inner = get_args(hint) or (Any,)
    if isinstance(data, dict) and is_record(hint):
        hints, notes = fields_of(hint), annotations_of(hint, kind)
        return {
            key: change(value, note, data, joined(where, key))
            if (note := notes[key]) and not isinstance(value, dict)
            else each_annotated(value, hints[key], kind, change, joined(where, key))
            for key, value in data.items()
        }
    if isinstance(data, dict):
        return {
            key: each_annotated(value, inner[-1], kind, change, joined(where, key))
            for key, value in data.items()
        }
    if isinstance(data, list | tuple):
        return [
            each_annotated(value, inner[0], kind, change, joined(where, index))
            for index, value in enumerate(data)
        ]
    return data


def _table_kind(hint: Any) -> Any:
    """The type of a table, whatever else its key may be."""
    kinds = [plain(kind) for kind in alternatives(hint)] or [hint]
    return next(filter(is_record, kinds), kinds[0])
