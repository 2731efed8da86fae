"""A universal file of functions: units, response points, and a data set 58 for each function."""

from collections.abc import Iterator

import numpy as np

from modeviz.export.functions import UNITS, Function, Functions, InputQuantity
from modeviz.export.universal.blocks import data_set, line_of_text, not_too_small, real, whole
from modeviz.export.universal.geometry import nodes, units
from modeviz.vehicle.arrays import Array, Floats

FREQUENCY_RESPONSE, PSD = 4, 9
"""Types of functions."""

REAL, COMPLEX = 4, 6
"""Double precision."""

UNKNOWN, FREQUENCY, ACCELERATION = 0, 18, 12
OF_INPUT: dict[InputQuantity, int] = {
    "displacement": 8,
    "force": 13,
    "acceleration": 12,
    "unbalance": 1,
}
"""Kinds of data; 1 is general."""

EVEN = 1e-9
"""Relative, of steps between frequencies that are all the same."""


def functions_file(functions: Functions) -> bytes:
    """Return a universal file of functions in SI; response points are its nodes, from one."""
    return "".join(_sets(functions)).encode("ascii")


def _sets(functions: Functions) -> Iterator[str]:
    places = np.array([point.position for point in functions.vehicle.response_points])
    yield units()
    yield nodes(np.arange(1, len(places) + 1), functions.axes.vectors(places))
    for number, function in enumerate(functions.functions, start=1):
        yield data_set(58, *_lines(functions, function, number))


def _lines(functions: Functions, function: Function, number: int) -> Iterator[str]:
    f, values, reference = functions.frequency_hz, function.values, function.reference
    step = (f[-1] - f[0]) / (len(f) - 1)
    is_even = bool(np.allclose(np.diff(f), step, rtol=EVEN, atol=0))
    unit = "(m/s^2)^2/Hz" if reference is None else f"(m/s^2)/({UNITS[reference.quantity]})"
    yield line_of_text(f"acceleration {functions.title(function)}")
    yield line_of_text(f"{functions.vehicle.name}, {functions.about}; {unit}")
    yield from ["NONE"] * 3
    yield _degrees_of_freedom(functions, function, number)
    kind = REAL if reference is None else COMPLEX
    spacing = (float(f[0]), float(step), 0.0) if is_even else (0.0, 0.0, 0.0)
    yield whole((kind, len(f), int(is_even))) + real(spacing)
    yield _axis(FREQUENCY, "Frequency", "Hz")
    if reference is None:
        yield _axis(ACCELERATION, "Acceleration PSD", unit)
        yield _axis(UNKNOWN, "NONE", "NONE")
    else:
        yield _axis(ACCELERATION, "Acceleration", "m/s^2")
        yield _axis(
            OF_INPUT[reference.quantity], reference.quantity.capitalize(), UNITS[reference.quantity]
        )
    yield _axis(UNKNOWN, "NONE", "NONE")
    yield _data(f, not_too_small(_parts(values)), is_even)


def _degrees_of_freedom(functions: Functions, function: Function, number: int) -> str:
    """The record of what responds to what.

    An input is a node beyond the response points: it has no place, for a road is under all wheels.
    """
    points, reference = functions.vehicle.response_points, function.reference
    name = line_of_text(points[function.point].name)[:10]
    response = function.point + 1, function.axis + 1
    to = response
    if reference is not None:
        inputs = list(dict.fromkeys(f.reference for f in functions.functions))
        to = len(points) + 1 + inputs.index(reference), reference.along
    kind = PSD if reference is None else FREQUENCY_RESPONSE
    return (
        f"{kind:5d}{number:10d}{0:5d}{0:10d} {name:<10}{response[0]:10d}{response[1]:4d} "
        f"{'NONE':<10}{to[0]:10d}{to[1]:4d}"
    )


def _axis(kind: int, label: str, unit: str) -> str:
    return f"{kind:10d}{0:5d}{0:5d}{0:5d} {label[:20]:<20} {unit[:20]:<20}"


def _parts(values: Array) -> Floats:
    """Real numbers as a column, complex ones as two, (n, 1 or 2)."""
    if np.iscomplexobj(values):
        return np.column_stack([np.real(values), np.imag(values)])
    return values[:, None]


def _data(f: Floats, parts: Floats, is_even: bool) -> str:
    """The numbers: four a line at even steps, else with their frequencies."""
    if is_even:
        flat = parts.ravel()
        rows = [flat[i : i + 4].tolist() for i in range(0, len(flat), 4)]
        return "\n".join("".join(f"{value:20.12E}" for value in row) for row in rows)
    per_line = 2 if parts.shape[1] == 1 else 1
    pairs = [
        f"{x:13.5E}" + "".join(f"{value:20.12E}" for value in values)
        for x, values in zip(f.tolist(), parts.tolist(), strict=True)
    ]
    return "\n".join("".join(pairs[i : i + per_line]) for i in range(0, len(pairs), per_line))
