"""A universal file of modes: units, points, and a data set 2414 or 55 for each mode.

Real modes have six motions at each node, complex ones the three translations, which is what test
systems write: pyuff and others read no complex rotations.
"""

from collections.abc import Callable, Iterator

import numpy as np

from modeviz.export.axes import FileAxes
from modeviz.export.points import Points
from modeviz.export.shapes import ShapeSet
from modeviz.export.universal.blocks import (
    LEFT_OUT,
    data_set,
    interleaved,
    line_of_text,
    not_too_small,
    real,
    whole,
)
from modeviz.export.universal.geometry import nodes, trace_line, triangles, units
from modeviz.formats.universal.shapes import RESIDUAL
from modeviz.vehicle.arrays import Array

STRUCTURAL, NORMAL, COMPLEX = 1, 2, 3
"""The model; kinds of analysis: normal modes, and complex ones by their eigenvalue."""

TRANSLATIONS, SIX_MOTIONS, DISPLACEMENT = 2, 3, 8
"""What a node's data are: x, y, z, or these and rx, ry, rz; and of what."""

SINGLE, SINGLE_COMPLEX = 2, 5
"""Precision of data."""

N_COLUMNS = 6
"""Of a line of data: six real numbers, or three complex ones."""

SetWriter = Callable[[ShapeSet, int, list[str], list[str]], str]


def modes_file(name: str, points: Points, shapes: ShapeSet, axes: FileAxes, number: int) -> bytes:
    """Return a universal file of modes in SI.

    Args:
        name: of the vehicle or the body, to say so.
        points: what moves; they are labelled from one, in their order.
        shapes: the modes.
        axes: in which it is written.
        number: of the data set of a mode, 2414 or 55.
    """
    sets = _sets(name, points, shapes, axes, number)
    return b"".join(text.encode("ascii") for text in sets)  # megabytes each


def _sets(name: str, points: Points, shapes: ShapeSet, axes: FileAxes, number: int) -> Iterator[str]:
    labels = np.arange(1, len(points.places) + 1)
    yield units()
    yield nodes(labels, axes.vectors(points.places))
    yield triangles(labels[points.triangles])
    for line, part in enumerate(points.parts, start=1):
        yield trace_line(line, part.body, labels[part.lines + points.starts[part.body]])
    moved = axes.motions(points.shapes(shapes.coordinates, shapes.dofs))
    form = "\n".join(["%10d\n" + "%13.5E" * N_COLUMNS] * len(labels))
    for mode in range(len(shapes.numbers)):
        data = form % tuple(_rows(labels, moved[:, :, mode]).ravel().tolist())
        header = _header_55 if number == 55 else _header_2414
        yield data_set(number, *header(shapes, mode, _titles(name, shapes, mode)), data)


def _titles(name: str, shapes: ShapeSet, mode: int) -> list[str]:
    """Five lines that say what a mode is, and its numbers with all their digits.

    The fourth marks a residual vector, as our reader has it: no kind of analysis of these data sets is
    one, and other programs use it like a mode.
    """
    is_residual = mode >= len(shapes.numbers) - shapes.n_residuals
    return [
        line_of_text(f"{name}: mode {shapes.numbers[mode]}, {shapes.names[mode]}"),
        line_of_text(
            f"{shapes.frequency_hz[mode]:.12g} Hz, damping ratio {shapes.damping_ratio[mode]:.9g}"
        ),
        line_of_text("mass-normalised: 1/sqrt(kg), rotations rad/(m sqrt(kg))"),
        RESIDUAL if is_residual else LEFT_OUT,
        LEFT_OUT,
    ]


def _kinds(shapes: ShapeSet) -> tuple[int, ...]:
    """The record that says what the data of a mode are."""
    if shapes.eigenvalue is not None:
        return STRUCTURAL, COMPLEX, TRANSLATIONS, DISPLACEMENT, SINGLE_COMPLEX, 3
    return STRUCTURAL, NORMAL, SIX_MOTIONS, DISPLACEMENT, SINGLE, 6


def _complex_parameters(shapes: ShapeSet, mode: int) -> list[float]:
    """Eigenvalue, modal A and modal B of a complex mode, real and imaginary parts in turn."""
    if shapes.eigenvalue is None or shapes.modal_a is None:
        return [0.0] * 6
    root, a = shapes.eigenvalue[mode], shapes.modal_a[mode]
    return interleaved(np.array([root, a, -root * a])).tolist()


def _header_55(shapes: ShapeSet, mode: int, titles: list[str]) -> list[str]:
    if shapes.eigenvalue is None:
        parameters = [
            float(shapes.frequency_hz[mode]),
            1.0,
            float(shapes.damping_ratio[mode]),
            shapes.loss_factor,
        ]
    else:
        parameters = _complex_parameters(shapes, mode)
    return [
        *titles,
        whole(_kinds(shapes)),
        whole((2, len(parameters), 1, shapes.numbers[mode])),
        real(parameters),
    ]


def _header_2414(shapes: ShapeSet, mode: int, titles: list[str]) -> list[str]:
    number, frequency = shapes.numbers[mode], float(shapes.frequency_hz[mode])
    omega_squared = (2 * np.pi * frequency) ** 2
    damping = float(shapes.damping_ratio[mode])
    return [
        whole((number,)),
        titles[0],
        whole((1,)),  # data at nodes
        *titles,
        whole(_kinds(shapes)),
        whole((0, 0, 0, 0, 1, number, 0, 0)),
        whole((0, 0)),
        real((0.0, frequency, omega_squared, 1.0, damping, shapes.loss_factor)),
        real(_complex_parameters(shapes, mode)),
    ]


def _rows(labels: Array, shape: Array) -> Array:
    """The label and the numbers of each node, (n_nodes, 7)."""
    numbers = interleaved(shape[:, :3]) if np.iscomplexobj(shape) else shape
    return np.column_stack([labels, not_too_small(numbers)])
