"""Nodes, elements, lines, coordinate systems and units of a universal file.

After the file formats of Structural Dynamics Research Corporation, as the University of Cincinnati
keeps them: data sets 15, 18, 82, 164, 2411, 2412 and 2420. They do not say what spherical coordinates
are. Read as Nastran has them, radius, angle from the z axis, angle about it, in degrees: so sdynpy
does, which follows IMAT, the toolbox for I-DEAS.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from modeviz.errors import VehicleError
from modeviz.formats.component import CORNERS, ElementKind, UnitSystem
from modeviz.formats.frames import Frame, FrameKind, frame_of_points
from modeviz.formats.universal.blocks import Block, ids, numbers, table, whole_numbers
from modeviz.vehicle.arrays import Array, Floats

KINDS: dict[int, FrameKind] = {0: "rectangular", 1: "cylindrical", 2: "spherical"}
"""Of coordinate systems."""

BEAMS = {11, 21, 22, 23, 24}
"""Elements that have a line on their ends before that of their nodes."""

_CORNERS_OF: dict[ElementKind, list[tuple[tuple[int, ...], tuple[int, ...]]]] = {
    "line": [((11, 21, 22, 121), (0, 1)), ((23, 24), (0, 2))],
    "triangle": [
        ((41, 51, 61, 71, 81, 91), (0, 1, 2)),
        ((42, 52, 62, 72, 82, 92), (0, 2, 4)),
    ],
    "quad": [
        ((44, 54, 64, 74, 84, 94), (0, 1, 2, 3)),
        ((45, 55, 65, 75, 85, 95), (0, 2, 4, 6)),
    ],
    "tetra": [((111,), (0, 1, 2, 3)), ((118,), (0, 2, 4, 9))],
    "wedge": [((101, 112), (0, 1, 2, 3, 4, 5)), ((102, 113), (0, 2, 4, 9, 11, 13))],
    "hexa": [((104, 115), tuple(range(8))), ((105, 116), (0, 2, 4, 6, 12, 14, 16, 18))],
}
ELEMENTS: dict[int, tuple[ElementKind, tuple[int, ...]]] = {
    number: (kind, corners)
    for kind, groups in _CORNERS_OF.items()
    for descriptors, corners in groups
    for number in descriptors
}
"""By finite element descriptor: the kind, and which of its nodes are corners."""


@dataclass(frozen=True, eq=False)
class GivenFrame:
    """A coordinate system as a file has it."""

    reference: int
    """The number of that in which it is given."""
    within: Callable[[Frame], Frame]
    """Returns it in the basic one, of that in which it is given."""


def read_nodes_15(block: Block) -> tuple[Array, Array, Floats]:
    """Return labels (n,), numbers of systems (n, 2) and coordinates (n, 3) of data set 15.

    The systems are that of the coordinates and that of motions.
    """
    rows = table(block.content, 7, "node")
    return ids(rows[:, 0], "node"), ids(rows[:, 1:3].ravel(), "system").reshape(-1, 2), rows[:, 4:]


def read_nodes_2411(block: Block) -> tuple[Array, Array, Floats]:
    """Return the same of data set 2411, whose coordinates are in the basic system."""
    rows = table(block.content, 7, "node")
    systems = ids(rows[:, 1:3].ravel(), "system").reshape(-1, 2)
    systems[:, 0] = 0
    return ids(rows[:, 0], "node"), systems, rows[:, 4:]


def read_lines(block: Block) -> Array:
    """Return the pairs of nodes that a trace line of data set 82 joins, (n, 2), by their labels."""
    (first, _name), rest = block.split(2)
    n_entries = whole_numbers(first, 2)[1]
    nodes = ids(numbers(rest), "node")
    if not 0 <= n_entries <= len(nodes):  # some say too few of them, as seven for a line of eight
        raise VehicleError(f"found {len(nodes)} nodes on a trace line, expected {n_entries}")
    pairs = np.column_stack([nodes[:-1], nodes[1:]])
    return pairs[(pairs != 0).all(axis=1)]  # zero lifts the pen


def read_elements(block: Block) -> Iterator[tuple[ElementKind | None, list[int]]]:
    """Yield kind and corners, by their labels, of each element of data set 2412; None if unknown."""
    lines = iter(block.content.decode("latin-1").splitlines())
    for line in lines:
        if not line.strip():
            continue
        element, descriptor, *_, n_nodes = whole_numbers(line, 6)[:6]
        if descriptor in BEAMS:
            next(lines, None)
        nodes: list[int] = []
        while len(nodes) < n_nodes:
            line = next(lines, "")
            if not line.strip():
                raise VehicleError(f"element {element}: found {len(nodes)} nodes of {n_nodes}")
            nodes += whole_numbers(line, 1)
        if descriptor not in ELEMENTS:
            yield None, nodes
            continue
        kind, corners = ELEMENTS[descriptor]
        if max(corners) >= n_nodes:
            raise VehicleError(f"element {element}: found {n_nodes} nodes, too few for a {kind}")
        yield kind, [nodes[corner] for corner in corners]


def grouped(elements: Iterator[tuple[ElementKind | None, list[int]]]) -> dict[ElementKind, Array]:
    """Return the corners of elements by kind, (n_elements, n_corners)."""
    groups: dict[ElementKind, list[list[int]]] = {}
    for kind, corners in elements:
        if kind:
            groups.setdefault(kind, []).append(corners)
    return {kind: np.array(rows).reshape(-1, CORNERS[kind]) for kind, rows in groups.items()}


def read_frames_18(block: Block) -> dict[int, GivenFrame]:
    """Return the systems of data set 18 by number, which are given by three points in others."""
    lines = [line for line in block.content.decode("latin-1").split("\n") if line.strip()]
    frames = {}
    for start in range(0, len(lines), 4):
        if len(lines) < start + 4:
            raise VehicleError("found a coordinate system that is not whole")
        number, kind, reference = whole_numbers(lines[start], 3)[:3]
        points = _rows_of_three(lines[start + 2 : start + 4], 3)
        frames[number] = GivenFrame(reference, partial(_frame_in, _frame_kind(kind), points))
    return frames


def _frame_in(kind: FrameKind, points: Floats, outer: Frame) -> Frame:
    """The system with those three points in another's coordinates: see `_frame_on_x`."""
    return _frame_on_x(kind, *outer.places(points))


