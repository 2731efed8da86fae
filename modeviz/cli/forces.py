"""The command that prints what forces mounts and other connections pass on under a load."""

from argparse import ArgumentParser
from dataclasses import dataclass

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
from modeviz.report.forces import forces_record, forces_table


@dataclass(frozen=True, kw_only=True)
class ForcesOptions(VehicleOptions, LoadOptions, JsonOptions):
    """What `modeviz forces` is asked for."""

    all: bool = False
    """Also of connections that are no mounts."""


def print_forces(options: ForcesOptions) -> None:
    """Prints the forces of mounts, transmissibilities and dissipated energy under a load."""
    check_printable()
    found = options.forces(*options.read())
    print_result(
        (forces_record if options.json else forces_table)(found, options.all), options.placements
    )


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    add_load(command)
    command.add_argument("--all", action="store_true", help="also of connections that are no mounts")
    add_json(command)


FORCES = Command(
    "forces",
    "force of every mount under a load, what gets through it, and dissipated energy",
    ForcesOptions,
    _add_options,
    print_forces,
)
