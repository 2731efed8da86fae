"""The frame's look: rails, crossmembers, brackets, bumpers, tank and exhaust."""

import numpy as np

from modeviz.vehicle.arrays import Floats
from pickup import box, frame
from pickup.connections import COIL, FRONT_DAMPER, REAR_DAMPER
from pickup.materials import Piece, both_sides
from pickup.parameters import Parameters
from pickup.sides import Place
from pickup.solids import (
    Surface,
    block,
    cylinder,
    joined,
    line,
    rectangle,
    revolved,
    shifted,
    swept,
    tube,
)

PAINT = "frame paint"
RAIL = np.array(frame.RAIL)
RAIL_SIZE = (0.068, 0.150)


def pieces(p: Parameters) -> list[Piece]:
    """Everything that rides on the frame."""
    return [
        *both_sides([Piece(PAINT, _rail()), *_brackets(p), *_suspension_towers()]),
        *(Piece(PAINT, _crossmember(station)) for station in frame.CROSSMEMBERS),
        *_transmission_support(p),
        *_front_bumper(),
        *_rear_bumper(),
        *_tank(),
        *_exhaust(),
        *_steering_box(),
    ]


def _rail() -> Surface:
    x = np.union1d(RAIL[:, 0], np.arange(-0.85, 4.15, 0.15))
    path = np.stack([x, *(np.interp(x, RAIL[:, 0], RAIL[:, i]) for i in (1, 2))], -1)
    return swept(path, rectangle(*RAIL_SIZE))


def _crossmember(station: int) -> Surface:
    x, y, z = RAIL[station]
    width, height = (0.15, 0.11) if station == frame.SUSPENSION_CROSSMEMBER else (0.085, 0.075)
    path = line((x, -y, z), (x, y, z), 11)
    return swept(path, rectangle(width, height), cap=False)


def _brackets(p: Parameters) -> list[Piece]:
    """Outriggers under the cab mounts, hats under the box, arms to the engine and front-end mounts."""
    outriggers = (
        (RAIL[6], p.cab_front_mount),
        (RAIL[9], p.cab_rear_mount),
        (RAIL[0], p.front_end_mount),
    )
    pieces = [
        Piece(PAINT, surface)
        for base, seat in outriggers
        for surface in _outrigger(base, shifted(seat, z=-0.045))
    ]
    below_engine = shifted(p.engine_mount, z=-0.03)
    pieces.append(Piece(PAINT, _arm(RAIL[frame.ENGINE_CROSSMEMBER], below_engine, 0.13, 0.07)))
    for station, tip in zip(frame.BOX_STATIONS, box.BRACKETS, strict=True):
        pieces.append(Piece(PAINT, _arm(RAIL[station], tip, 0.10, 0.08, up=(1, 0, 0))))
    return pieces


def _outrigger(base: Place, seat: Floats) -> list[Surface]:
    """A tapering arm that ends in a cup."""
    return [
        _arm(base, seat, 0.15, 0.08),
        revolved([(0, -0.012), (0.058, -0.012), (0.062, 0.006), (0, 0.002)], "z", seat, 15),
    ]


def _arm(start: Place, end: Place, wide: float, narrow: float, up: Place = (0, 0, 1)) -> Surface:
    """A bar that tapers from `wide` to `narrow`."""
    section = np.array([rectangle(w, 0.7 * w) for w in (wide, narrow)])
    return swept(line(start, end), section, up)


def _suspension_towers() -> list[Piece]:
    """The spring pocket over the lower arm, the upper arm's ears, and the dampers' upper halves."""
    rail = RAIL[frame.SUSPENSION_CROSSMEMBER]
    pocket = [(0.045, 0.02), (0.088, 0.02), (0.088, 0.0), (0.080, -0.035), (0.074, -0.035)]
    seat = np.array([COIL[0], COIL[1], 0.62])
    ears = [
        _arm(rail, np.array(tip), 0.08, 0.05, up=(1, 0, 0)) for tip in frame.SUSPENSION_BRACKETS[:4]
    ]
    x, y, z = FRONT_DAMPER
    rear = np.array(REAR_DAMPER)
    return [
        Piece(PAINT, revolved(pocket, "z", seat, 15)),
        Piece(PAINT, _arm(shifted(rail, z=0.04), shifted(seat, y=-0.03), 0.17, 0.12)),
        Piece(PAINT, joined(ears)),
        Piece(
            "trim", tube(line((x, y, z + 0.02), (x, y - 0.02, z + 0.24), 2), 0.026, n=12, up=(1, 0, 0))
        ),
        Piece(
            "trim",
            tube(
                line(shifted(rear, z=0.02), shifted(rear, x=0.05, y=0.02, z=0.20), 2),
                0.03,
                n=12,
                up=(1, 0, 0),
            ),
        ),
    ]


