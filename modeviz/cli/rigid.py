"""The command that prints how pure rigid modes are, and axes and centres of bodies on their mounts."""

import math
from argparse import ArgumentParser
from dataclasses import dataclass
from typing import get_args

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import main_bodies, rigid_figures
from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, VehicleOptions, add_json, add_vehicle
from modeviz.cli.results import check_printable, print_result
from modeviz.errors import ModevizError
from modeviz.report.rigid import rigid_record, rigid_table
from modeviz.vehicle.decoupling import Axes


@dataclass(frozen=True, kw_only=True)
class RigidOptions(VehicleOptions, JsonOptions):
    """What `modeviz rigid` is asked for."""

    axes: Axes = "vehicle"
    body: tuple[str, ...] = ()
    """Names of bodies; none: those that are no linkages, absorbers or wheels, with `json` all."""
    up_to: float | None = None
    """Hz: to where modes are looked for, if beyond the vehicle's band."""


def print_rigid(options: RigidOptions) -> None:
    """Prints energy in six directions, purity and gaps, axes and centres of bodies."""
    check_printable()
    if options.up_to is not None and not (options.up_to > 0 and math.isfinite(options.up_to)):
        raise ModevizError(f"--up-to: found {options.up_to:g} Hz, expected more than zero")
    vehicle, rates = options.read()
    chosen = options.body or (() if options.json else main_bodies(vehicle))
    top_hz = max(options.up_to or 0.0, vehicle.highest_frequency)
    results = solve_modal(prepare_modes(vehicle, top_hz), rates)
    bodies = rigid_figures(results, options.axes, chosen)
    print_result(
        (rigid_record if options.json else rigid_table)(results, bodies, options.axes),
        options.placements,
    )


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "--axes",
        choices=get_args(Axes),
        help="along which energy is told: the vehicle's (default), those of the body's inertia, or the "
        "vehicle's turned so that one lies along the crank",
    )
    command.add_argument(
        "--body",
        action="append",
        metavar="NAME",
        help="a body; may be repeated (default: all that are no linkages, absorbers or wheels)",
    )
    command.add_argument(
        "--up-to",
        type=float,
        metavar="HZ",
        help="look for modes up to there, if that is beyond the vehicle's band",
    )
    add_json(command)


RIGID = Command(
    "rigid",
    "purity of rigid modes, axes and centres of bodies on mounts",
    RigidOptions,
    _add_options,
    print_rigid,
)
