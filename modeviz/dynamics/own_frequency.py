"""Undamped modes where mounts depend on frequency, each with the rates at its own frequency.

    (K + RᵀΔ(ω)R) φ = ω² M φ

The i-th eigenvalue λ_i(ω) of the matrix on the left meets ω² where a mode is. Each meeting is found by
the safeguarded iteration of H. Voss and B. Werner ("A minimax principle for nonlinear eigenvalue
problems with applications to nonoverdamped systems", Mathematical Methods in the Applied Sciences 4,
1982): the i-th vector at a guess, then the ω at which Rayleigh's quotient of that vector is ω².
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
import scipy.linalg

from modeviz.dynamics.basis import EnrichedBasis
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats

N_GUESSES = 40
"""Steps from zero to the top of the band, at least, within which meetings are looked for."""

N_FINE = 8000
"""Frequencies at which it is seen how fast rates change there."""

STEADY = 0.03
"""By no larger part does a rate change within a step, in which a mode might come and go unseen."""

MAX_STEPS = 60
"""Of an iteration that gains digits with the square of what it has, or halves where it would not."""

CONVERGED = 1e-12
"""Relative change of ω²; rounding of the squares of slow modes is beyond that."""


@dataclass(frozen=True, eq=False)
class Pencil:
    """K + RᵀΔ(ω)R and M."""

    stiffness: Floats
    """K, (n, n)."""
    mass: Floats | None
    """M, (n, n); None: the identity."""
    motions: Floats
    """R, (n_springs, n)."""
    change: Callable[[float], Floats]
    """Δ, (n_springs,), N/m, at a frequency, Hz."""
    guesses_hz: Floats
    """Rising from zero to the top of the band: within a step rates hardly change."""

    def eigenvalues(self, frequency_hz: float) -> Floats:
        """Return λ_i(ω), (n,), rising."""
        A = self.at(frequency_hz)
        return scipy.linalg.eigh(A, self.mass, eigvals_only=True, check_finite=False)

    def vector(self, number: int, frequency_hz: float) -> tuple[float, Floats]:
        """Return λ_i(ω) and its vector, φᵀMφ = 1."""
        A = self.at(frequency_hz)
        found = scipy.linalg.eigh(A, self.mass, subset_by_index=[number, number], check_finite=False)
        return float(found[0][0]), found[1][:, 0]

    def at(self, frequency_hz: float) -> Floats:
        """Return K + RᵀΔ(ω)R, (n, n)."""
        R = self.motions
        return self.stiffness + (R.T * self.change(frequency_hz)) @ R


def ritz_pencil(basis: EnrichedBasis, stiffness: Complexes, n: int | None = None) -> Pencil:
    """Return the matrices of other mount rates within the first vectors of a basis, all if None.

    Args:
        basis: of the vehicle.
        stiffness: (n_springs,), complex rates at the reference, N/m.
        n: how many vectors.
    """
    K, R = basis.stiffness[:n, :n], basis.spring_motions[:, :n]
    return Pencil(K, None, R, partial(_change, basis, stiffness), _guesses(basis))


def full_pencil(basis: EnrichedBasis, stiffness: Complexes) -> Pencil:
    """Return the full matrices with other mount rates; arguments as of `ritz_pencil`."""
    system = basis.system
    K, M = system.condensed(system.stiffness), system.condensed(system.mass)
    R = system.condensed_rows(system.mount_motions)
    return Pencil(K, M, R, partial(_change, basis, stiffness), _guesses(basis))


def _guesses(basis: EnrichedBasis) -> Floats:
    """Frequencies, Hz, from zero to the top of the band, closer where rates change."""
    if basis.law.is_constant:
        return np.array([0.0, basis.top_hz])
    fine = np.linspace(0.0, basis.top_hz, N_FINE + 1)
    rates = np.real(basis.law.ratios(fine))
    size = np.maximum(np.abs(rates[:-1]), np.abs(rates[1:]))
    changes = np.abs(np.diff(rates, axis=0)) / np.maximum(size, np.finfo(np.float64).tiny)
    steps = changes.max(axis=1, initial=0.0) / STEADY + N_GUESSES / N_FINE
    passed = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.linspace(0.0, passed[-1], int(np.ceil(passed[-1])) + 1)
    return fine[np.searchsorted(passed, wanted * (1 - 1e-12))]


def _change(basis: EnrichedBasis, stiffness: Complexes, frequency_hz: float) -> Floats:
    """Δ at a frequency, (n_springs,), N/m."""
    return np.asarray(basis.change(stiffness, np.array([frequency_hz]))[0].real, np.float64)


def own_modes(pencil: Pencil, top: float) -> tuple[Floats, Floats, int]:
    """Return ω², (n_modes,), rising, and vectors, (n, n_modes), of the modes below a frequency.

    Where rates rise so fast with frequency that a λ_i meets ω² from below, nothing vibrates: mass and
    stiffness have changed places. How many such meetings there are is the third.

    Args:
        pencil: what vibrates.
        top: ω² below which modes are wanted, rad²/s².

    Raises:
        SolveError: a mode at whose frequency the iteration does not arrive.
    """
    guesses = 2 * np.pi * pencil.guesses_hz
    above = np.array([pencil.eigenvalues(omega / (2 * np.pi)) - omega**2 for omega in guesses])
    is_above = above > 0
    is_above[0] = True
    starts, numbers = np.nonzero(is_above[:-1] & ~is_above[1:])
    n_against = int(np.count_nonzero(~is_above[:-1] & is_above[1:]))
    found = [
        _meeting(pencil, number, guesses[start], guesses[start + 1])
        for start, number in zip(starts.tolist(), numbers.tolist(), strict=True)
    ]
    omega_squared = np.array([value for value, _ in found])
    order = np.argsort(omega_squared, kind="stable")
    vectors = np.array([vector for _, vector in found]).reshape(len(found), len(pencil.stiffness))
    return omega_squared[order], vectors[order].T, n_against


def own_frequencies(pencil: Pencil, count: int, top: float) -> Floats:
    """Return the ω² at which each of the lowest λ_i meets ω² first, (count,), rising.

    Args:
        pencil: what vibrates.
        count: how many.
        top: ω², rad²/s², near which the highest of them is.
    """
    found = []
    for number in range(count):
        high = np.sqrt(top)
        while pencil.vector(number, high / (2 * np.pi))[0] > high**2:
            high *= 2
        found.append(_meeting(pencil, number, 0.0, high)[0])
    return np.sort(np.array(found))


def _meeting(pencil: Pencil, number: int, low: float, high: float) -> tuple[float, Floats]:
    """Return ω² and the vector where λ_i(ω) meets ω² between two ω, rad/s."""
    omega = (low + high) / 2
    for _ in range(MAX_STEPS):
        value, vector = pencil.vector(number, omega / (2 * np.pi))
        if value > omega**2:
            low = omega
        else:
            high = omega
        after = np.sqrt(max(_quotient(pencil, vector, max(value, 0.0)), 0.0))
        if not low <= after <= high:
            after = (low + high) / 2
        if abs(after**2 - omega**2) <= CONVERGED * high**2:
            return float(after**2), vector
        omega = after
    raise SolveError(
        f"mode {number + 1} near {omega / (2 * np.pi):.3g} Hz was not found: the rates of its mounts "
        "change too fast with frequency; look at their table"
    )


def _quotient(pencil: Pencil, vector: Floats, guess: float) -> float:
    """Return the ω² at which that is Rayleigh's quotient of a vector, or nearly so, by secants."""
    stretch = (pencil.motions @ vector) ** 2
    base = float(vector @ (pencil.stiffness @ vector))

    def quotient(omega_squared: float) -> float:
        frequency_hz = np.sqrt(max(omega_squared, 0.0)) / (2 * np.pi)
        return base + float(pencil.change(frequency_hz) @ stretch)

    before, x = guess, quotient(guess)
    error_before = x - before
    for _ in range(MAX_STEPS):
        error = quotient(x) - x
        if abs(error) <= CONVERGED * abs(x) or error == error_before:
            break
        before, x, error_before = x, x - error * (x - before) / (error - error_before), error
    return x
