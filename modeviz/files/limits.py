"""Limits on what is read, checked before it takes memory or time."""

import os

from modeviz.errors import VehicleError

VARIABLE = "MODEVIZ_LIMIT"
"""The environment variable that allows everything to be so many times as large."""

LARGEST_FACTOR = 1000
"""The most that it may say."""


def check_size(what: str, found: int, most: int) -> None:
    """Checks that there is not too much of something.

    Args:
        what: there is, in the plural.
        found: how many.
        most: how many are read, unless `VARIABLE` is set.

    Raises:
        VehicleError: there are more.
    """
    allowed = int(most * _factor())
    if found > allowed:
        raise VehicleError(
            f"found {found:,} {what}, expected at most {allowed:,}; {_advice(found, most)}"
        )


def most_allowed(most: int) -> int:
    """The number of something that is read, of which there are usually at most so many."""
    return int(most * _factor())


def _advice(found: int, most: int) -> str:
    """A sentence on how more than usual is allowed, as far as it can be."""
    needed = -(-found // most)
    if needed <= LARGEST_FACTOR:
        return f"{VARIABLE}={needed} in the environment would allow them"
    return f"{VARIABLE}={LARGEST_FACTOR} in the environment would allow {most * LARGEST_FACTOR:,}"


def _factor() -> float:
    text = os.environ.get(VARIABLE, "1")
    try:
        factor = float(text)
    except ValueError:
        factor = 0.0
    if not 1 <= factor <= LARGEST_FACTOR:
        raise VehicleError(f"{VARIABLE}: found {text!r}, expected a number from 1 to {LARGEST_FACTOR}")
    return factor
