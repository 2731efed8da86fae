"""The cab's look: panes, seams, sill, mirrors, handles, and a bench inside."""

import numpy as np

from modeviz.fem.mesh import FiniteElementMesh
from modeviz.vehicle.arrays import Floats
from pickup import cab
from pickup.dressing.panels import PROUD, panels, seam, skirt
from pickup.materials import Piece, both_sides
from pickup.solids import block, circle, cylinder, line, patch, rotation, shifted, swept, tube

PAINT = "cab paint"
FLOOR, ROCKER, BELT, ROOF = range(4)
FRONT, DOOR_FRONT, DOOR_REAR, BACK = range(4)

CORNERS = cab.corners()[:, -1]
"""(4, 4, 3): the right side's corners by place along the cab and level."""
SILL_BOTTOM = 0.52


def pieces(mesh: FiniteElementMesh) -> list[Piece]:
    """Panels and everything on them."""
    return [
        *panels(mesh, PAINT),
        *both_sides([*_side_glass(), *_door(), *_pillars(), *_mirror(), _sill(), *_seat_track()]),
        *_headers(),
        *_wipers(),
        *_inside(),
    ]


def side_point(along: float, level: float) -> Floats:
    """A place on the right side; whole numbers are the block's corners, between them it is linear."""
    i, k = min(int(along), BACK - 1), min(int(level), ROOF - 1)
    s, t = along - i, level - k
    low = (1 - s) * CORNERS[i, k] + s * CORNERS[i + 1, k]
    return (1 - t) * low + t * ((1 - s) * CORNERS[i, k + 1] + s * CORNERS[i + 1, k + 1])


def _side_glass() -> list[Piece]:
    """The door's window, and the vent pane in the wide pillar before it."""
    window = [(1.04, 2.06), (1.96, 2.06), (1.95, 2.90), (1.05, 2.90)]
    vent = [(0.30, 2.06), (0.96, 2.06), (0.95, 2.90), (0.36, 2.90)]
    return [Piece("glass", patch([_off_side(*c) for c in pane], 5, 4)) for pane in (window, vent)]


def _door() -> list[Piece]:
    """The gaps around the door, its handle and its rubbing strip."""
    shell = [side_point(*place) for place in ((1, 2), (1, 1.08), (2, 1.08), (2, 2))]
    belt = [side_point(*place) for place in ((0.9, 2), (2, 2))]
    divider = [side_point(*place) for place in ((1, 2), (1, 2.94))]
    frame = [side_point(*place) for place in ((2, 2), (2, 2.94), (0.34, 2.94))]
    rub = [side_point(along, 1.25) for along in (0.05, 1, 2, 2.95)]
    handle = side_point(1.86, 1.80)
    return [
        Piece("seam", seam(shell)),
        Piece("seam", seam(belt, width=0.016)),
        Piece("seam", seam(divider, width=0.014)),
        Piece("seam", seam(frame)),
        Piece("trim", block(shifted(handle, y=0.012), (0.13, 0.022, 0.026))),
        Piece("chrome", block(shifted(handle, x=0.03, y=0.020), (0.05, 0.016, 0.014))),
        Piece("trim", seam(rub, width=0.045)),
    ]


def _pillars() -> list[Piece]:
    """Painted edges beside windshield and rear window, so that the glass ends in a frame."""
    front = [CORNERS[FRONT, BELT], CORNERS[FRONT, ROOF]]
    back = [CORNERS[BACK, BELT], CORNERS[BACK, ROOF]]
    inward = np.array([0.0, -0.03, 0.0])
    return [
        Piece(PAINT, seam([p + inward for p in front], 0.06, _normal(front, (0, 1, 0)))),
        Piece(PAINT, seam([p + inward for p in back], 0.06, _normal(back, (0, -1, 0)))),
    ]


def _headers() -> list[Piece]:
    """The roof's edge over the windshield, and the black band along its foot."""
    top, foot = CORNERS[FRONT, ROOF], CORNERS[FRONT, BELT]
    normal = _normal([foot, top], (0, 1, 0))
    down = (foot - top) / np.linalg.norm(foot - top)
    across = np.array([1.0, -1.0, 1.0])
    header, cowl = top + 0.03 * down, foot - 0.025 * down
    return [
        Piece(PAINT, seam([header, header * across], 0.06, normal)),
        Piece("trim", seam([cowl, cowl * across], 0.05, normal)),
    ]


