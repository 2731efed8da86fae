"""Data sets of a universal file as text, column by column.

After the file formats of Structural Dynamics Research Corporation, as the University of Cincinnati
keeps them.
"""

from collections.abc import Iterable, Sequence

import numpy as np

from modeviz.vehicle.arrays import Array

LONGEST_LINE = 80
"""Letters of a line of text."""

LEAST = 1e-99
"""Of a number: the exponent of a smaller one would fill the space before it."""

LEFT_OUT = "NONE"
"""A line of text of which nothing is to be said."""


def data_set(number: int, *lines: str) -> str:
    """Return a data set of that number with its lines."""
    return "\n".join([f"{-1:6d}", f"{number:6d}", *lines, f"{-1:6d}", ""])


def line_of_text(text: str) -> str:
    """Return a text as a line in ASCII, cut where it is too long."""
    plain = " ".join(text.split()).encode("ascii", "replace").decode()
    return plain[:LONGEST_LINE] or LEFT_OUT


def whole(values: Iterable[int]) -> str:
    """Return whole numbers as a line, each in ten columns."""
    return "".join(f"{value:10d}" for value in values)


def wrapped(values: Sequence[int]) -> list[str]:
    """Return whole numbers as lines of eight."""
    return [whole(values[i : i + 8]) for i in range(0, len(values), 8)]


def real(values: Iterable[float]) -> str:
    """Return numbers as a line, each in thirteen columns with six digits."""
    return "".join(f"{value:13.5E}" for value in not_too_small(np.array([*values])).tolist())


def not_too_small(values: Array) -> Array:
    """Return numbers with zeros for those that are too small to be written."""
    return np.where(np.abs(values) < LEAST, 0.0, values)


def interleaved(values: Array) -> Array:
    """Return real and imaginary parts in turn along the last axis; real numbers as they are."""
    if not np.iscomplexobj(values):
        return values
    pairs = np.stack([np.real(values), np.imag(values)], axis=-1)
    return pairs.reshape(*values.shape[:-1], -1)
