"""How far two right computations of one number lie apart at most, whatever the processor.

Kernels of BLAS sum in other orders, so that last bits depend on the processor, on the number of threads
and on how many systems are solved at once. A solution of A x = b is right to a relative n ε κ(A), with
rows and columns of A scaled to a diagonal of ones (N. J. Higham, "Accuracy and Stability of Numerical
Algorithms", 2nd edition, theorems 9.3 and 7.2). Two solutions differ by twice that, their squares by
four times.
"""

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.dynamics.assembly import System, assemble
from modeviz.vehicle.arrays import Floats

EPSILON = float(np.finfo(np.float64).eps)

SEARCHED = 1e-9
"""Relative, between the goals of two searches of one problem: each ends where a step brings 1e-12 of
the goal (`descent.TOLERANCE`), which may be a step sooner."""

SEARCHED_X = 1e-4
"""Between their designs, ln k, and between other goals of these: the goal searched for changes by the
square of that."""


def of_powers(system: System, frequency_hz: Floats) -> float:
    """Relative, of power spectra from the equations of motion, and of what is summed from them."""
    omegas = 2 * np.pi * np.asarray(frequency_hz)
    K = system.stiffness + 1j * system.structural_damping
    Z = np.array([K + 1j * w * system.damping - w**2 * system.mass for w in omegas])
    size = np.sqrt(np.abs(np.diagonal(Z, axis1=1, axis2=2)))
    scaled = Z / (size[:, :, None] * size[:, None, :])
    return float(4 * system.n_dofs * EPSILON * np.linalg.cond(scaled).max())


CABIN = of_powers(assemble(mounted_cabin()), np.linspace(0.5, 40, 80))
"""Of the small cabin with rates about its own."""

TRUCK = 1e-8
"""Of the pickup: 430 coordinates, κ = 1.9e4 from 6 to 14 Hz."""


def assert_near(found: Floats, expected: Floats, within: float, lines: int = 0) -> None:
    """Differences are small beside the largest value of the same line, whatever else it holds."""
    axes = tuple(i for i in range(np.ndim(expected)) if i != lines)
    largest = np.abs(expected).max(axis=axes, keepdims=True)
    worst = np.max(np.abs(np.asarray(found) - expected) / np.where(largest > 0, largest, 1.0))
    assert worst <= within, f"{worst:.1e} of the largest, expected at most {within:.1e}"
