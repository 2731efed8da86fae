"""The numbers of a PLY file: its elements' properties as columns."""

import struct
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats.parts import numbers
from modeviz.files.mesh_formats.ply_header import Element
from modeviz.vehicle.arrays import Array

Bytes = NDArray[np.uint8]
Places = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Column:
    """A property of all items of an element."""

    body: Bytes
    kind: np.dtype
    starts: Places
    """(n_items,): where in the body its values begin."""
    lengths: Places
    """(n_items,), how many values each has."""

    @property
    def values(self) -> Array:
        """All of them, item after item."""
        number = np.arange(self.lengths.sum()) - np.repeat(
            np.cumsum(self.lengths) - self.lengths, self.lengths
        )
        return _at(
            self.body, self.kind, np.repeat(self.starts, self.lengths) + self.kind.itemsize * number
        )


Columns = Mapping[str, Column]


def lines_of(text: bytes) -> tuple[Bytes, Places]:
    """The numbers of a text, eight bytes each, and the places where its lines begin."""
    counts = [n for line in text.split(b"\n") if (n := len(line.split()))]
    return numbers(text).view(np.uint8), 8 * np.cumsum([0, *counts])


def read_columns(elements: Sequence[Element], body: Bytes, lines: Places | None) -> dict[str, Columns]:
    """The columns of all elements up to the faces.

    Args:
        elements: of the header.
        body: all numbers.
        lines: where in it the lines of a text begin; an item may have more on its line than it says.

    Raises:
        VehicleError: there are fewer items than the header tells.
    """
    found: dict[str, Columns] = {}
    place = 0
    for element in elements:
        if lines is None:
            begins = _even(element, body, place)
            begins = _walked(element, body, place) if begins is None else begins
            place = int(begins[-1])
        else:
            begins, lines = lines[: element.count + 1], lines[element.count :]
            if len(begins) <= element.count:
                raise _cut(element, len(begins) - 1)
        found[element.name], _ = _columns(element, body, begins[:-1], begins[1:])
        if element.name == "face":
            break
    return found


def _even(element: Element, body: Bytes, place: int) -> Places | None:
    """The places where items begin and the last ends, if all lists are as long as the first one."""
    if not element.count:
        return np.array([place])
    end = np.array([len(body)])
    _, ends = _columns(element, body, np.array([place]), end)
    begins = place + (int(ends[0]) - place) * np.arange(element.count + 1)
    if begins[-1] > len(body):
        return None
    try:
        _, ends = _columns(element, body, begins[:-1], np.broadcast_to(end, element.count))
    except VehicleError:
        return None
    return begins if np.array_equal(ends, begins[1:]) else None


def _walked(element: Element, body: Bytes, place: int) -> Places:
    """The places where items begin and the last ends, found item by item."""
    steps, tail = _steps(element)
    begins = [place]
    for i in range(element.count):
        try:
            for before, unpack, size, step in steps:
                (n,) = unpack(body, place + before)
                place += before + size + step * int(n)
        except (struct.error, ValueError, OverflowError):
            raise _cut(element, i) from None
        place += tail
        if not begins[-1] <= place <= len(body):
            raise _cut(element, i)
        begins.append(place)
    return np.array(begins)


def _steps(element: Element) -> tuple[list, int]:
    """For each list how many bytes are before, what reads its length, the sizes of that and of a value.

    And how many bytes come after the last list.
    """
    steps, before = [], 0
    for p in element.properties:
        if p.length is None:
            before += p.kind.itemsize
            continue
        order = ">" if p.length.str[0] == ">" else "<"
        unpack = struct.Struct(order + p.length.char).unpack_from
        steps.append((before, unpack, p.length.itemsize, p.kind.itemsize))
        before = 0
    return steps, before


def _columns(
    element: Element, body: Bytes, begins: Places, ends: Places
) -> tuple[dict[str, Column], Places]:
    """The columns of items of an element, and where each item really ends.

    Args:
        element: whose properties they have.
        body: all numbers.
        begins: (n_items,), where items begin.
        ends: (n_items,), beyond which they must not go.

    Raises:
        VehicleError: an item does.
    """
    columns: dict[str, Column] = {}
    place = begins
    for p in element.properties:
        lengths = np.ones(len(place), np.int64)
        if p.length is not None:
            _check_within(element, place + p.length.itemsize, ends)
            told = _at(body, p.length, place).astype(float)
            lengths = np.where((told >= 0) & (told <= len(body)), told, len(body) + 1).astype(np.int64)
            place = place + p.length.itemsize
        columns[p.name] = Column(body, p.kind, place, lengths)
        place = place + p.kind.itemsize * lengths
        _check_within(element, place, ends)
    return columns, place


def _check_within(element: Element, place: Places, ends: Places) -> None:
    beyond = place > ends
    if beyond.any():
        raise _cut(element, int(beyond.argmax()))


def _at(body: Bytes, kind: np.dtype, starts: Places) -> Array:
    """The numbers that begin at places."""
    found = body[starts[:, None] + np.arange(kind.itemsize)]
    return np.ascontiguousarray(found).view(kind)[:, 0]


def _cut(element: Element, n_found: int) -> VehicleError:
    return VehicleError(
        f"is cut or damaged: of the element {element.name} found {n_found} whole items of the "
        f"{element.count} that its header tells"
    )
