"""What shakes the vehicle of a study: the road that was asked for, or the one it has."""

from collections.abc import Sized
from dataclasses import replace

import numpy as np

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError, VehicleError
from modeviz.ride.excitation import Load, known_part
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.loads import RandomLoad, ResponsePoint, Road
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

EVEN_HZ = np.array([1e-3, 1e3])
"""At which an even road is known: everywhere, at any speed."""


def road_conditions(vehicle: Vehicle, road: str | None, speed: float) -> Conditions:
    """Return a road, or the one that usually shakes the vehicle, and the speed on it.

    Args:
        vehicle: that is to be shaken.
        road: name of a road or another random load, or a class of ISO 8608, "ISO C"; None: the
            vehicle's first or, if it has none, the usual class.
        speed: m/s.

    Raises:
        ModevizError: there is no such road, or nothing to drive or to feel it with.
    """
    usual = vehicle.usual_load or next(iter(vehicle.random_loads), None)
    if usual is None:
        raise ModevizError(
            f"vehicle {vehicle.name!r} has no road: give its vehicle.toml a [[tyre]] with stiffness "
            "along z, which can be driven over roads of ISO 8608 at once, or another random load"
        )
    need(vehicle, "response point", vehicle.response_points)
    load = usual if road is None else vehicle.random_load(road)
    check_shaken(vehicle, load)
    known_part(load, vehicle.frequency_hz, speed)  # what is wrong there is better said before preparing
    return Conditions(load.name, speed)


def has_ride(vehicle: Vehicle) -> bool:
    """Return whether something shakes a vehicle at random, and somebody feels it."""
    return vehicle.usual_load is not None and bool(vehicle.response_points)


def on_even_road(vehicle: Vehicle) -> tuple[Vehicle, Conditions]:
    """Return a vehicle without a ride as one that can be shown: on an even road.

    What harmonic loads do to it is felt at its response points or, if it has none, at the centres of
    its rigid bodies. Of its problems those remain that need no road.
    """
    even = Road("no road", "No road", vehicle.speed, EVEN_HZ, np.zeros((len(EVEN_HZ), 2, 2), complex))
    points = (vehicle.response_points or _centers(vehicle)) if vehicle.swept_loads else ()
    still = replace(vehicle, roads=(even,), response_points=points, problems=())
    kept = tuple(problem for problem in vehicle.problems if _holds(still, problem))
    return replace(still, problems=kept), Conditions(even.name, still.speed)


def _centers(vehicle: Vehicle) -> tuple[ResponsePoint, ...]:
    """A response point at the centre of gravity of every rigid body."""
    bodies = (body for body in vehicle.bodies if isinstance(body, RigidBody))
    return tuple(
        ResponsePoint(f"{body.name} center of gravity", body.name, body.center_of_gravity)
        for body in bodies
    )


def _holds(vehicle: Vehicle, problem: Problem) -> bool:
    """Whether a vehicle has all that a problem names."""
    try:
        vehicle.check_problem(problem)
    except VehicleError:
        return False
    return not any(performance.roads for performance in problem.performance)


def chosen_load(vehicle: Vehicle, name: str | None) -> Load:
    """Return a load of a vehicle: a road or another random one, or a harmonic one.

    Args:
        vehicle: that is to be shaken.
        name: of the load, or a class of ISO 8608, "ISO C"; None: the random load that usually shakes
            it, else its first harmonic one.

    Raises:
        ModevizError: there is no such load, or it does not get into the vehicle.
    """
    every = (*vehicle.harmonic_loads, *vehicle.engine_orders)
    usual = vehicle.usual_load or next(iter(every), None)
    if name is None and usual is not None:
        return usual
    if name is None:
        raise ModevizError(
            f"vehicle {vehicle.name!r} has no load: give its vehicle.toml an [[engine]], a [[force]], "
            "a [[base_motion]] or a [[tyre]] with stiffness along z, which can be driven over roads of "
            "ISO 8608"
        )
    load = vehicle.load(name)
    if isinstance(load, Road):
        check_shaken(vehicle, load)
    return load


def check_shaken(vehicle: Vehicle, load: RandomLoad) -> None:
    """Raises ModevizError unless a load gets into a vehicle."""
    if not vehicle.is_shaken_by(load):
        raise ModevizError(
            f"road {load.name!r} does not shake vehicle {vehicle.name!r}: give its vehicle.toml a "
            "[[tyre]] with stiffness or damping along z"
        )


def need(vehicle: Vehicle, what: str, found: Sized) -> None:
    """Raises ModevizError unless the vehicle has some of what is asked for."""
    if not found:
        key = what.replace(" ", "_")
        raise ModevizError(f"vehicle {vehicle.name!r} has no {what}: give its vehicle.toml a [[{key}]]")
