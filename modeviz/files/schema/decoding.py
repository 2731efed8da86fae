"""Plain data, as TOML or JSON give it, into checked records; errors name key, found and expected."""

import math
import re
import sys
from reprlib import repr as brief
from typing import Any, Literal, TypeVar, get_args, get_origin

import msgspec

from modeviz.errors import VehicleError, unknown
from modeviz.files.schema.hints import fields_of, plain

T = TypeVar("T")

LARGEST = 1e100
"""No quantity of a vehicle is beyond it."""

LONGEST = 10_000
"""Bits of a whole number that is written out."""

_WORDS = {
    "float": "a number",
    "int": "a whole number",
    "str": "text",
    "bool": "true or false",
    "array": "a list",
    "object": "a table",
}

_SYMBOLS = {">= 0.0": "of zero or more", "> 0.0": "above zero", ">=": "at least", "<=": "at most"}


def decode(data: Any, kind: type[T], where: str = "") -> T:
    """The data as a record of that kind.

    Args:
        data: dictionaries, lists, text and numbers.
        kind: a msgspec Struct, or a container of them.
        where: the key path of the data in its file.

    Raises:
        VehicleError: an unknown, missing or wrong value, or a number that is not finite.
    """
    try:
        _check_finite(data, where)
        return msgspec.convert(data, kind)
    except RecursionError:
        raise VehicleError(f"{where or 'the whole'}: tables in tables too deep to be read") from None
    except msgspec.ValidationError as error:
        message, _, path = str(error).partition(" - at `$")
        steps = re.findall(r"[^.\[\]`]+|\.\.\.", path)
        raise VehicleError(_explain(message, data, kind, steps, where)) from None


def unreadable(error: ValueError | RecursionError) -> str:
    """Why a text is not TOML or JSON, by the error of who read it."""
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    if isinstance(error, UnicodeDecodeError):
        return "its bytes are not UTF-8 text"
    if type(error) is ValueError:
        return f"it has a whole number of more than {sys.get_int_max_str_digits():,} digits"
    return str(error)


def joined(where: str, key: str | int) -> str:
    """The key path one step further in."""
    if isinstance(key, int):
        return f"{where}[{key}]"
    return f"{where}.{key}" if where else key


def _check_finite(data: Any, where: str) -> None:
    """Raises VehicleError if a number in the data is infinite, not a number or beyond any use."""
    if isinstance(data, dict):
        for key, value in data.items():
            _check_finite(value, joined(where, key))
    elif isinstance(data, list):
        for index, value in enumerate(data):
            _check_finite(value, joined(where, index))
    elif isinstance(data, int | float) and not abs(data) < LARGEST:
        raise VehicleError(
            f"{where}: found {_number(data)}, expected a finite number below {LARGEST:g}"
        )


def _number(value: float) -> str:
    """A number for people; Python refuses to write very long ones."""
    if isinstance(value, int) and value.bit_length() > LONGEST:
        return f"a number of {value.bit_length() * math.log10(2):,.0f} digits"
    return brief(value)


def _explain(message: str, data: Any, kind: Any, steps: list[str], where: str) -> str:
    """What msgspec says, in the user's words, with the value found and the names that exist."""
    for step in steps:
        key, kind = _step(data, kind, step)
        data, where = data[key], joined(where, key)
    field = re.search(r"field `(.*)`", message)
    if field and "unknown" in message:
        return f"{joined(where, field[1])}: " + unknown("key", field[1], fields_of(plain(kind)))
    if field:
        return f"{joined(where, field[1])}: missing"
    prefix = f"{where}: " if where else ""
    if get_origin(plain(kind)) is Literal:
        return prefix + unknown("value", str(data), map(str, get_args(plain(kind))))
    return f"{prefix}found {brief(data)}, expected {_in_words(message)}"


def _step(data: Any, kind: Any, step: str) -> tuple[str | int, Any]:
    """The next key of msgspec's path, and the type of what is there."""
    kind = plain(kind)
    if isinstance(data, list):
        return int(step), next(iter(get_args(kind)), kind)
    if get_origin(kind) is dict:  # of which msgspec does not say the key
        inner = get_args(kind)[1]
        return next(key for key, value in data.items() if not _fits(value, inner)), inner
    return step, fields_of(kind)[step]


def _fits(value: Any, kind: Any) -> bool:
    try:
        msgspec.convert(value, kind)
    except msgspec.ValidationError:
        return False
    return True


def _in_words(message: str) -> str:
    """What msgspec expected, "Expected `float` >= 0.0", for people."""
    wanted = re.sub(r", got .*|^Expected ", "", message).replace(" | null", "")
    for symbol, words in _SYMBOLS.items():
        wanted = wanted.replace(symbol, words)
    return re.sub(r"`(.*?)`", _kinds_in_words, wanted)


def _kinds_in_words(kinds: re.Match[str]) -> str:
    return " or ".join(_WORDS.get(kind, kind) for kind in kinds[1].split(" | "))
