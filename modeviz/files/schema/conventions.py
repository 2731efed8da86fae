"""The units and the axes of the arrays, tables and meshes that a vehicle file names."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from modeviz.files.schema.scaling import factors_of, unit_in_si
from modeviz.vehicle.arrays import Floats


@dataclass(frozen=True, eq=False)
class Conventions:
    """The units and axes of a file's numbers; SI and our axes, if nothing is said."""

    units: Mapping[str, str] = field(default_factory=lambda: {"length": "m", "mass": "kg"})
    """Quantity to unit."""
    axes: Floats = field(default_factory=lambda: np.eye(3))
    """(3, 3), see `axes_of`."""

    def with_units(self, units: Mapping[str, str]) -> Self:
        """These conventions with a file's own units in place of some.

        Raises:
            FaultsError: no such quantity or unit.
        """
        factors_of(units)
        return replace(self, units={**self.units, **units})

    def unit(self, quantity: str) -> float:
        """One unit of a quantity in SI; raises VehicleError if none is said."""
        return unit_in_si(quantity, self.units)

    def positions(self, positions: np.ndarray) -> np.ndarray:
        """Places (..., 3), m, in our axes."""
        return self._turned(positions, axis=-1) * self.unit("length")

    def shapes(self, shapes: np.ndarray) -> np.ndarray:
        """Mass-normalised shapes (..., 6 or 3, n_modes) of motions and rotations, in our axes.

        φᵀMφ = I with M in the file's unit of mass: motions are in 1/√mass, rotations in
        1/(length √mass).
        """
        per_mass = 1 / np.sqrt(self.unit("mass"))
        units = (per_mass, per_mass / self.unit("length"))
        blocks = np.split(shapes, range(3, shapes.shape[-2], 3), axis=-2)
        turned = [
            self._turned(block, axis=-2) * shapes.dtype.type(unit)
            for block, unit in zip(blocks, units, strict=False)
        ]
        return np.concatenate(turned, axis=-2)

    def _turned(self, vectors: np.ndarray, axis: int) -> np.ndarray:
        """Vectors whose components lie along an axis of the array; an exchange, and so exact."""
        from_axis = np.abs(self.axes).argmax(axis=1)
        sign = self.axes[np.arange(3), from_axis].astype(vectors.dtype)
        taken = np.take(vectors, from_axis, axis=axis)
        return taken * (sign if axis == -1 else sign[:, None])
