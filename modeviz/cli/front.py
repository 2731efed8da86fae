"""`modeviz optimise --front`: designs between two goals."""

from functools import partial
from pathlib import Path

from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.results import json_text, keep, print_result
from modeviz.cli.terminal import progress, say
from modeviz.compute.cancel import CancelToken
from modeviz.errors import ModevizError, located
from modeviz.files.disk import write_text
from modeviz.files.rate_files import rates_format
from modeviz.optimise.pareto import Front, FrontProgress, find_front
from modeviz.optimise.trade_off import TradeOff, chosen_sides, prepare_trade_off
from modeviz.report.front import front_csv, front_record, front_table
from modeviz.report.records import Record
from modeviz.scatter.searching import SearchOptions
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


def optimise_front(
    goals: str,
    how: SearchOptions,
    vehicle: Vehicle,
    problem: Problem,
    rates: Rates,
    speed: float,
    output: Path | None,
    json: bool,
) -> None:
    """Looks for the front, writes its designs and prints what they are worth.

    Args:
        goals: such as "lateral against vertical".
        how: it is searched, `starts` for each design besides those found before.
        vehicle: with its own rates.
        problem: of which these are two sides.
        rates: to begin with, of every group.
        speed: on the roads, m/s.
        output: where to write designs, .json or .csv, if anywhere.
        json: whether a record is printed and not a table.

    Raises:
        ModevizError: the problem does not offer that, or another search is asked for as well.
    """
    _check_is_one_search(how)
    with located("--front"):
        pair = chosen_sides(vehicle, problem, goals)
    trade_off = prepare_trade_off(vehicle, problem, pair, rates, speed)
    with cancelled_by_interrupt() as token:
        front = _found(how, trade_off, rates, token)
        record = front_record(problem, trade_off, front)
        keep(
            lambda: _write(output, front_csv(problem, trade_off, front), record) if output else None,
            lambda: print_result(record if json else front_table(problem, trade_off, front)),
        )


def _check_is_one_search(how: SearchOptions) -> None:
    """Raises ModevizError for what a front cannot be asked for."""
    for option, is_given in (
        ("global", how.everywhere),
        ("scheduler", how.scheduler),
        ("robust", how.tolerance),
    ):
        if is_given:
            raise ModevizError(f"--front is many searches here: expected it without --{option}")


def _write(path: Path, as_csv: str, record: Record) -> None:
    write_text(path, as_csv if rates_format(path) == "csv" else json_text(record) + "\n")


def _found(how: SearchOptions, trade_off: TradeOff, rates: Rates, token: CancelToken) -> Front:
    """The front as far as it is found until its end, or until it is cancelled."""
    try:
        return find_front(
            trade_off,
            [rates],
            n_starts=how.starts,
            seed=how.seed,
            budget=how.budget,
            token=token,
            tell=partial(_tell, token),
        )
    finally:
        say("")


def _tell(token: CancelToken, where: FrontProgress) -> None:
    if token.is_cancelled:
        return
    n = len(where.designs)
    if where.done < 1:
        progress(f"searching, {n} designs on the front")(where.done)
        return
    checked = sum(design.verification is not None for design in where.designs)
    say(f"solving the model as given from scratch, {checked} of {n} designs")
