"""A universal file as a component."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, of_file, paths_together
from modeviz.files.disk import read_bytes
from modeviz.formats.component import Component, ElementKind, Modes, UnitSystem, rows_of
from modeviz.formats.frames import BASIC, Frame, basic_places, turn_to_basic
from modeviz.formats.limits import LARGEST_FILE, check_shapes
from modeviz.formats.node_sets import NodeSet
from modeviz.formats.universal.blocks import Block, blocks
from modeviz.formats.universal.geometry import (
    GivenFrame,
    grouped,
    read_elements,
    read_frames_18,
    read_frames_2420,
    read_lines,
    read_nodes_15,
    read_nodes_2411,
    read_units,
)
from modeviz.formats.universal.groups import read_groups
from modeviz.formats.universal.shapes import Shape, read_mode, unread_name
from modeviz.vehicle.arrays import Array, Floats

SUFFIXES = (".unv", ".uff", ".uf", ".uf5", ".ufb")

SILENT = {"151", "2400"}
"""Data sets that have only titles and dates."""

GROUPS = {"2467", "2477"}

DEEPEST = 100
"""So many coordinate systems may stand in each other."""


@dataclass
class _Content:
    """What the data sets of all files say, as it is gathered."""

    labels: list[Array] = field(default_factory=list)
    systems: list[Array] = field(default_factory=list)
    coordinates: list[Floats] = field(default_factory=list)
    lines: list[Array] = field(default_factory=list)
    elements: list[tuple[ElementKind | None, list[int]]] = field(default_factory=list)
    frames: dict[int, GivenFrame] = field(default_factory=dict)
    """By number."""
    units: UnitSystem | None = None
    shapes: list[Shape] = field(default_factory=list)
    node_sets: dict[str, NodeSet] = field(default_factory=dict)
    """By name."""
    unread: Counter[str] = field(default_factory=Counter)
    """Data sets that are not a component's, by what they are."""

    def add(self, block: Block) -> None:
        """Takes in what a data set has."""
        kind = block.kind
        if kind in ("15", "2411"):
            labels, systems, coordinates = (
                read_nodes_15(block) if kind == "15" else read_nodes_2411(block)
            )
            self.labels.append(labels)
            self.systems.append(systems)
            self.coordinates.append(coordinates)
        elif kind == "82":
            self.lines.append(read_lines(block))
        elif kind == "2412":
            self.elements += read_elements(block)
        elif kind in ("18", "2420"):
            self.frames |= read_frames_18(block) if kind == "18" else read_frames_2420(block)
        elif kind == "164":
            self.units = read_units(block)
        elif kind in GROUPS and (groups := _groups(block)):
            self.node_sets |= groups
        elif kind in ("55", "2414") and (shape := read_mode(block)):
            self.shapes.append(shape)
        elif kind not in SILENT:
            self.unread[unread_name(block)] += 1


def read_universal(paths: Sequence[Path]) -> Component:
    """Return the component of universal files, which may have the geometry and the shapes apart.

    Raises:
        VehicleError: a file is none, is cut, or says what cannot be.
    """
    content = _Content()
    for path in paths:
        with located(path):
            for block in blocks(_without_zeros(read_bytes(path, LARGEST_FILE))):
                with of_file("" if block.kind in ("55", "2414") else block.where):
                    content.add(block)
    with located(paths_together(paths)):
        return _component(content)


def _groups(block: Block) -> dict[str, NodeSet]:
    """Those of nodes; none of what is written otherwise, since nothing else depends on them."""
    try:
        return read_groups(block)
    except VehicleError:
        return {}


def _without_zeros(content: bytes) -> bytes:
    """The content of a file that is text."""
    if content[:2] in (b"\xff\xfe", b"\xfe\xff"):
        raise VehicleError("found text in UTF-16, expected plain text; save it anew")
    return content


