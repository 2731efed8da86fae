"""The command that prints the response to every wheel load."""

from argparse import ArgumentParser
from dataclasses import dataclass

from modeviz.analysis.wheel_results import solve_wheels
from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, VehicleOptions, add_json, add_vehicle, prepare_telling
from modeviz.cli.results import check_printable, print_result
from modeviz.report.records import wheels_record
from modeviz.report.tables import wheels_table
from modeviz.study.conditions import need


@dataclass(frozen=True, kw_only=True)
class WheelsOptions(VehicleOptions, JsonOptions):
    """What `modeviz wheels` is asked for."""


def print_wheels(options: WheelsOptions) -> None:
    """Prints the response to every wheel load."""
    check_printable()
    vehicle, rates = options.read()
    need(vehicle, "response point", vehicle.response_points)
    need(vehicle, "wheel load", vehicle.harmonic_loads)
    results = solve_wheels(prepare_telling(vehicle), rates)
    tuned = vehicle.with_rates(rates)
    print_result((wheels_record if options.json else wheels_table)(tuned, results), options.placements)


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    add_json(command)


WHEELS = Command(
    "wheels",
    "response to unbalance and tyre force variation",
    WheelsOptions,
    _add_options,
    print_wheels,
)
