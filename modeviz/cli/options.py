"""What commands share: the vehicle, rates, road and speed that were asked for."""

import json
from argparse import Namespace
from collections.abc import Sized
from dataclasses import replace
from pathlib import Path

import numpy as np

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions
from modeviz.cli.terminal import progress, remark
from modeviz.errors import ModevizError, located
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.files.problem_file import ENDING, read_problem
from modeviz.files.rate_settings import resolve_rates
from modeviz.report.records import Record
from modeviz.ride.excitation import known_part
from modeviz.scatter.tolerance import Tolerance
from modeviz.units import parse
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.default_problem import problems
from modeviz.vehicle.loads import Road
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

EVEN_HZ = np.array([1e-3, 1e3])
"""At which an even road is known: everywhere, at any speed."""


def vehicle_and_rates(options: Namespace) -> tuple[Vehicle, Rates]:
    """The vehicle with its own rates, and the rates chosen; says the notes on the vehicle."""
    vehicle = read_vehicle(options.vehicle or builtin_vehicle())
    for note in vehicle.notes:
        remark(note)
    return vehicle, resolve_rates(vehicle, options.rates, options.settings)


def conditions(options: Namespace, vehicle: Vehicle) -> Conditions:
    """The road and the speed chosen, or the vehicle's.

    Raises:
        ModevizError: there is no such road, or nothing to drive or to feel it with.
    """
    need(vehicle, "road", vehicle.random_loads)
    need(vehicle, "response point", vehicle.response_points)
    speed = chosen_speed(options, vehicle)
    shaking = [load.name for load in vehicle.random_loads if vehicle.is_shaken_by(load)]
    load = vehicle.random_load(options.road or (*shaking, vehicle.random_loads[0].name)[0])
    if not vehicle.is_shaken_by(load):
        raise ModevizError(
            f"road {load.name!r} does not shake vehicle {vehicle.name!r}: give its vehicle.toml a "
            "[[tyre]] with stiffness or damping along z"
        )
    known_part(
        load, vehicle.frequency_hz, speed
    )  # what is wrong there is better said before a preparation
    return Conditions(load.name, speed)


def chosen_speed(options: Namespace, vehicle: Vehicle) -> float:
    """The speed chosen, or the vehicle's, m/s.

    Raises:
        ModevizError: it is not a speed above zero.
    """
    if options.speed is None:
        return vehicle.speed
    with located("--speed"):
        speed = parse(options.speed, "speed")
        if speed <= 0:
            raise ModevizError(f"found {options.speed!r}, expected more than zero")
    return speed


def chosen_problem(options: Namespace, vehicle: Vehicle) -> Problem:
    """The problem of the vehicle or of the file that was named, or else the vehicle's usual one.

    Raises:
        VehicleError: there is none of that name, or not in that file, or nothing to make one of.
    """
    if options.problem is None:
        return problems(vehicle)[0]
    path = Path(options.problem)
    return read_problem(path, vehicle) if path.suffix == ENDING else vehicle.problem(options.problem)


def chosen_tolerance(options: Namespace) -> Tolerance:
    """That of the parts, as far as it is given, or else the usual one; raises as `Tolerance`."""
    given = {"rates": options.tolerance, "loss_factor": options.loss_tolerance}
    return Tolerance(**{name: value for name, value in given.items() if value is not None})


def ride(options: Namespace, vehicle: Vehicle) -> Conditions | None:
    """As `conditions`; None for a vehicle that nothing shakes or feels, unless it is asked for."""
    asked = options.road is not None or options.speed is not None
    if asked or (any(map(vehicle.is_shaken_by, vehicle.random_loads)) and vehicle.response_points):
        return conditions(options, vehicle)
    return None


def shown(options: Namespace, vehicle: Vehicle) -> tuple[Vehicle, Conditions]:
    """A vehicle that can be shown, and what it drives over: without a ride, an even road unfelt."""
    chosen = ride(options, vehicle)
    if chosen is not None:
        return vehicle, chosen
    even = Road("no road", "No road", vehicle.speed, EVEN_HZ, np.zeros((len(EVEN_HZ), 2, 2), complex))
    still = replace(vehicle, roads=(even,), response_points=(), problems=())
    return still, Conditions(even.name, still.speed)


def need(vehicle: Vehicle, what: str, found: Sized) -> None:
    """Raises ModevizError unless the vehicle has some of what a command shows."""
    if not found:
        key = what.replace(" ", "_")
        raise ModevizError(f"vehicle {vehicle.name!r} has no {what}: give its vehicle.toml a [[{key}]]")


def prepare_telling(vehicle: Vehicle) -> Prepared:
    """Prepares a vehicle and shows on a terminal how far that is."""
    return prepare(vehicle, progress=progress("preparing"))


def json_text(record: Record) -> str:
    """A record as it is printed."""
    return json.dumps(record, indent=1, ensure_ascii=False)
