"""Responses at many sets of mount rates from few stretches, by Galerkin's method.

At one frequency, x = (I + GΔ)⁻¹ b are the stretches of the mount springs once their rates have changed
by Δ. While these changes are small, all x lie close to the span of a few, V, of those that some samples
have; within it (I + VᴴGΔV) y = Vᴴ b is a small system (A. K. Noor, J. M. Peters, "Reduced basis
technique for nonlinear analysis of structures", AIAA Journal 18(4), 1980).
"""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.reanalysis import Receptances, solve_checked
from modeviz.dynamics.spring_law import SpringLaw
from modeviz.vehicle.arrays import Complexes, Floats

TOLERANCE = 3e-4
"""What the stretches left out may be, relative to the largest."""

SOFTEST = 1e-9
"""A spring softer than this part of the stiffest counts as if it were so stiff."""


@dataclass(frozen=True, eq=False)
class _Line:
    """One frequency; stretches are scaled so that every spring counts by its energy."""

    basis: Complexes
    """V, (n_springs, n_few)."""
    between: Complexes
    """(n_springs, n_few²): VᴴG and V of each spring, multiplied."""
    load: Complexes
    """Vᴴ b, (n_few, n_inputs)."""
    outputs: Complexes
    """(n_springs, n_outputs)."""
    direct: Complexes
    """(n_outputs, n_inputs)."""

    def responses(self, change: Complexes, frequency_hz: float) -> Complexes:
        """(n_sets, n_outputs, n_inputs) for changes of rates, (n_sets, n_springs)."""
        n_few, n_inputs = self.load.shape
        A = (change @ self.between).reshape(len(change), n_few, n_few)
        A[:, range(n_few), range(n_few)] += 1
        b = np.broadcast_to(self.load, (len(change), n_few, n_inputs))
        y = solve_checked(A, b, np.full(len(change), frequency_hz))
        forces = np.tensordot(y, self.basis, (1, 1)) * change[:, None]
        return self.direct - np.tensordot(forces, self.outputs, 1).transpose(0, 2, 1)


@dataclass(frozen=True, eq=False)
class Reduced:
    """Receptances whose stretches are combinations of few."""

    frequency_hz: Floats
    """(n_freqs,)."""
    mount_stiffness: Complexes
    """(n_springs,), N/m: from which rates change."""
    lines: tuple[_Line, ...]
    """One for each frequency."""
    law: SpringLaw
    """How rates depend on frequency."""

    def responses(self, stiffness: Complexes) -> Complexes:
        """The responses at sets of mount rates; arguments and errors as `Receptances.responses`."""
        changes = _changes(self.law, self.frequency_hz, stiffness, self.mount_stiffness)
        pairs = zip(self.lines, changes, self.frequency_hz.tolist(), strict=True)
        return np.stack([line.responses(change, f) for line, change, f in pairs], axis=1)


def reduced(receptances: Receptances, stiffness: Complexes) -> Reduced:
    """Reduce springs to as few stretches as samples need; it pays where there are few inputs.

    Args:
        receptances: at one frequency or more.
        stiffness: (n_sets, n_springs), complex rates to learn from, N/m, the first in their midst.

    Raises:
        SolveError: with rates of a set an undamped resonance lies on a frequency.
    """
    middle, f = receptances.modified(stiffness[0]), receptances.frequency_hz
    rates = np.abs(middle.law.stiffness(stiffness[0], f[len(f) // 2 :])[0])
    scale = np.sqrt(np.maximum(rates, SOFTEST * rates.max()))
    changes = _changes(middle.law, f, stiffness, stiffness[0])
    lines = tuple(_line(middle, i, change, scale) for i, change in enumerate(changes))
    return Reduced(f, stiffness[0], lines, middle.law)


def _changes(
    law: SpringLaw, frequency_hz: Floats, stiffness: Complexes, base: Complexes
) -> Iterator[Complexes]:
    """Return the changes of sets of rates, (n_sets, n_springs), from others, frequency by frequency."""
    shape = len(frequency_hz), len(base)
    ratios = np.broadcast_to(law.ratios(frequency_hz), shape)
    present = np.broadcast_to(law.at_reference.stiffness(base, frequency_hz), shape)
    return (stiffness * ratio - there for ratio, there in zip(ratios, present, strict=True))


def _line(middle: Receptances, i: int, changes: Complexes, scale: Floats) -> _Line:
    G, b = middle.springs[i], middle.inputs[i]
    A = np.eye(len(scale)) + G * changes[:, None]
    f = np.full(len(changes), middle.frequency_hz[i])
    x = solve_checked(A, np.broadcast_to(b, (len(A), *b.shape)), f)
    samples = (x * scale[:, None]).transpose(1, 0, 2).reshape(len(scale), -1)
    squares, vectors = np.linalg.eigh(samples @ samples.conj().T)
    kept = vectors[:, squares > TOLERANCE**2 * squares[-1]]
    V, Vh = (kept / scale[:, None]).astype(complex), (kept * scale[:, None]).conj().T
    between = ((Vh @ G).T[:, :, None] * V[:, None, :]).reshape(len(scale), -1)
    return _Line(V, between, Vh @ b, middle.outputs[i], middle.direct[i])
