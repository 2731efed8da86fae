"""How pure modes are in a body's directions, whose they are, and how that changes with its mounts.

Modes are given in the vectors of a basis V, as the enriched one or the vehicle's own coordinates.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from modeviz.mounting.purity import TAKES_PART
from modeviz.mounting.stiffness import FREE, HeldBody
from modeviz.vehicle.arrays import Floats

REPEATED = 1e-9
"""Relative difference of ω² below which modes have no shapes of their own; no larger, for a search
would stop where it can have the purest mixture."""


@dataclass(frozen=True, eq=False)
class BasisModes:
    """Modes of a vehicle in the vectors of a basis."""

    omega_squared: Floats
    """(n_modes,), rising, rad²/s²."""
    vectors: Floats
    """(n_vectors, n_modes), orthonormal."""
    stretch: Floats
    """(n_springs, n_modes), of every mount spring."""
    n_known: int
    """How many of them are modes of the vehicle; the others stand for the rest."""
    are_masses: NDArray[np.bool_]
    """(n_springs,): which of the springs resist acceleration, see `PartKind`."""


@dataclass(frozen=True, eq=False)
class BodyRows:
    """Rows that read a body's rigid motion, and how it is held, out of the vectors of a basis."""

    motion: Floats
    """(6, n_vectors): along and about the axes that were chosen."""
    momentum: Floats
    """(6, n_vectors): its impulse and angular impulse."""
    springs: NDArray[np.intp]
    """(n_own,): which mount springs hold it."""
    others: Floats
    """(n_others, n_vectors): the stretch of all else that does."""
    other_rates: Floats
    """(n_others,), N/m and N m/rad."""


def body_rows(held: HeldBody, axes: Floats, vectors: Floats) -> BodyRows:
    """Return the rows of a body.

    Args:
        held: the body.
        axes: as rows, (3, 3).
        vectors: V, (n_dofs, n_vectors).
    """
    turn, part = np.kron(np.eye(2), axes), held.part
    momentum = turn @ part.momentum @ vectors[part.own]
    motion = turn @ part.inverse_mass @ part.momentum @ vectors[part.own]
    others = held.relative[len(held.springs) :] @ vectors
    return BodyRows(motion, momentum, held.springs, others, held.other_rates)


@dataclass(frozen=True, eq=False)
class BodyModes:
    """How pure every mode is in each of a body's six directions, and how much of a direction it has.

    ∂φ_i/∂k = Σ_j φ_j (φ_jᵀ ∂K/∂k φ_i) / (ω_i² - ω_j²) over all other modes of the basis (R. L. Fox and
    M. P. Kapoor, "Rates of change of eigenvalues and eigenvectors", AIAA Journal 6(12), 1968), so that
    φ_iᵀBφ_i changes by 2 Σ_j φ_jᵀBφ_i of that. Derivatives are to the rate of every mount spring,
    (n_springs,). What resists acceleration has -ω_i² ∂M/∂m for ∂K/∂k, and makes the mode smaller by
    φ_iᵀ ∂M/∂m φ_i / 2 of itself, for φᵀMφ = 1.
    """

    modes: BasisModes
    """Repeated ones as pure as can be."""
    cluster: NDArray[np.intp]
    """(n_modes,): which are as good as at one frequency, by the same number."""
    rows: BodyRows
    mount_rates: Floats
    """(n_springs,), N/m and N m/rad."""
    motion: Floats
    """(6, n_modes), of the body."""
    momentum: Floats
    """(6, n_modes)."""

    @cached_property
    def frequency_hz(self) -> Floats:
        """(n_known,)."""
        return np.sqrt(self.modes.omega_squared[: self.modes.n_known]) / (2 * np.pi)

    @cached_property
    def energy(self) -> Floats:
        """(n_known, 6): the body's kinetic energy in each direction, a part of the mode's."""
        return (self.motion * self.momentum)[:, : self.modes.n_known].T

    @cached_property
    def purity(self) -> Floats:
        """(n_known, 6): the part of each direction in the body's energy."""
        whole = self.energy.sum(axis=1, keepdims=True)
        return np.divide(self.energy, whole, out=np.zeros_like(self.energy), where=whole > 0)

    @cached_property
    def strain(self) -> Floats:
        """(n_known,): the part of each mode's strain energy in what holds the body."""
        n = self.modes.n_known
        twice = np.array([self._strained(i)[i] for i in range(n)])
        squares = self.modes.omega_squared[:n]
        return np.where(squares > FREE, twice / np.maximum(squares, FREE), 0.0)

    @cached_property
    def weight(self) -> Floats:
        """(n_known, 6): energy times strain, as `sorted_modes` has it; zero where below."""
        return np.maximum(self.energy * self.strain[:, None], 0.0)

    @cached_property
    def leading(self) -> Floats:
        """(n_known, 6): weight by the largest of the direction; zero where it has no mode."""
        largest = self.weight.max(axis=0, initial=0.0)
        return np.where(largest > TAKES_PART, self.weight / np.maximum(largest, TAKES_PART), 0.0)

    def frequency_gradient(self, mode: int) -> Floats:
        """Return ∂f/∂k, Hz per N/m or N m/rad."""
        return self._square_gradient(mode) / (8 * np.pi**2 * self.frequency_hz[mode])

    def purity_gradient(self, mode: int, direction: int) -> Floats:
        """Return the derivatives of one of `purity`."""
        whole = self.energy[mode].sum()
        crossed = self._crossed(mode)
        own = crossed[direction] - self.purity[mode, direction] * crossed.sum(axis=0)
        return self._changed(mode, own) / whole

    def leading_gradient(self, mode: int, direction: int) -> Floats:
        """Return the derivatives of one of `leading`."""
        first = int(self.weight[:, direction].argmax())
        own, largest = (self._weight_gradient(i, direction) for i in (mode, first))
        return (own - self.leading[mode, direction] * largest) / self.weight[first, direction]

    def _weight_gradient(self, mode: int, direction: int) -> Floats:
        energy, strain = self.energy[mode, direction], self.strain[mode]
        square, are_masses = self.modes.omega_squared[mode], self.modes.are_masses
        stretched = self.modes.stretch[:, mode] ** 2
        smaller = np.where(are_masses, stretched, 0.0)
        by_energy = self._changed(mode, self._crossed(mode)[direction]) - smaller * energy
        twice = 2 * self._changed(mode, self._strained(mode)) - smaller * strain * square
        own = self.rows.springs
        twice[own] += np.where(are_masses[own], 0.0, stretched[own])
        by_strain = (twice - strain * self._square_gradient(mode)) / square
        return strain * by_energy + energy * by_strain

    def _square_gradient(self, mode: int) -> Floats:
        """∂ω²/∂k, rad²/s² per unit of each."""
        return self._effect(mode) * self.modes.stretch[:, mode] ** 2

    def _effect(self, mode: int) -> Floats:
        """What a unit of each rate is as stiffness at a mode's frequency, (n_springs,)."""
        return np.where(self.modes.are_masses, -self.modes.omega_squared[mode], 1.0)

    def _crossed(self, mode: int) -> Floats:
        """2 φ_jᵀBφ_i for the energy of each direction, (6, n_modes)."""
        return self.motion * self.momentum[:, [mode]] + self.motion[:, [mode]] * self.momentum

    def _strained(self, mode: int) -> Floats:
        """φ_jᵀBφ_i for twice the strain energy in what holds the body, (n_modes,)."""
        own = self.modes.stretch[self.rows.springs]
        others = self._others
        along = (self.mount_rates[self.rows.springs] * own[:, mode]) @ own
        return along + (self.rows.other_rates * others[:, mode]) @ others

    @cached_property
    def _others(self) -> Floats:
        return self.rows.others @ self.modes.vectors

    def _changed(self, mode: int, forms: Floats) -> Floats:
        """Σ_j forms_j φ_jᵀ ∂K/∂k φ_i / (ω_i² - ω_j²), none of it within the mode's cluster."""
        squares = self.modes.omega_squared
        is_other = self.cluster != self.cluster[mode]
        apart = np.where(is_other, squares[mode] - squares, 1.0)
        mixed = np.where(is_other, forms / apart, 0.0)
        return self._effect(mode) * self.modes.stretch[:, mode] * (self.modes.stretch @ mixed)


