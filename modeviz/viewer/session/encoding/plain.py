"""Frozen dataclasses as plain data, as JSON has them, and back: hints of their fields are the schema.

What else was weighed: msgspec takes dataclasses too, but neither a union of two of them nor infinite
numbers, passes over keys that it does not know, and words and path of its errors are no part of its
contract. Its reader of JSON is used in `text`.
"""

import dataclasses
from collections.abc import Callable, Mapping
from functools import cache
from reprlib import repr as brief
from types import NoneType
from typing import Any, Literal, TypeVar, get_args, get_origin, get_type_hints

from modeviz.errors import LONGEST_NAME, Fault, FaultsError, at_key, cut, kind_of, unknown
from modeviz.files.schema.decoding import LARGEST
from modeviz.files.schema.hints import alternatives, joined
from modeviz.files.schema.mismatches import KINDS, found

T = TypeVar("T")

LONGEST_TEXT = 4000
"""Letters of one text: as many as a page may send."""

MOST_ITEMS = 20_000
"""In one list or table."""


def plain_of(value: Any) -> Any:
    """Return a value as tables, lists, texts, numbers and None; the same for sets in any order.

    Args:
        value: a dataclass, or what its fields may be: mappings by text, tuples, frozen sets, text,
            numbers, None.
    """
    if dataclasses.is_dataclass(value):
        return {f.name: plain_of(getattr(value, f.name)) for f in dataclasses.fields(value)}
    if isinstance(value, Mapping):
        return {key: plain_of(inner) for key, inner in value.items()}
    if isinstance(value, frozenset):
        return sorted(map(plain_of, value))
    if isinstance(value, tuple):
        return [*map(plain_of, value)]
    if isinstance(value, float):  # numpy's too
        return float(value)
    assert value is None or isinstance(value, str | int), f"no way to write {value!r}"
    return value


def value_of(data: Any, kind: type[T]) -> T:
    """Return the value that plain data stand for; it is a stranger's until then.

    A field that is missing has its default, if it has one: so texts of before it was there are read.

    Args:
        data: tables, lists, texts, numbers and None.
        kind: of the value, a dataclass.

    Raises:
        FaultsError: what is there does not fit, a number is not finite or beyond any use, a text is
            too long, or there is too much of something.
    """
    return _value(data, kind, "")


def _value(data: Any, hint: Any, where: str) -> Any:
    kinds = alternatives(hint)
    if data is None and NoneType in get_args(hint):
        return None
    if len(kinds) > 1:
        return _record(data, _meant(data, kinds, where), where)
    kind = kinds[0]
    if dataclasses.is_dataclass(kind):
        return _record(data, kind, where)
    return _READERS[get_origin(kind) or kind](data, kind, where)


def _record(data: Any, record: Any, where: str) -> Any:
    _check_kind(data, dict, where)
    hints = _fields(record)
    for key in data:
        if key not in hints:
            raise FaultsError(Fault(joined(where, key), unknown("key", key, hints)))
    for field in dataclasses.fields(record):
        if _is_needed(field) and field.name not in data:
            raise FaultsError(Fault(joined(where, field.name), "missing"))
    values = {key: _value(inner, hints[key], joined(where, key)) for key, inner in data.items()}
    with at_key(where):
        return record(**values)


def _meant(data: Any, records: list[Any], where: str) -> Any:
    """The dataclass among some, no two of which need the same fields, that a table is meant to be."""
    _check_kind(data, dict, where)
    for record in records:
        if {f.name for f in dataclasses.fields(record) if _is_needed(f)} <= data.keys():
            return record
    raise FaultsError(Fault(where, f"found the keys {brief([*data])}, which belong to nothing known"))


def _mapping(data: Any, kind: Any, where: str) -> dict[str, Any]:
    _check_kind(data, dict, where)
    key_kind, inner_kind = get_args(kind)
    return {
        _value(key, key_kind, where): _value(inner, inner_kind, joined(where, key))
        for key, inner in data.items()
    }


def _set(data: Any, kind: Any, where: str) -> frozenset[Any]:
    return frozenset(_tuple(data, tuple[get_args(kind)[0], ...], where))


def _tuple(data: Any, kind: Any, where: str) -> tuple[Any, ...]:
    _check_kind(data, list, where)
    inner = get_args(kind)
    if inner[-1] is Ellipsis:
        inner = inner[:1] * len(data)
    if len(data) != len(inner):
        raise FaultsError(found(_short(data), f"a list of length {len(inner)}", where))
    pairs = zip(data, inner, strict=True)
    return tuple(_value(item, of, joined(where, i)) for i, (item, of) in enumerate(pairs))


def _choice(data: Any, kind: Any, where: str) -> Any:
    _check_kind(data, str, where)
    if data not in get_args(kind):
        raise FaultsError(Fault(where, unknown("value", data, get_args(kind))))
    return data


def _number(data: Any, kind: Any, where: str) -> Any:
    _check_kind(data, kind, where)
    if not abs(data) < LARGEST:
        raise FaultsError(found(_short(data), f"a finite number below {LARGEST:g}", where))
    return kind(data)


def _plain(data: Any, kind: Any, where: str) -> Any:
    _check_kind(data, kind, where)
    return data


_READERS: Mapping[Any, Callable[[Any, Any, str], Any]] = {
    Mapping: _mapping,
    frozenset: _set,
    tuple: _tuple,
    Literal: _choice,
    float: _number,
    int: _number,
    str: _plain,
    bool: _plain,
}
"""What makes a value of plain data, by the stem of its hint."""


def _check_kind(data: Any, kind: type, where: str) -> None:
    """Raises FaultsError unless plain data are of a kind, and no more of it than anybody needs."""
    words, kinds = KINDS[kind]
    if type(data) not in kinds:
        raise FaultsError(found(_short(data), words, where))
    most = {str: LONGEST_TEXT, list: MOST_ITEMS, dict: MOST_ITEMS}.get(kind)
    if most is not None and len(data) > most:
        raise FaultsError(found(f"{kind_of(data)} of length {len(data):,}", f"at most {most:,}", where))


def _short(data: Any) -> str:
    return cut(brief(data), LONGEST_NAME)


def _is_needed(field: dataclasses.Field[Any]) -> bool:
    return field.default is field.default_factory is dataclasses.MISSING


@cache
def _fields(record: type) -> dict[str, Any]:
    """The hints of the fields of a dataclass, by name."""
    hints = get_type_hints(record)
    return {field.name: hints[field.name] for field in dataclasses.fields(record)}
