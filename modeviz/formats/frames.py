"""Coordinate systems of other programs: places and motions in them, taken to the basic one."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Array, Floats, frozen

FrameKind = Literal["rectangular", "cylindrical", "spherical"]


@dataclass(frozen=True, eq=False)
class Frame:
    """A coordinate system: where it stands in the basic one, and what its coordinates are."""

    kind: FrameKind
    """rectangular: x, y, z. cylindrical: r, θ, z. spherical: r, θ from the z axis, φ about it.

    Angles are in degrees, as files have them.
    """
    origin: Floats
    """(3,)."""
    axes: Floats
    """(3, 3), columns are its x, y and z axes, of length one."""

    def __post_init__(self) -> None:
        frozen(self, "origin", self.origin, (3,))
        frozen(self, "axes", self.axes, (3, 3))

    def places(self, coordinates: Floats) -> Floats:
        """Return where places are in the basic system, (n, 3), of their coordinates in this one."""
        return self.origin + _rectangular(self.kind, coordinates) @ self.axes.T

    def directions(self, places: Floats) -> Floats:
        """Return the directions of the coordinates at places, (n, 3, 3), as columns.

        What a motion's components along them are multiplied by to have it in the basic system. On the
        axis of a cylinder or a sphere, θ and φ are taken for zero.

        Args:
            places: (n, 3), in the basic system.
        """
        if self.kind == "rectangular":
            return np.broadcast_to(self.axes, (len(places), 3, 3))
        x, y, z = ((places - self.origin) @ self.axes).T
        radius = np.hypot(x, y)
        about = np.arctan2(y, x)
        c, s, zero = np.cos(about), np.sin(about), np.zeros_like(x)
        if self.kind == "cylindrical":
            rows = [[c, -s, zero], [s, c, zero], [zero, zero, zero + 1]]
        else:
            down = np.arctan2(radius, z)
            cd, sd = np.cos(down), np.sin(down)
            rows = [[sd * c, cd * c, -s], [sd * s, cd * s, c], [cd, -sd, zero]]
        return self.axes @ np.moveaxis(np.array(rows), -1, 0)


BASIC = Frame("rectangular", np.zeros(3), np.eye(3))
"""The system that all others stand in; 0 in files."""


def frame_of_points(kind: FrameKind, origin: Floats, on_z: Floats, in_xz: Floats) -> Frame:
    """Return the system whose z axis goes through one point and whose xz plane through another.

    Args:
        kind: of its coordinates.
        origin: (3,), as the points.
        on_z: on its z axis.
        in_xz: in its xz plane, on the side of x.

    Raises:
        VehicleError: the three lie on a line.
    """
    z = on_z - origin
    y = np.cross(z, in_xz - origin)
    lengths = np.linalg.norm(z), np.linalg.norm(y)
    if not min(lengths) > 1e-9 * max(1e-300, float(np.abs([z, in_xz - origin]).max()) ** 2):
        raise VehicleError("the three points of a coordinate system lie on a line")
    z, y = z / lengths[0], y / lengths[1]
    return Frame(kind, origin, np.column_stack([np.cross(y, z), y, z]))


def basic_places(frames: Mapping[int, Frame], numbers: Array, coordinates: Floats) -> Floats:
    """Return places in the basic system, (n, 3), of coordinates in the systems of those numbers.

    Raises:
        VehicleError: there is no system of a number.
    """
    places = coordinates.copy()
    for number in np.unique(numbers[numbers != 0]).tolist():
        those = numbers == number
        places[those] = _frame(frames, number).places(coordinates[those])
    return places


def turn_to_basic(frames: Mapping[int, Frame], numbers: Array, places: Floats, shapes: Array) -> None:
    """Turns motions, which are in the systems of those numbers, into the basic one, in place.

    Args:
        frames: by number.
        numbers: (n_nodes,), the system of each node's motions.
        places: (n_nodes, 3), in the basic system.
        shapes: (n_nodes, 6, n_modes), motions and rotations.

    Raises:
        VehicleError: there is no system of a number.
    """
    for number in np.unique(numbers[numbers != 0]).tolist():
        those = np.flatnonzero(numbers == number)
        directions = _frame(frames, number).directions(places[those])
        for rows in (slice(0, 3), slice(3, 6)):
            shapes[those, rows] = directions @ shapes[those, rows]


def _frame(frames: Mapping[int, Frame], number: int) -> Frame:
    if number not in frames:
        raise VehicleError(f"a node names the coordinate system {number}, which the file does not have")
    return frames[number]


def _rectangular(kind: FrameKind, coordinates: Floats) -> Floats:
    if kind == "rectangular":
        return coordinates
    r, first, last = coordinates.T
    if kind == "cylindrical":
        about = np.radians(first)
        return np.column_stack([r * np.cos(about), r * np.sin(about), last])
    down, about = np.radians(first), np.radians(last)
    return np.column_stack(
        [r * np.sin(down) * np.cos(about), r * np.sin(down) * np.sin(about), r * np.cos(down)]
    )
