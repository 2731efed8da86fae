"""Integrals over frequency of what is known at lines that lie closer where a response is sharp.

Lines f_j are equal steps of a parameter t, j = t, of which frequency is a smooth function. So
∫ S df = ∫ S f'(t) dt is a sum of equal steps, which for smooth functions is far more accurate than
trapezia over the lines as they lie (L. N. Trefethen, J. A. C. Weideman, "The exponentially convergent
trapezoidal rule", SIAM Review 56(3), 2014).
"""

from functools import lru_cache

import numpy as np

from modeviz.vehicle.arrays import Floats

N_SLOPE = 15
"""Lines that tell the slope f'(t) at their middle."""

N_CELL = 6
"""Lines that tell an integral between two of them."""

SMOOTH = 0.3
"""How far, relative, the slope of lines may be from that of their polygon: they change smoothly."""

N_STEPS = 4
"""Of Newton's method, to find where in the parameter a frequency is."""


def integration_weights(frequency_hz: Floats, band: tuple[float, float]) -> Floats:
    """The weight of each value of a spectrum in its integral over a band, (n_freqs,), Hz.

    By trapezia where the lines are few or their distances change abruptly.

    Args:
        frequency_hz: (n_freqs,), rising.
        band: Hz; only the part that `frequency_hz` covers counts.
    """
    return _weights(np.asarray(frequency_hz, np.float64).tobytes(), band)


@lru_cache(maxsize=8)
def _weights(frequency_hz: bytes, band: tuple[float, float]) -> Floats:
    """Weights of `integration_weights`, kept for the next spectrum at the same lines."""
    f = np.frombuffer(frequency_hz)
    if not is_graded(f):
        return _trapezia(f, band)
    start, end = (_position(f, float(np.clip(edge, f[0], f[-1]))) for edge in band)
    return line_distances(f) * (_up_to(end, len(f)) - _up_to(start, len(f)))


def is_graded(f: Floats) -> bool:
    """Whether there are enough lines, and their distances change smoothly."""
    if len(f) <= N_SLOPE:
        return False
    slope, polygon = line_distances(f), np.gradient(f)
    return not (np.abs(slope - polygon) > SMOOTH * polygon).any()


def _trapezia(f: Floats, band: tuple[float, float]) -> Floats:
    """Weights of the integral of a polygon over a band, (n_freqs,), Hz."""
    start, end = np.clip(f[:-1], *band), np.clip(f[1:], *band)
    length, middle = end - start, (start + end) / 2
    of_right = length * (middle - f[:-1]) / np.diff(f)
    return np.append(length - of_right, 0.0) + np.insert(of_right, 0, 0.0)


def line_distances(f: Floats) -> Floats:
    """The distance that each of `N_SLOPE` lines or more stands for, f'(t), (n_freqs,), Hz.

    By the polynomials through the lines around it.
    """
    half = N_SLOPE // 2
    slope = np.empty(len(f))
    slope[half:-half] = np.correlate(f, _derivative(half))
    for i in range(half):
        slope[i] = _derivative(i) @ f[:N_SLOPE]
        slope[-1 - i] = _derivative(N_SLOPE - 1 - i) @ f[-N_SLOPE:]
    return slope


@lru_cache(maxsize=N_SLOPE)
def _derivative(at: int) -> Floats:
    """Weights (N_SLOPE,) of equidistant values whose sum is the derivative at one of them."""
    apart = np.subtract.outer(np.arange(N_SLOPE), np.arange(N_SLOPE)).astype(float)
    np.fill_diagonal(apart, 1)
    size = apart.prod(axis=1)
    weights = size[at] / (size * -apart[:, at])
    weights[at] = 0
    weights[at] = -weights.sum()
    return weights


def _position(f: Floats, frequency_hz: float) -> float:
    """T at a frequency within the lines."""
    if frequency_hz in (f[0], f[-1]):
        return 0.0 if frequency_hz == f[0] else len(f) - 1.0
    i = int(np.clip(np.searchsorted(f, frequency_hz, "right") - 1, 0, len(f) - 2))
    first = int(np.clip(i - N_CELL // 2 + 1, 0, len(f) - N_CELL))
    powers = np.arange(N_CELL, dtype=float)
    through = np.linalg.solve(powers[:, None] ** powers, f[first : first + N_CELL])
    polynomial = np.polynomial.Polynomial(through)
    derivative = polynomial.deriv()
    t = i - first + (frequency_hz - f[i]) / (f[i + 1] - f[i])
    for _ in range(N_STEPS):
        t -= (polynomial(t) - frequency_hz) / derivative(t)
    return first + float(np.clip(t, i - first, i - first + 1))


def _up_to(t: float, n: int) -> Floats:
    """Weights (n,) of values at 0, 1, ... whose sum is the integral from 0 to t."""
    weights = np.zeros(n)
    middle = N_CELL // 2 - 1
    whole = min(int(t), n - 2)
    inner = max(min(whole, n - N_CELL + middle + 1) - middle, 0)
    if inner:
        weights[: inner + N_CELL - 1] += np.convolve(np.ones(inner), _cell(middle, 1.0))
    for i in (*range(min(middle, whole)), *range(middle + inner, whole)):
        _add_cell(weights, i, 1.0)
    _add_cell(weights, whole, t - whole)
    return weights


def _add_cell(weights: Floats, i: int, part: float) -> None:
    """Adds the integral over a part of the cell behind value i."""
    first = min(max(i - N_CELL // 2 + 1, 0), len(weights) - N_CELL)
    weights[first : first + N_CELL] += _cell(i - first, part)


@lru_cache(maxsize=64)
def _cell(start: int, part: float) -> Floats:
    """Weights (N_CELL,) of equidistant values whose sum is the integral from one of them a part on."""
    powers = np.arange(1, N_CELL + 1)
    moments = ((start + part) ** powers - float(start) ** powers) / powers
    nodes = np.arange(N_CELL, dtype=float)
    return np.linalg.solve(nodes[None, :] ** (powers[:, None] - 1), moments).astype(np.float64)
