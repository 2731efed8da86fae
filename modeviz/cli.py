"""The command line: `modeviz [view|modes|psd|wheels] [VEHICLE]`."""

import argparse
import json
import math
import os
import sys
from collections.abc import Callable, Sequence, Sized
from importlib.metadata import version
from pathlib import Path
from typing import get_args

from modeviz.dynamics.band import Method
from modeviz.dynamics.basis import TOP_HZ
from modeviz.errors import ModevizError, located
from modeviz.export.records import Record, modes_record, psd_record, wheels_record
from modeviz.export.tables import modes_table, psd_table, wheels_table
from modeviz.ride.roads import road_spectrum
from modeviz.tuning.following import solve_followed
from modeviz.tuning.preparation import FREQUENCY_HZ, Prepared, prepare, prepare_modes
from modeviz.tuning.rates import resolve_rates
from modeviz.tuning.results import Conditions, solve, solve_wheels
from modeviz.units import parse
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.files import builtin_vehicle, read_vehicle
from modeviz.vehicle.vehicle import Vehicle

DEFAULT_PORT = 8080
COMMANDS = ("view", "modes", "psd", "wheels")


def main(arguments: Sequence[str] | None = None) -> int:
    """Runs a command and returns its exit status: 0, or 2 for what the user can put right."""
    arguments = list(sys.argv[1:] if arguments is None else arguments)
    parser = _parser()
    if not arguments or (arguments[0] not in (*COMMANDS, "-h", "--help", "--version")):
        arguments = ["view", *arguments]
    options = parser.parse_args(arguments)
    try:
        options.run(options)
        sys.stdout.flush()
    except ModevizError as error:
        print(f"modeviz: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # Whoever reads, such as `head`, has enough; Python would fail again when it flushes at its end.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except KeyboardInterrupt:
        return 130
    return 0


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="modeviz",
        description="Modes, ride and mount tuning of a vehicle. Without a command: view.",
    )
    parser.add_argument("--version", action="version", version=f"modeviz {version('modeviz')}")
    commands = parser.add_subparsers(required=True, metavar="COMMAND")

    view = _command(commands, "view", _view, "open the vehicle in the browser")
    _add_road(view)
    view.add_argument(
        "--host", default="127.0.0.1", help="address to listen on (default: this machine)"
    )
    view.add_argument("--port", type=int, default=DEFAULT_PORT, help=f"default {DEFAULT_PORT}")
    view.add_argument("--token", help="asked of every visitor; needed when --host is not this machine")
    view.add_argument("--dark", action="store_true", help="dark page")

    modes = _command(commands, "modes", _modes, "frequencies, damping, names and energies")
    modes.add_argument("--below", type=float, default=25.0, metavar="HZ", help="default 25")
    modes.add_argument(
        "--method",
        choices=get_args(Method),
        default="enriched",
        help="enriched (default), classic: the paper's equation on the original modes, or exact",
    )
    _add_json(modes)

    psd = _command(commands, "psd", _psd, "accelerations on a road and their rating")
    _add_road(psd)
    _add_json(psd)

    _add_json(_command(commands, "wheels", _wheels, "response to unbalance and tyre force variation"))
    return parser


def _command(commands, name: str, run, help_text: str) -> argparse.ArgumentParser:
    command = commands.add_parser(name, help=help_text, description=help_text.capitalize() + ".")
    command.set_defaults(run=run)
    command.add_argument(
        "vehicle", nargs="?", type=Path, metavar="VEHICLE", help="vehicle folder (default: the pickup)"
    )
    command.add_argument(
        "--rates",
        default="original",
        metavar="NAME|FILE",
        help="a set of the vehicle's, such as original or optimised, or a JSON or CSV file",
    )
    command.add_argument(
        "--set",
        action="append",
        default=[],
        metavar="RATE",
        dest="settings",
        help='one rate, such as "C2.lateral=131 N/mm"; may be repeated',
    )
    return command


