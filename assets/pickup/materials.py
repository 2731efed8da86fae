"""What the truck's surfaces look like, and how pieces become a body's display mesh."""

from collections.abc import Iterable
from typing import NamedTuple

from modeviz.vehicle.bodies import Material, Mesh, MeshPart
from pickup.solids import Surface, joined

MATERIALS = {
    "front end paint": Material((84, 118, 152), roughness=0.42, metallic=0.25),
    "cab paint": Material((202, 134, 98), roughness=0.42, metallic=0.25),
    "box paint": Material((112, 142, 118), roughness=0.42, metallic=0.25),
    "frame paint": Material((72, 77, 84), roughness=0.6, metallic=0.4),
    "glass": Material((24, 32, 40), opacity=0.86, roughness=0.12, metallic=0.2),
    "chrome": Material((186, 190, 196), roughness=0.35, metallic=0.7),
    "castings": Material((148, 153, 160), roughness=0.45, metallic=0.6),
    "steel": Material((92, 96, 102), roughness=0.55, metallic=0.5),
    "dark": Material((52, 55, 60), roughness=0.7, metallic=0.2),
    "trim": Material((40, 42, 46), roughness=0.6, metallic=0.2),
    "seam": Material((20, 22, 24), roughness=0.8, metallic=0.0),
    "rubber": Material((34, 35, 38), roughness=0.9, metallic=0.0),
    "cloth": Material((88, 84, 80), roughness=0.95, metallic=0.0),
    "head lamp": Material((238, 240, 232), roughness=0.2, metallic=0.1),
    "turn signal": Material((226, 142, 42), roughness=0.3, metallic=0.1),
    "tail lamp": Material((168, 38, 34), roughness=0.3, metallic=0.1),
}


class Piece(NamedTuple):
    """A surface and the name of its material."""

    material: str
    surface: Surface


def both_sides(pieces: Iterable[Piece]) -> list[Piece]:
    """The pieces and their mirror images."""
    right = list(pieces)
    return [*right, *(Piece(p.material, p.surface.mirrored()) for p in right)]


def display_mesh(pieces: Iterable[Piece]) -> Mesh:
    """One part for each material, in the order in which they first come."""
    by_material: dict[str, list[Surface]] = {}
    for material, surface in pieces:
        by_material.setdefault(material, []).append(surface)
    return tuple(
        MeshPart(name, whole.vertices, whole.faces, MATERIALS[name])
        for name, whole in ((name, joined(surfaces)) for name, surfaces in by_material.items())
    )
