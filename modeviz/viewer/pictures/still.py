"""A picture of what moves, drawn without a browser: for where there is none, and no page yet."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PIL import Image, ImageDraw

from modeviz.report.images import on_color
from modeviz.shapes.motion import default_amplitude, displacement, vertex_shapes
from modeviz.shapes.stand_in import drawn_mesh
from modeviz.shapes.surface import Patch, Surface, surface, vertex_areas
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.scene.body_view import SEE_THROUGH, is_sheet
from modeviz.viewer.scene.stage import CARD_FRACTION, DARK, FIELD_OF_VIEW, ISO, LIGHT, box, camera
from modeviz.viewer.session.answers import Solved

FINER = 2
"""It is drawn so many times as large, and then made smaller, which smooths its edges."""

KEY = np.array([-5.0, -7.0, 10.0]) / np.linalg.norm([-5.0, -7.0, 10.0])
"""Where the light comes from."""

DARKEST = 0.45
"""What is turned away from the light has so much of its colour."""


@dataclass(frozen=True, eq=False)
class Triangles:
    """Triangles in space."""

    corners: Floats
    """(n, 3, 3), m: triangle, corner, coordinate."""
    colors: Floats
    """(n, 4), sRGB and opacity, 0 to 255."""


@dataclass(frozen=True, eq=False)
class Seen:
    """Triangles in a picture."""

    corners: Floats
    """(n, 3, 2), pixels to the right and down."""
    colors: Array
    """(n, 4), as of `Triangles`, whole numbers."""


def still(solved: Solved, dark: bool, width: int, height: int) -> Image.Image:
    """Return what moves at its largest, seen as a page opens, RGB.

    Args:
        solved: what is drawn.
        dark: whether the background is.
        width: pixels.
        height: pixels.
    """
    return _drawn(_triangles(solved), solved.now.prepared.vehicle, dark, width, height)


def still_at_rest(vehicle: Vehicle, dark: bool, width: int, height: int) -> Image.Image:
    """Return a vehicle as it stands there, which need not be prepared; else as `still`."""
    bodies = [body for body in vehicle.bodies if drawn_mesh(body)]
    surfaces = [surface(drawn_mesh(body)) for body in bodies]
    clear = [[patch.material.opacity for patch in drawn.patches] for drawn in surfaces]
    triangles = _colored(surfaces, [drawn.vertices for drawn in surfaces], clear)
    return _drawn(triangles, vehicle, dark, width, height)


def _drawn(triangles: Triangles, vehicle: Vehicle, dark: bool, width: int, height: int) -> Image.Image:
    """Return triangles drawn from the furthest to the nearest, each in one shade."""
    theme = DARK if dark else LIGHT
    whole = round(height / (1 - CARD_FRACTION))  # a page keeps the lowest part of it free
    size = FINER * width, FINER * whole
    pose = camera(box(vehicle), ISO, width, whole)
    drawn = on_color(Image.new("RGBA", size), theme.top, theme.bottom)
    draw = ImageDraw.Draw(drawn, "RGBA")
    seen = _seen(triangles, *pose, size)
    for corners, color in zip(seen.corners.reshape(-1, 6).tolist(), seen.colors.tolist(), strict=True):
        draw.polygon(corners, tuple(color))
    smaller = drawn.resize((width, whole), Image.Resampling.LANCZOS)
    return smaller.crop((0, 0, width, height))


def _triangles(solved: Solved) -> Triangles:
    """What is drawn of the bodies, in the shape that moves, as clear to see as on a page."""
    vehicle, system = solved.now.prepared.vehicle, solved.now.prepared.system
    moving = solved.movement.shape
    bodies = [body for body in vehicle.bodies if drawn_mesh(body) and _is_shown(body, solved)]
    surfaces = [surface(drawn_mesh(body)) for body in bodies]
    shapes = [
        displacement(vertex_shapes(body, drawn.vertices), np.real(moving[system.dofs[body.name]]))
        for body, drawn in zip(bodies, surfaces, strict=True)
    ]
    scale = default_amplitude(shapes, [vertex_areas(s) for s in surfaces], box(vehicle).length)
    clear = [
        [_opacity(body, patch, solved) for patch in drawn.patches]
        for body, drawn in zip(bodies, surfaces, strict=True)
    ]
    moved = [d.vertices + scale * shape for d, shape in zip(surfaces, shapes, strict=True)]
    return _colored(surfaces, moved, clear)


def _colored(
    surfaces: Sequence[Surface], vertices: Sequence[Floats], opacities: Sequence[Sequence[float]]
) -> Triangles:
    """Return the triangles of surfaces, with each patch as clear to see as is said of it."""
    corners, colors = [np.zeros((0, 3, 3))], [np.zeros((0, 4))]
    for drawn, moved, clear in zip(surfaces, vertices, opacities, strict=True):
        for patch, opacity in zip(drawn.patches, clear, strict=True):
            color = *patch.material.color, 255 * opacity
            corners.append(moved[patch.faces])
            colors.append(np.tile(np.array(color, float), (len(patch.faces), 1)))
    return Triangles(np.concatenate(corners), np.concatenate(colors))


def _is_shown(body: Body, solved: Solved) -> bool:
    alone = solved.movement.bodies
    return body.name not in solved.state.look.hidden if alone is None else body.name in alone


def _opacity(body: Body, patch: Patch, solved: Solved) -> float:
    is_seen_through = patch.is_skin and is_sheet(body) and solved.state.look.see_through
    return patch.material.opacity * (SEE_THROUGH if is_seen_through else 1.0)


def _seen(triangles: Triangles, place: Floats, look_at: Floats, size: tuple[int, int]) -> Seen:
    """Return triangles as a camera sees them, from the furthest to the nearest."""
    width, height = size
    backward = (place - look_at) / np.linalg.norm(place - look_at)
    right = np.cross([0, 0, 1.0], backward)
    right /= np.linalg.norm(right)
    axes = np.stack([right, np.cross(backward, right), backward])
    x, y, z = np.moveaxis((triangles.corners - place) @ axes.T, -1, 0)
    scale = height / 2 / np.tan(FIELD_OF_VIEW / 2)
    pixels = np.stack([width / 2 - scale * x / z, height / 2 + scale * y / z], axis=-1)
    colors = triangles.colors.copy()
    colors[:, :3] *= _brightness(triangles.corners, backward)[:, None]
    order = np.argsort(z.mean(axis=1))
    return Seen(pixels[order], colors[order].round().astype(int))


def _brightness(corners: Floats, backward: Floats) -> Floats:
    """How bright each triangle is on the side that is seen, `DARKEST` to 1."""
    a, b, c = np.moveaxis(corners, 1, 0)
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    facing = np.copysign(1.0, normals @ backward)
    lit = np.divide(facing * (normals @ KEY), lengths, np.zeros_like(lengths), where=lengths > 0)
    return DARKEST + (1 - DARKEST) * lit.clip(0)
