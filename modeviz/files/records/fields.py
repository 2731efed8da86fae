"""Types of the fields of records: numbers with their bounds and quantities, and how they turn."""

from functools import partial
from typing import Annotated, Literal

from msgspec import Meta

from modeviz.files.schema.axes import (
    Turns,
    turn_direction,
    turn_ends,
    turn_frame,
    turn_inertia,
    turn_motions,
    turn_order,
    turn_range,
    turn_rates,
    turn_vectors,
)
from modeviz.files.schema.quantities import UNITLESS, FixedUnit, Quantity, Vector

Name = Annotated[str, Meta(min_length=1)]

Ratio = Annotated[float, Meta(ge=0), UNITLESS]
"""A loss factor, a fraction of critical damping, a weight."""
RatioLimits = Annotated[tuple[float, float], UNITLESS]
Frequency = Annotated[float, Meta(gt=0), FixedUnit("Hz")]
LowestFrequency = Annotated[float, Meta(ge=0), FixedUnit("Hz")]

Speed = Annotated[float, Meta(gt=0), Quantity("speed")]
RoadLevel = Annotated[float, Meta(gt=0), Quantity("roughness")]
TrackWidth = Annotated[float, Meta(ge=0), Quantity("length")]
Mass = Annotated[float, Meta(gt=0), Quantity("mass")]
Length = Annotated[float, Quantity("length")]
Position = Annotated[Vector, Quantity("length"), Turns(turn_vectors)]
Place = Annotated[
    tuple[float | Vector, ...],
    Meta(min_length=2, max_length=3),
    Quantity("length"),
    Turns(turn_vectors),
]
"""x, y, z; or two of those, where the ends of a connection are at different places."""
Ends = Annotated[tuple[Vector, Vector], Quantity("length"), Turns(turn_vectors)]
Inertia = Annotated[
    tuple[float, ...], Meta(min_length=3, max_length=6), Quantity("inertia"), Turns(turn_inertia)
]

Rate = Annotated[float, Meta(ge=0), Quantity("stiffness")]
RotationalRate = Annotated[float, Meta(ge=0), Quantity("rotational_stiffness")]
DampingRate = Annotated[float, Meta(ge=0), Quantity("damping")]
Stiffness = Annotated[Vector, Quantity("stiffness"), Turns(turn_rates)]
RotationalStiffness = Annotated[Vector, Quantity("rotational_stiffness"), Turns(turn_rates)]
Damping = Annotated[Vector, Quantity("damping"), Turns(turn_rates)]
RotationalDamping = Annotated[Vector, Quantity("rotational_damping"), Turns(turn_rates)]

ForceVector = Annotated[Vector, Quantity("force"), Turns(turn_vectors)]
Torque = Annotated[float, Meta(ge=0), Quantity("torque")]
TorqueVector = Annotated[Vector, Quantity("torque"), Turns(turn_vectors)]
LoadInG = Annotated[Vector, FixedUnit("g"), Turns(turn_vectors)]

Range = tuple[float, float]
VerticalRange = Annotated[Range, Quantity("length"), Turns(partial(turn_range, 2))]
LateralRange = Annotated[Range, Quantity("length"), Turns(partial(turn_range, 1))]
ForeAftRange = Annotated[Range, Quantity("length"), Turns(partial(turn_range, 0))]
"""The least and the most along a local axis."""

ForceAmplitude = Annotated[float, Meta(ge=0), Quantity("force")]
Displacement = Annotated[float, Meta(ge=0), Quantity("length")]
Acceleration = Annotated[float, Meta(ge=0), Quantity("acceleration")]
WheelLoadAmplitude = Annotated[
    float,
    Meta(ge=0),
    Quantity(
        by_kind={"unbalance": "unbalance", "radial force": "force", "lateral force": "force"},
    ),
]
ForcePsd = Annotated[str, Quantity("force")]
DisplacementPsd = Annotated[str, Quantity("length")]
AccelerationPsd = Annotated[str, Quantity("acceleration")]
"""A file of the folder, .csv, with the PSD of that."""

Direction = Annotated[
    Literal["vertical", "lateral", "fore-aft"] | Vector, UNITLESS, Turns(turn_direction)
]
"""One of `DIRECTIONS`, or a vector along which something points, of any length."""
Frame = Annotated[tuple[Vector, ...], Meta(min_length=2, max_length=3), UNITLESS, Turns(turn_frame)]
"""Local axes as rows: all three, or x and y."""
Angles = Annotated[Vector, Quantity("angle"), Turns(turn_vectors)]
"""About x, y and z."""
AngleEnds = Annotated[tuple[Vector, Vector], Quantity("angle"), Turns(turn_ends)]
OffsetEnds = Annotated[tuple[Vector, Vector], Quantity("length"), Turns(turn_ends)]
"""The least and the most about, or along, x, y and z."""
AngleOrder = Annotated[str, Turns(turn_order)]
Motions = Annotated[bool | tuple[str, ...], Turns(turn_motions)]
"""Some of `MOTIONS`, or whether all."""
