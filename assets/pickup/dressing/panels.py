"""Sheet metal drawn from the finite-element mesh, and the rounded outer skin set on it."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from modeviz.fem.mesh import FiniteElementMesh
from modeviz.vehicle.arrays import Floats
from pickup.connections import WHEEL_RADIUS
from pickup.materials import Piece
from pickup.sections import is_glass
from pickup.sides import Place
from pickup.solids import Path, Surface, grid, ribbon, shifted, swept, triangles

ARCH_RADIUS = 0.405
"""m: of a wheel arch, about the wheel's centre."""

PROUD = 0.005
"""m: how far a seam or a pane stands off the panel it is drawn on."""


def panels(mesh: FiniteElementMesh, paint: str) -> list[Piece]:
    """The shells as they are, with the nodes for vertices; glass apart."""
    glazed = np.array([is_glass(section) for section in mesh.quad_sections])
    kinds = ((paint, mesh.quads[~glazed]), ("glass", mesh.quads[glazed]))
    return [Piece(material, _shells(mesh, quads)) for material, quads in kinds if len(quads)]


def skirt(
    low: Callable[[Floats], Floats],
    high: Callable[[Floats], Floats],
    x: Floats,
    y: Callable,
    rows: int = 3,
) -> Surface:
    """A side panel between two outlines z = low(x) and z = high(x), at y(z)."""
    bottom, top = low(x), high(x)
    z = bottom + (top - bottom) * np.linspace(0, 1, rows)[:, None]
    return grid(np.stack([np.broadcast_to(x, z.shape), y(z), z], axis=-1).swapaxes(0, 1))


def arch_stations(center: float, sill: float, front: float, rear: float) -> Floats:
    """Places along x for a skirt with a wheel arch in it, from front to rear."""
    half = np.sqrt(ARCH_RADIUS**2 - (sill - WHEEL_RADIUS) ** 2)
    reach = np.arccos(half / ARCH_RADIUS)
    inside = center + ARCH_RADIUS * np.cos(np.linspace(np.pi - reach, reach, 19))
    before = np.linspace(front, inside[0], 5)[:-1]
    after = np.linspace(inside[-1], rear, 8)[1:]
    return np.concatenate([before, inside, after])


def arch_outline(x: Floats, center: float, sill: float | Floats) -> Floats:
    """The lower edge of a skirt: the sill, and over the wheel the arch."""
    height = np.sqrt(np.maximum(ARCH_RADIUS**2 - (x - center) ** 2, 0.0))
    return np.maximum(sill, WHEEL_RADIUS + height)


def arch_lip(center: float, sill: float, y: Callable[[Floats], Floats]) -> Surface:
    """The flare around a wheel arch."""
    path = _arch(center, sill, ARCH_RADIUS + 0.018)
    path[:, 1] = y(path[:, 2]) + 0.004
    section = [(-0.020, -0.018), (-0.012, 0.018), (0.006, 0.018), (0.014, -0.018)]
    return swept(path, section, up=(0, 1, 0))


def wheel_house(center: float, sill: float, inner: float, outer: float) -> Surface:
    """The liner inside a wheel arch, from y = inner to y = outer."""
    arch = _arch(center, sill, ARCH_RADIUS + 0.004)
    return grid(np.stack([shifted(arch, y=y) for y in (inner, outer)], axis=1))


def seam(path: Path, width: float = 0.010, normal: Place = (0, 1, 0)) -> Surface:
    """A dark gap between panels, along straight lines between the places of a path."""
    fine = _refined(np.asarray(path, float))
    return ribbon(fine + PROUD * np.asarray(normal, float), width, normal)


def _refined(path: Floats, length: float = 0.12) -> Floats:
    """The same path with places at most that far apart, so that it follows what bends."""
    legs = [
        a + (b - a) * np.linspace(0, 1, int(np.ceil(np.linalg.norm(b - a) / length)) + 1)[:-1, None]
        for a, b in pairwise(path)
    ]
    return np.vstack([*legs, path[-1:]])


def _shells(mesh: FiniteElementMesh, quads: np.ndarray) -> Surface:
    used, numbers = np.unique(quads, return_inverse=True)
    return Surface(mesh.nodes[used], triangles(numbers.reshape(quads.shape)))


def _arch(center: float, sill: float, radius: float) -> Floats:
    """Points (n, 3) in the plane y = 0 from the sill in front of a wheel over it to the sill behind."""
    least = np.arcsin((sill - WHEEL_RADIUS) / radius)
    angle = np.linspace(np.pi - least, least, 19)
    points = np.stack([np.cos(angle), np.zeros(19), np.sin(angle)], -1)
    return shifted(radius * points, x=center, z=WHEEL_RADIUS)
