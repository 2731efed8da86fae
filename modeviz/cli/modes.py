"""The command that prints natural frequencies, damping, names and energies."""

import math
from argparse import ArgumentParser
from dataclasses import dataclass
from typing import get_args

from modeviz.analysis.mode_tracking import solve_followed
from modeviz.analysis.preparation import prepare_modes
from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, VehicleOptions, add_json, add_vehicle
from modeviz.cli.results import check_printable, print_result
from modeviz.dynamics.band import Method
from modeviz.errors import ModevizError
from modeviz.report.records import modes_record
from modeviz.report.tables import modes_table


@dataclass(frozen=True, kw_only=True)
class ModesOptions(VehicleOptions, JsonOptions):
    """What `modeviz modes` is asked for."""

    below: float = 25.0
    """Hz: modes above are left out."""
    method: Method = "enriched"


def print_modes(options: ModesOptions) -> None:
    """Prints natural frequencies, damping, names and energies."""
    check_printable()
    if not (options.below > 0 and math.isfinite(options.below)):
        raise ModevizError(f"--below: found {options.below:g} Hz, expected more than zero")
    given = options.given()
    vehicle, rates = options.with_rates(given)
    top_hz = max(options.below, vehicle.highest_frequency)
    original = prepare_modes(given, top_hz) if options.places else None
    followed = solve_followed(prepare_modes(vehicle, top_hz), rates, options.method, original)
    print_result(
        (modes_record if options.json else modes_table)(followed, options.below), options.placements
    )


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument("--below", type=float, metavar="HZ", help="default 25")
    command.add_argument(
        "--method",
        choices=get_args(Method),
        help="enriched (default), classic: the paper's equation on the original modes, or exact",
    )
    add_json(command)


MODES = Command(
    "modes", "frequencies, damping, names and energies", ModesOptions, _add_options, print_modes
)
