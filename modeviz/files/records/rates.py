"""The tables of mount rates in files, in SI."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Self

from modeviz.errors import Fault, FaultsError, at_key
from modeviz.files.records.fields import DampingRate, Rate, Ratio, RotationalRate
from modeviz.files.records.record import Record
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import (
    OTHER_FIELDS,
    RATE_FIELDS,
    STIFFNESS_FIELDS,
    Bounds,
    MountRates,
    Rates,
)


class DampingRatesRecord(Record, kw_only=True):
    """The damping of a damper along its axes."""

    damping_vertical: DampingRate | None = None
    damping_lateral: DampingRate | None = None
    damping_fore_aft: DampingRate | None = None

    @property
    def said(self) -> dict[str, float]:
        """Those of `RATE_FIELDS` that are said."""
        found = {field: getattr(self, field, None) for field in RATE_FIELDS}
        return {field: rate for field, rate in found.items() if rate is not None}

    @property
    def others(self) -> dict[str, float]:
        """Those of `OTHER_FIELDS` that are said."""
        return {field: rate for field, rate in self.said.items() if field in OTHER_FIELDS}


class OtherRatesRecord(DampingRatesRecord, kw_only=True):
    """The rates of a mount but those along its axes."""

    rx: RotationalRate | None = None
    """About the axis along which it is fore-aft, those of lateral and of vertical."""
    ry: RotationalRate | None = None
    rz: RotationalRate | None = None


class SomeRatesRecord(OtherRatesRecord, kw_only=True):
    """The rates of a mount, of which any may be left out."""

    vertical: Rate | None = None
    lateral: Rate | None = None
    fore_aft: Rate | None = None

    @classmethod
    def of(cls, rates: MountRates, tuned: Iterable[str] = ()) -> Self:
        """What is not along the axes is said if it is not zero, or one of those that are tuned."""
        return cls(**rates.of(STIFFNESS_FIELDS), **_others(rates, tuned))


class RatesRecord(OtherRatesRecord, kw_only=True):
    """The rates of a mount."""

    vertical: Rate
    lateral: Rate
    fore_aft: Rate

    @classmethod
    def of(cls, rates: MountRates, tuned: Iterable[str] = ()) -> Self:
        """As `SomeRatesRecord.of`."""
        return cls(**rates.of(STIFFNESS_FIELDS), **_others(rates, tuned))

    def build(self) -> MountRates:
        return MountRates(self.vertical, self.lateral, self.fore_aft, **self.others)


class RateSetRecord(SomeRatesRecord, kw_only=True):
    """The rates of a mount, and its loss factor if that is not the group's own."""

    loss_factor: Ratio | None = None

    @classmethod
    def of(cls, rates: MountRates, tuned: Iterable[str] = ()) -> Self:
        record = super().of(rates, tuned)
        record.loss_factor = rates.loss_factor
        return record

    def build_for(self, group: MountGroup | None) -> MountRates:
        """The rates; what is not along the axes or not tuned, and not said, is as in the group's own.

        Raises:
            FaultsError: it does not say a rate along an axis that is tuned.
        """
        said = self.said
        tuned = set(STIFFNESS_FIELDS) & set(group.fields) if group else ()
        if missing := [f for f in STIFFNESS_FIELDS if f in tuned and f not in said]:
            raise FaultsError(*(Fault(f, "missing, expected a number") for f in missing))
        own = group.rates if group else MountRates(0.0, 0.0, 0.0)
        return MountRates(**{**own.of(RATE_FIELDS), **said}, loss_factor=self.loss_factor)


def rate_set(records: Mapping[str, RateSetRecord], groups: Iterable[MountGroup]) -> Rates:
    """The rates of mount groups, of which there may be none of that name.

    Raises:
        FaultsError: as `RateSetRecord.build_for`.
    """
    by_name = {group.name: group for group in groups}
    rates: dict[str, MountRates] = {}
    for name, record in records.items():
        with at_key(name):
            rates[name] = record.build_for(by_name.get(name))
    return rates


def _others(rates: MountRates, tuned: Iterable[str]) -> dict[str, float]:
    return {f: k for f, k in rates.of(OTHER_FIELDS).items() if k or f in tuned}


def bounds_of(softest: RatesRecord | None, stiffest: RatesRecord | None, usual: Bounds) -> Bounds:
    """The bounds that are said, the usual ones where they are not.

    Of what is not along the axes, one that is said alone is that to zero.
    """
    given = [record.others if record else {} for record in (softest, stiffest)]
    unsaid = [field for field in OTHER_FIELDS if not any(field in others for others in given)]
    low, high = (
        MountRates(
            **(record.build() if record else its).of(STIFFNESS_FIELDS),
            **{**its.of(unsaid), **others},
        )
        for record, its, others in zip((softest, stiffest), usual, given, strict=True)
    )
    return low, high


def both_said(softest: SomeRatesRecord, stiffest: SomeRatesRecord) -> Bounds:
    """The bounds of a problem: zero of a rate that neither says, which has those of its mounts.

    Raises:
        FaultsError: one says a rate along an axis that the other does not.
    """
    for field in STIFFNESS_FIELDS:
        for key, own, other in (("softest", softest, stiffest), ("stiffest", stiffest, softest)):
            if field in other.said and field not in own.said:
                raise FaultsError(Fault(f"{key}.{field}", "missing, expected a number"))
    none = MountRates(0.0, 0.0, 0.0)
    return replace(none, **softest.said), replace(none, **stiffest.said)
