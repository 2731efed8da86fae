"""Frequencies as a person writes them: "11, 13.25" or "6 to 14 by 1/3"."""

import re
from fractions import Fraction

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats

MOST = 2_000
"""So many are looked at in a search that somebody waits for."""

NUMBER = r"\d+(?:\.\d*)?|\.\d+"
ITEM = re.compile(
    rf"({NUMBER})(?:\s*to\s*({NUMBER})\s*by\s*({NUMBER})(?:\s*/\s*({NUMBER}))?)?", re.ASCII
)

FEWEST = 4
"""So many evenly spaced ones are a range; fewer are written out."""
LARGEST_DIVISOR = 100
"""Of the step of a range that is written as a fraction."""
CLOSE = 1e-9
"""Of a step."""


def parse_frequencies(text: str) -> Floats:
    """The frequencies of a text, Hz, rising and each once.

    Args:
        text: numbers and ranges with commas between; a range goes as far as its last frequency.

    Raises:
        VehicleError: anything else, or too many.
    """
    found: list[float] = []
    for item in text.split(","):
        match = ITEM.fullmatch(item.strip())
        if match is None:
            raise _unreadable(item.strip())
        found += _span(*match.groups())
        if len(found) > MOST:
            raise VehicleError(f"frequencies: found more than {MOST}: take a wider step")
    return np.unique(found)


def spoken_frequencies(frequency_hz: Floats) -> str:
    """A text that `parse_frequencies` reads, to ten digits."""
    f = np.asarray(frequency_hz)
    if len(f) >= FEWEST and np.allclose(np.diff(f, 2), 0, atol=CLOSE):
        step = (f[-1] - f[0]) / (len(f) - 1)
        return f"{f[0]:.10g} to {f[-1]:.10g} by {_spoken_step(step)}"
    return ", ".join(f"{value:.10g}" for value in f)


def _span(first: str, last: str | None, step: str | None, divisor: str | None) -> list[float]:
    """The frequencies of one item."""
    if last is None or step is None:
        return [float(first)]
    low, high, by = float(first), float(last), float(step)
    below = float(divisor) if divisor else 1.0
    if not (by and below and high > low):
        raise _unreadable(f"{first} to {last} by {step}{f'/{divisor}' if divisor else ''}")
    by /= below
    n_steps = (high - low) / by
    if n_steps > MOST:
        raise VehicleError(f"frequencies: found more than {MOST}: take a wider step")
    n_whole = int(n_steps + CLOSE)
    end = high if abs(n_steps - n_whole) <= CLOSE else low + n_whole * by
    return np.linspace(low, end, n_whole + 1).tolist()


def _spoken_step(step: float) -> str:
    """A step as a short number, or else as a fraction if it is one of small numbers."""
    fraction = Fraction(step).limit_denominator(LARGEST_DIVISOR)
    is_short = f"{step:.10g}" == f"{step:.4g}"
    is_fraction = abs(float(fraction) - step) < CLOSE * step
    return f"{step:.10g}" if is_short or not is_fraction else str(fraction)


def _unreadable(found: str) -> VehicleError:
    return VehicleError(
        f"frequencies: found {found!r}, expected numbers and ranges in Hz, as in 11, 13.25 or "
        "6 to 14 by 1/3"
    )