def _transmission_support(p: Parameters) -> list[Piece]:
    foot = RAIL[7] * [1, 0, 1]
    seat = shifted(p.transmission_mount, z=-0.03)
    return [Piece(PAINT, _arm(foot, seat, 0.14, 0.10, up=(1, 0, 0)))]


def _front_bumper() -> list[Piece]:
    y = np.linspace(-0.92, 0.92, 19)
    x = -1.00 + 0.10 * np.abs(y / 0.92) ** 4
    path = np.stack([x, y, np.full_like(y, 0.58)], -1)
    section = [
        (-0.035, -0.085),
        (0.02, -0.085),
        (0.04, -0.03),
        (0.04, 0.03),
        (0.02, 0.085),
        (-0.035, 0.085),
    ]
    rub = shifted(path, x=-0.044)
    iron = line((-0.88, 0.36, 0.52), (-0.98, 0.40, 0.57), 3)
    return [
        Piece("chrome", swept(path, np.array(section) * [-1, 1])),
        Piece("trim", swept(rub, rectangle(0.016, 0.05))),
        *both_sides([Piece(PAINT, swept(iron, rectangle(0.05, 0.09)))]),
    ]


def _rear_bumper() -> list[Piece]:
    """A step bumper with the licence plate in its middle."""
    y = np.linspace(-0.88, 0.88, 13)
    path = np.stack([4.275 - 0.05 * np.abs(y / 0.88) ** 4, y, np.full_like(y, 0.60)], -1)
    return [
        Piece("chrome", swept(path, rectangle(0.13, 0.16))),
        Piece("trim", swept(shifted(path, z=0.082), rectangle(0.10, 0.012))),
        Piece("head lamp", block((4.343, 0, 0.60), (0.008, 0.32, 0.11))),
        *both_sides(
            [Piece(PAINT, swept(line(RAIL[-1], (4.24, 0.48, 0.60), 2), rectangle(0.05, 0.09)))]
        ),
    ]


def _tank() -> list[Piece]:
    body = swept(line((1.93, 0.635, 0.45), (2.53, 0.635, 0.47), 5), _rounded(0.22, 0.21))
    straps = [
        swept(line((x, 0.635, z), (x + 0.03, 0.635, z), 2), _rounded(0.226, 0.216))
        for x, z in ((2.05, 0.454), (2.38, 0.465))
    ]
    return [Piece("dark", body), *(Piece("steel", strap) for strap in straps)]


def _rounded(width: float, height: float) -> Floats:
    """A rectangle with its corners cut, a section for `swept`."""
    w, h, c = width / 2, height / 2, 0.035
    return np.array(
        [
            (-w + c, -h),
            (w - c, -h),
            (w, -h + c),
            (w, h - c),
            (w - c, h),
            (-w + c, h),
            (-w, h - c),
            (-w, -h + c),
        ]
    )


def _exhaust() -> list[Piece]:
    pipe = [
        (0.55, -0.24, 0.42),
        (0.90, -0.27, 0.37),
        (1.45, -0.27, 0.37),
        (2.45, -0.30, 0.42),
        (2.75, -0.30, 0.52),
        (3.00, -0.30, 0.56),
        (3.30, -0.30, 0.50),
        (3.75, -0.55, 0.42),
        (4.12, -0.62, 0.41),
    ]
    muffler = swept(line((1.50, -0.27, 0.37), (2.10, -0.28, 0.39), 4), _rounded(0.19, 0.13))
    return [Piece("steel", tube(pipe, 0.027, n=10)), Piece("steel", muffler)]


def _steering_box() -> list[Piece]:
    return [
        Piece("castings", block((-0.16, -0.42, 0.50), (0.17, 0.10, 0.13), top=0.85)),
        Piece("castings", cylinder(0.035, 0.16, "z", (-0.16, -0.40, 0.46), 14)),
    ]
