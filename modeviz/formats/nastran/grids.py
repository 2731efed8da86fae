"""Grids that springs hold on to: where they are, and along what they move."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError
from modeviz.files.mount_tables.bushing import Bushing, End
from modeviz.formats.component import UnitSystem
from modeviz.formats.frames import Frame
from modeviz.formats.nastran.bush_properties import BushRates
from modeviz.formats.nastran.model import Model, basic_geometry
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND

COINCIDENT = 1e-4
"""Of the file's length: grids that are nearer have no line between them, as MSC Nastran has it."""


@dataclass(frozen=True, eq=False)
class Grids:
    """The grids of an input file in its basic system, and the bodies that they are of."""

    model: Model
    positions: Floats
    """(n, 3)."""
    frames: Mapping[int, Frame]
    units: UnitSystem
    bodies: tuple[str, ...]
    """Of the first and the second grids of springs; none if they are to be found."""
    held: frozenset[int]
    """Those that do not move, which are the ground."""

    @classmethod
    def of(
        cls, model: Model, units: UnitSystem, bodies: tuple[str, ...], held: frozenset[int]
    ) -> "Grids":
        """Raises VehicleError for a coordinate system that is missing."""
        return cls(model, *basic_geometry(model), units, bodies, held)

    def has(self, number: int) -> bool:
        """Whether there is a grid of a number."""
        return bool(np.isin(number, self.model.ids))

    def _row(self, number: int) -> int:
        if not self.has(number):
            raise VehicleError(f"grid {number}: is not in the file")
        return int(np.searchsorted(self.model.ids, number))

    def place(self, number: int) -> Floats:
        """Return where a grid is, (3,); raises VehicleError if there is none of that number."""
        return self.positions[self._row(number)]

    def directions(self, number: int) -> Floats:
        """Return the directions of a grid's motions as rows, (3, 3); raises as `place`."""
        system = int(self.model.systems[self._row(number), 1])
        return self.axes(system, self.place(number))

    def axes(self, system: int, place: Floats) -> Floats:
        """Return the directions of a coordinate system at a place as rows, (3, 3).

        Raises:
            VehicleError: there is none of that number.
        """
        if system not in self.frames:
            raise VehicleError(f"coordinate system {system}: is not in the file")
        return self.frames[system].directions(place[None])[0].T

    def bushing(
        self, name: str, ends: Mapping[str, int], rates: BushRates, axes: Floats, loss_factor: float
    ) -> Bushing:
        """Return the bushing between two grids, which is not tuned.

        Args:
            name: of the element.
            ends: two grids by their fields of the card, zero for the ground.
            rates: in the file's units.
            axes: (3, 3), rows.
            loss_factor: of all its directions.
        """
        first, second = (self._end(name, i, *end) for i, end in enumerate(ends.items()))
        mass, length = self.units.mass, self.units.length
        scale = np.array([mass] * 3 + [mass * length**2] * 3)
        return Bushing(
            name,
            name,
            (first, second),
            stiffness=rates.stiffness * scale,
            damping=rates.damping * scale,
            loss_factor=loss_factor,
            axes=axes,
            rigid=rates.rigid,
        )

    def _end(self, name: str, side: int, field: str, grid: int) -> End:
        if not grid:
            return End(f"{name}, {field}", GROUND)
        where, place = f"{name}, {field} {grid}", self.place(grid) * self.units.length
        if grid in self.held:
            return End(where, GROUND, place=place)
        body = self.bodies[side] if self.bodies else ""
        return End(where, body, str(grid), place, may_be_elsewhere=True)
