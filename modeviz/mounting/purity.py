"""How pure the modes of a body are: its kinetic energy in six directions, and what is asked of it."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from scipy.optimize import linear_sum_assignment

from modeviz.dynamics.catalogue import MOTION_WORDS
from modeviz.mounting.rigid_part import RigidPart
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.decoupling import Decoupling

TAKES_PART = 0.005
"""A direction has no mode of its own where less than this part of a mode's energy is in it."""


def direction_energy(part: RigidPart, shapes: Floats, axes: Floats) -> Floats:
    """Return a body's kinetic energy in x, y, z, rx, ry, rz, (n_modes, 6), as parts of each mode's.

    r_k (M_b r)_k of its rigid motion r; where products of inertia couple directions one may be below
    zero. In a mode they add up to the body's share of it, of a flexible body to that of its rigid
    part. (T. Jeong, R. Singh, "Analytical methods of decoupling the automotive engine torque roll
    axis", Journal of Sound and Vibration 234(1), 2000, among many.)

    Args:
        part: of the body.
        shapes: mass-normalised, (n_dofs, n_modes).
        axes: as rows, (3, 3), see `frames.frame`.
    """
    momentum = part.momentum @ shapes[part.own]
    motion = part.inverse_mass @ momentum
    turn = np.kron(np.eye(2), axes)
    return ((turn @ motion) * (turn @ momentum)).T


def sorted_modes(energy: Floats, strain: Floats) -> tuple[int | None, ...]:
    """Return the mode of each direction, six different ones; None where a direction has none.

    Those that have most energy in their directions together, counted by how much of a mode's strain is
    in what holds the body: so a body that only goes along with the vehicle has no mode of its own
    there (H. W. Kuhn, "The Hungarian method for the assignment problem", Naval Research Logistics
    Quarterly 2, 1955).

    Args:
        energy: (n_modes, 6), see `direction_energy`.
        strain: (n_modes,), the part of each mode's strain energy that is in what holds the body.
    """
    weight = energy * strain[:, None]
    modes, directions = linear_sum_assignment(-weight)
    found: list[int | None] = [None] * energy.shape[1]
    for mode, direction in zip(modes.tolist(), directions.tolist(), strict=True):
        if weight[mode, direction] > TAKES_PART:
            found[direction] = mode
    return tuple(found)


@dataclass(frozen=True)
class Gap:
    """Two modes of a body, and how far apart they are."""

    motions: tuple[str, str]
    """Of `MOTIONS`, the lower mode's first."""
    hz: float
    wanted: float
    """Hz: what is asked for."""

    @property
    def passes(self) -> bool:
        return self.hz >= self.wanted


@dataclass(frozen=True, eq=False)
class Purity:
    """A body's energy in six directions in every mode, and which of the modes are its own."""

    frequency_hz: Floats
    """(n_modes,)."""
    energy: Floats
    """(n_modes, 6), see `direction_energy`."""
    share: Floats
    """(n_modes,): all of the body's kinetic energy, also that in which it bends."""
    modes: tuple[int | None, ...]
    """The mode of each of `MOTIONS`, see `sorted_modes`."""
    targets: Decoupling
    crank_motion: str
    """Of `MOTIONS`: the turning that is nearest to that about its crank."""
    has_crank: bool
    """Whether it has one; else it is that about its long axis."""

    def purity(self, motion: str) -> float | None:
        """Return the part that a direction has in the body's rigid energy in its mode.

        None if no mode is in that direction.
        """
        number = MOTIONS.index(motion)
        mode = self.modes[number]
        return None if mode is None else float(self.energy[mode, number] / self.energy[mode].sum())

    def motion_of(self, mode: int) -> str | None:
        """Return the direction of which a mode is the body's; None if it is of none."""
        return MOTIONS[self.modes.index(mode)] if mode in self.modes else None

    def frequency(self, motion: str) -> float | None:
        """Return the frequency of the mode of a direction, Hz; None if there is none."""
        mode = self.modes[MOTIONS.index(motion)]
        return None if mode is None else float(self.frequency_hz[mode])

    def is_pure(self, motion: str) -> bool:
        """Return whether the mode of a direction is as pure as is asked."""
        purity = self.purity(motion)
        return purity is not None and purity >= self.targets.purity

    def is_in_band(self, motion: str) -> bool:
        """Return whether the mode of a direction is where its frequency should be."""
        f, targets = self.frequency(motion), self.targets
        return f is not None and targets.lowest_frequency <= f <= targets.highest_frequency

    @property
    def crank_word(self) -> str:
        """What turning about its crank is called, also of a body that has none."""
        return "crank" if self.has_crank else MOTION_WORDS[MOTIONS.index(self.crank_motion)]

    @property
    def least(self) -> float:
        """The least purity of the six; zero if a direction has no mode."""
        return min(self.purity(motion) or 0.0 for motion in MOTIONS)

    @property
    def gaps(self) -> tuple[Gap, ...]:
        """Between modes that follow each other."""
        return self._between(MOTIONS, self.targets.gap)

    @property
    def bounce_gaps(self) -> tuple[Gap, ...]:
        """Between the modes of bounce and of turning about the crank, if there are both."""
        return self._between(("z", self.crank_motion), self.targets.bounce_gap)

    def _between(self, motions: Sequence[str], wanted: float) -> tuple[Gap, ...]:
        found = sorted((f, m) for m in motions if (f := self.frequency(m)) is not None)
        return tuple(
            Gap((low, high), above - below, wanted) for (below, low), (above, high) in pairwise(found)
        )

    @property
    def passes(self) -> bool:
        """Whether all that is asked of the body's modes holds."""
        held = (self.is_pure(m) and self.is_in_band(m) for m in MOTIONS)
        return all(held) and all(gap.passes for gap in (*self.gaps, *self.bounce_gaps))
