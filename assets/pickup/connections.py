"""What joins the bodies besides the tuned mounts: bolts, suspension, steering, driveline, tyres."""

from collections.abc import Sequence

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND, Bolt, Connection, Damper, Rod, Spring, Tyre
from pickup import box
from pickup.parameters import WHEELBASE, Parameters
from pickup.sides import SIDES, Place, Side, on_side

HALF_TRACK = 0.80
WHEEL_RADIUS = 0.355
"""m: loaded tyre."""
PATCH_HEIGHT = 0.02

FRONT_END_BOLTS = {
    "fender top": (0.50, 0.93, 1.14),
    "cowl": (0.49, 0.66, 1.155),
    "toe": (0.51, 0.64, 0.78),
    "fender foot": (0.60, 0.90, 0.54),
}
LOWER_BUSHES = {"front": (-0.14, 0.34, 0.36), "rear": (0.16, 0.34, 0.36)}
UPPER_BUSHES = {"front": (-0.10, 0.46, 0.63), "rear": (0.16, 0.46, 0.63)}
LOWER_BALL_JOINT = (0.00, 0.76, 0.24)
UPPER_BALL_JOINT = (0.02, 0.70, 0.56)
COIL = (0.00, 0.56, 0.50)
FRONT_DAMPER = (0.02, 0.60, 0.42)
REAR_DAMPER = (WHEELBASE + 0.05, 0.45, 0.50)
TIE_ROD_ENDS = ((-0.16, 0.70, 0.38), (-0.16, 0.30, 0.40))
RELAY_ROD = (-0.16, 0.30, 0.42)
FRONT_JOINT = (1.25, 0.0, 0.48)
REAR_JOINT = (2.72, 0.0, 0.37)


def connections(p: Parameters) -> tuple[Connection, ...]:
    """Every connection that is not tuned."""
    sided = (part for side in SIDES for part in _one_side(p, side))
    return (*sided, *_driveline())


def _one_side(p: Parameters, side: Side) -> Sequence[Connection]:
    return [
        *_body_joints(p, side),
        *_front_suspension(p, side),
        *_steering(p, side),
        *_rear_suspension(p, side),
        *_tyres(p, side),
    ]


def _body_joints(p: Parameters, side: Side) -> Sequence[Connection]:
    bolts = [
        Bolt(
            f"{name} bolt {side}",
            "bolts",
            ("front end", "cab"),
            _same(place, side),
            stiffness=_xyz(p.bolt_rate, p.bolt_rate, p.bolt_rate),
            loss_factor=0.03,
        )
        for name, place in FRONT_END_BOLTS.items()
    ]
    box_mounts = [
        Spring(
            f"box mount {number} {side}",
            "box mounts",
            ("box", "frame"),
            _same(place, side),
            stiffness=_xyz(p.box_mount_rate, p.box_mount_rate, 1.5 * p.box_mount_rate),
            loss_factor=0.06,
        )
        for number, place in enumerate(box.BRACKETS, start=1)
    ]
    return [*bolts, *box_mounts]


def _front_suspension(p: Parameters, side: Side) -> Sequence[Connection]:
    lower, upper, knuckle = f"lower arm {side}", f"upper arm {side}", f"knuckle {side}"
    lower_rates = p.bush_rate * _xyz(0.5, 1.0, 1.0)
    upper_rates = p.bush_rate * _xyz(0.4, 0.7, 0.7)
    return [
        *(
            _bush(f"lower {end} bush {side}", lower, _same(place, side), lower_rates, 60.0)
            for end, place in LOWER_BUSHES.items()
        ),
        *(
            _bush(f"upper {end} bush {side}", upper, _same(place, side), upper_rates, 40.0)
            for end, place in UPPER_BUSHES.items()
        ),
        _ball_joint(f"lower ball joint {side}", (lower, knuckle), _same(LOWER_BALL_JOINT, side)),
        _ball_joint(f"upper ball joint {side}", (upper, knuckle), _same(UPPER_BALL_JOINT, side)),
        Spring(
            f"coil {side}", "springs", (lower, "frame"), _same(COIL, side), _xyz(0.0, 0.0, p.coil_rate)
        ),
        Damper(
            f"front damper {side}",
            "dampers",
            (lower, "frame"),
            _same(FRONT_DAMPER, side),
            damping=_xyz(0.0, 0.0, p.front_damping),
        ),
    ]


