"""Wheels, axle, arms, springs and shafts."""

import numpy as np

from modeviz.vehicle.arrays import Floats
from pickup.connections import (
    COIL,
    FRONT_DAMPER,
    FRONT_JOINT,
    HALF_TRACK,
    LOWER_BALL_JOINT,
    LOWER_BUSHES,
    REAR_DAMPER,
    REAR_JOINT,
    TIE_ROD_ENDS,
    UPPER_BALL_JOINT,
    UPPER_BUSHES,
    WHEEL_RADIUS,
)
from pickup.dressing.wheels import wheel
from pickup.materials import Piece, both_sides
from pickup.parameters import WHEELBASE, Parameters
from pickup.solids import (
    block,
    circle,
    coil,
    cylinder,
    grid,
    joined,
    line,
    rectangle,
    revolved,
    shifted,
    swept,
    tube,
)

AXLE = np.array([WHEELBASE, 0.0, WHEEL_RADIUS])
COIL_FOOT = 0.315
COIL_TOP = 0.60


def knuckle() -> list[Piece]:
    """The right front wheel with hub, brake and upright."""
    center = np.array([0.0, HALF_TRACK, WHEEL_RADIUS])
    low, high = np.array(LOWER_BALL_JOINT), np.array(UPPER_BALL_JOINT)
    steering_arm = line(shifted(center, x=-0.02, y=-0.10), TIE_ROD_ENDS[0], 3)
    return [
        *wheel(center),
        Piece("chrome", cylinder(0.145, 0.024, "y", shifted(center, y=-0.045), 24)),
        Piece("castings", tube([low, shifted(center, y=-0.09), high], 0.03, n=10, up=(1, 0, 0))),
        Piece("castings", cylinder(0.055, 0.13, "y", shifted(center, y=-0.05), 16)),
        Piece("steel", tube(steering_arm, 0.018)),
    ]


def lower_arm() -> list[Piece]:
    """The right lower arm with the coil that stands on it and the damper's lower half."""
    joint = np.array(LOWER_BALL_JOINT)
    x, y, z = FRONT_DAMPER
    spring = coil((COIL[0], COIL[1], COIL_FOOT), COIL_TOP - COIL_FOOT, 0.062, 0.0085, 5)
    return [
        *_wishbone(list(LOWER_BUSHES.values()), joint, 0.026),
        Piece("steel", cylinder(0.08, 0.02, "z", (COIL[0], COIL[1], COIL_FOOT - 0.01), 14)),
        Piece("dark", spring),
        Piece("chrome", tube([(x, y, 0.31), (x, y, z + 0.06)], 0.014, n=10, up=(1, 0, 0))),
    ]


def upper_arm() -> list[Piece]:
    """The right upper arm."""
    return _wishbone(list(UPPER_BUSHES.values()), np.array(UPPER_BALL_JOINT), 0.02)


def steering_linkage() -> list[Piece]:
    """Relay rod, its two arms and the tie rods."""
    outer, inner = (np.array(end) for end in TIE_ROD_ENDS)
    relay = line(inner * [1, -1, 1], inner, 5)
    arm = line(inner, shifted(inner, x=0.10, y=0.02, z=0.03), 2)
    sides = [
        Piece("steel", tube(line(inner, outer, 3), 0.014)),
        Piece("castings", swept(arm, rectangle(0.035, 0.022))),
        Piece("dark", cylinder(0.022, 0.04, "z", inner, 10)),
    ]
    return [Piece("steel", tube(relay, 0.017)), *both_sides(sides)]


def propshaft() -> list[Piece]:
    """A tube with a yoke at each end."""
    start, end = np.array(FRONT_JOINT), np.array(REAR_JOINT)
    along = (end - start) / np.linalg.norm(end - start)
    yokes = [
        tube([joint, joint + sign * 0.09 * along], 0.028, n=10)
        for joint, sign in ((start, 1), (end, -1))
    ]
    crosses = [cylinder(0.016, 0.11, axis, joint, 10) for joint in (start, end) for axis in ("y", "z")]
    shaft = tube([start + 0.09 * along, end - 0.09 * along], 0.04, n=16)
    return [Piece("steel", shaft), Piece("castings", joined([*yokes, *crosses]))]


