"""`modeviz optimise --front`: designs between two goals."""

from argparse import Namespace
from functools import partial
from pathlib import Path

from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import json_text
from modeviz.cli.results import keep, print_result
from modeviz.cli.terminal import progress, say
from modeviz.compute.cancel import CancelToken
from modeviz.errors import ModevizError, unknown
from modeviz.files.disk import write_text
from modeviz.files.rate_files import rates_format
from modeviz.optimise.pareto import Front, FrontProgress, find_front
from modeviz.optimise.trade_off import TradeOff, prepare_trade_off, sides
from modeviz.report.front import front_csv, front_record, front_table
from modeviz.report.records import Record
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

N_STARTS = 5
"""For each design, besides those found before."""


def optimise_front(
    options: Namespace, vehicle: Vehicle, problem: Problem, rates: Rates, speed: float
) -> None:
    """Looks for the front, writes its designs and prints what they are worth."""
    for name in ("everywhere", "scheduler", "robust"):
        if getattr(options, name):
            option = "global" if name == "everywhere" else name
            raise ModevizError(f"--front is many searches here: expected it without --{option}")
    offers = sides(vehicle, problem)
    if options.front not in offers:
        raise ModevizError("--front: " + unknown("trade-off", options.front, offers))
    trade_off = prepare_trade_off(vehicle, problem, offers[options.front], rates, speed)
    with cancelled_by_interrupt() as token:
        front = _found(options, trade_off, rates, token)
        record = front_record(problem, trade_off, front)
        keep(
            lambda: _write(options.output, problem, front, record) if options.output else None,
            lambda: print_result(record if options.json else front_table(problem, trade_off, front)),
        )


def _write(path: Path, problem: Problem, front: Front, record: Record) -> None:
    is_csv = rates_format(path) == "csv"
    write_text(path, front_csv(problem, front) if is_csv else json_text(record) + "\n")


def _found(options: Namespace, trade_off: TradeOff, rates: Rates, token: CancelToken) -> Front:
    """The front as far as it is found until its end, or until it is cancelled."""
    try:
        return find_front(
            trade_off,
            [rates],
            n_starts=options.starts or N_STARTS,
            seed=options.seed,
            budget=options.budget,
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
    say(f"checking with the full model, {checked} of {n} designs")
