"""The tables of a mount group that say how a mount is progressive, in SI."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar, Literal, Self

import numpy as np
from msgspec import Meta

from modeviz.errors import Fault, FaultsError, VehicleError, at_key
from modeviz.files.force_curves import read_force_curve
from modeviz.files.records.rates import SomeRatesRecord
from modeviz.files.records.record import Record, tuples
from modeviz.files.schema.quantities import Quantity
from modeviz.files.source import Source
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import DIRECTIONS, STIFFNESS_FIELDS, MountRates
from modeviz.vehicle.progressive import ForceCurve, not_rising

Points = Annotated[tuple[float, ...], Meta(min_length=2, max_length=10_000)]
UPWARD = dict(zip(DIRECTIONS, (2, 1, 0), strict=True))
"""Which of our axes a direction is along."""


class CurveRecord(Record, kw_only=True):
    """[[mount_group.curve]]: the force over the deflection along one direction."""

    depending: ClassVar[frozenset[str]] = frozenset(("file", "deflection", "force"))

    direction: Literal["vertical", "lateral", "fore-aft"]
    file: str | None = None
    """A file of the folder, .csv, with the columns deflection and force."""
    deflection: Annotated[Points, Quantity("length")] | None = None
    force: Annotated[Points, Quantity("force")] | None = None

    @classmethod
    def of(cls, direction: str, curve: ForceCurve) -> Self:
        points = {"deflection": curve.deflection, "force": curve.force}
        fields: dict[str, Any] = {"direction": direction, **{k: tuples(v) for k, v in points.items()}}
        return cls(**fields)

    def build(self, source: Source) -> ForceCurve:
        deflection, force = self._points(source)
        if source.conventions.axes[UPWARD[self.direction]].sum() < 0:
            deflection, force = -deflection[::-1], -force[::-1]
        return ForceCurve(deflection, force)

    def _points(self, source: Source) -> tuple[Floats, Floats]:
        """Deflections and forces along the file's axes, (n_points,) each."""
        if (self.file is None) == (self.deflection is None and self.force is None):
            raise VehicleError("expected either file, or deflection and force")
        if self.file is not None:
            with at_key("file"):
                path = source.path(self.file)
                return read_force_curve(path, source.conventions, source.note)
        if self.deflection is None or self.force is None or len(self.deflection) != len(self.force):
            counts = [len(points or ()) for points in (self.deflection, self.force)]
            words = f"found {counts[0]} deflections and {counts[1]} forces, expected as many"
            raise VehicleError(words)
        for key, values in (("deflection", self.deflection), ("force", self.force)):
            if (fault := not_rising(np.array(values))) is not None:
                words = "is not above the value before it; deflections and forces rise together"
                raise FaultsError(Fault(f"{key}[{fault}]", words))
        return np.array(self.deflection), np.array(self.force)


class GroupRatesRecord(SomeRatesRecord, kw_only=True):
    """[mount_group.rates]: the rates of its mounts, unloaded where they are progressive.

    One along an axis that is not given is that of its curve.
    """

    def build(self, curves: Mapping[str, ForceCurve], static_ratio: float) -> MountRates:
        """The rates: those given, or those with which the curves are as they stand."""
        found: list[float] = []
        for key, direction in zip(STIFFNESS_FIELDS, DIRECTIONS, strict=True):
            given: float | None = getattr(self, key)
            if given is None and direction not in curves:
                words = "missing; only a direction that has a [[mount_group.curve]] needs none"
                raise FaultsError(Fault(key, words))
            found.append(static_ratio * curves[direction].rate if given is None else given)
        return MountRates(*found, **self.others)
