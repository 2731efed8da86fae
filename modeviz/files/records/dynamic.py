"""The tables of `vehicle.toml` that say how a mount's rates depend on frequency, in SI."""

from typing import Annotated, ClassVar, Self

import numpy as np
from msgspec import Meta

from modeviz.errors import VehicleError, at_key
from modeviz.files.rate_tables import read_rate_table
from modeviz.files.records.fields import DampingRate, Frequency, Length, Mass, Rate, Ratio
from modeviz.files.records.record import Record, tuples
from modeviz.files.schema.axes import Turns, turn_rates
from modeviz.files.schema.quantities import UNITLESS, Vector
from modeviz.files.source import Source
from modeviz.vehicle.dynamic_rates import (
    DynamicRates,
    HydraulicRates,
    RateTable,
    ThreeParameterRates,
)

Stiffening = Annotated[Vector, UNITLESS, Turns(turn_rates)]
AreaRatio = Annotated[float, Meta(gt=0), UNITLESS]


class ThreeParameterRecord(Record, kw_only=True):
    """[mount_group.dynamic.three_parameter]."""

    stiffening: Stiffening
    """Along the local x, y, z: the spring in series with the damper in parts of the other."""
    corner: Frequency
    """Hz: where that damper is as stiff as its spring."""


class HydraulicRecord(Record, kw_only=True):
    """[mount_group.dynamic.hydraulic]: filled with fluid, which acts along the local z."""

    rubber: Rate
    rubber_loss: Ratio = 0.0
    bulge_stiffness: Rate
    track_mass: Mass
    track_damping: DampingRate
    area_ratio: AreaRatio
    """Of the piston to the inertia track."""


class DynamicRecord(Record, kw_only=True):
    """[mount_group.dynamic]: how the rates along the axes of its mounts depend on frequency."""

    depending: ClassVar[frozenset[str]] = frozenset(("file", "three_parameter", "hydraulic"))

    reference_frequency: Frequency
    """Hz: at which they are the rates of the group."""
    file: str | None = None
    """A file of the folder, .csv, see `rate_tables`."""
    amplitude: Length | None = None
    """Whose lines are taken of a table of several."""
    three_parameter: ThreeParameterRecord | None = None
    hydraulic: HydraulicRecord | None = None

    @classmethod
    def of(cls, dynamic: DynamicRates, file: str) -> Self:
        record = cls(reference_frequency=dynamic.reference_hz)
        match dynamic:
            case ThreeParameterRates():
                record.three_parameter = ThreeParameterRecord(
                    stiffening=tuples(dynamic.stiffening), corner=dynamic.corner_hz
                )
            case HydraulicRates():
                keys = HydraulicRecord.__struct_fields__
                record.hydraulic = HydraulicRecord(**{key: getattr(dynamic, key) for key in keys})
            case _:
                record.file = file
        return record

    def build(self, source: Source) -> DynamicRates:
        """Return how rates depend on frequency; raises VehicleError."""
        given = [key for key in sorted(self.depending) if getattr(self, key) is not None]
        if len(given) != 1:
            found = " and ".join(given) or "none"
            raise VehicleError(f"found {found}, expected one of file, hydraulic, three_parameter")
        if self.amplitude is not None and self.file is None:
            raise VehicleError("amplitude: does nothing without file, leave it out")
        if self.file is not None:
            return self._of_file(source, self.file)
        if self.hydraulic is not None:
            keys = HydraulicRecord.__struct_fields__
            with at_key("hydraulic"):
                return HydraulicRates(
                    reference_hz=self.reference_frequency,
                    **{key: getattr(self.hydraulic, key) for key in keys},
                )
        assert self.three_parameter is not None
        with at_key("three_parameter"):
            return ThreeParameterRates(
                reference_hz=self.reference_frequency,
                stiffening=np.array(self.three_parameter.stiffening),
                corner_hz=self.three_parameter.corner,
            )

    def _of_file(self, source: Source, file: str) -> RateTable:
        with at_key("file"):
            path = source.path(file)
            return source.once(
                (path, "rates", self.reference_frequency, self.amplitude),
                lambda: read_rate_table(
                    path,
                    self.reference_frequency,
                    self.amplitude,
                    source.conventions,
                    source.note,
                ),
            )
