"""Surfaces of simple shapes, to be drawn: blocks, tubes, things of revolution, strips."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Floats
from pickup.sides import Place

Path = Sequence[Place] | Floats
"""Several places, (n, 3)."""

Section = Sequence[tuple[float, float]] | Floats
"""Points in a plane, (n, 2)."""

AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, eq=False)
class Surface:
    """Triangles; the two of a quadrilateral follow each other, which see-through drawing needs."""

    vertices: Floats
    """(n_vertices, 3), m."""
    faces: np.ndarray
    """(n_faces, 3), indices of vertices."""

    def moved(self, by: Place) -> "Surface":
        return Surface(self.vertices + by, self.faces)

    def turned(self, rotation: Floats, about: Place = (0, 0, 0)) -> "Surface":
        """Turned by a rotation matrix (3, 3) about a point."""
        return Surface((self.vertices - about) @ rotation.T + about, self.faces)

    def mirrored(self) -> "Surface":
        """The same on the other side of the vehicle."""
        return Surface(self.vertices * [1, -1, 1], self.faces[:, ::-1])


def rotation(axis: str, degrees: float) -> Floats:
    """The matrix (3, 3) that turns about a coordinate axis, right-handed."""
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    i, j = [k for k in range(3) if k != AXES[axis]]
    T = np.eye(3)
    T[i, i] = T[j, j] = c
    T[i, j], T[j, i] = (s, -s) if axis == "y" else (-s, s)
    return T


def shifted(point: Place | Path, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> Floats:
    """A place, or several (..., 3), so far along the axes."""
    return np.asarray(point, float) + np.array([x, y, z])


def triangles(quads: Sequence[Sequence[int]] | np.ndarray) -> np.ndarray:
    """Quadrilaterals (..., 4) as pairs of triangles (n, 3)."""
    return np.asarray(quads)[..., [0, 1, 2, 0, 2, 3]].reshape(-1, 3)


def joined(surfaces: Iterable[Surface]) -> Surface:
    """Several surfaces as one."""
    surfaces = list(surfaces)
    starts = np.cumsum([0] + [len(s.vertices) for s in surfaces])
    return Surface(
        np.vstack([s.vertices for s in surfaces]),
        np.vstack([s.faces + n for s, n in zip(surfaces, starts, strict=False)]),
    )


def grid(points: Sequence[Path] | Floats, wrap: bool = False) -> Surface:
    """A sheet through points (n, m, 3); wrapped, the last row of the first axis meets the first."""
    p = np.asarray(points, float)
    number = np.arange(p.shape[0] * p.shape[1]).reshape(p.shape[:2])
    if wrap:
        number = np.vstack([number, number[:1]])
    quads = np.stack([number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]], -1)
    return Surface(p.reshape(-1, 3), triangles(quads))


def patch(corners: Path, n: int = 6, m: int = 6) -> Surface:
    """A bilinear sheet between four corners, given around it."""
    a, b, c, d = (np.asarray(corner, float) for corner in corners)
    s = np.linspace(0, 1, n)[:, None, None]
    t = np.linspace(0, 1, m)[None, :, None]
    return grid((1 - s) * (1 - t) * a + s * (1 - t) * b + s * t * c + (1 - s) * t * d)


def block(center: Place, size: Place, top: float = 1.0, rear: float = 1.0) -> Surface:
    """A box whose upper face is scaled by `top`, and whose rear face by `rear`."""
    corners = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    shape = corners * size
    shape[corners[:, 2] > 0, :2] *= top
    shape[corners[:, 0] > 0, 1:] *= rear
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    return Surface(shape + center, triangles(sides))


def revolved(profile: Section, axis: str, center: Place, n: int = 32) -> Surface:
    """A profile of (radius, height along the axis), turned about a coordinate axis."""
    r, h = np.asarray(profile, float).T
    angle = 2 * np.pi * np.arange(n) / n
    along = AXES[axis]
    points = np.zeros((n, len(r), 3))
    points[..., (along + 1) % 3] = np.cos(angle)[:, None] * r
    points[..., (along + 2) % 3] = np.sin(angle)[:, None] * r
    points[..., along] = h
    surface = grid(points + center, wrap=True)
    on_axis = (np.asarray(r) == 0)[surface.faces % len(r)]
    return Surface(surface.vertices, surface.faces[on_axis.sum(axis=1) < 2])


def cylinder(radius: float, length: float, axis: str, center: Place, n: int = 16) -> Surface:
    """A closed cylinder."""
    half = length / 2
    return revolved([(0, -half), (radius, -half), (radius, half), (0, half)], axis, center, n)


def swept(path: Path, section: Section, up: Place = (0, 0, 1), cap: bool = True) -> Surface:
    """A closed section (m, 2), or one for each place (n, m, 2), carried along a path (n, 3).

    The section's first coordinate lies across the path and level, its second along `up`.
    """
    p = np.asarray(path, float)
    tangent = np.gradient(p, axis=0)
    tangent /= np.linalg.norm(tangent, axis=1)[:, None]
    across = np.cross(tangent, up)
    across /= np.linalg.norm(across, axis=1)[:, None]
    upward = np.cross(across, tangent)
    s = np.broadcast_to(np.asarray(section, float), (len(p), *np.shape(section)[-2:]))
    rings = p[:, None] + s[..., :1] * across[:, None] + s[..., 1:] * upward[:, None]
    skin = grid(rings.swapaxes(0, 1), wrap=True)
    if not cap:
        return skin
    n, m = rings.shape[:2]
    first = n * np.arange(m)
    lids = [_fan(first), _fan(first[::-1] + n - 1)]
    return Surface(skin.vertices, np.vstack([skin.faces, *lids]))


def rectangle(width: float, height: float) -> Floats:
    """A section for `swept`."""
    w, h = width / 2, height / 2
    return np.array([(-w, -h), (w, -h), (w, h), (-w, h)])


def circle(radius: float, n: int = 8) -> Floats:
    """A section for `swept`."""
    angle = 2 * np.pi * np.arange(n) / n
    return radius * np.stack([np.cos(angle), np.sin(angle)], -1)


def tube(path: Path, radius: float, n: int = 8, up: Place = (0, 0, 1)) -> Surface:
    """A round bar along a path."""
    return swept(path, circle(radius, n), up)


def line(start: Place, end: Place, n: int = 2) -> Floats:
    """Points (n, 3) from start to end."""
    return np.linspace(np.asarray(start, float), np.asarray(end, float), n)


def ribbon(path: Path, width: float, normal: Place) -> Surface:
    """A flat strip along a path (n, 3), facing `normal`."""
    p = np.asarray(path, float)
    across = np.cross(np.gradient(p, axis=0), normal)
    across *= width / 2 / np.linalg.norm(across, axis=1)[:, None]
    return grid(np.stack([p - across, p + across], axis=1))


def coil(foot: Place, height: float, radius: float, wire: float, turns: int) -> Surface:
    """A helical spring standing on `foot`."""
    t = np.linspace(0, 1, 12 * turns + 1)
    angle = 2 * np.pi * turns * t
    path = np.stack([radius * np.cos(angle), radius * np.sin(angle), height * t], -1)
    return tube(path + np.asarray(foot), wire, n=5)


def _fan(ring: np.ndarray) -> np.ndarray:
    """The faces (m - 2, 3) that close a ring of m vertices."""
    return np.stack([np.broadcast_to(ring[0], len(ring) - 2), ring[2:], ring[1:-1]], -1)
