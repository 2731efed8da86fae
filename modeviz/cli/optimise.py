"""The command that searches for better mount rates."""

from argparse import Namespace
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from math import inf

from modeviz.cli.front import optimise_front
from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import (
    chosen_problem,
    chosen_speed,
    chosen_tolerance,
    vehicle_and_rates,
)
from modeviz.cli.results import check_printable, keep, print_result
from modeviz.cli.terminal import progress, say
from modeviz.compute.cancel import CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.compute.runner import Runner
from modeviz.errors import ModevizError
from modeviz.files.disk import check_writable
from modeviz.files.rate_files import rates_format, write_rates
from modeviz.optimise.multistart import optimise_on
from modeviz.optimise.run import Optimum, Progress, optimise, search_globally
from modeviz.optimise.search import Search, prepare_search
from modeviz.optimise.starts import MOST_STARTS, start_points
from modeviz.report.optimum import optimum_record, optimum_table
from modeviz.report.records import Record
from modeviz.scatter.robust import optimise_robustly, robust_search
from modeviz.scatter.tolerance import Tolerance
from modeviz.text.wording import significant
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

N_STARTS = 20


def optimise_rates(options: Namespace) -> None:
    """Searches, writes the rates that were found and prints what they are worth."""
    if options.starts is not None:
        _check("--starts", options.starts, 1, MOST_STARTS)
    _check("--budget", options.budget, 1, inf)
    _check("--seed", options.seed, 0, inf)
    if options.everywhere and options.scheduler:
        raise ModevizError("--global is one search: expected it without --scheduler")
    if not options.robust and (options.tolerance, options.loss_tolerance) != (None, None):
        raise ModevizError("--tolerance and --loss-tolerance: expected them with --robust")
    if options.output is None:
        check_printable()
    vehicle, rates = vehicle_and_rates(options)
    problem = _problem(options, vehicle)
    speed = chosen_speed(options, vehicle)
    if options.output:
        rates_format(options.output)
        check_writable(options.output)
    if options.front:
        optimise_front(options, vehicle, problem, rates, speed)
        return
    tolerance = chosen_tolerance(options) if options.robust else None
    search = prepare_search(vehicle, problem, rates, speed)
    with cancelled_by_interrupt() as control:
        search, optimum = _search(options, search, rates, tolerance, control)
        keep(
            lambda: write_rates(options.output, optimum.rates) if options.output else None,
            lambda: print_result(_result(options, problem, search, optimum)),
        )


def _result(options: Namespace, problem: Problem, search: Search, optimum: Optimum) -> Record | str:
    told = optimum_record if options.json else optimum_table
    return told(problem, search, optimum)


def _problem(options: Namespace, vehicle: Vehicle) -> Problem:
    """The problem that was asked for, as the vehicle has it but for what was changed."""
    problem = chosen_problem(options, vehicle)
    if options.goal:
        problem = replace(problem, goal=options.goal)
    return replace(problem, is_normalised=problem.is_normalised and not options.plain)


def _search(
    options: Namespace, search: Search, rates: Rates, tolerance: Tolerance | None, control: CancelToken
) -> tuple[Search, Optimum]:
    """The last search and the best that it found until its end, or until it is cancelled."""
    robustly = robust_search(search, tolerance) if tolerance else None
    try:
        with runner_at(options.scheduler) as runner:
            tell = partial(_tell, control)
            optimum = _search_once(options, search, rates, runner, control, tell)
            if robustly is None or control.is_cancelled:
                return search, optimum
            return robustly, optimise_robustly(robustly, optimum, options.budget, control, tell)
    finally:
        say("")


def _search_once(
    options: Namespace,
    search: Search,
    rates: Rates,
    runner: Runner,
    control: CancelToken,
    tell: Callable[[Progress], None],
) -> Optimum:
    if options.everywhere:
        return search_globally(search, options.seed, options.budget, control, tell)
    starts = start_points(search, rates, options.starts or N_STARTS, options.seed, control)
    if options.scheduler:
        return optimise_on(runner, search, starts, options.budget, control, tell)
    return optimise(search, starts, options.budget, control, tell)


def _tell(control: CancelToken, where: Progress) -> None:
    if control.is_cancelled:
        return
    if where.is_checking:
        say("checking with the full model")
        return
    text = f"search {where.start:3d} of {where.n_starts}, objective {significant(where.value):>9}"
    progress(text)((where.start - 1) / where.n_starts)


def _check(option: str, value: int, low: int, high: float) -> None:
    if not low <= value <= high:
        expected = f"{low} or more" if high == inf else f"{low} to {high:.0f}"
        raise ModevizError(f"{option}: found {value}, expected {expected}")
