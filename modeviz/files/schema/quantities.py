"""What the numbers of a key are: a quantity, which has a unit, and turns with the axes."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Annotated, Any, Literal, get_args

from msgspec import Meta

from modeviz.files.schema.axes import (
    turn_direction,
    turn_frame,
    turn_inertia,
    turn_motions,
    turn_rates,
    turn_vectors,
)
from modeviz.files.schema.hints import annotation, fields_of, joined, plain
from modeviz.vehicle.arrays import Floats

Vector = tuple[float, float, float]


@dataclass(frozen=True, eq=False)
class Quantity:
    """The annotation of a field whose numbers have a unit or depend on the axes."""

    name: str = ""
    """A key of `units`; empty for what has no unit."""
    turn: Callable[[Any, Floats], Any] | None = None
    """The value in other axes; None for what is the same in all."""
    by_kind: Mapping[str, str] = field(default_factory=dict)
    """The name, where it depends on what the table has as its `kind`."""

    def named(self, table: Mapping[str, Any]) -> str:
        """What the quantity is in a table."""
        return self.by_kind.get(str(table.get("kind")), self.name)


Speed = Annotated[float, Meta(gt=0), Quantity("speed")]
Mass = Annotated[float, Meta(gt=0), Quantity("mass")]
Length = Annotated[float, Quantity("length")]
Position = Annotated[Vector, Quantity("length", turn_vectors)]
Place = Annotated[
    tuple[float | Vector, ...],
    Meta(min_length=2, max_length=3),
    Quantity("length", turn_vectors),
]
"""x, y, z; or two of those, where the ends of a connection are at different places."""
Ends = Annotated[tuple[Vector, Vector], Quantity("length", turn_vectors)]
Inertia = Annotated[
    tuple[float, ...], Meta(min_length=3, max_length=6), Quantity("inertia", turn_inertia)
]
Rate = Annotated[float, Meta(ge=0), Quantity("stiffness")]
Stiffness = Annotated[Vector, Quantity("stiffness", turn_rates)]
RotationalStiffness = Annotated[Vector, Quantity("rotational_stiffness", turn_rates)]
DampingRate = Annotated[float, Meta(ge=0), Quantity("damping")]
Damping = Annotated[Vector, Quantity("damping", turn_rates)]
RotationalDamping = Annotated[Vector, Quantity("rotational_damping", turn_rates)]
ForceAmplitude = Annotated[float, Meta(ge=0), Quantity("force")]
Displacement = Annotated[float, Meta(ge=0), Quantity("length")]
Acceleration = Annotated[float, Meta(ge=0), Quantity("acceleration")]
Direction = Annotated[
    Literal["vertical", "lateral", "fore-aft"] | Vector, Quantity(turn=turn_direction)
]
"""One of `DIRECTIONS`, or a vector along which something points, of any length."""
Frame = Annotated[tuple[Vector, Vector, Vector], Quantity(turn=turn_frame)]
"""Local axes as rows."""
Motions = Annotated[bool | tuple[str, ...], Quantity(turn=turn_motions)]
"""Some of `MOTIONS`, or whether all."""
Amplitude = Annotated[
    float,
    Meta(ge=0),
    Quantity(
        by_kind={"unbalance": "unbalance", "radial force": "force", "lateral force": "force"},
    ),
]


Change = Callable[[Any, Quantity, Mapping[str, Any], str], Any]
"""What becomes of a value that is a quantity: the value, what it is, its table, and its key path."""


def turned(data: Any, kind: Any, T: Floats) -> Any:
    """The content of a file of that kind, with everything that depends on the axes in others."""

    def change(value: Any, quantity: Quantity, _: Mapping[str, Any], where: str) -> Any:
        return value if quantity.turn is None or value is None else quantity.turn(value, T)

    return each_quantity(data, kind, change)


def each_quantity(data: Any, kind: Any, change: Change, where: str = "") -> Any:
    """The data with what `change` makes of it in place of each value that is a quantity.

    Args:
        data: plain data that `decode` accepts as that kind.
        kind: a record, or a container of records.
        change: see `Change`.
        where: the key path of the data.
    """
    kind = plain(kind)
    if isinstance(data, dict) and hasattr(kind, "__struct_fields__"):
        hints = fields_of(kind)
        return {
            key: change(value, quantity, data, joined(where, key))
            if (quantity := annotation(hints[key], Quantity))
            else each_quantity(value, hints[key], change, joined(where, key))
            for key, value in data.items()
        }
    inner = get_args(kind) or (Any,)
    if isinstance(data, dict):
        return {
            key: each_quantity(value, inner[-1], change, joined(where, key))
            for key, value in data.items()
        }
    if isinstance(data, list | tuple):
        return [
            each_quantity(value, inner[0], change, joined(where, index))
            for index, value in enumerate(data)
        ]
    return data
