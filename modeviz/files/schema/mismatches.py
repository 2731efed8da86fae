"""What plain data have that does not fit a type: where it is, what is there, what is right.

msgspec only says whether a value fits; the words and the path of its errors are no part of its
contract, and are not looked at. The place is found by asking again for the parts of what does not fit,
and what would be right stands in the type hints: all that for data that are refused only.

What else was weighed, on the records of vehicle.toml and a file of 4 500 tables, in time of one core:
msgspec reads it in 0.8 ms; its import, which viser needs too, takes 25 ms. pydantic takes 4 ms, 75 ms
to import, 21 ms for these types and 10 MB; strict it refuses TOML's lists where tuples are meant, lax
it takes "12" and true for numbers; of unions it gives an error for each branch, with the branch in the
path. cattrs takes "12" for a number too, and has neither bounds nor, without hooks, these unions.
"""

import operator
from collections.abc import Callable, Iterator, Mapping
from reprlib import repr as brief
from typing import Any, Literal, get_args, get_origin

import msgspec
from msgspec import Meta

from modeviz.errors import LONGEST_NAME, Fault, cut, unknown
from modeviz.files.schema.hints import alternatives, annotation, fields_of, is_record, joined, plain

KINDS: Mapping[Any, tuple[str, tuple[type, ...]]] = {
    float: ("a number", (int, float)),
    int: ("a whole number", (int,)),
    str: ("text", (str,)),
    bool: ("true or false", (bool,)),
    list: ("a list", (list,)),
    tuple: ("a list", (list,)),
    dict: ("a table", (dict,)),
}
"""What a type is for people, and what plain data have for it."""

Bounds = Mapping[str, tuple[Callable[[float, float], bool], str]]
"""By the attribute of `Meta`: when a bound holds, and how it is said."""

BOUNDS: Bounds = {
    "gt": (operator.gt, "above {}"),
    "ge": (operator.ge, "at least {}"),
    "lt": (operator.lt, "below {}"),
    "le": (operator.le, "at most {}"),
}
LENGTHS: Bounds = {
    "min_length": (operator.ge, "of length at least {}"),
    "max_length": (operator.le, "of length at most {}"),
}


AT_ONCE = 1000
"""Items of a list that are asked for together, since lists can have millions."""


def mismatch(data: Any, hint: Any, where: str = "") -> Fault:
    """The first value that does not fit.

    Args:
        data: dictionaries, lists, text and numbers, which do not fit.
        hint: the type that they should fit.
        where: the key path of the data.
    """
    meant = next((kind for kind in alternatives(hint) if type(data) in _plain_types(kind)), None)
    if meant is None:
        return found(_brief(data), _in_words(hint), where)
    kind = plain(meant)
    if is_record(kind):
        return next(faults_of(data, kind, where))
    if get_origin(kind) is Literal and len(get_args(kind)) > 1:
        return Fault(where, unknown("value", str(data), map(str, get_args(kind))))
    if bound := _broken_bound(data, meant):
        return found(_brief(data), f"{_word(kind)} {bound}", where)
    for key, value, inner in _parts(data, kind):
        if not _fits(value, inner):
            return mismatch(value, inner, joined(where, key))
    return found(_brief(data), _in_words(hint), where)


def _brief(data: Any) -> str:
    """A value in a sentence; of lists within lists `reprlib` leaves many."""
    return cut(brief(data), LONGEST_NAME)


def found(value: str, expected: str, where: str) -> Fault:
    """The fault of a value that is wrong."""
    return Fault(where, f"found {value}, expected {expected}")


def faults_of(table: dict[str, Any], record: Any, where: str = "") -> Iterator[Fault]:
    """What is wrong with the keys of a table: those that are wrong, then those that are not there.

    Args:
        table: plain data.
        record: the type that it should be.
        where: its key path.
    """
    hints = fields_of(record)
    for key, value in table.items():
        if key not in hints and record.__struct_config__.forbid_unknown_fields:
            yield Fault(joined(where, key), unknown("key", key, hints))
        if key in hints and not _fits(value, hints[key]):
            yield mismatch(value, hints[key], joined(where, key))
    for field in msgspec.structs.fields(record):
        if field.required and (missing := field.encode_name) not in table:
            yield Fault(joined(where, missing), f"missing, expected {_in_words(hints[missing])}")


def _parts(data: Any, kind: Any) -> Iterator[tuple[str | int, Any, Any]]:
    """Key, value and type of items of a table or a list, of those at least that do not fit."""
    inner = get_args(kind)
    if isinstance(data, dict):
        yield from ((key, value, inner[1]) for key, value in data.items())
    elif _is_fixed(kind):
        yield from ((i, *pair) for i, pair in enumerate(zip(data, inner, strict=True)))
    elif isinstance(data, list):
        for start in range(0, len(data), AT_ONCE):
            some = data[start : start + AT_ONCE]
            if not _fits(some, list[inner[0]]):
                yield from ((start + i, value, inner[0]) for i, value in enumerate(some))


def _fits(value: Any, hint: Any) -> bool:
    try:
        msgspec.convert(value, hint)
    except msgspec.ValidationError:
        return False
    return True


def _broken_bound(value: Any, hint: Any) -> str | None:
    """Words for the bound of its type that a value breaks."""
    if _is_fixed(plain(hint)):
        length = len(get_args(plain(hint)))
        return f"of length {length}" if len(value) != length else None
    meta = annotation(hint, Meta) or Meta()
    bounds, size = (LENGTHS, len(value)) if isinstance(value, str | list) else (BOUNDS, value)
    for name, (holds, words) in bounds.items():
        limit = getattr(meta, name)
        if limit is not None and not holds(size, limit):
            return words.format(limit or "zero").replace("at least zero", "of zero or more")
    return None


def _is_fixed(kind: Any) -> bool:
    """Whether a type is a list of so many items."""
    return get_origin(kind) is tuple and Ellipsis not in get_args(kind)


def _plain_types(hint: Any) -> tuple[type, ...]:
    """The types that plain data have for one type."""
    kind = plain(hint)
    if get_origin(kind) is Literal:
        return tuple(map(type, get_args(kind)))
    return KINDS[_stem(kind)][1]


def _in_words(hint: Any) -> str:
    """All that a value may be: "a number or a list"."""
    *others, last = [word for kind in alternatives(hint) for word in _words(plain(kind))]
    return f"{', '.join(others)} or {last}" if others else last


def _words(kind: Any) -> list[str]:
    return [*map(repr, get_args(kind))] if get_origin(kind) is Literal else [_word(kind)]


def _word(kind: Any) -> str:
    return KINDS[_stem(kind)][0]


def _stem(kind: Any) -> Any:
    """The key of a type in `KINDS`."""
    return dict if is_record(kind) else get_origin(kind) or kind
