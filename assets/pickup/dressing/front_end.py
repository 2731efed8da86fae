"""The front end's look: arches, grille, lamps, seams and radiator."""

import numpy as np

from modeviz.fem.mesh import FiniteElementMesh
from modeviz.vehicle.arrays import Floats
from pickup import front_end
from pickup.dressing.panels import (
    arch_lip,
    arch_outline,
    arch_stations,
    panels,
    seam,
    skirt,
    wheel_house,
)
from pickup.materials import Piece, both_sides
from pickup.solids import block, circle, line, swept, tube

PAINT = "front end paint"
CORNERS = front_end.corners()
SILL, FENDER_LINE, HOOD = range(3)
EDGE, OUTER = 2, 3
"""Where across the hood ends, and the fender's side."""
NOSE = -0.865
"""x: what is set on the radiator support starts here."""


def pieces(mesh: FiniteElementMesh) -> list[Piece]:
    """Panels and everything on them."""
    return [
        *panels(mesh, PAINT),
        *both_sides([*_arch(), *_lamps(), *_seams()]),
        *_grille(),
        *_radiator(),
        *_under_the_hood(),
        Piece("trim", tube(line((0.30, 0.80, 1.13), (0.42, 0.82, 1.72), 3), 0.004, n=6, up=(0, 1, 0))),
    ]


def _arch() -> list[Piece]:
    """A round arch in the opening that the structure leaves straight."""
    front, rear = CORNERS[1, OUTER], CORNERS[3, OUTER]
    sill = front[SILL, 2]
    top = CORNERS[1:4, OUTER, FENDER_LINE]

    def y(z: Floats) -> Floats:
        low, high = front[SILL], front[FENDER_LINE]
        return np.interp(z, [low[2], high[2]], [low[1], high[1]])

    x = arch_stations(0.0, sill, front[SILL, 0], rear[SILL, 0])
    panel = skirt(
        lambda x: arch_outline(x, 0.0, sill), lambda x: np.interp(x, top[:, 0], top[:, 2]), x, y
    )
    return [
        Piece(PAINT, panel),
        Piece(PAINT, arch_lip(0.0, sill, y)),
        Piece("dark", wheel_house(0.0, sill, inner=0.66, outer=0.915)),
    ]


def _lamps() -> list[Piece]:
    return [
        Piece("trim", block((NOSE + 0.002, 0.665, 0.905), (0.03, 0.36, 0.20))),
        Piece("head lamp", block((NOSE - 0.012, 0.655, 0.915), (0.02, 0.29, 0.135), top=0.97)),
        Piece("turn signal", block((NOSE + 0.005, 0.855, 0.915), (0.03, 0.075, 0.135))),
        Piece("turn signal", block((NOSE + 0.005, 0.70, 0.745), (0.02, 0.20, 0.055))),
        Piece("turn signal", block((-0.79, 0.925, 0.93), (0.11, 0.012, 0.045))),
    ]


def _seams() -> list[Piece]:
    """The gap between hood and fender, and the rubbing strip that runs on along the cab."""
    hood = [CORNERS[i, EDGE, HOOD] for i in range(5)]
    rub = [(x, y - 0.002, 0.875) for x, y, _ in CORNERS[:, OUTER, FENDER_LINE] + [0.015, 0, 0]]
    return [
        Piece("seam", seam(hood, 0.012, (0, 0, 1))),
        Piece("trim", seam(rub, 0.045)),
    ]


def _grille() -> list[Piece]:
    bars = [
        Piece("chrome", block((NOSE - 0.013, 0, z), (0.014, 0.92, 0.014)))
        for z in (0.845, 0.88, 0.915, 0.95, 0.985)
    ]
    posts = [
        Piece("chrome", block((NOSE - 0.010, y, 0.915), (0.012, 0.012, 0.16)))
        for y in (-0.46, -0.23, 0.0, 0.23, 0.46)
    ]
    return [
        Piece("seam", block((NOSE + 0.002, 0, 0.915), (0.02, 0.95, 0.18))),
        *bars,
        *posts,
        Piece("chrome", block((NOSE + 0.006, 0, 1.012), (0.024, 1.66, 0.016))),
        Piece("trim", block((NOSE + 0.005, 0, 0.735), (0.02, 1.10, 0.075))),
    ]


def _radiator() -> list[Piece]:
    tank = swept(line((-0.76, -0.34, 0.99), (-0.76, 0.34, 0.99), 5), circle(0.03, 8))
    return [
        Piece("dark", block((-0.76, 0, 0.77), (0.05, 0.66, 0.42))),
        Piece("steel", tank),
    ]


def _under_the_hood() -> list[Piece]:
    """Battery and washer bottle on the inner fenders."""
    return [
        Piece("trim", block((-0.28, 0.79, 0.96), (0.25, 0.17, 0.19))),
        Piece("head lamp", block((-0.30, -0.80, 0.95), (0.16, 0.14, 0.16), top=0.9)),
    ]
