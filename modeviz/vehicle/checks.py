"""What a vehicle checks of itself as a whole: names, places, and that what is named is there."""

from typing import TYPE_CHECKING

import numpy as np

from modeviz.errors import Fault, FaultsError, PartError, VehicleError, check_unique, of_part, unknown
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import GROUND, Bolt, Connection, Damper, Mount, Rod, Spring, Tyre
from modeviz.vehicle.load_cases import LoadCase
from modeviz.vehicle.loads import BaseMotion
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import UNFELT, Problem

if TYPE_CHECKING:
    from modeviz.vehicle.vehicle import Vehicle

REACH = 0.10
"""m: how far from an attachment of a flexible body a connection may hold on to it."""

FARTHEST = 20.0
"""m: hardly a vehicle is farther from its origin."""

FEWEST_LINES, MOST_LINES = 10, 5000
"""Of a band: each is a solution of the vehicle's equations, kept in memory."""

WHOLE = 1e-9
"""Relative: a number of steps this close to a whole one is whole."""


def check_vehicle(vehicle: "Vehicle") -> None:
    """Raises VehicleError unless all of a vehicle fits together."""
    if not vehicle.bodies:
        raise VehicleError(f"vehicle {vehicle.name!r} has no bodies")
    if not (np.isfinite(vehicle.speed) and vehicle.speed > 0):
        raise FaultsError(Fault("speed", f"found {vehicle.speed} m/s, expected more than 0"))
    _check_band(vehicle)
    _check_names(vehicle)
    for connection in vehicle.all_connections:
        with of_part("connection", connection.name):
            _check_ends(vehicle, connection)
    for kind, things in (
        ("added mass", vehicle.added_masses),
        ("response point", vehicle.response_points),
        ("force", vehicle.forces),
        ("engine", vehicle.engines),
    ):
        for thing in things:
            with of_part(kind, thing.name):
                _check_place(vehicle, thing.body, thing.position)
    for case in vehicle.load_cases:
        with of_part("load case", case.name):
            _check_load_case(vehicle, case)
    check_unique("mode damping of", (damping.name for damping in vehicle.mode_damping))
    _check_references(vehicle)


def check_problem(vehicle: "Vehicle", problem: Problem) -> None:
    """Raises VehicleError unless all that a problem names is there."""
    for group in problem.groups:
        vehicle.mount_group(group.group)
    points = [point.name for point in vehicle.response_points]
    if problem.goal not in UNFELT and not points:
        raise VehicleError(f"goal {problem.goal!r} needs a [[response_point]]")
    if problem.goal == "idle" and not vehicle.engines:
        raise VehicleError("goal 'idle' needs an [[engine]]")
    for performance in problem.performance:
        for road in performance.roads:
            if not vehicle.is_shaken_by(vehicle.random_load(road)):
                raise VehicleError(
                    f"road {road!r} shakes nothing; expected a [[tyre]] with stiffness or damping "
                    "along z"
                )
        for load in performance.wheel_loads:
            vehicle.harmonic_load(load)
        for point in performance.points:
            if point not in points:
                raise VehicleError(unknown("response point", point, points))
    for target in problem.mounts:
        _check_mount_target(vehicle, target)
    for decoupled in problem.decoupling:
        vehicle.body(decoupled.body)
    mounts, cases = ([x.name for x in every] for every in (vehicle.mounts, vehicle.static_cases))
    for limit in problem.deflections:
        if limit.mount not in mounts:
            raise VehicleError(unknown("mount", limit.mount, mounts))
        if limit.load_case not in cases:
            raise VehicleError(unknown("load case", limit.load_case, cases))
    if problem.reference and problem.reference not in vehicle.rate_sets:
        raise VehicleError(unknown("set of rates", problem.reference, vehicle.rate_sets))


def _check_mount_target(vehicle: "Vehicle", target: MountTarget) -> None:
    """Raises VehicleError unless the mounts and loads are there."""
    names = [mount.name for mount in vehicle.mounts]
    for mount in target.mounts:
        if mount not in names:
            raise VehicleError(unknown("mount", mount, names))
    for load in target.loads:
        vehicle.load(load)


def _check_band(vehicle: "Vehicle") -> None:
    for key in ("highest_frequency", "frequency_step"):
        value = getattr(vehicle, key)
        if not (np.isfinite(value) and value > 0):
            raise FaultsError(Fault(key, f"found {value} Hz, expected more than 0"))
    count = vehicle.highest_frequency / vehicle.frequency_step
    if abs(count - round(count)) > WHOLE * count:
        words = (
            f"found {vehicle.highest_frequency:g} Hz, expected a whole multiple of frequency_step, "
            f"{vehicle.frequency_step:g} Hz"
        )
        raise FaultsError(Fault("highest_frequency", words))
    if not FEWEST_LINES <= round(count) <= MOST_LINES:
        words = (
            f"found {vehicle.frequency_step:g} Hz for {vehicle.highest_frequency:g} Hz, which makes "
            f"{round(count)} lines; expected {FEWEST_LINES} to {MOST_LINES}"
        )
        raise FaultsError(Fault("frequency_step", words))


