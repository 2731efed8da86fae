"""The command that drives many vehicles whose mounts scatter."""

from argparse import Namespace
from functools import partial

from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import (
    chosen_problem,
    chosen_tolerance,
    conditions,
    of_options,
    prepare_telling,
    vehicle_and_rates,
)
from modeviz.cli.results import check_printable, print_result
from modeviz.cli.terminal import progress, remark, say
from modeviz.report.scatter import scatter_record, scatter_table
from modeviz.scatter.driving import ScatterOptions, drive_many
from modeviz.study.conditions import need


def scatter_mounts(options: Namespace) -> None:
    """Prints percentiles of ride and goal, the worst corner, and which mounts make the spread."""
    check_printable()
    tolerance = chosen_tolerance(options)
    with of_options():
        chosen_vehicles = ScatterOptions(
            options.samples, tolerance, options.seed, _points(options), options.scheduler
        )
    vehicle, rates = vehicle_and_rates(options)
    need(vehicle, "mount group", vehicle.mount_groups)
    chosen = conditions(options, vehicle)
    problem = chosen_problem(options, vehicle)
    with cancelled_by_interrupt() as token:
        try:
            told = drive_many(
                vehicle,
                partial(prepare_telling, vehicle),
                rates,
                chosen,
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
        print_result(scatter_record(told) if options.json else scatter_table(told))


def _points(options: Namespace) -> tuple[str, ...]:
    """The response point that is looked at, if one was named."""
    return () if options.point is None else (options.point,)
