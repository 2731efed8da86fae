"""What all records of `vehicle.toml` are made of."""

from collections.abc import Callable, Iterable
from typing import Annotated, Self, TypeVar

import msgspec
from msgspec import Meta

from modeviz.errors import located
from modeviz.vehicle.connections import MountRates

Name = Annotated[str, Meta(min_length=1)]
Positive = Annotated[float, Meta(gt=0)]
NonNegative = Annotated[float, Meta(ge=0)]

R = TypeVar("R")
P = TypeVar("P")


class Record(msgspec.Struct, forbid_unknown_fields=True, omit_defaults=True):
    """A table of the file."""


class RatesRecord(Record, kw_only=True):
    """The rates of a mount."""

    vertical: NonNegative
    lateral: NonNegative
    fore_aft: NonNegative

    @classmethod
    def of(cls, rates: MountRates) -> Self:
        return cls(vertical=rates.vertical, lateral=rates.lateral, fore_aft=rates.fore_aft)

    def build(self) -> MountRates:
        return MountRates(self.vertical, self.lateral, self.fore_aft)


def built(records: Iterable[R], key: str, build: Callable[[R], P]) -> tuple[P, ...]:
    """What each record builds; an error names the record."""
    parts = []
    for index, record in enumerate(records):
        with located(f"{key}[{index}]"):
            parts.append(build(record))
    return tuple(parts)
