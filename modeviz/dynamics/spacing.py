"""Frequencies at which responses are solved: evenly spaced, and closer where a mode is sharp.

The lines are where a counting function t(f) is whole,

    t = f/h + Σ_r N_r Φ((f - f_r)/γ_r),

γ = ζ f_n being half the width of a resonance at half its power and Φ' about 1/√(γ² + (f - f_r)²) near
it. So N_r lines are added to those around a mode, in a grading that turns a resonance into a smooth
function of t, whose integral a sum of equal steps gives; the lines away from sharp modes stay.
"""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from modeviz.vehicle.arrays import Floats

FINE = 2.0
"""How far from the real axis of t a resonance's pole is, in steps: sums are right to 2 e^{-2πt}."""

REACH = 2.5
"""Steps from a mode within which lines are added."""

NEAR = 4.0
"""Beyond so many times `REACH` lines stay where they are."""

PHASE = 3.0
"""How far around a mode, in units of asinh((f - f_r)/γ), lines are shifted to have one on the mode."""

SHARPEST = 1e-5
"""Damping ratio below which a mode counts as undamped: no lines resolve it."""

N_CELLS = 120
"""Cubics that tell where lines are added, for each mode."""

CLASS = 1.1
"""Factor between half widths that are told apart."""

SLIGHT = 1e-3
"""Of a line: by so much the ends of the band may be shifted."""

SHARED = 0.3
"""Relative singular value below which modes share their lines."""

N_LOOKED_AT = 17
"""Places around each mode that are counted, before whole numbers are looked for."""

SAME = 1e-4
"""Of a step of the grid: lines that moved less have not."""

BESIDE = 1.5
"""Steps of the grid: places farther apart have lines of the grid alone between them."""


def placed_lines(grid_hz: Floats, natural_frequency_hz: Floats, damping_ratio: Floats) -> Floats:
    """Lines for modes, (n_lines,), rising: a grid whose lines move and have others beside sharp modes.

    Args:
        grid_hz: (n_freqs,), evenly spaced.
        natural_frequency_hz: (n_modes,).
        damping_ratio: (n_modes,); undamped modes are passed over.
    """
    if len(grid_hz) < 2:
        return grid_hz
    start, h = grid_hz[0], (grid_hz[-1] - grid_hz[0]) / (len(grid_hz) - 1)
    f = (natural_frequency_hz - start) / h
    gamma = damping_ratio * natural_frequency_hz / h
    is_sharp = (damping_ratio > SHARPEST) & (gamma < FINE)
    is_sharp &= (f > -NEAR * REACH) & (f < len(grid_hz) - 1 + NEAR * REACH)
    if not is_sharp.any():
        return grid_hz
    classes = CLASS ** np.floor(np.log(gamma[is_sharp]) / np.log(CLASS))
    lines = _lines(f[is_sharp].tobytes(), classes.tobytes(), len(grid_hz) - 1)
    placed, on_grid = start + h * lines, lines == np.round(lines)
    placed[on_grid] = grid_hz[lines[on_grid].astype(int)]
    return placed


@dataclass(frozen=True, eq=False)
class _Counting:
    """t of x, which is the number of a line of the grid if that is whole."""

    center: Floats
    gamma: Floats
    """(n_modes,): where modes are and half their widths, in steps of the grid."""
    cells: Floats
    """(n_modes N_CELLS, 4): of each mode's `_grading`, one after the other."""
    parts: Floats
    """(2, n_modes): what each adds is the first plus the second times the grading."""
    phase: Floats
    """(n_modes,): by how many lines t is shifted on the mode."""
    last: int
    """Number of the grid's last line."""

    def __call__(self, x: Floats) -> tuple[Floats, Floats]:
        """The counts t and dt/dx, (n,) both."""
        stretched = self.stretched(x)
        added, slope = self.added(*stretched)
        shift, turn = self.shift(*stretched)
        offset, factor = self.parts
        t = x + offset.sum() + added @ factor + shift @ self.phase
        return t, 1 + slope @ factor + turn @ self.phase

    def added(self, d: Floats, u: Floats, width: Floats) -> tuple[Floats, Floats]:
        """The grading of each mode at places, and that differentiated, (n, n_modes)."""
        per_u = N_CELLS / (2 * np.arcsinh(NEAR * REACH / self.gamma))
        place = np.clip(u * per_u + N_CELLS / 2, 0, N_CELLS)
        i = np.minimum(place.astype(int), N_CELLS - 1)
        w = place - i
        cells = self.cells[i + N_CELLS * np.arange(len(self.center))]
        c0, c1, c2, c3 = np.moveaxis(cells, -1, 0)
        slope = (c1 + w * (2 * c2 + 3 * w * c3)) * per_u / width
        return c0 + w * (c1 + w * (c2 + w * c3)), slope

    def shift(self, d: Floats, u: Floats, width: Floats) -> tuple[Floats, Floats]:
        """One on a mode, falling to zero beside it, and that differentiated, (n, n_modes)."""
        shift = np.exp(-((u / PHASE) ** 2) - (d / REACH) ** 2)
        return shift, -2 * shift * (u / PHASE**2 / width + d / REACH**2)

    def stretched(self, x: Floats) -> tuple[Floats, Floats, Floats]:
        """Distances d = x - center, u = asinh(d/γ) and dx/du, (n, n_modes) each."""
        d = x[:, None] - self.center
        width = np.sqrt(self.gamma**2 + d**2)
        return d, np.arcsinh(d / self.gamma), width


