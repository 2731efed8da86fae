"""Axes of a chart: where values are drawn, and the round values that are written."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.text.wording import number, power_of_ten

USUAL_HZ, USUAL_SHOWN_HZ = 40.0, (1.0, 25.0)
"""The usual band's end, and what of it is drawn."""

MOST_TICKS = 8
DECIBELS = 60
"""How far below its top a spectrum is drawn."""


@dataclass(frozen=True)
class Axis:
    """One axis of a chart."""

    title: str
    """With its unit: "Frequency, Hz"."""
    low: float
    high: float
    is_logarithmic: bool = False

    def __post_init__(self) -> None:
        assert self.low < self.high
        assert self.low > 0 or not self.is_logarithmic

    def place(self, values: NDArray[np.float64] | Sequence[float] | float) -> NDArray[np.float64]:
        """The places of values between the ends, 0 to 1; far below where there is no logarithm."""
        values, ends = np.asarray(values, float), np.array([self.low, self.high])
        if self.is_logarithmic:
            values, ends = np.log10(np.maximum(values, 1e-9 * self.low)), np.log10(ends)
        return (values - ends[0]) / (ends[1] - ends[0])

    def ticks(self) -> list[tuple[float, str]]:
        """Round values and how they are written."""
        return self._decades() if self.is_logarithmic else self._even()

    def _even(self) -> list[tuple[float, str]]:
        step = _round_up((self.high - self.low) / MOST_TICKS)
        decimals = max(0, -math.floor(math.log10(step) + 1e-9))
        first, last = math.ceil(self.low / step - 1e-9), math.floor(self.high / step + 1e-9)
        return [(i * step, number(i * step, decimals)) for i in range(first, last + 1)]

    def _decades(self) -> list[tuple[float, str]]:
        first, last = math.floor(math.log10(self.low)), math.ceil(math.log10(self.high))
        if last - first > 3:
            every = math.ceil((last - first) / MOST_TICKS)
            found = [(10.0**e, power_of_ten(e)) for e in range(first, last + 1, every)]
        else:
            found = [
                (m * 10.0**e, f"{m * 10.0**e:g}") for e in range(first, last + 1) for m in (1, 2, 5)
            ]
        inside = [(v, text) for v, text in found if -1e-9 < self.place(v) < 1 + 1e-9]
        return inside if len(inside) > 2 else self._even()


def shown_hz(highest_frequency: float) -> tuple[float, float]:
    """The part of a band that is drawn: of the usual one the paper's part, of others all."""
    if highest_frequency == USUAL_HZ:
        return USUAL_SHOWN_HZ
    return min(USUAL_SHOWN_HZ[0], highest_frequency / USUAL_HZ), highest_frequency


def decibel_axis(title: str, curves: Sequence[NDArray[np.float64]]) -> Axis:
    """An axis of whole tens of dB that holds the curves, at most `DECIBELS` below their top."""
    top = 10 * math.ceil(max(c.max() for c in curves) / 10)
    bottom = 10 * math.floor(min(c.min() for c in curves) / 10)
    return Axis(title, min(max(bottom, top - DECIBELS), top - 10), top)


def _round_up(step: float) -> float:
    """The next of 1, 2, 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(step))
    return next(m * power for m in (1, 2, 5, 10) if m * power >= step * (1 - 1e-9))


def round_top(value: float) -> float:
    """The next of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(value)) if value > 0 else 1.0
    return next(m * power for m in (1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12) if m * power >= value)
