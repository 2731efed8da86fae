"""What is drawn of bodies, and how every corner of it moves, as on the screen."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.export.points import BodyPoints, body_points
from modeviz.export.shapes import ShapeSet
from modeviz.shapes.motion import displacement, vertex_shapes
from modeviz.shapes.surface import surface
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Drawn:
    """Triangles and lines of one body."""

    body: str
    places: Floats
    """(n_points, 3), m."""
    triangles: Array
    """(n_triangles, 3), rows of `places`."""
    lines: Array
    """(n_lines, 2), likewise."""
    shapes: Array
    """(n_coordinates, n_points, 3), single precision: in the body's coordinates."""


def drawn_bodies(vehicle: Vehicle, bodies: Sequence[Body]) -> tuple[Drawn, ...]:
    """Return what is drawn of bodies: their meshes, or else their points with what joins them."""
    return tuple(_mesh(body) if body.mesh else _points(body_points(vehicle, body)) for body in bodies)


def moved(drawn: Drawn, modes: ShapeSet, mode: int) -> Array:
    """Return the displacement of every point in a mode, (n_points, 3), real or complex."""
    return displacement(drawn.shapes, modes.coordinates[modes.dofs[drawn.body], mode])


def _mesh(body: Body) -> Drawn:
    its = surface(body.mesh)
    triangles = np.concatenate([patch.faces for patch in its.patches])
    shapes = vertex_shapes(body, its.vertices)
    return Drawn(body.name, its.vertices, triangles, np.zeros((0, 2), int), shapes)


def _points(points: BodyPoints) -> Drawn:
    shapes = np.ascontiguousarray(np.moveaxis(points.motions[:, :3], -1, 0), np.float32)
    return Drawn(points.body, points.places, points.triangles, points.lines, shapes)