def _add_road(command: argparse.ArgumentParser) -> None:
    command.add_argument("--road", help="default: the vehicle's first")
    command.add_argument("--speed", metavar="SPEED", help='such as "88 km/h" (default: the vehicle\'s)')


def _add_json(command: argparse.ArgumentParser) -> None:
    command.add_argument("--json", action="store_true", help="print JSON instead of a table")


def _vehicle_and_rates(options: argparse.Namespace) -> tuple[Vehicle, Rates]:
    """The vehicle with its own rates, and the rates chosen."""
    vehicle = read_vehicle(options.vehicle or builtin_vehicle())
    return vehicle, resolve_rates(vehicle, options.rates, options.settings).rates


def _prepare(vehicle: Vehicle) -> Prepared:
    """Prepares a vehicle and shows on a terminal how far that is."""
    return prepare(vehicle, progress=_progress())


def _progress() -> Callable[[float], None] | None:
    """Shows on a terminal how far the preparation is; nothing where errors go to a file."""
    return _tell_progress if sys.stderr.isatty() else None


def _tell_progress(done: float) -> None:
    text = f"\rpreparing {done:4.0%}" if done < 1 else "\r\x1b[K"
    print(end=text, file=sys.stderr, flush=True)


def _conditions(options: argparse.Namespace, vehicle: Vehicle) -> Conditions:
    _need(vehicle, "road", vehicle.roads)
    _need(vehicle, "response point", vehicle.response_points)
    speed = vehicle.speed if options.speed is None else _speed(options.speed)
    road = vehicle.road(options.road or vehicle.roads[0].name)
    road_spectrum(road, FREQUENCY_HZ, speed)  # what is wrong there is better said before a preparation
    return Conditions(road.name, speed)


def _speed(text: str) -> float:
    with located("--speed"):
        speed = parse(text, "speed")
        if speed <= 0:
            raise ModevizError(f"found {text!r}, expected more than zero")
    return speed


def _need(vehicle: Vehicle, what: str, found: Sized) -> None:
    """Raises ModevizError unless the vehicle has some of what a command shows."""
    if not found:
        key = what.replace(" ", "_")
        raise ModevizError(f"vehicle {vehicle.name!r} has no {what}: give its vehicle.toml a [[{key}]]")


def _modes(options: argparse.Namespace) -> None:
    if not (options.below > 0 and math.isfinite(options.below)):
        raise ModevizError(f"--below: found {options.below:g} Hz, expected more than zero")
    vehicle, rates = _vehicle_and_rates(options)
    prepared = prepare_modes(vehicle, max(options.below, TOP_HZ))
    followed = solve_followed(prepared, rates, options.method)
    if options.json:
        _print_json(modes_record(followed, options.below))
    else:
        print(modes_table(followed, options.below))


def _psd(options: argparse.Namespace) -> None:
    vehicle, rates = _vehicle_and_rates(options)
    conditions = _conditions(options, vehicle)
    results = solve(_prepare(vehicle), rates, conditions)
    if options.json:
        _print_json(psd_record(results))
    else:
        print(psd_table(results))


def _wheels(options: argparse.Namespace) -> None:
    vehicle, rates = _vehicle_and_rates(options)
    _need(vehicle, "response point", vehicle.response_points)
    _need(vehicle, "wheel load", vehicle.wheel_loads)
    results = solve_wheels(_prepare(vehicle), rates)
    tuned = vehicle.with_rates(rates)
    if options.json:
        _print_json(wheels_record(tuned, results))
    else:
        print(wheels_table(tuned, results))


def _view(options: argparse.Namespace) -> None:
    from modeviz.viewer.app import serve

    vehicle, start = _vehicle_and_rates(options)
    serve(
        vehicle,
        start,
        _conditions(options, vehicle),
        options.host,
        options.port,
        options.token,
        options.dark,
        _progress(),
    )


def _print_json(record: Record) -> None:
    print(json.dumps(record, indent=1, ensure_ascii=False))
