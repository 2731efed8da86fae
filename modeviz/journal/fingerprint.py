"""By what a vehicle is known again: digests of its parts, the same on every processor."""

import hashlib
import json
from collections.abc import Iterable, Mapping, Set
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from functools import cached_property
from typing import Any

import numpy as np

from modeviz.errors import kind_of
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.vehicle import Vehicle

BITS = 30
"""Of a number that count, nine digits: two processors differ in the last of 53."""

NOISE_BITS = 45
"""What is smaller than the largest of an array by more is as good as zero."""

NOT_OF_IT = {"file", "notes", "remarks", "axes"}
"""Fields of a vehicle that say where it is from, or what there is to say of it."""


@dataclass(frozen=True)
class Fingerprint:
    """What a vehicle is made of."""

    parts: Mapping[str, str]
    """A digest of each part: "name", "body cab", "mount group C2"."""

    @cached_property
    def digest(self) -> str:
        """Of the whole vehicle."""
        return hashlib.sha256(self.text.encode()).hexdigest()

    @property
    def text(self) -> str:
        """It as JSON, in one order."""
        return json.dumps(dict(self.parts), sort_keys=True, ensure_ascii=False)

    @classmethod
    def of_text(cls, text: str) -> "Fingerprint":
        """Return the one that `text` was of; raises ValueError for another text."""
        parts = json.loads(text)
        if not isinstance(parts, dict) or not all(isinstance(each, str) for each in parts.values()):
            raise ValueError("found no digests of a vehicle's parts")
        return cls(parts)

    def changed_since(self, before: "Fingerprint") -> tuple[str, ...]:
        """Return the parts that are other than they were, or new: "new body cab", or gone."""
        now, then = self.parts, before.parts
        return (
            *(part for part in now if part in then and now[part] != then[part]),
            *(f"new {part}" for part in now if part not in then),
            *(f"no {part}" for part in then if part not in now),
        )


def fingerprint_of(vehicle: Vehicle) -> Fingerprint:
    """Return the fingerprint of a vehicle: of what is in it, not of where it lies.

    Numbers count to nine digits, the order of what has a name in a mapping does not.
    """
    parts: dict[str, list[Any]] = {}
    for field in fields(vehicle):
        if field.name not in NOT_OF_IT:
            for name, value in _parts(field.name, getattr(vehicle, field.name)):
                parts.setdefault(name, []).append(value)
    return Fingerprint({name: _digest(values) for name, values in parts.items()})


def _parts(name: str, value: Any) -> Iterable[tuple[str, Any]]:
    """The named things of a field one by one, else the field as a whole."""
    spoken = name.replace("_", " ")
    if isinstance(value, tuple) and all(hasattr(each, "name") for each in value):
        return [(f"{kind_of(each)} {each.name}", each) for each in value]
    if isinstance(value, Mapping):
        return [(f"{spoken} {key}", each) for key, each in value.items()]
    return [(spoken, value)]


def _digest(value: Any) -> str:
    found = hashlib.sha256()
    _feed(found, value)
    return found.hexdigest()[:32]


def _feed(found: "hashlib._Hash", value: Any) -> None:
    """Adds a value with its kind and length, so that no two are alike by how they are joined."""
    match value:
        case None | bool() | str() | bytes() | Enum():
            said = repr(value).encode()
            found.update(b"%d:%s" % (len(said), said))
        case np.ndarray() | np.generic() | float() | int() | complex():
            _feed_numbers(found, np.asarray(value))
        case Mapping():
            found.update(b"map%d" % len(value))
            for key in sorted(value, key=repr):
                _feed(found, key)
                _feed(found, value[key])
        case Set():
            found.update(b"set%d" % len(value))
            for each in sorted(value, key=repr):
                _feed(found, each)
        case tuple() | list():
            found.update(b"row%d" % len(value))
            for each in value:
                _feed(found, each)
        case _ if is_dataclass(value):
            _feed(found, type(value).__name__)
            for field in fields(value):
                _feed(found, field.name)
                _feed(found, getattr(value, field.name))
        case _:
            raise TypeError(f"no fingerprint of a {type(value).__name__}")


def _feed_numbers(found: "hashlib._Hash", numbers: np.ndarray) -> None:
    found.update(f"numbers{numbers.shape}".encode())
    if np.iscomplexobj(numbers):
        numbers = np.stack([np.real(numbers), np.imag(numbers)])
    mantissa, exponent = _rounded(np.asarray(numbers, np.float64))
    found.update(np.ascontiguousarray(mantissa, "<i8").tobytes())
    found.update(np.ascontiguousarray(exponent, "<i4").tobytes())


def _rounded(numbers: Floats) -> tuple[np.ndarray, np.ndarray]:
    """Numbers to `BITS` as whole numbers and powers of two, by steps that are exact everywhere."""
    mantissa, exponent = np.frexp(numbers)
    whole = np.rint(np.ldexp(mantissa, BITS))
    carried = np.abs(whole) == 2.0**BITS  # 0.9999999999 and 1 are as good as the same
    whole, exponent = np.where(carried, whole / 2, whole), exponent + carried
    is_finite = np.isfinite(numbers)
    largest = np.max(exponent, where=is_finite & (numbers != 0), initial=-5000)
    is_noise = is_finite & ((whole == 0) | (exponent < largest - NOISE_BITS))
    code = np.where(
        is_finite, whole, np.where(np.isnan(numbers), 2.0**40, np.copysign(2.0**41, numbers))
    )
    return np.where(is_noise, 0.0, code).astype(np.int64), np.where(is_noise | ~is_finite, 0, exponent)