def body_modes(rows: BodyRows, modes: BasisModes, mount_rates: Floats) -> BodyModes:
    """Return how pure modes are in each direction of a body.

    Of modes as good as at one frequency any mixture is a mode: the purest counts, and derivatives are
    those of the space that they have in common.

    Args:
        rows: of the body.
        modes: with the present rates.
        mount_rates: (n_springs,), N/m and N m/rad.
    """
    turned, cluster = _purest(rows, modes)
    motion, momentum = rows.motion @ turned.vectors, rows.momentum @ turned.vectors
    return BodyModes(turned, cluster, rows, mount_rates, motion, momentum)


def _purest(rows: BodyRows, modes: BasisModes) -> tuple[BasisModes, NDArray[np.intp]]:
    """The modes with repeated ones as pure as can be, and the number of each one's cluster."""
    squares = modes.omega_squared
    begins = np.diff(squares, prepend=-np.inf) > REPEATED * np.maximum(squares, FREE)
    cluster = np.cumsum(begins) - 1
    vectors, stretch = modes.vectors, modes.stretch
    for begin, end in pairwise([*np.flatnonzero(begins), len(squares)]):
        if end - begin > 1 and begin < modes.n_known:
            own = slice(begin, end)
            turn = _turn(rows.motion @ vectors[:, own], rows.momentum @ vectors[:, own])
            vectors = np.hstack([vectors[:, :begin], vectors[:, own] @ turn, vectors[:, end:]])
            stretch = np.hstack([stretch[:, :begin], stretch[:, own] @ turn, stretch[:, end:]])
    return BasisModes(squares, vectors, stretch, modes.n_known, modes.are_masses), cluster


def _turn(motion: Floats, momentum: Floats) -> Floats:
    """The rotation of repeated modes that lays each along a direction of its own, (n, n).

    The energy of a direction is a form aᵀb of a mixture; its axis is where that is largest. The
    rotation is the nearest to the axes of the directions with most (orthogonal Procrustes: P. H.
    Schönemann, Psychometrika 31, 1966).
    """
    n = motion.shape[1]
    axes = np.zeros((len(motion), n))
    for direction, (a, b) in enumerate(zip(motion, momentum, strict=True)):
        form = (np.outer(a, b) + np.outer(b, a)) / 2
        largest, vectors = np.linalg.eigh(form)
        axes[direction] = np.sqrt(max(float(largest[-1]), 0.0)) * vectors[:, -1]
    order = np.argsort(-np.linalg.norm(axes, axis=1), kind="stable")
    target = np.zeros((n, n))
    kept = axes[np.sort(order[:n])]
    target[: len(kept)] = kept
    u, _, vt = np.linalg.svd(target)
    return (u @ vt).T