def rear_axle(p: Parameters) -> list[Piece]:
    """The beam axle with its wheels, brakes and leaf springs."""
    housing = [
        (0, -0.15),
        (0.07, -0.14),
        (0.125, -0.09),
        (0.15, 0.0),
        (0.125, 0.09),
        (0.07, 0.14),
        (0, 0.15),
    ]
    nose = [
        (0.10, -0.12),
        (0.07, -0.20),
        (0.05, REAR_JOINT[0] - WHEELBASE + 0.02),
        (0, REAR_JOINT[0] - WHEELBASE + 0.02),
    ]
    drum = [(0, -0.07), (0.15, -0.07), (0.155, -0.05), (0.155, 0.0), (0, 0.0)]
    center = shifted(AXLE, y=HALF_TRACK)
    sides = [
        *wheel(center),
        Piece("steel", revolved(drum, "y", center, 24)),
        *_leaf_spring(p),
        *_rear_damper(),
    ]
    return [
        Piece(
            "steel", swept(line(shifted(AXLE, y=-0.74), shifted(AXLE, y=0.74), 3), circle(0.045, 18))
        ),
        Piece("steel", revolved(housing, "y", AXLE, 24)),
        Piece("steel", revolved(nose, "x", AXLE, 20)),
        *both_sides(sides),
    ]


def _wishbone(bushes: list, joint: Floats, radius: float) -> list[Piece]:
    """Two legs from the bushes to the ball joint, and the web between them."""
    front, rear = (np.array(b) for b in bushes)
    legs = [tube(line(bush, joint, 3), radius) for bush in (front, rear)]
    web = grid([line(front, joint, 5)[1:-1], line(rear, joint, 5)[1:-1]])
    return [
        Piece("steel", joined([*legs, web])),
        *(Piece("trim", cylinder(0.034, 0.06, "x", bush, 10)) for bush in (front, rear)),
        Piece("castings", cylinder(0.034, 0.06, "z", joint, 10)),
    ]


def _leaf_spring(p: Parameters) -> list[Piece]:
    """Three leaves clamped to the axle, and the shackle at the rear."""
    half, y = p.leaf_half_length, p.leaf_y
    seat = WHEEL_RADIUS + 0.06
    leaves = []
    for n, share in enumerate((1.0, 0.75, 0.5)):
        t = np.linspace(-share, share, 11)
        eye = np.where(t < 0, p.leaf_eye[2], p.leaf_shackle[2])
        z = seat + 0.013 * (2 - n) + (eye - seat - 0.04) * t**2
        path = np.stack([WHEELBASE + half * t, np.full_like(t, y), z], -1)
        leaves.append(swept(path, rectangle(0.062, 0.011)))
    eyes = [cylinder(0.026, 0.07, "y", end, 10) for end in (p.leaf_eye, p.leaf_shackle)]
    bolts = [
        tube(
            [(WHEELBASE + dx, y, seat - 0.12), (WHEELBASE + dx, y, seat + 0.075)],
            0.008,
            n=6,
            up=(1, 0, 0),
        )
        for dx in (-0.055, 0.055)
    ]
    return [
        Piece("dark", joined(leaves)),
        Piece("steel", joined(eyes)),
        Piece("steel", block((WHEELBASE, y, seat + 0.062), (0.15, 0.085, 0.018))),
        Piece("steel", joined(bolts)),
    ]


def _rear_damper() -> list[Piece]:
    x, y, z = REAR_DAMPER
    return [
        Piece(
            "chrome", tube([(x, y, WHEEL_RADIUS - 0.04), (x, y, z + 0.10)], 0.015, n=10, up=(1, 0, 0))
        )
    ]
