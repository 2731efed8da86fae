"""The command that drives many vehicles whose mounts scatter."""

from argparse import Namespace
from functools import partial
from math import inf

from modeviz.analysis.results import Conditions
from modeviz.cli.interrupt import cancelled_by_interrupt
from modeviz.cli.options import (
    chosen_problem,
    chosen_tolerance,
    conditions,
    need,
    prepare_telling,
    vehicle_and_rates,
)
from modeviz.cli.results import check_printable, print_result
from modeviz.cli.terminal import progress, remark, say
from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.errors import ModevizError, SolveError
from modeviz.optimise.goals import ResponseGoal, prepare_goal
from modeviz.report.scatter import Scattered, scatter_record, scatter_table
from modeviz.scatter.monte_carlo import CHUNK, Scatter, scatter
from modeviz.scatter.sobol import Spread, spread
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import worst_corner
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

MOST_SAMPLES = 1_000_000
"""Their results would not fit the memory of most machines."""


def scatter_mounts(options: Namespace) -> None:
    """Prints percentiles of ride and goal, the worst corner, and which mounts make the spread."""
    check_printable()
    tolerance = chosen_tolerance(options)
    for name, least, most in (("samples", 2, MOST_SAMPLES), ("seed", 0, inf)):
        found = getattr(options, name)
        if not least <= found <= most:
            expected = f"{least} or more" if most == inf else f"{least} to {most}"
            raise ModevizError(f"--{name}: found {found}, expected {expected}")
    vehicle, rates = vehicle_and_rates(options)
    need(vehicle, "mount group", vehicle.mount_groups)
    chosen = conditions(options, vehicle)
    problem = chosen_problem(options, vehicle)
    with cancelled_by_interrupt() as control:
        told = _scattered(options, vehicle, rates, tolerance, chosen, problem, control)
        print_result(scatter_record(told) if options.json else scatter_table(told))


def _scattered(
    options: Namespace,
    vehicle: Vehicle,
    rates: Rates,
    tolerance: Tolerance,
    chosen: Conditions,
    problem: Problem,
    control: CancelToken,
) -> Scattered:
    """What the vehicles do, or those driven until it is cancelled, a few at least."""
    goal = prepare_goal(vehicle, problem, rates, chosen.speed)
    if not isinstance(goal, ResponseGoal):
        raise ModevizError(
            f"problem {problem.name!r}: its goal, {problem.goal}, does not scatter: only what is made "
            "of accelerations does; choose another problem with --problem"
        )
    points = () if options.point is None else (options.point,)
    with runner_at(options.scheduler) as runner:
        prepared = prepare_telling(vehicle)
        parts = scattered_parts(prepared, rates, tolerance)
        drive = partial(scatter, prepared, parts, chosen, goal, seed=options.seed, points=points)
        try:
            tell = progress("scattering")
            result = drive(options.samples, runner=runner, control=control, tell=tell)
        except CancelledError:
            result = drive(min(options.samples, CHUNK))
        finally:
            say("")
    if len(result.goal) < options.samples:
        remark(f"ended after {len(result.goal)} of {options.samples} vehicles")
    worst = worst_corner(goal, parts, result.deviations[result.goal.argmax()])
    return Scattered(problem, chosen, options.seed, result, worst, _spread(result))


def _spread(result: Scatter) -> Spread | None:
    """What makes the goal's spread, where there are samples enough to tell."""
    try:
        return spread(result.deviations, result.goal)
    except SolveError:
        return None