def _component(content: _Content) -> Component:
    labels, systems, coordinates = _nodes(content)
    frames, notes = _basic_frames(content.frames), []
    missing = sorted(set(np.unique(systems).tolist()) - {0, *frames})
    if missing:
        notes.append(
            f"the nodes name the coordinate systems {listed(missing)}, which the file does not have; "
            "taken for the basic one"
        )
        frames |= dict.fromkeys(missing, BASIC)
    known = len(labels)
    every = _with_unplaced(labels, content.shapes)
    if len(every) > known:
        notes.append(
            f"{len(every) - known} nodes are moved but stand nowhere in the file; give the file with "
            "the geometry too"
        )
    rows = rows_of(every, labels)
    nodes = np.full((len(every), 3), np.nan)
    nodes[rows] = basic_places(frames, systems[:, 0], coordinates)
    motion_systems = np.zeros(len(every), np.int64)
    motion_systems[rows] = systems[:, 1]
    modes = _modes(every, content.shapes)
    placed = np.nan_to_num(nodes)
    turn_to_basic(frames, motion_systems, placed, modes.shapes)
    unknown = sum(kind is None for kind, _ in content.elements)
    if unknown:
        notes.append(f"{unknown} elements are springs, masses or of kinds unknown, and are not drawn")
    if content.unread:
        skipped = (f"{number} of {kind}" for kind, number in content.unread.items())
        notes.append(f"data sets left out, which are no part of modes: {', '.join(skipped)}")
    return Component(
        every,
        nodes,
        _elements(content, every),
        modes,
        content.units,
        tuple(notes),
        node_sets=content.node_sets,
    )


def _nodes(content: _Content) -> tuple[Array, Array, Floats]:
    """Labels, rising, systems and coordinates of all nodes that have a place."""
    labels = np.concatenate([np.zeros(0, np.int64), *content.labels])
    systems = np.concatenate([np.zeros((0, 2), np.int64), *content.systems])
    coordinates = np.concatenate([np.zeros((0, 3)), *content.coordinates])
    order = np.argsort(labels, kind="stable")
    labels, systems, coordinates = labels[order], systems[order], coordinates[order]
    again = np.flatnonzero(labels[1:] == labels[:-1]) + 1
    differs = (coordinates[again] != coordinates[again - 1]).any(axis=1)
    if differs.any():
        raise VehicleError(f"node {labels[again[differs][0]]} is there twice, at different places")
    kept = np.delete(np.arange(len(labels)), again)
    return labels[kept], systems[kept], coordinates[kept]


def _basic_frames(frames: Mapping[int, GivenFrame]) -> dict[int, Frame]:
    """Coordinate systems in the basic one, of those that may be given in others."""
    basic: dict[int, Frame] = {}

    def resolved(number: int, depth: int) -> Frame:
        if number == 0 or number not in frames:
            return BASIC
        if depth > DEEPEST:
            raise VehicleError(f"coordinate system {number} is given in itself, or in too many others")
        if number not in basic:
            given = frames[number]
            basic[number] = given.within(resolved(given.reference, depth + 1))
        return basic[number]

    return {number: resolved(number, 0) for number in frames}


def _with_unplaced(labels: Array, shapes: Sequence[Shape]) -> Array:
    return np.unique(np.concatenate([labels, *(shape.labels for shape in shapes)]))


def _modes(labels: Array, shapes: Sequence[Shape]) -> Modes:
    """The modes, the slowest first, and after them residual vectors."""
    ordered = sorted(shapes, key=lambda shape: (shape.is_residual, shape.frequency_hz))
    check_shapes(len(labels), len(ordered))
    is_complex = any(np.iscomplexobj(shape.values) for shape in ordered)
    array = np.zeros((len(labels), 6, len(ordered)), np.complex128 if is_complex else np.float64)
    for column, shape in enumerate(ordered):
        if len(np.unique(shape.labels)) < len(shape.labels):
            raise VehicleError(f"the mode at {shape.frequency_hz:g} Hz moves a node twice")
        rows = rows_of(labels, shape.labels)
        array[rows, : shape.values.shape[1], column] = shape.values
    return Modes(
        np.array([shape.frequency_hz for shape in ordered]),
        np.array([shape.modal_mass for shape in ordered]),
        np.array([shape.damping_ratio for shape in ordered]),
        array,
        sum(shape.is_residual for shape in shapes),
    )


def _elements(content: _Content, labels: Array) -> dict[ElementKind, Array]:
    """Elements and trace lines, by rows of the nodes."""
    lines = (("line", pair.tolist()) for pair in chain.from_iterable(content.lines))
    both: Iterator[tuple[ElementKind | None, list[int]]] = chain(content.elements, lines)  # type: ignore[arg-type]
    return {kind: rows_of(labels, corners) for kind, corners in grouped(both).items()}