def _check_names(vehicle: "Vehicle") -> None:
    for kind, items in (
        ("body", vehicle.bodies),
        ("connection", vehicle.all_connections),
        ("mount group", vehicle.mount_groups),
        ("added mass", vehicle.added_masses),
        ("response point", vehicle.response_points),
        ("random load", vehicle.random_loads),
        ("engine", vehicle.engines),
        ("harmonic load", (*vehicle.harmonic_loads, *vehicle.engine_orders)),
        ("problem", vehicle.problems),
        ("load case", vehicle.load_cases),
    ):
        check_unique(kind, (item.name for item in items))
    if GROUND in (body.name for body in vehicle.bodies):
        raise PartError("body", GROUND, ": that name means what does not move; take another")
    for connection in vehicle.all_connections:
        if connection.group in (body.name for body in vehicle.bodies):
            words = f": group {connection.group!r} is the name of a body; their energies are "
            words += "reported side by side, so take another"
            raise PartError("connection", connection.name, words)


def _check_references(vehicle: "Vehicle") -> None:
    """Raises VehicleError unless every tyre and mount group that is named exists."""
    tyres = [t.name for t in vehicle.tyres]
    for load in vehicle.wheel_loads:
        if load.tyre not in tyres:
            raise PartError("wheel load", load.name, ": " + unknown("tyre", load.tyre, tyres))
    for motion in vehicle.base_motions:
        with of_part("base motion", motion.name):
            _check_base_motion(vehicle, motion)
    for name, rates in vehicle.rate_sets.items():
        for group in rates:
            if group not in vehicle.rates:
                raise PartError("rates", name, ": " + unknown("mount group", group, vehicle.rates))
    for problem in vehicle.problems:
        with of_part("problem", problem.name):
            vehicle.check_problem(problem)


def _check_base_motion(vehicle: "Vehicle", motion: BaseMotion) -> None:
    """Raises VehicleError unless what it moves holds on to the ground."""
    grounded = [c.name for c in vehicle.all_connections if c.bodies[1] == GROUND]
    for name in motion.connections:
        if name not in grounded:
            raise VehicleError(unknown("connection to the ground", name, grounded))
    if not vehicle.moved_connections(motion):
        raise VehicleError("nothing is connected to the ground, so nothing moves")


def _check_load_case(vehicle: "Vehicle", case: LoadCase) -> None:
    """Raises VehicleError unless every body it presses on is there, and can be where it does."""
    for load in case.loads:
        vehicle.body(load.body)
        if load.position is not None:
            _check_place(vehicle, load.body, load.position)


def _check_ends(vehicle: "Vehicle", connection: Connection) -> None:
    if not isinstance(connection, Mount | Spring | Rod | Bolt | Damper | Tyre):
        raise VehicleError("expected a Spring, Rod, Bolt, Damper or Tyre")
    if connection.rigid and not isinstance(connection, Spring | Rod | Bolt | Mount):
        raise VehicleError("only a spring, a rod or a bolt can be rigid")
    if connection.bodies[0] == GROUND:
        raise VehicleError(f"{GROUND!r} must be the second of its bodies")
    for body, point in zip(connection.bodies, connection.points, strict=True):
        if body != GROUND:
            _check_place(vehicle, body, point)


def _check_place(vehicle: "Vehicle", body_name: str, position: Floats) -> None:
    """Raises VehicleError unless the body is there and something can hang on it at `position`."""
    body = vehicle.body(body_name)
    if not isinstance(body, FlexibleBody):
        return
    nearest = body.nearest_attachment(position)
    distance = np.linalg.norm(nearest.position - position)
    if distance > REACH:
        raise VehicleError(
            f"{position.tolist()} is {distance:.2f} m from the nearest attachment of "
            f"{body_name!r}, {nearest.name!r}; at most {REACH} m is allowed"
            f"{_in_other_units(body, position)}"
        )


def _in_other_units(body: FlexibleBody, position: Floats) -> str:
    """Words for a place that would be near an attachment in mm where it is in m, or the reverse."""
    is_far = np.abs(position).max() > FARTHEST
    scale, meant, found = (1e-3, "mm", "m") if is_far else (1e3, "m", "mm")
    moved = scale * position
    if np.linalg.norm(body.nearest_attachment(moved).position - moved) > REACH:
        return ""
    return f"; it would fit if its numbers were in {meant} and not in {found}: see length in [units]"
