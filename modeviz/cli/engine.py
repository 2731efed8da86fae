"""The command that prints what a running engine does to a vehicle."""

from argparse import ArgumentParser
from dataclasses import dataclass

from modeviz.analysis.engine_results import solve_engine
from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, VehicleOptions, add_json, add_vehicle, prepare_telling
from modeviz.cli.results import check_printable, print_result
from modeviz.report.engine import engine_record, engine_table
from modeviz.study.conditions import need


@dataclass(frozen=True, kw_only=True)
class EngineOptions(VehicleOptions, JsonOptions):
    """What `modeviz engine` is asked for."""

    engine: str | None = None
    """Its name; None: the first."""


def print_engine(options: EngineOptions) -> None:
    """Prints what an engine's orders do at points and mounts, at idle and over its speed."""
    check_printable()
    vehicle, rates = options.read()
    need(vehicle, "engine", vehicle.engines)
    need(vehicle, "response point", (*vehicle.response_points, *vehicle.mounts))
    engine = vehicle.engines[0] if options.engine is None else vehicle.engine(options.engine)
    results = solve_engine(prepare_telling(vehicle), rates, engine)
    print_result(
        (engine_record if options.json else engine_table)(vehicle.with_rates(rates), results),
        options.placements,
    )


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument("--engine", metavar="NAME", help="which (default: the first)")
    add_json(command)


ENGINE = Command(
    "engine",
    "response to the orders of a running engine, and forces of mounts, at idle and over its speed",
    EngineOptions,
    _add_options,
    print_engine,
)
