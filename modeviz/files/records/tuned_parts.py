"""The tables of `vehicle.toml` that make springs and dampers tunable, in SI."""

from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import ClassVar, Self

import msgspec

from modeviz.errors import VehicleError, listed, quoted
from modeviz.files.records.fields import Name
from modeviz.files.records.rates import DampingRatesRecord, SomeRatesRecord
from modeviz.files.records.record import Record
from modeviz.vehicle.connections import Connection
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Bounds, MountRates
from modeviz.vehicle.tuned_parts import rates_of, tuned_group, usual_bounds_of


class TunedPartsRecord(Record, kw_only=True):
    """What [[damper_group]] and [[spring_group]] have in common."""

    part: ClassVar[str]
    """The key of the tables of these."""
    name: Name
    """The group of the dampers or springs that it tunes."""
    label: str = ""
    """The name, if not given."""

    @classmethod
    def of(cls, group: MountGroup) -> Self:
        bounds = zip(("softest", "stiffest"), group.bounds, strict=True)
        said = {key: rates.of(group.fields) for key, rates in bounds}
        return msgspec.convert({"name": group.name, "label": group.label, **said}, cls)

    def build(self, parts: Sequence[Connection]) -> MountGroup:
        """The group of those of some springs or dampers that have its name.

        Raises:
            VehicleError: there are none, or as `tuned_group`.
        """
        own = [part for part in parts if part.group == self.name]
        if not own:
            groups = dict.fromkeys(part.group for part in parts)
            there = f"; there are {listed(groups)}" if groups else ", of which there is none"
            raise VehicleError(
                f"name: found {quoted(self.name)}, expected the group of some [[{self.part}]]{there}"
            )
        return tuned_group(own, self._bounds(rates_of(own[0])), self.label)

    def _bounds(self, rates: MountRates) -> Bounds:
        """The bounds that are said, the usual ones where one of them is not or none is said."""
        usual = usual_bounds_of(rates)
        bounds: Iterable[DampingRatesRecord | None] = (
            getattr(self, k) for k in ("softest", "stiffest")
        )
        given = [record.said if record else {} for record in bounds]
        if not any(given):
            return usual
        tuned = {field for said in given for field in said}
        low, high = (
            replace(rates, **{**its.of(tuned), **said}) for its, said in zip(usual, given, strict=True)
        )
        return low, high


class DamperGroupRecord(TunedPartsRecord, kw_only=True):
    """[[damper_group]]: makes the dampers of a group tunable."""

    part: ClassVar[str] = "damper"
    softest: DampingRatesRecord | None = None
    stiffest: DampingRatesRecord | None = None


class SpringGroupRecord(TunedPartsRecord, kw_only=True):
    """[[spring_group]]: makes the springs of a group tunable."""

    part: ClassVar[str] = "spring"
    softest: SomeRatesRecord | None = None
    stiffest: SomeRatesRecord | None = None
