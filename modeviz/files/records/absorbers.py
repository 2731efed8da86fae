"""The table of `vehicle.toml` that is an absorber, in SI."""

from typing import Annotated, Self

import numpy as np

from modeviz.files.records.connections import VEHICLE_AXES, frame
from modeviz.files.records.fields import (
    AngleOrder,
    Angles,
    Frame,
    Frequency,
    Mass,
    Name,
    Position,
    Ratio,
)
from modeviz.files.records.record import Record, said, tuples
from modeviz.files.schema.quantities import FixedUnit
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.local_axes import angles_of_axes


class AbsorberRecord(Record, kw_only=True):
    """[[absorber]]."""

    name: Name
    body: str
    at: Position
    mass: Mass
    frequency: Frequency
    """Hz, of the mass on its spring, were the body still."""
    damping_ratio: Ratio = 0.0
    loss_factor: Ratio = 0.0
    directions: tuple[str, ...] = ("vertical",)
    axes: Frame = VEHICLE_AXES
    """Of its directions, as those of a mount."""
    angles: Angles | None = None
    angle_order: AngleOrder = ""
    frequency_range: Annotated[tuple[float, float], FixedUnit("Hz")] | None = None
    """Within which it can be tuned; half its frequency to twice it, if not given."""
    damping_range: tuple[Ratio, Ratio] | None = None
    """Likewise its damping ratio; a quarter of it to four times it, if not given."""

    @classmethod
    def of(cls, absorber: Absorber) -> Self:
        fields = {
            "name": absorber.name,
            "body": absorber.body,
            "at": absorber.position,
            "mass": absorber.mass,
            "frequency": absorber.frequency_hz,
            "damping_ratio": absorber.damping_ratio,
            "loss_factor": absorber.loss_factor,
            "directions": absorber.directions,
            "axes": tuples(absorber.axes),
            "frequency_range": absorber.frequency_range,
            "damping_range": absorber.damping_range,
        }
        return cls(**said(cls, fields))

    def build(self) -> Absorber:
        x, y, z = np.array(self.at).tolist()
        about_x, about_y, about_z = self._angles().tolist()
        return Absorber(
            self.name,
            self.body,
            (x, y, z),
            self.mass,
            self.frequency,
            self.damping_ratio,
            self.loss_factor,
            self.directions,
            (about_x, about_y, about_z),
            frequency_range=self.frequency_range,
            damping_range=self.damping_range,
        )

    def _angles(self) -> Floats:
        """By which its directions are turned out of the vehicle's, about x, then y, then z, rad."""
        return angles_of_axes(frame(self.axes, self.angles, self.angle_order))
