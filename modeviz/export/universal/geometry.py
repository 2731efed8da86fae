"""Units, nodes, triangles and lines of a universal file: data sets 164, 2411, 2412 and 82."""

import numpy as np

from modeviz.export.universal.blocks import data_set, line_of_text, whole, wrapped
from modeviz.vehicle.arrays import Array, Floats

SI, KELVIN = 1, 273.15
"""The code of metres and newtons, and what a temperature of zero is there."""

THIN_SHELL, COLOR = 91, 7
"""The finite element descriptor of a triangle of three nodes; white."""


def units() -> str:
    """Return data set 164, which says SI units."""
    factors = "".join(_double(value) for value in (1.0, 1.0, 1.0))
    return data_set(164, f"{SI:10d}{'SI: Meter (newton)':<20}{2:10d}", factors, _double(KELVIN, 17))


def nodes(labels: Array, places: Floats) -> str:
    """Return data set 2411, nodes in the basic coordinates.

    Args:
        labels: (n,).
        places: (n, 3), m.
    """
    lines = []
    for label, place in zip(labels.tolist(), places.tolist(), strict=True):
        lines.append(whole((label, 0, 0, COLOR)))
        lines.append("".join(_double(value, 16) for value in place))
    return data_set(2411, *lines)


def triangles(corners: Array) -> str:
    """Return data set 2412, shells on the nodes of those labels, (n, 3); nothing if there are none."""
    lines = []
    for number, labels in enumerate(corners.tolist(), start=1):
        lines.append(whole((number, THIN_SHELL, 1, 1, COLOR, len(labels))))
        lines.append(whole(labels))
    return data_set(2412, *lines) if lines else ""


def trace_line(number: int, name: str, pairs: Array) -> str:
    """Return data set 82, lines between nodes of those labels, (n, 2); nothing if there are none."""
    lifted = np.column_stack([pairs, np.zeros(len(pairs), int)]).ravel().tolist()[:-1]
    if not lifted:
        return ""
    return data_set(82, whole((number, len(lifted), COLOR)), line_of_text(name), *wrapped(lifted))


def _double(value: float, digits: int = 17) -> str:
    """A number of double precision in 25 columns."""
    return f"{value:25.{digits}E}".replace("E", "D")
