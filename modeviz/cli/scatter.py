"""The command that drives many vehicles whose mounts scatter."""

from argparse import ArgumentParser
from dataclasses import dataclass
from functools import partial

from modeviz.cli.command import Command, of_options
from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import (
    JsonOptions,
    ProblemOptions,
    RoadOptions,
    ToleranceOptions,
    VehicleOptions,
    add_json,
    add_problem,
    add_road,
    add_scheduler,
    add_seed,
    add_tolerances,
    add_vehicle,
    prepare_telling,
)
from modeviz.cli.results import check_printable, print_result
from modeviz.cli.terminal import progress, remark, say
from modeviz.report.scatter import scatter_record, scatter_table
from modeviz.scatter.driving import ScatterOptions, drive_many
from modeviz.study.conditions import need


@dataclass(frozen=True, kw_only=True)
class ScatterCommandOptions(VehicleOptions, ToleranceOptions, ProblemOptions, RoadOptions, JsonOptions):
    """What `modeviz scatter` is asked for."""

    samples: int = 1000
    """How many vehicles."""
    seed: int = 0
    """The same gives the same vehicles."""
    point: str | None = None
    """Name of the response point that is looked at; None: the vehicle's first."""
    scheduler: str | None = None
    """Address of a dask cluster; None: here."""

    def chosen_vehicles(self) -> ScatterOptions:
        """Return which vehicles are driven; raises ModevizError for what cannot be."""
        points = () if self.point is None else (self.point,)
        tolerance = self.chosen_tolerance()
        with of_options():
            return ScatterOptions(self.samples, tolerance, self.seed, points, self.scheduler)


def scatter_mounts(options: ScatterCommandOptions) -> None:
    """Prints percentiles of ride and goal, the worst corner, and which mounts make the spread."""
    check_printable()
    chosen_vehicles = options.chosen_vehicles()
    vehicle, rates = options.read()
    need(vehicle, "mount group", vehicle.mount_groups)
    conditions = options.conditions(vehicle)
    problem = options.chosen_problem(vehicle)
    with cancelled_by_interrupt() as token:
        try:
            told = drive_many(
                vehicle,
                partial(prepare_telling, vehicle),
                rates,
                conditions,
                problem,
                chosen_vehicles,
                token,
                progress("scattering"),
            )
        finally:
            say("")
        n_driven = len(told.scatter.goal)
        if n_driven < options.samples:
            remark(f"ended after {n_driven} of {options.samples} vehicles")
        print_result(scatter_record(told) if options.json else scatter_table(told), options.placements)


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument("--samples", type=int, metavar="N", help="default 1000")
    add_seed(command)
    add_tolerances(command)
    add_problem(command, "whose goal; ")
    command.add_argument("--point", metavar="NAME", help="response point; default: the vehicle's first")
    add_road(command)
    add_scheduler(command)
    add_json(command)


SCATTER = Command(
    "scatter",
    "drive many vehicles whose mounts are not as drawn",
    ScatterCommandOptions,
    _add_options,
    scatter_mounts,
)
