"""Where mounts sit and how they are turned, as numbers that a search chooses."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from modeviz.errors import located
from modeviz.optimise.limits import Limit
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.carried_mass import carried_mass
from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.place_bounds import FARTHEST, PlaceBounds
from modeviz.vehicle.placement import Placement, Placements
from modeviz.vehicle.problem import DesignGroup, Problem
from modeviz.vehicle.vehicle import Vehicle

Kind = Literal["offset", "angles"]
"""The fields of a `Placement`."""

UNITS: Mapping[Kind, tuple[str, float]] = {
    "offset": ("mm", factor("mm", "length")),
    "angles": ("°", factor("deg", "angle")),
}
"""In which people read them."""


@dataclass(frozen=True)
class PlaceVariable:
    """One number: how far a mount group is moved along, or turned about, one axis of the vehicle."""

    group: str
    kind: Kind
    axis: int
    """0, 1 or 2."""
    bounds: tuple[float, float]
    """The least and the most, m or rad."""

    @property
    def spoken(self) -> str:
        """What a person calls it: "M1 offset x"."""
        return f"{self.group} {self.kind.removesuffix('s')} {AXES[self.axis]}"

    @property
    def width(self) -> float:
        """Between its bounds, m or rad: a search chooses how many of these, as it does ln(k/k₀)."""
        return self.bounds[1] - self.bounds[0]

    def said(self, value: float) -> str:
        """The number in words: "+12 mm"."""
        unit, size = UNITS[self.kind]
        return f"{value / size:+.4g}{'' if unit == '°' else ' '}{unit}"

    def of(self, placements: Placements) -> float:
        """The number where mounts are placed so, m or rad."""
        placed = placements.get(self.group, Placement())
        return getattr(placed, self.kind)[self.axis]

    def put(self, placements: Placements, value: float) -> dict[str, Placement]:
        """Return placements with another number."""
        placed = placements.get(self.group, Placement())
        numbers = list(getattr(placed, self.kind))
        numbers[self.axis] = value
        return {**placements, self.group: replace(placed, **{self.kind: tuple(numbers)})}


@dataclass(frozen=True, eq=False)
class Places:
    """The places that a search may choose, and where all else stays."""

    variables: tuple[PlaceVariable, ...] = ()
    base: Placements = field(default_factory=dict)
    """Of the vehicle's mounts; what no variable changes keeps that."""

    @property
    def widths(self) -> Floats:
        """(n_places,), m or rad."""
        return np.array([v.width for v in self.variables])

    def placements(self, x: Floats) -> Placements:
        """Where mounts are in a design, (n_places,)."""
        placements = dict(self.base)
        for variable, value in zip(self.variables, (x * self.widths).tolist(), strict=True):
            placements = variable.put(placements, value)
        return {name: placed for name, placed in placements.items() if not placed.is_as_given}

    def to_x(self, placements: Placements) -> Floats:
        """The numbers of mounts that are placed so, (n_places,), whether within their bounds or not."""
        return np.array([v.of(placements) / v.width for v in self.variables])

    def limits(self, first: int) -> list[Limit]:
        """The bounds of each number; `first` is the number of the first, the others follow."""
        return [
            limit
            for number, variable in enumerate(self.variables, first)
            for limit in _bounds(variable, number)
        ]

    def spoken(self, x: Floats) -> list[str]:
        """Each number of a design as a person says it: "M1 offset x +12 mm"."""
        values = (x * self.widths).tolist()
        return [f"{v.spoken} {v.said(u)}" for v, u in zip(self.variables, values, strict=True)]


def places_of(
    vehicle: Vehicle, groups: Sequence[DesignGroup], placements: Placements | None = None
) -> Places:
    """The places that design groups leave to choose.

    Args:
        vehicle: whose mounts.
        groups: of a problem.
        placements: what no group may change; None: all mounts are where they were given.

    Raises:
        VehicleError: what may be placed otherwise holds the mass of an absorber that cannot be moved
            alone.
    """
    variables = [
        PlaceVariable(group.group, kind, axis, bounds)
        for group in groups
        for kind in UNITS
        for axis, bounds in _bounds_by_axis(group, kind)
    ]
    for name in {variable.group: None for variable in variables}:
        with located("offset and angles"):
            carried_mass(vehicle, vehicle.mount_group(name))
    return Places(tuple(variables), placements or {})


def _bounds_by_axis(group: DesignGroup, kind: Kind) -> Iterator[tuple[int, tuple[float, float]]]:
    bounds = group.offsets if kind == "offset" else group.angles
    return ((axis, bounds[name]) for axis, name in enumerate(AXES) if name in bounds)


def seen_from(problem: Problem, placements: Placements) -> Problem:
    """Return a problem whose bounds leave the same places, for mounts that were placed so.

    Exactly of offsets and of turns about one axis; turns about several do not add up, so that what is
    left is the same near where the mounts are, and no more than may be asked for.
    """
    groups = tuple(
        replace(
            group,
            offsets=_from(group.offsets, placements[group.group].offset),
            angles=_from(group.angles, placements[group.group].angles, FARTHEST),
        )
        if group.group in placements
        else group
        for group in problem.groups
    )
    return replace(problem, groups=groups)


def _from(bounds: PlaceBounds, moved: Sequence[float], most: float = np.inf) -> PlaceBounds:
    """Bounds from where mounts were placed, but no farther than so much; none of an axis all beyond."""
    by_axis: dict[str, float] = dict(zip(AXES, moved, strict=True))
    ends = {
        axis: (max(low - by_axis[axis], -most), min(high - by_axis[axis], most))
        for axis, (low, high) in bounds.items()
    }
    return {axis: (low, high) for axis, (low, high) in ends.items() if low < high}


def _bounds(variable: PlaceVariable, number: int) -> list[Limit]:
    low, high = (end / variable.width for end in variable.bounds)
    return [
        Limit(f"{variable.spoken}: lower bound", number, None, -1, -low),
        Limit(f"{variable.spoken}: upper bound", number, None, 1, high),
    ]