def _steering(p: Parameters, side: Side) -> Sequence[Connection]:
    """The pitman arm on the left holds the relay rod better sideways than the right's idler arm."""
    asymmetry = p.relay_rod_asymmetry if side == "left" else -p.relay_rod_asymmetry
    return [
        Rod.between(
            f"tie rod {side}",
            "steering",
            (f"knuckle {side}", "steering linkage"),
            np.array([on_side(end, side) for end in TIE_ROD_ENDS]),
            stiffness=1.2e7,
        ),
        Spring(
            f"relay rod {side}",
            "steering",
            ("steering linkage", "frame"),
            _same(RELAY_ROD, side),
            stiffness=_xyz(3e6, p.relay_rod_rate * (1 + asymmetry), 3e6),
            rotational_stiffness=_xyz(50.0, 50.0, 50.0),
        ),
    ]


def _rear_suspension(p: Parameters, side: Side) -> Sequence[Connection]:
    """A leaf spring is two half springs, hinged at the front eye and free to swing at the shackle."""
    bodies = ("rear axle", "frame")
    return [
        Spring(
            f"leaf eye {side}",
            "springs",
            bodies,
            _same(p.leaf_eye, side),
            stiffness=_xyz(p.leaf_fore_aft_rate, p.leaf_lateral_rate, p.half_leaf_rate),
            loss_factor=0.03,
        ),
        Spring(
            f"leaf shackle {side}",
            "springs",
            bodies,
            _same(p.leaf_shackle, side),
            stiffness=_xyz(0.0, p.leaf_lateral_rate, p.half_leaf_rate),
            loss_factor=0.03,
        ),
        Damper(
            f"rear damper {side}",
            "dampers",
            bodies,
            _same(REAR_DAMPER, side),
            damping=_xyz(0.0, 0.0, p.rear_damping),
        ),
    ]


def _tyres(p: Parameters, side: Side) -> Sequence[Connection]:
    front = _xyz(p.tyre_fore_aft_rate, p.front_tyre_lateral_rate, p.front_tyre_vertical_rate)
    rear = _xyz(p.tyre_fore_aft_rate, p.rear_tyre_lateral_rate, p.rear_tyre_vertical_rate)
    return [
        _tyre(f"front {side}", f"knuckle {side}", 0.0, side, front, p.tyre_trail),
        _tyre(f"rear {side}", "rear axle", WHEELBASE, side, rear, p.tyre_trail),
    ]


def _driveline() -> Sequence[Connection]:
    """Universal joints; the splined shaft slides, so they hold little fore-aft."""
    return [
        Spring(
            f"{name} universal joint",
            "driveline",
            ("propshaft", other),
            np.array([place, place]),
            stiffness=_xyz(2e5, 5e6, 5e6),
        )
        for name, other, place in (
            ("front", "engine", FRONT_JOINT),
            ("rear", "rear axle", REAR_JOINT),
        )
    ]


def _xyz(x: float, y: float, z: float) -> Floats:
    return np.array([x, y, z])


def _same(place: Place, side: Side) -> Floats:
    """Both ends of a connection at one place."""
    return np.tile(on_side(place, side), (2, 1))


def _bush(name: str, arm: str, points: Floats, stiffness: Floats, rotational: float) -> Spring:
    return Spring(
        name,
        "bushes",
        (arm, "frame"),
        points,
        stiffness=stiffness,
        rotational_stiffness=rotational * np.ones(3),
        loss_factor=0.08,
    )


def _ball_joint(name: str, bodies: tuple[str, str], points: Floats) -> Spring:
    return Spring(name, "ball joints", bodies, points, stiffness=_xyz(3e7, 3e7, 3e7))


def _tyre(name: str, body: str, x: float, side: Side, stiffness: Floats, trail: float) -> Tyre:
    return Tyre(
        name,
        "tyres",
        (body, GROUND),
        _same((x, HALF_TRACK, PATCH_HEIGHT), side),
        stiffness=stiffness,
        damping=_xyz(60.0, 60.0, 60.0),
        loss_factor=0.04,
        wheel_center=on_side((x, HALF_TRACK, WHEEL_RADIUS), side),
        trail=trail,
    )
