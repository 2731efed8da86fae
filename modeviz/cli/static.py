"""The command that prints sag, static forces and travel."""

from argparse import ArgumentParser
from dataclasses import dataclass

from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, VehicleOptions, add_json, add_vehicle
from modeviz.cli.results import check_printable, print_result
from modeviz.dynamics.assembly import assemble
from modeviz.errors import of_file
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.report.statics import statics_record, statics_table


@dataclass(frozen=True, kw_only=True)
class StaticOptions(VehicleOptions, JsonOptions):
    """What `modeviz static` is asked for."""

    cases: tuple[str, ...] = ()
    """Names of load cases; none are all."""


def print_static(options: StaticOptions) -> None:
    """Prints motions of bodies, forces, deflections and travel of mounts under loads that stay."""
    check_printable()
    vehicle, rates = options.read()
    with of_file(vehicle.file):
        statics = solve_statics(prepare_statics(assemble(vehicle)), rates)
    chosen = statics.chosen(options.cases)
    print_result((statics_record if options.json else statics_table)(chosen), options.placements)


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "--case",
        action="append",
        metavar="NAME",
        dest="cases",
        help="a load case; may be repeated (default: all)",
    )
    add_json(command)


STATIC = Command(
    "static",
    "sag under gravity and other load cases, static forces, deflections and travel of mounts",
    StaticOptions,
    _add_options,
    print_static,
)
