"""The command that searches for better mount rates."""

from argparse import Namespace
from dataclasses import replace
from functools import partial

from modeviz.cli.front import optimise_front
from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import (
    chosen_problem,
    chosen_speed,
    chosen_tolerance,
    of_options,
    vehicle_and_rates,
)
from modeviz.cli.results import check_printable, keep, print_result
from modeviz.cli.terminal import progress, say
from modeviz.compute.cancel import CancelToken
from modeviz.errors import ModevizError
from modeviz.files.disk import check_writable
from modeviz.files.rate_files import rates_format, write_rates
from modeviz.optimise.run import Optimum, Progress
from modeviz.optimise.search import Search, prepare_search
from modeviz.report.optimum import optimum_record, optimum_table
from modeviz.report.records import Record
from modeviz.scatter.searching import SearchOptions, find_best
from modeviz.text.wording import significant
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

N_STARTS = 20


def optimise_rates(options: Namespace) -> None:
    """Searches, writes the rates that were found and prints what they are worth."""
    if options.everywhere and options.scheduler:
        raise ModevizError("--global is one search: expected it without --scheduler")
    how = _how(options)
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
    search = prepare_search(vehicle, problem, rates, speed)
    with cancelled_by_interrupt() as token:
        try:
            search, optimum = find_best(search, rates, how, token, partial(_tell, token))
        finally:
            say("")
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


def _how(options: Namespace) -> SearchOptions:
    """How the search goes that was asked for."""
    tolerance = chosen_tolerance(options) if options.robust else None
    starts = N_STARTS if options.starts is None else options.starts
    with of_options():
        return SearchOptions(
            starts, options.seed, options.budget, options.everywhere, tolerance, options.scheduler
        )


def _tell(token: CancelToken, where: Progress) -> None:
    if token.is_cancelled:
        return
    if where.is_checking:
        say("checking with the full model")
        return
    text = f"search {where.start:3d} of {where.n_starts}, objective {significant(where.value):>9}"
    progress(text)((where.start - 1) / where.n_starts)
