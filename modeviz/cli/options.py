"""What commands share: the vehicle, rates, road and speed that were asked for."""

import json
from argparse import Namespace
from collections.abc import Iterator
from contextlib import contextmanager

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions
from modeviz.cli.terminal import progress, remark
from modeviz.errors import ModevizError, located
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.files.rate_settings import resolve_rates
from modeviz.report.records import Record
from modeviz.scatter.tolerance import Tolerance
from modeviz.study.conditions import has_ride, on_even_road, road_conditions
from modeviz.study.searching import chosen_problem as problem_called
from modeviz.units import parse
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


def vehicle_and_rates(options: Namespace) -> tuple[Vehicle, Rates]:
    """The vehicle with its own rates, and the rates chosen; says the notes on the vehicle."""
    vehicle = read_vehicle(options.vehicle or builtin_vehicle())
    for note in vehicle.notes:
        remark(note)
    return vehicle, resolve_rates(vehicle, options.rates, options.settings)


def conditions(options: Namespace, vehicle: Vehicle) -> Conditions:
    """The road and the speed chosen, or the vehicle's; raises as `road_conditions`."""
    return road_conditions(vehicle, options.road, chosen_speed(options, vehicle))


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
    return problem_called(vehicle, options.problem)


def chosen_tolerance(options: Namespace) -> Tolerance:
    """That of the parts, as far as it is given, or else the usual one; raises as `Tolerance`."""
    given = {"rates": options.tolerance, "loss_factor": options.loss_tolerance}
    return Tolerance(**{name: value for name, value in given.items() if value is not None})


def ride(options: Namespace, vehicle: Vehicle) -> Conditions | None:
    """As `conditions`; None for a vehicle that nothing shakes or feels, unless it is asked for."""
    asked = options.road is not None or options.speed is not None
    return conditions(options, vehicle) if asked or has_ride(vehicle) else None


def shown(options: Namespace, vehicle: Vehicle) -> tuple[Vehicle, Conditions]:
    """A vehicle that can be shown, and what it drives over: without a ride, an even road unfelt."""
    chosen = ride(options, vehicle)
    return on_even_road(vehicle) if chosen is None else (vehicle, chosen)


@contextmanager
def of_options() -> Iterator[None]:
    """Names what is wrong inside the block as an option is written: "--seed" for "seed".

    Raises:
        ModevizError: something inside raised one.
    """
    try:
        yield
    except ModevizError as error:
        raise ModevizError(f"--{error}") from None


def prepare_telling(vehicle: Vehicle) -> Prepared:
    """Prepares a vehicle and shows on a terminal how far that is."""
    return prepare(vehicle, progress=progress("preparing"))


def json_text(record: Record) -> str:
    """A record as it is printed."""
    return json.dumps(record, indent=1, ensure_ascii=False)
