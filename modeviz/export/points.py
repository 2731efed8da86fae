"""The points of bodies whose motion is known, and what is drawn between them.

Other programs draw a mode on nodes that it moves. Those of a flexible body are its attachments and the
nodes that carry its mesh; corners of the mesh go to the nearest of these, so that nothing is drawn but
what is known. A rigid body moves the corners themselves.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from scipy.spatial import KDTree

from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body, FlexibleBody, Mesh, RigidBody
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class BodyPoints:
    """Points of one body, in vehicle coordinates."""

    body: str
    names: tuple[str, ...]
    """What the first points are, its attachments for one; the others have no names."""
    places: Floats
    """(n_points, 3), m."""
    motions: Array
    """(n_points, 6, n_coordinates): of each in the body's coordinates."""
    triangles: Array
    """(n_triangles, 3), rows of `places`."""
    lines: Array
    """(n_lines, 2), likewise."""

    @property
    def n_points(self) -> int:
        """How many there are."""
        return len(self.places)


@dataclass(frozen=True, eq=False)
class Points:
    """Points of several bodies, one body after the other."""

    parts: tuple[BodyPoints, ...]

    @property
    def places(self) -> Floats:
        """(n_points, 3), m."""
        return np.concatenate([part.places for part in self.parts])

    @property
    def starts(self) -> Mapping[str, int]:
        """The row of each body's first point."""
        counts = np.cumsum([0, *(part.n_points for part in self.parts)]).tolist()
        return {part.body: start for part, start in zip(self.parts, counts, strict=False)}

    @property
    def triangles(self) -> Array:
        """(n_triangles, 3), rows of `places`."""
        return np.concatenate([p.triangles + self.starts[p.body] for p in self.parts])

    @property
    def lines(self) -> Array:
        """(n_lines, 2), rows of `places`."""
        return np.concatenate([p.lines + self.starts[p.body] for p in self.parts])

    def shapes(self, coordinates: Array, dofs: Mapping[str, slice]) -> Array:
        """Return how points move, (n_points, 6, n_shapes).

        Args:
            coordinates: (n_dofs, n_shapes), real or complex.
            dofs: which of them are whose, by the body's name.
        """
        return np.concatenate([part.motions @ coordinates[dofs[part.body]] for part in self.parts])


def vehicle_points(vehicle: Vehicle) -> Points:
    """Return the points of all bodies of a vehicle."""
    return Points(tuple(body_points(vehicle, body) for body in vehicle.bodies))


def body_points(vehicle: Vehicle, body: Body) -> BodyPoints:
    """Return the points of one body of a vehicle."""
    return _flexible_points(body) if isinstance(body, FlexibleBody) else _rigid_points(vehicle, body)


def _flexible_points(body: FlexibleBody) -> BodyPoints:
    """Attachments, then the nodes."""
    attachments = body.attachments
    triangles, lines = _on_nodes(body.mesh, body.nodes)
    at = np.array([a.shapes for a in attachments]).reshape(-1, 6, body.n_modes)
    return BodyPoints(
        body.name,
        tuple(a.name for a in attachments),
        np.concatenate([np.array([a.position for a in attachments]).reshape(-1, 3), body.nodes]),
        np.concatenate([at, body.shapes]),
        triangles + len(attachments),
        lines + len(attachments),
    )


def _on_nodes(mesh: Mesh, nodes: Floats) -> tuple[Array, Array]:
    """The faces of a mesh on the nearest nodes, and the lines that are left of flat ones, by rows."""
    if not mesh or not len(nodes):
        return np.zeros((0, 3), int), np.zeros((0, 2), int)
    tree = KDTree(nodes)
    nearest = [np.asarray(tree.query(part.vertices)[1], int) for part in mesh]
    corners = np.concatenate([at[part.faces] for at, part in zip(nearest, mesh, strict=True)])
    n_different = 1 + (np.diff(np.sort(corners, axis=1), axis=1) > 0).sum(axis=1)
    triangles = _once(corners[n_different == 3])
    flat = np.sort(corners[n_different == 2], axis=1)
    lines = np.unique(flat[:, [0, 2]], axis=0)
    edges = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=-1).reshape(-1, 2)
    drawn = {tuple(edge) for edge in edges.tolist()}
    return triangles, np.array([e for e in lines.tolist() if tuple(e) not in drawn], int).reshape(-1, 2)


def _once(triangles: Array) -> Array:
    """The first of those with the same corners."""
    _, first = np.unique(np.sort(triangles, axis=1), axis=0, return_index=True)
    return triangles[np.sort(first)]


def _rigid_points(vehicle: Vehicle, body: RigidBody) -> BodyPoints:
    """The centre of gravity, what holds on to the body, then the corners of its mesh.

    Without a mesh, lines lead from the centre of gravity to what holds on to it.
    """
    ends = _ends(vehicle, body.name)
    named = {"centre of gravity": body.center_of_gravity, **ends}
    vertices, faces = _welded(body.mesh)
    places = np.concatenate([np.array([*named.values()]), vertices])
    star = [(0, row) for row in range(1, len(named)) if not len(faces)]
    return BodyPoints(
        body.name,
        tuple(named),
        places,
        rigid_motions(places - body.center_of_gravity),
        faces + len(named),
        np.array(star, int).reshape(-1, 2),
    )


def _ends(vehicle: Vehicle, body: str) -> dict[str, Floats]:
    """Where connections and response points are on a body, by their names."""
    ends = {
        connection.name: point
        for connection in vehicle.all_connections
        for its, point in zip(connection.bodies, connection.points, strict=True)
        if its == body
    }
    return ends | {p.name: p.position for p in vehicle.response_points if p.body == body}


def _welded(mesh: Mesh) -> tuple[Floats, Array]:
    """The different corners of a mesh, (n, 3), and its faces, rows of these."""
    corners = [part.vertices[part.faces].reshape(-1, 3) for part in mesh]
    places, rows = np.unique(np.concatenate([np.zeros((0, 3)), *corners]), axis=0, return_inverse=True)
    return places, rows.reshape(-1, 3)
