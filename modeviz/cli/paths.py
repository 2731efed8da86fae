"""The command that prints what of a response comes through which mount."""

from argparse import ArgumentParser
from dataclasses import dataclass
from typing import get_args

from modeviz.cli.command import Command
from modeviz.cli.options import (
    JsonOptions,
    LoadOptions,
    VehicleOptions,
    add_json,
    add_load,
    add_vehicle,
)
from modeviz.cli.results import check_printable, print_result
from modeviz.mounting.paths import By
from modeviz.report.paths import paths_record, paths_table
from modeviz.study.paths import point_paths
from modeviz.vehicle.mount_rates import DIRECTIONS


@dataclass(frozen=True, kw_only=True)
class PathsOptions(VehicleOptions, LoadOptions, JsonOptions):
    """What `modeviz paths` is asked for."""

    point: str | None = None
    """Name of a response point; None: the driver's."""
    direction: str = "vertical"
    by: By = "mount"


def print_paths(options: PathsOptions) -> None:
    """Prints the share of each path in a response."""
    check_printable()
    vehicle, rates = options.read()
    paths = point_paths(
        vehicle, options.point, options.direction, lambda: options.forces(vehicle, rates)
    )
    print_result(
        paths_record(paths) if options.json else paths_table(paths, options.by), options.placements
    )


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "--point", metavar="NAME", help="a response point (default: the driver's, the first)"
    )
    command.add_argument("--direction", choices=DIRECTIONS, help="default vertical")
    add_load(command)
    command.add_argument(
        "--by",
        choices=get_args(By),
        help="tell paths by mount (default), by each direction of each mount, by the body at the "
        "mount's other end, or by mount group; JSON has all",
    )
    add_json(command)


PATHS = Command(
    "paths",
    "what of a response comes through which mount",
    PathsOptions,
    _add_options,
    print_paths,
)
