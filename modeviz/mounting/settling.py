"""Where mount springs settle under a load that stays, by Newton's method.

    q + f(d) - k₀ d = 0,    d = d₀ + G q

d are their deflections, d₀ those with the rates k₀ and G = R K₀⁻¹Rᵀ, see `static_system`. That is where
the potential energy has its only minimum, for curves rise; each step goes as far along Newton's
direction as the energy falls, at most the whole way (J. Nocedal and S. J. Wright, "Numerical
Optimization", 2nd ed., chapter 3).
"""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import get_lapack_funcs

from modeviz.errors import SolveError
from modeviz.mounting.springs import SpringLaws
from modeviz.vehicle.arrays import Floats

MOST_STEPS = 100
"""Each ends on another straight part of some curve."""

SETTLED = 1e-9
"""What springs may be off their curves, a part of the largest force."""

SINGULAR = 1e-12
"""The reciprocal condition of the springs' equation below which rounding has more to say than they."""

HALVINGS = 40
"""So finely is the way along a direction divided."""


@dataclass(frozen=True, eq=False)
class Settling:
    """The mount springs of a vehicle at some rates."""

    laws: SpringLaws
    stiffness: Floats
    """k, (n_springs,), of unloaded mounts."""
    base: Floats
    """k₀, (n_springs,)."""
    between: Floats
    """G, (n_springs, n_springs), m/N."""

    def straight(self, deflections: Floats) -> Floats:
        """Return q of springs without curves, (n_springs, n_cases).

        Args:
            deflections: d₀, (n_springs, n_cases).

        Raises:
            SolveError: nothing holds what a mount held.
        """
        change = (self.stiffness - self.base)[:, None]
        return self._solved(change, -change * deflections)

    def settled(self, deflections: Floats, case: str, names: tuple[str, ...]) -> Floats:
        """Return q in one load case, (n_springs,).

        Args:
            deflections: d₀, (n_springs,).
            case: the name of the load case.
            names: of the springs.

        Raises:
            SolveError: nothing holds what a mount held, or the springs do not settle.
        """
        q = self.straight(deflections[:, None])[:, 0]
        for _ in range(MOST_STEPS):
            d = deflections + self.between @ q
            off = self._off(q, d)
            if np.abs(off).max() <= SETTLED * np.abs([q, self.base * d]).max():
                return q
            slope = self.stiffness * self.laws.tangent(d) - self.base
            way = -self._solved(slope[:, None], off[:, None])[:, 0]
            q = q + self._step(deflections, q, way) * way
        d = deflections + self.between @ q
        off = self._off(q, d)
        worst = int(np.abs(off).argmax())
        raise SolveError(
            f"load case {case!r}: the mounts do not settle within {MOST_STEPS} steps; "
            f"{names[worst]} is {abs(off[worst]):.3g} N off its curve at {1e3 * d[worst]:.3g} mm, give "
            "that curve more points where it bends"
        )

    def by_stiffness(self, deflections: Floats) -> Floats:
        """Return derivatives of settled deflections to unloaded rates, (n_springs, n_springs).

        (K + Rᵀ k c' R) ∂x/∂k_s = -R_sᵀ c_s, for F = K x + Rᵀ f; at a corner of a curve of one side.

        Args:
            deflections: d, (n_springs,), where springs have settled.
        """
        return -self.compliance(deflections) * self.laws.force(np.ones_like(deflections), deflections)

    def compliance(self, deflections: Floats) -> Floats:
        """Return R (K + Rᵀ k c' R)⁻¹ Rᵀ, (n_springs, n_springs), m/N; argument as `by_stiffness`."""
        change = self.stiffness * self.laws.tangent(deflections) - self.base
        return self.between @ self._solved(change[:, None], np.eye(len(change)))

    def _off(self, q: Floats, d: Floats) -> Floats:
        """What springs are off their curves, N: zero where they settle."""
        return q + self.laws.force(self.stiffness, d) - self.base * d

    def _step(self, deflections: Floats, q: Floats, way: Floats) -> float:
        """How much of a way to go: all of it, or to where the energy is least on it."""
        moved = self.between @ way

        def falls(part: float) -> bool:
            there = q + part * way
            return float(moved @ self._off(there, deflections + self.between @ there)) <= 0

        if falls(1.0):
            return 1.0
        low, high = 0.0, 1.0
        for _ in range(HALVINGS):
            middle = (low + high) / 2
            low, high = (middle, high) if falls(middle) else (low, middle)
        return low or high

    def _solved(self, change: Floats, right: Floats) -> Floats:
        """(I + ΔG)⁻¹ of columns; `change` is Δ, (n_springs, 1).

        Raises:
            SolveError: it is singular.
        """
        equation = np.eye(len(change)) + change * self.between
        if not len(equation):
            return right
        dgetrf, dgecon, dgetrs = get_lapack_funcs(("getrf", "gecon", "getrs"), (equation,))
        factors, pivots, _ = dgetrf(equation)
        size = float(np.abs(equation).sum(axis=0).max())
        if dgecon(factors, size)[0] < SINGULAR:
            raise SolveError("with these mount rates something moves freely that only a mount holds")
        return np.asarray(dgetrs(factors, pivots, right)[0], np.float64)