def _counting(center: Floats, gamma: Floats, last: int) -> _Counting:
    """The counting function of modes at places on the grid, whole at both ends of it."""
    cells = np.concatenate([_grading(each) for each in gamma.tolist()])
    alone = np.array([np.zeros(len(center)), np.ones(len(center))])
    counting = _Counting(center, gamma, cells, alone, 0 * center, last)
    before, after = counting.added(*counting.stretched(np.array([0.0, last])))[0]
    factor = np.ceil(after - before) / (after - before)
    counting = replace(counting, parts=np.array([-before * factor, factor]))
    return replace(counting, phase=_phase(counting))


@lru_cache(maxsize=512)
def _grading(gamma: float) -> Floats:
    """The number of lines that a mode adds up to places beside it, as cubics, (N_CELLS, 4).

    Equal cells of u = asinh(d/γ), each with its powers of 0 to 1.

    Args:
        gamma: half the mode's width, in steps of the grid.
    """
    end = np.arcsinh(NEAR * REACH / gamma)
    u, step = np.linspace(-end, end, N_CELLS + 1, retstep=True)
    d = gamma * np.sinh(u)
    slopes = 2 / np.pi * (FINE - gamma) * np.exp(-((d / REACH) ** 2)) * step
    bend = slopes * step * np.hypot(gamma, d) * -2 * d / REACH**2
    parts = (slopes[:-1] + slopes[1:]) / 2 + (bend[:-1] - bend[1:]) / 12
    before, p, q = np.cumsum(parts) - parts, slopes[:-1], slopes[1:]
    return np.stack([before, p, 3 * parts - 2 * p - q, p + q - 2 * parts], axis=1)


def _phase(counting: _Counting) -> Floats:
    """Shifts that bring a line onto each mode, (n_modes,), as far as modes do not share their lines."""
    ends = counting.stretched(np.array([0.0, counting.last]))
    free = np.flatnonzero(counting.shift(*ends)[0].max(axis=0) < SLIGHT)
    t, _ = counting(counting.center[free])
    shares = counting.shift(*counting.stretched(counting.center[free]))[0][:, free]
    phase = np.zeros(len(counting.center))
    phase[free] = np.clip(np.linalg.lstsq(shares, np.round(t) - t, rcond=SHARED)[0], -0.5, 0.5)
    return phase


@lru_cache(maxsize=64)
def _lines(center: bytes, gamma: bytes, last: int) -> Floats:
    """Places where the counting function is whole, in steps of the grid; kept for similar rates."""
    lines = _whole(_counting(np.frombuffer(center), np.frombuffer(gamma), last))
    lines.flags.writeable = False
    return lines


def _whole(counting: _Counting) -> Floats:
    """Places where the counting function is whole, from the grid's first line to its last."""
    last = counting.last
    grid = np.arange(last + 1.0)
    is_near = (np.abs(grid[:, None] - counting.center) < NEAR * REACH + 1).any(axis=1)
    u = np.linspace(-1, 1, N_LOOKED_AT)[:, None] * np.arcsinh(NEAR * REACH / counting.gamma)
    around = (counting.center + counting.gamma * np.sinh(u)).ravel()
    x = np.sort(np.concatenate([grid[is_near], around[(around > 0) & (around < last)]]))
    t, _ = counting(x)
    whole = np.arange(np.ceil(t[0] - SAME), np.floor(t[-1] + SAME) + 1)
    after = np.clip(np.searchsorted(t, whole), 1, len(x) - 1)
    low, high = x[after - 1], x[after]
    is_within = high - low < BESIDE
    whole, low, high = whole[is_within], low[is_within], high[is_within]
    about = np.interp(whole, t, x)
    reached, slope = counting(about)
    lines = np.clip(about - (reached - whole) / slope, low, high)
    nearest = np.round(lines)
    lines = np.where(np.abs(lines - nearest) < SAME, nearest, lines)
    resting = x[(np.abs(t - np.round(t)) < SAME) & (x == np.round(x))]
    return np.unique(np.concatenate([grid[~is_near], resting, lines, [0.0, last]]))
