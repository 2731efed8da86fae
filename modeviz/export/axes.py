"""The axes of a vehicle's file, into which everything is turned that is written for other programs."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.files.schema.axes import axes_of
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.mount_rates import DIRECTIONS


@dataclass(frozen=True)
class FileAxes:
    """Axes along the vehicle that are not ours, such as those of the models that it is made of."""

    text: str
    """As a vehicle's file says them: "x forward, y left, z up"."""

    @cached_property
    def turn(self) -> Floats:
        """T (3, 3): a vector is T v in our axes that is v in these."""
        return axes_of(self.text)

    def vectors(self, vectors: Array) -> Array:
        """Return vectors (..., 3), which are in our axes, in these."""
        return vectors @ self.turn + 0.0  # no -0.0

    def motions(self, motions: Array) -> Array:
        """Return motions and rotations (..., 6, n), which are in our axes, in these."""
        back = np.kron(np.eye(2), self.turn.T).astype(np.real(motions).dtype)
        return back @ motions

    def frame(self, axes: Floats) -> Floats:
        """Return local axes as rows, (3, 3), so that identity stays identity; see `rates`."""
        return self.turn.T @ axes @ self.turn + 0.0

    def rates(self, rates: Floats) -> Floats:
        """Return rates (3,) along local x, y, z along those of the same frame here."""
        return np.abs(self.turn.T) @ rates

    def ranges(self, ranges: Floats) -> Floats:
        """Return the least and the most along local x, y, z, (2, 3), along those of the same frame."""
        ours = np.abs(self.turn).argmax(axis=0)
        is_against = self.turn[ours, np.arange(3)] < 0
        return np.where(is_against, 0.0 - ranges[::-1, ours], ranges[:, ours])

    @property
    def directions(self) -> tuple[str, ...]:
        """What a person calls the directions along x, y and z: "fore-aft", "lateral", "vertical"."""
        return tuple(DIRECTIONS[::-1][line] for line in np.abs(self.turn).argmax(axis=0))

    def signed(self, axis: int) -> int:
        """Return which of these axes one of ours is along, 1 to 3, below zero if against it."""
        along = int(np.abs(self.turn[axis]).argmax())
        return (along + 1) * int(self.turn[axis, along])
