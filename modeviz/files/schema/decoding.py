"""Plain data, as TOML or JSON give it, into checked records; errors name key, found and expected."""

import math
import sys
from reprlib import repr as brief
from typing import Any, TypeVar

import msgspec

from modeviz.errors import Fault, FaultsError
from modeviz.files.schema.hints import joined
from modeviz.files.schema.mismatches import found, mismatch

T = TypeVar("T")

LARGEST = 1e100
"""No quantity of a vehicle is beyond it."""

LONGEST = 10_000
"""Bits of a whole number that is written out."""


def decode(data: Any, kind: type[T], where: str = "") -> T:
    """The data as a record of that kind.

    Args:
        data: dictionaries, lists, text and numbers.
        kind: a msgspec Struct, or a container of them.
        where: the key path of the data in its file.

    Raises:
        FaultsError: an unknown, missing or wrong value, or a number that is not finite.
    """
    try:
        _check_finite(data, where)
        return msgspec.convert(data, kind)
    except RecursionError:
        words = "tables in tables too deep to be read"
        raise FaultsError(Fault(where or "the whole", words)) from None
    except msgspec.ValidationError:
        raise FaultsError(mismatch(data, kind, where)) from None


def unreadable(error: ValueError | RecursionError) -> str:
    """The reason why a text is not TOML or JSON, by the error of who read it."""
    if isinstance(error, RecursionError):
        return "it is nested too deeply"
    if isinstance(error, UnicodeDecodeError):
        return "its bytes are not UTF-8 text"
    if type(error) is ValueError:
        return f"it has a whole number of more than {sys.get_int_max_str_digits():,} digits"
    return str(error)


def _check_finite(data: Any, where: str) -> None:
    """Raises VehicleError if a number in the data is infinite, not a number or beyond any use."""
    if isinstance(data, dict):
        for key, value in data.items():
            _check_finite(value, joined(where, key))
    elif isinstance(data, list):
        for index, value in enumerate(data):
            _check_finite(value, joined(where, index))
    elif isinstance(data, int | float) and not abs(data) < LARGEST:
        raise FaultsError(found(_number(data), f"a finite number below {LARGEST:g}", where))


def _number(value: float) -> str:
    """A number for people; Python refuses to write very long ones."""
    if isinstance(value, int) and value.bit_length() > LONGEST:
        return f"a number of {value.bit_length() * math.log10(2):,.0f} digits"
    return brief(value)
