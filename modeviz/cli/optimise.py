"""The command that searches for better mount rates."""

from argparse import ArgumentParser
from dataclasses import dataclass, replace
from functools import partial
from pathlib import Path
from typing import get_args

from modeviz.cli.command import Command, of_options
from modeviz.cli.front import optimise_front
from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import (
    JsonOptions,
    ProblemOptions,
    SpeedOptions,
    ToleranceOptions,
    VehicleOptions,
    add_json,
    add_problem,
    add_scheduler,
    add_seed,
    add_speed,
    add_tolerances,
    add_vehicle,
)
from modeviz.cli.results import check_printable, keep, print_result
from modeviz.cli.terminal import progress, say
from modeviz.compute.cancel import CancelToken
from modeviz.errors import ModevizError
from modeviz.files import write_vehicle
from modeviz.files.disk import check_writable
from modeviz.files.folder import check_vehicle_folder
from modeviz.files.rate_files import rates_format, write_rates
from modeviz.optimise.run import BUDGET, Progress
from modeviz.optimise.search import prepare_search
from modeviz.report.optimum import optimum_record, optimum_table
from modeviz.scatter.searching import FRONT_STARTS, SearchOptions, find_best
from modeviz.text.wording import significant
from modeviz.vehicle.problem import GoalKind, Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, kw_only=True)
class OptimiseOptions(VehicleOptions, ProblemOptions, ToleranceOptions, SpeedOptions, JsonOptions):
    """What `modeviz optimise` is asked for."""

    output: Path | None = None
    """Where to write what is found, .json or .csv, if anywhere."""
    folder: Path | None = None
    """Where to write the vehicle with what is found, if anywhere."""
    goal: str | None = None
    """Instead of the problem's: one of `GoalKind`."""
    plain: bool = False
    """Whether load cases are added up as they are."""
    starts: int | None = None
    """None: as many as are usual."""
    front: str | None = None
    """Two goals, to find designs between them instead."""
    everywhere: bool = False
    """Whether to search everywhere at once instead of from starts."""
    seed: int = 0
    """The same finds the same."""
    budget: int = BUDGET
    """The most evaluations, besides those that choose where to start."""
    robust: bool = False
    """Whether then the 95th percentile over parts is made small."""
    scheduler: str | None = None
    """Address of a dask cluster; None: here."""

    def how(self) -> SearchOptions:
        """Return how the search goes.

        Raises:
            ModevizError: it cannot go so.
        """
        if self.everywhere and self.scheduler:
            raise ModevizError("--global is one search: expected it without --scheduler")
        usual = FRONT_STARTS if self.front else SearchOptions.starts
        tolerance = self.chosen_tolerance() if self.robust else None
        with of_options():
            how = SearchOptions(
                usual if self.starts is None else self.starts,
                self.seed,
                self.budget,
                self.everywhere,
                tolerance,
                self.scheduler,
            )
        if self.has_tolerance and not self.robust:
            raise ModevizError("--tolerance and --loss-tolerance: expected them with --robust")
        return how

    def changed_problem(self, vehicle: Vehicle) -> Problem:
        """Return the problem that was asked for, as the vehicle has it but for what was changed."""
        problem = self.chosen_problem(vehicle)
        if self.goal:
            problem = replace(problem, goal=self.goal)
        return replace(problem, is_normalised=problem.is_normalised and not self.plain)


def optimise_rates(options: OptimiseOptions) -> None:
    """Searches, writes the rates that were found and prints what they are worth."""
    how = options.how()
    if options.output is None:
        check_printable()
    vehicle, rates = options.read()
    problem = options.changed_problem(vehicle)
    speed = options.chosen_speed(vehicle)
    output, folder, json = options.output, options.folder, options.json
    if output:
        rates_format(output)
        check_writable(output)
    if folder:
        check_vehicle_folder(folder)
    if options.front:
        if folder:
            raise ModevizError("--front finds many designs: expected it without --folder")
        optimise_front(options.front, how, vehicle, problem, rates, speed, output, json)
        return
    search = prepare_search(vehicle, problem, rates, speed)
    with cancelled_by_interrupt() as token:
        try:
            search, optimum = find_best(search, rates, how, token, partial(_tell, token))
        finally:
            say("")
        told = optimum_record if json else optimum_table
        keep(
            lambda: write_rates(output, optimum.rates, vehicle) if output else None,
            lambda: write_vehicle(search.space.built(optimum.x), folder) if folder else None,
            lambda: print_result(told(problem, search, optimum)),
        )


def _tell(token: CancelToken, where: Progress) -> None:
    if token.is_cancelled:
        return
    if where.is_checking:
        say("solving the model as given from scratch")
        return
    text = f"search {where.start:3d} of {where.n_starts}, objective {significant(where.value):>9}"
    progress(text)((where.start - 1) / where.n_starts)


def _add_options(command: ArgumentParser) -> None:
    add_vehicle(command)
    command.add_argument(
        "--output", type=Path, metavar="FILE", help="where to write rates that are found: .json or .csv"
    )
    command.add_argument(
        "--folder",
        type=Path,
        metavar="FOLDER",
        help="where to write the vehicle with all that is found, places of mounts too: new, or empty",
    )
    add_problem(command)
    command.add_argument(
        "--goal", metavar="NAME", help="instead of the problem's: " + ", ".join(get_args(GoalKind))
    )
    command.add_argument(
        "--plain",
        action="store_true",
        help="add load cases up as they are, as the paper does, not relative to the original",
    )
    command.add_argument(
        "--starts",
        type=int,
        metavar="N",
        help=f"the first from --rates; default {SearchOptions.starts}, or {FRONT_STARTS} for each "
        "design of a front",
    )
    command.add_argument(
        "--front",
        metavar="GOALS",
        help='find designs between two goals instead, such as "lateral against vertical"',
    )
    command.add_argument(
        "--global",
        action="store_true",
        dest="everywhere",
        help="search everywhere at once instead: slower, and finds what starts may miss",
    )
    add_seed(command)
    command.add_argument(
        "--budget",
        type=int,
        metavar="N",
        help=f"evaluations, besides those that choose where to start; default {BUDGET}",
    )
    command.add_argument(
        "--robust",
        action="store_true",
        help="then make the 95th percentile over mounts within their tolerances small",
    )
    add_tolerances(command)
    add_scheduler(command)
    add_speed(command)
    add_json(command)


OPTIMISE = Command(
    "optimise", "search for better mount rates", OptimiseOptions, _add_options, optimise_rates
)
