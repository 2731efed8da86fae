"""Blocks on ground that moves."""

from dataclasses import replace

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import AXIS
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, MOTIONS, Bolt, Damper, Mount, Spring
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint, Spectrum
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

F = np.arange(1, 401) / 10
UP = np.array([0.0, 0.0, 1.0])
FLAT = Spectrum(np.array([0.01, 100.0]), np.array([2e-3, 2e-3]))
MASS, RATE, LOSS, DASHPOT = 50.0, 2e5, 0.1, 300.0


def shaken_block(*loads, rate=RATE):
    """A block on one mount and a dashpot to the ground, its seat above them."""
    block = RigidBody("block", "linkage", "block", MASS, np.zeros(3), np.eye(3))
    bounds = MountRates(1e3, 1e3, 1e3), MountRates(1e6, 1e6, 1e6)
    mount = Mount("mount", "M", ("block", GROUND), np.zeros((2, 3)))
    group = MountGroup("M", "mount", MountRates(rate, 1e5, 1e5), LOSS, bounds, (mount,))
    dashpot = Damper(
        "dashpot", "dampers", ("block", GROUND), np.zeros((2, 3)), damping=np.full(3, DASHPOT)
    )
    turned = Spring(
        "turns", "springs", ("block", GROUND), np.zeros((2, 3)), rotational_stiffness=np.full(3, 1e4)
    )
    return Vehicle(
        "block", (block,), (dashpot, turned), (group,),
        response_points=(ResponsePoint("seat", "block", np.zeros(3)),),
        forces=tuple(load for load in loads if isinstance(load, Force)),
        base_motions=tuple(load for load in loads if isinstance(load, BaseMotion)),
    )  # fmt: skip


def stiffness_of(rate, f):
    return rate * (1 + 1j * LOSS) + 2j * np.pi * f * DASHPOT


def vertical_peaks(vehicle, rates=None):
    """Peak accelerations of the seat, m/s², (n_freqs, n_loads)."""
    found = solve_wheels(prepare(vehicle), rates or {})
    return found.acceleration_g[:, :, 0, AXIS["vertical"]] * STANDARD_GRAVITY


def softer(rate):
    return {"M": MountRates(rate, 1e5, 1e5)}


def shaken_cabin():
    """The cabin with mounts to the ground, too, which is shaken along a slanted axis."""
    cabin = mounted_cabin()
    group, *others = cabin.mount_groups
    body = cabin.bodies[0]
    place = body.center_of_gravity + np.array([0.2, -0.1, -0.3])
    axes = np.array([[0.8, 0.6, 0.0], [-0.6, 0.8, 0.0], [0.0, 0.0, 1.0]])
    grounded = Mount("grounded", group.name, (body.name, GROUND), np.tile(place, (2, 1)), axes=axes,
                     damping=np.array([40.0, 50.0, 60.0]))  # fmt: skip
    direction = np.array([0.3, -0.5, 0.8])
    return replace(
        cabin,
        mount_groups=(replace(group, mounts=(*group.mounts, grounded)), *others),
        base_motions=(
            BaseMotion("random floor", direction, "acceleration", FLAT),
            BaseMotion("floor", direction, "displacement", 1e-3),
        ),
        forces=(Force("fan", body.name, place, direction, 20.0),),
    )


def changed(vehicle):
    factors = 0.4, 2.5
    return {
        g.name: MountRates(*(x * k for k in g.rates.as_tuple()))
        for g, x in zip(vehicle.mount_groups, factors, strict=False)
    }


Z = 1e-3
SHAKER = BaseMotion("shaker", UP, "displacement", Z)


def on_table(vehicle, *names):
    """The vehicle with connections to the ground, all if none is named, on a table bolted to it."""
    table = RigidBody("table", "linkage", "table", 200.0, np.array([0.0, 0.0, -0.5]), 9 * np.eye(3))
    bolt = Bolt("bolt", "bolts", ("table", GROUND), np.zeros((2, 3)), rigid=MOTIONS)

    def moved(connection):
        if connection.bodies[1] != GROUND or (names and connection.name not in names):
            return connection
        return replace(connection, bodies=(connection.bodies[0], "table"))

    return replace(
        vehicle,
        bodies=(*vehicle.bodies, table),
        connections=(*map(moved, vehicle.connections), bolt),
        mount_groups=tuple(
            replace(g, mounts=tuple(map(moved, g.mounts))) for g in vehicle.mount_groups
        ),
        response_points=(
            *vehicle.response_points,
            ResponsePoint("on table", "table", np.array([0.3, 0.2, -0.1])),
        ),
    )


def cabin_on_table():
    """The cabin of which a mount stands on a table; its tyres stand on the ground."""
    return on_table(shaken_cabin(), "grounded")


def bolted_twice():
    """The table with a second bolt, though one would do."""
    vehicle = on_table(shaken_block(SHAKER))
    again = replace(vehicle.connections[-1], name="again", points=np.full((2, 3), 0.2))
    return replace(vehicle, connections=(*vehicle.connections, again))


def bolted_apart():
    """The same, but only one of the bolts is moved."""
    return replace(bolted_twice(), base_motions=(replace(SHAKER, connections=("bolt",)),))
