"""What an absorber is made of: a rigid body, a mount group and a joint, as any vehicle may have.

Its rates are tuned as those of all mounts are; the joint leaves it the directions in which it moves and
no others.
"""

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from functools import partial
from typing import Any

import numpy as np

from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorber_names import guide_name
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import MOTIONS, Mount, Spring
from modeviz.vehicle.local_axes import angles_of_axes
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DAMPING_FIELDS, DIRECTIONS, STIFFNESS_FIELDS, MountRates
from modeviz.vehicle.vehicle import Vehicle

STEEL = 7850.0
"""kg/m³: an absorber is a cube of it, which tells how large it is and how hard to turn."""

ROUNDING = 1e-9
"""Of the largest number in an array: parts that differ by no more are those of one absorber."""

GUIDES = "absorber guides"
"""The group of the joints that guide absorbers."""


def absorber_mass(absorber: Absorber) -> RigidBody:
    """Return the mass of an absorber: a cube of steel, whose moments of inertia are m a²/6."""
    edge = np.cbrt(absorber.mass / STEEL)
    return RigidBody(
        absorber.body_name,
        "absorber",
        absorber.name,
        absorber.mass,
        np.array(absorber.position),
        absorber.mass * edge**2 / 6 * np.eye(3),
    )


def absorber_spring(absorber: Absorber) -> MountGroup:
    """Return the spring of an absorber as a group of one mount; it sags as it vibrates, by m g/k."""
    softest, stiffest = map(partial(_along, absorber), absorber.tuned_hz, absorber.tuned_damping_ratio)
    rates = _along(absorber, absorber.frequency_hz, absorber.damping_ratio)
    return MountGroup(
        absorber.name,
        absorber.name,
        rates,
        absorber.loss_factor,
        (softest, stiffest),
        (Mount(absorber.name, absorber.name, _ends(absorber), _points(absorber), axes=absorber.axes),),
        static_ratio=1.0,
    )


def absorber_guide(absorber: Absorber) -> Spring:
    """Return the joint that holds all of an absorber's motions but those along its directions."""
    free = {MOTIONS[2 - DIRECTIONS.index(direction)] for direction in absorber.directions}
    return Spring(
        absorber.guide_name,
        GUIDES,
        _ends(absorber),
        _points(absorber),
        axes=absorber.axes,
        rigid=tuple(motion for motion in MOTIONS if motion not in free),
    )


def _along(absorber: Absorber, frequency_hz: float, damping_ratio: float) -> MountRates:
    """The rates with which it has a frequency and damping along its directions; none along others."""
    along = np.array([direction in absorber.directions for direction in DIRECTIONS])
    stiffness = absorber.stiffness_at(frequency_hz) * along
    damping = absorber.damping_with(damping_ratio) * along
    return MountRates(
        **dict(zip(STIFFNESS_FIELDS, stiffness.tolist(), strict=True)),
        **dict(zip(DAMPING_FIELDS, damping.tolist(), strict=True)),
    )


def _ends(absorber: Absorber) -> tuple[str, str]:
    return absorber.body_name, absorber.body


def _points(absorber: Absorber) -> Floats:
    return np.tile(absorber.position, (2, 1))


def absorbers_of(vehicle: Vehicle) -> tuple[Absorber, ...]:
    """Return the absorbers among a vehicle's parts, in the order of their mount groups.

    What lacks one of the parts, or has another spring along each direction, is none.
    """
    found = (_with_spring(vehicle, group) for group in vehicle.mount_groups)
    return tuple(absorber for absorber in found if absorber is not None)


def _with_spring(vehicle: Vehicle, group: MountGroup) -> Absorber | None:
    """The absorber whose spring a mount group is; None if it is of none."""
    mount = group.mounts[0]
    mass = vehicle.body(mount.bodies[0])
    guide = next((c for c in vehicle.connections if c.name == guide_name(group.name)), None)
    k = max(group.rates.as_tuple())
    if not (isinstance(mass, RigidBody) and mass.role == "absorber" and guide and k):
        return None
    every = group.bounds[0], group.rates, group.bounds[1]
    low, frequency, high = (
        float(np.sqrt(max(rates.as_tuple()) / mass.mass) / (2 * np.pi)) for rates in every
    )
    softest, damping, stiffest = (
        max(rates.damping()) / (2 * float(np.sqrt(k * mass.mass))) for rates in every
    )
    x, y, z = mount.center.tolist()
    about_x, about_y, about_z = angles_of_axes(mount.axes).tolist()
    absorber = Absorber(
        group.name,
        mount.bodies[1],
        (x, y, z),
        mass.mass,
        frequency,
        damping,
        group.loss_factor,
        tuple(d for d in DIRECTIONS if MOTIONS[2 - DIRECTIONS.index(d)] not in guide.rigid),
        (about_x, about_y, about_z),
        frequency_range=(low, high),
        damping_range=(softest, stiffest),
    )
    own = absorber_mass(absorber), absorber_spring(absorber), absorber_guide(absorber)
    return absorber if _alike(own, (mass, group, guide)) else None


def _alike(one: Any, other: Any) -> bool:
    """Whether two values are the same but for rounding, with all that is in them."""
    if is_dataclass(one):
        names = (field.name for field in fields(one))
        return type(one) is type(other) and all(
            _alike(getattr(one, n), getattr(other, n)) for n in names
        )
    if isinstance(one, Mapping):
        return one.keys() == other.keys() and all(_alike(one[key], other[key]) for key in one)
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(_alike, one, other))
    if isinstance(one, float | np.ndarray):
        if np.shape(one) != np.shape(other):
            return False
        return bool(np.all(np.abs(one - other) <= ROUNDING * np.abs(other).max(initial=0.0)))
    return one == other
