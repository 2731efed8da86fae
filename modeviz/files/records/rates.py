"""The tables of mount rates in files, in SI."""

from collections.abc import Iterable, Mapping
from typing import Self

from modeviz.files.records.fields import DampingRate, Rate, Ratio, RotationalRate
from modeviz.files.records.record import Record
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import OTHER_FIELDS, STIFFNESS_FIELDS, Bounds, MountRates, Rates


class OtherRatesRecord(Record, kw_only=True):
    """The rates of a mount but those along its axes."""

    rx: RotationalRate | None = None
    """About the axis along which it is fore-aft, those of lateral and of vertical."""
    ry: RotationalRate | None = None
    rz: RotationalRate | None = None
    damping_vertical: DampingRate | None = None
    damping_lateral: DampingRate | None = None
    damping_fore_aft: DampingRate | None = None

    @property
    def others(self) -> dict[str, float]:
        """Those of `OTHER_FIELDS` that are said."""
        found = {field: getattr(self, field) for field in OTHER_FIELDS}
        return {field: rate for field, rate in found.items() if rate is not None}


class RatesRecord(OtherRatesRecord, kw_only=True):
    """The rates of a mount."""

    vertical: Rate
    lateral: Rate
    fore_aft: Rate

    @classmethod
    def of(cls, rates: MountRates, tuned: Iterable[str] = ()) -> Self:
        """What is not along the axes is said if it is not zero, or one of those that are tuned."""
        others = {f: k for f, k in rates.of(OTHER_FIELDS).items() if k or f in tuned}
        return cls(**rates.of(STIFFNESS_FIELDS), **others)

    def build(self) -> MountRates:
        return MountRates(self.vertical, self.lateral, self.fore_aft, **self.others)


class RateSetRecord(RatesRecord, kw_only=True):
    """The rates of a mount, and its loss factor if that is not the group's own."""

    loss_factor: Ratio | None = None

    @classmethod
    def of(cls, rates: MountRates, tuned: Iterable[str] = ()) -> Self:
        others = {f: k for f, k in rates.of(OTHER_FIELDS).items() if k or f in tuned}
        return cls(**rates.of(STIFFNESS_FIELDS), **others, loss_factor=rates.loss_factor)

    def build_for(self, own: MountRates) -> MountRates:
        """The rates; what is not along the axes and not said is as in the group's own."""
        others = {**own.of(OTHER_FIELDS), **self.others}
        return MountRates(self.vertical, self.lateral, self.fore_aft, self.loss_factor, **others)


def rate_set(records: Mapping[str, RateSetRecord], groups: Iterable[MountGroup]) -> Rates:
    """The rates of mount groups, of which there may be none of that name."""
    own = {group.name: group.rates for group in groups}
    none = MountRates(0.0, 0.0, 0.0)
    return {name: record.build_for(own.get(name, none)) for name, record in records.items()}


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
