"""The modes of a body's own, how pure they are, and how both change with the rates of its mounts.

Modes are given in the vectors of a basis V, as the enriched one or the vehicle's own coordinates.
"""

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from modeviz.mounting.purity import sorted_modes
from modeviz.mounting.stiffness import FREE, HeldBody
from modeviz.vehicle.arrays import Floats

REPEATED = 1e-6
"""Relative difference of ω² below which modes have no shapes of their own."""


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
class OwnModes:
    """The mode of each of a body's six directions."""

    frequency_hz: Floats
    """(6,), not a number where a direction has none."""
    purity: Floats
    """(6,): the part of the direction in the body's energy there; zero where it has none."""
    frequency_gradient: Floats
    """(6, n_springs): derivatives to the rate of every mount spring, Hz per N/m or N m/rad."""
    purity_gradient: Floats
    """(6, n_springs), likewise."""


def own_modes(rows: BodyRows, modes: BasisModes, mount_rates: Floats) -> OwnModes:
    """Return the modes of a body's own with their derivatives.

    ∂φ_i/∂k = Σ_j φ_j (φ_jᵀ ∂K/∂k φ_i) / (ω_i² - ω_j²) over all other modes of the basis (R. L. Fox and
    M. P. Kapoor, "Rates of change of eigenvalues and eigenvectors", AIAA Journal 6(12), 1968).

    Which mode is whose goes by all directions together, see `sorted_modes`: modes that cross without
    being coupled pass each other. Where coupled ones veer they change hands where both directions
    together have as much either way, so that the sum of their purities has no jump, only a kink. Of
    modes as good as at one frequency any mixture is a mode: the purest counts, and derivatives are
    those of the space that they have in common.

    Args:
        rows: of the body.
        modes: with the present rates.
        mount_rates: (n_springs,), N/m and N m/rad.
    """
    turned, cluster = _purest(rows, modes)
    motion, momentum = rows.motion @ turned.vectors, rows.momentum @ turned.vectors
    n = turned.n_known
    energy = (motion * momentum)[:, :n].T
    chosen = sorted_modes(energy, _strain(rows, turned, mount_rates)[:n])
    n_springs = len(turned.stretch)
    f, purity = np.full(6, np.nan), np.zeros(6)
    f_gradient, gradient = np.zeros((2, 6, n_springs))
    for direction, mode in enumerate(chosen):
        if mode is None:
            continue
        omega = np.sqrt(turned.omega_squared[mode])
        f[direction] = omega / (2 * np.pi)
        f_gradient[direction] = turned.stretch[:, mode] ** 2 / (4 * np.pi * omega)
        part, whole = energy[mode, direction], energy[mode].sum()
        purity[direction] = part / whole
        mixed = _mixed(turned, mode, cluster)
        crossed = motion * momentum[:, [mode]] + motion[:, [mode]] * momentum
        weights = (crossed[direction] - part / whole * crossed.sum(axis=0)) / whole * mixed
        gradient[direction] = turned.stretch[:, mode] * (turned.stretch @ weights)
    return OwnModes(f, purity, f_gradient, gradient)


def _strain(rows: BodyRows, modes: BasisModes, mount_rates: Floats) -> Floats:
    """The part of each mode's strain energy in what holds the body, (n_modes,); zero if it is free."""
    twice = mount_rates[rows.springs] @ modes.stretch[rows.springs] ** 2
    twice = twice + rows.other_rates @ (rows.others @ modes.vectors) ** 2
    squares = modes.omega_squared
    return np.where(squares > FREE, twice / np.maximum(squares, FREE), 0.0)


def _mixed(modes: BasisModes, mode: int, cluster: NDArray[np.intp]) -> Floats:
    """1/(ω_i² - ω_j²), (n_modes,): how much of each other a mode takes on; none within its cluster."""
    apart = modes.omega_squared[mode] - modes.omega_squared
    is_other = cluster != cluster[mode]
    return np.where(is_other, 1 / np.where(is_other, apart, 1.0), 0.0)


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
    return BasisModes(squares, vectors, stretch, modes.n_known), cluster


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
