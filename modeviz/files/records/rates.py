"""The tables of mount rates in files, in SI."""

from dataclasses import asdict, replace
from typing import Self

from modeviz.files.records.fields import (
    Rate,
    Ratio,
)
from modeviz.files.records.record import Record
from modeviz.vehicle.mount_rates import MountRates


class RatesRecord(Record, kw_only=True):
    """The rates of a mount."""

    vertical: Rate
    lateral: Rate
    fore_aft: Rate

    @classmethod
    def of(cls, rates: MountRates) -> Self:
        return cls(vertical=rates.vertical, lateral=rates.lateral, fore_aft=rates.fore_aft)

    def build(self) -> MountRates:
        return MountRates(self.vertical, self.lateral, self.fore_aft)


class RateSetRecord(RatesRecord, kw_only=True):
    """The rates of a mount, and its loss factor if that is not the group's own."""

    loss_factor: Ratio | None = None

    @classmethod
    def of(cls, rates: MountRates) -> Self:
        return cls(**asdict(rates))

    def build(self) -> MountRates:
        return replace(super().build(), loss_factor=self.loss_factor)
