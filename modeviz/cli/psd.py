"""The command that prints accelerations on a road and their rating."""

from argparse import ArgumentParser
from dataclasses import dataclass

from modeviz.analysis.results import solve
from modeviz.cli.command import Command
from modeviz.cli.options import (
    JsonOptions,
    RoadOptions,
    VehicleOptions,
    add_json,
    add_road,
    add_vehicle,
    prepare_telling,
)
from modeviz.cli.results import check_printable, print_result
from modeviz.report.records import psd_record
from modeviz.report.tables import psd_table


@dataclass(frozen=True, kw_only=True)
class PsdOptions(VehicleOptions, RoadOptions, JsonOptions):
    """What `modeviz psd` is asked for."""


def print_psd(options: PsdOptions) -> None:
    """Prints accelerations on a road and their rating."""
    check_printable()
    vehicle, rates = options.read()
    conditions = options.conditions(vehicle)
    results = solve(prepare_telling(vehicle), rates, conditions)
    print_result((psd_record if options.json else psd_table)(results), options.placements)


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    add_road(command)
    add_json(command)


PSD = Command("psd", "accelerations on a road and their rating", PsdOptions, _add_options, print_psd)