def _rows_of_three(lines: list[str], n_rows: int) -> Floats:
    """The numbers of lines, (n_rows, 3)."""
    rows = table(" ".join(lines).encode("latin-1"), 3, "place")
    if len(rows) != n_rows:
        raise VehicleError(f"found {rows.size} numbers of a coordinate system, expected {3 * n_rows}")
    return rows


def _frame_on_x(kind: FrameKind, origin: Floats, on_x: Floats, in_xz: Floats) -> Frame:
    """The system with a point on its x axis and one in its xz plane, on the side of z."""
    turned = frame_of_points(kind, origin, on_x, in_xz)  # with its z along our x, its x along our z
    x, z = turned.axes[:, 2], turned.axes[:, 0]
    return Frame(kind, origin, np.column_stack([x, np.cross(z, x), z]))


def read_frames_2420(block: Block) -> dict[int, GivenFrame]:
    """Return the systems of data set 2420 by number; they are given in the basic one, 0."""
    _, rest = block.split(2)
    lines = [line for line in rest.decode("latin-1").split("\n") if line.strip()]
    frames = {}
    for start in range(0, len(lines), 6):
        if len(lines) < start + 6:
            raise VehicleError("found a coordinate system that is not whole")
        number, kind = whole_numbers(lines[start], 2)[:2]
        axes = _rows_of_three(lines[start + 2 : start + 6], 4)
        if not np.allclose(axes[:3] @ axes[:3].T, np.eye(3), atol=1e-4):
            raise VehicleError(f"coordinate system {number}: its axes are not at right angles")
        frame = Frame(_frame_kind(kind), axes[3], axes[:3].T)
        frames[number] = GivenFrame(0, partial(_same, frame))
    return frames


def _same(frame: Frame, _outer: Frame) -> Frame:
    return frame


def _frame_kind(number: int) -> FrameKind:
    if number not in KINDS:
        raise VehicleError(f"found a coordinate system of kind {number}, expected 0, 1 or 2")
    return KINDS[number]


def read_units(block: Block) -> UnitSystem:
    """Return the units of data set 164, which says how many of them one of SI is."""
    (first,), rest = block.split(1)
    name = first[10:30].split("  ")[0].strip() or "of data set 164"
    per_si = table(rest, 4, "system of units")
    if per_si.shape[0] != 1 or not (per_si[0, :2] > 0).all():
        raise VehicleError("found no factors of length and force above zero")
    length, force = 1 / per_si[0, :2]
    return UnitSystem(name, float(length), float(force / length))
