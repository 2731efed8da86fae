"""The base of all records of `vehicle.toml`."""

from collections.abc import Callable, Iterable, Mapping
from typing import Any, ClassVar, TypeVar

import msgspec
import numpy as np

from modeviz.errors import Fault, FaultsError, at_key
from modeviz.files.schema.quantities import Vector, check_annotations
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import DIRECTIONS

R = TypeVar("R")
P = TypeVar("P")


class Record(msgspec.Struct, forbid_unknown_fields=True, omit_defaults=True):
    """A table of a file, whose numbers have their quantities at its fields."""

    depending: ClassVar[frozenset[str]] = frozenset()
    """Keys without one of which it may not be what it was meant to be, though each can be left out."""

    def __init_subclass__(cls, **options: Any) -> None:
        """Raises TypeError for a field of which nothing is said, see `check_annotations`."""
        super().__init_subclass__(**options)
        check_annotations(cls)


class FileRecord(Record, kw_only=True):
    """A whole file."""

    units: dict[str, str] = msgspec.field(default_factory=dict)
    """Of its numbers, quantity to unit."""


def built(records: Iterable[R], key: str, build: Callable[[R], P]) -> tuple[P, ...]:
    """The values that records build.

    Raises:
        FaultsError: some build none, each of which it names by its table.
    """
    parts: list[P] = []
    faults: list[Fault] = []
    for index, record in enumerate(records):
        try:
            with at_key(f"{key}[{index}]"):
                parts.append(build(record))
        except FaultsError as error:
            faults += error.faults
    if faults:
        raise FaultsError(*faults)
    return tuple(parts)


def said(kind: type[Record], fields: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a record that differ from its defaults."""
    default = {field.name: field.default for field in msgspec.structs.fields(kind)}
    return {key: value for key, value in fields.items() if value != default[key]}


def tuples(value: Any) -> Any:
    """An array as tuples, whatever else as it is."""
    if isinstance(value, np.ndarray):
        return tuple(map(tuples, value)) if value.ndim else float(value)
    return float(value) if isinstance(value, np.floating) else value


def vector_along(direction: str | Vector) -> Floats:
    """A direction, of any length, in our axes: itself, or the one that a word of `DIRECTIONS` means."""
    if isinstance(direction, str):
        return np.eye(3)[2 - DIRECTIONS.index(direction)]
    return np.array(direction)
