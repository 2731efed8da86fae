"""The box's look: outer sides with arches, ribs, rails, tailgate and lamps."""

import numpy as np

from modeviz.fem.mesh import FiniteElementMesh
from modeviz.vehicle.arrays import Floats
from pickup import box
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
from pickup.parameters import WHEELBASE
from pickup.solids import block, line, rectangle, ribbon, swept

PAINT = "box paint"
FRONT, REAR = box.X[0], box.X[-1]
FLOOR, LEDGE, TOP = box.Z
SIDE = box.Y[-1]
SILL = 0.52
TAIL_RISE = 0.06
"""m: how much the sill rises behind the wheel."""


def pieces(mesh: FiniteElementMesh) -> list[Piece]:
    """Panels and everything on them."""
    return [
        *panels(mesh, PAINT),
        *both_sides([*_outer_side(), *_rail(), *_tail_lamp()]),
        *_tailgate(),
        *_ribs(),
    ]


def _outer_side() -> list[Piece]:
    """The skirt below the floor, which the structure leaves out."""

    def y(z: Floats) -> Floats:
        return np.interp(z, [SILL, FLOOR, LEDGE], [SIDE - 0.01, SIDE, SIDE + box.FLARE])

    def low(x: Floats) -> Floats:
        sill = np.interp(x, [WHEELBASE + 0.4, REAR], [SILL, SILL + TAIL_RISE])
        return np.minimum(arch_outline(x, WHEELBASE, sill), FLOOR - 0.002)

    x = arch_stations(WHEELBASE, SILL, FRONT, REAR)
    panel = skirt(low, lambda x: np.full_like(x, FLOOR), x, y)
    rub = [(x, SIDE + box.FLARE * 0.56, 0.875) for x in (FRONT + 0.02, WHEELBASE, REAR - 0.02)]
    return [
        Piece(PAINT, panel),
        Piece(PAINT, arch_lip(WHEELBASE, SILL, lambda z: y(z) + 0.004)),
        Piece("dark", wheel_house(WHEELBASE, SILL, inner=0.62, outer=SIDE - 0.006)),
        Piece("trim", seam(rub, 0.045)),
    ]


def _rail() -> list[Piece]:
    """The thick upper edge of the side."""
    y = SIDE + box.FLARE - 0.012
    return [Piece(PAINT, swept(line((FRONT, y, TOP), (REAR, y, TOP), 14), rectangle(0.055, 0.035)))]


def _tail_lamp() -> list[Piece]:
    y = SIDE + box.FLARE - 0.062
    return [
        Piece("trim", block((REAR + 0.006, y, 1.005), (0.02, 0.115, 0.33))),
        Piece("tail lamp", block((REAR + 0.016, y, 1.065), (0.02, 0.095, 0.185))),
        Piece("head lamp", block((REAR + 0.016, y, 0.935), (0.02, 0.095, 0.055))),
        Piece("turn signal", block((REAR + 0.016, y, 0.875), (0.02, 0.095, 0.055))),
    ]


def _tailgate() -> list[Piece]:
    half, low, high = 0.765, 0.79, 1.20
    outline = [(REAR, half, high), (REAR, half, low), (REAR, -half, low), (REAR, -half, high)]
    return [
        Piece("seam", seam(outline, 0.012, (1, 0, 0))),
        Piece("trim", block((REAR + 0.008, 0, 1.10), (0.02, 0.26, 0.065))),
        Piece("chrome", block((REAR + 0.018, 0, 1.105), (0.014, 0.18, 0.022))),
        Piece(PAINT, swept(line((REAR, -0.84, TOP), (REAR, 0.84, TOP), 10), rectangle(0.04, 0.03))),
        Piece(PAINT, swept(line((FRONT, -0.84, TOP), (FRONT, 0.84, TOP), 10), rectangle(0.04, 0.03))),
    ]


def _ribs() -> list[Piece]:
    """The pressed ribs of the floor."""
    up = np.array([0.0, 0.0, 1.0])
    ends = np.array([FRONT + 0.05, REAR - 0.05])
    return [
        Piece(
            "dark", ribbon(line((ends[0], y, FLOOR + 0.006), (ends[1], y, FLOOR + 0.006), 12), 0.03, up)
        )
        for y in np.linspace(-0.54, 0.54, 7)
    ]