def _mirror() -> list[Piece]:
    foot = side_point(0.62, 2.04)
    head = shifted(foot, x=0.02, y=0.13, z=0.09)
    return [
        Piece("trim", tube([foot, shifted(head, y=-0.05, z=-0.04)], 0.014)),
        Piece("trim", block(head, (0.07, 0.17, 0.15), top=0.85, rear=1.0)),
        Piece("glass", block(shifted(head, x=0.037), (0.004, 0.14, 0.12), top=0.9)),
    ]


def _sill() -> Piece:
    """The rocker's outer skin, which the structure has further in."""
    x = np.linspace(0.62, 2.0, 15)
    top = cab.HEIGHTS[ROCKER] - 0.02
    return Piece(
        PAINT,
        skirt(
            lambda x: np.full_like(x, SILL_BOTTOM),
            lambda x: np.full_like(x, top),
            x,
            lambda z: np.interp(z, [SILL_BOTTOM, top], [0.885, 0.924]),
        ),
    )


def _seat_track() -> list[Piece]:
    floor = cab.HEIGHTS[FLOOR]
    return [
        Piece(
            "steel", swept(line((1.10, y, floor + 0.02), (1.70, y, floor + 0.02), 6), circle(0.012, 6))
        )
        for y in (0.25, 0.59)
    ]


def _wipers() -> list[Piece]:
    foot, top = CORNERS[FRONT, BELT], CORNERS[FRONT, ROOF]
    up = (top - foot) / np.linalg.norm(top - foot)
    start = np.array([foot[0] - 0.02, 0.0, foot[2] + 0.02])
    return [
        Piece("seam", tube([shifted(start, y=y), shifted(start, y=y - 0.42) + 0.13 * up], 0.007, n=6))
        for y in (0.02, 0.62)
    ]


def _inside() -> list[Piece]:
    """Bench, head rests, instrument panel and steering wheel."""
    lean = rotation("y", 14)
    back = block((1.68, 0, 1.14), (0.13, 1.36, 0.52), top=0.94)
    pieces = [
        Piece("cloth", block((1.42, 0, 0.83), (0.54, 1.40, 0.17), top=0.95)),
        Piece("cloth", back.turned(lean, (1.63, 0, 0.88))),
        Piece("trim", block((0.70, 0, 1.06), (0.30, 1.66, 0.16), top=0.85)),
    ]
    for y in (-0.38, 0.38):
        rest = block((1.68, y, 1.47), (0.09, 0.26, 0.15), top=0.8)
        pieces.append(Piece("cloth", rest.turned(lean, (1.63, y, 0.88))))
    return [*pieces, *_steering_wheel()]


def _steering_wheel() -> list[Piece]:
    hub = np.array([1.02, -0.38, 1.10])
    tilt = rotation("y", -60)
    angle = np.linspace(0, 2 * np.pi, 17)
    rim = np.stack([0.19 * np.cos(angle), 0.19 * np.sin(angle), 0 * angle], -1)
    spoke = block((0, 0, 0), (0.03, 0.37, 0.012))
    return [
        Piece("trim", tube(rim @ tilt.T + hub, 0.013, n=6, up=tilt[:, 2])),
        Piece("trim", spoke.turned(tilt).moved(hub)),
        Piece("trim", cylinder(0.05, 0.03, "z", (0, 0, 0)).turned(tilt).moved(hub)),
        Piece("trim", tube([hub, hub - 0.36 * tilt[:, 2]], 0.02)),
    ]


def _off_side(along: float, level: float) -> Floats:
    """A place just outside the right side."""
    return shifted(side_point(along, level), y=PROUD)


def _normal(edge: list[Floats], across: tuple[float, float, float]) -> Floats:
    """The outward direction of a pane, from its upward edge and a direction across it."""
    n = np.cross(edge[1] - edge[0], across)
    return n / np.linalg.norm(n)
