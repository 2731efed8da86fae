"""Vehicles whose mounts scatter, as a study asks for them."""

from dataclasses import dataclass

from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions
from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.errors import ModevizError, SolveError
from modeviz.optimise.goals import ResponseGoal, prepare_goal
from modeviz.report.scatter import Scattered
from modeviz.scatter.monte_carlo import Scatter, scatter
from modeviz.scatter.sobol import Spread, spread
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import worst_corner
from modeviz.study.telling import Tell
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.problem import Problem


@dataclass(frozen=True)
class ScatterOptions:
    """Which vehicles are driven."""

    samples: int
    """How many, two or more."""
    tolerance: Tolerance
    """Of their parts."""
    seed: int
    """The same gives the same vehicles."""
    point: str | None
    """The response point that is looked at; None: the vehicle's first."""
    scheduler: str | None
    """Address of the dask cluster where they are computed; None: here."""


def drive_many(
    prepared: Prepared,
    rates: Rates,
    conditions: Conditions,
    problem: Problem,
    options: ScatterOptions,
    token: CancelToken,
    tell: Tell,
) -> Scattered:
    """Return what vehicles do whose mounts scatter, or those that were driven until it is cancelled.

    Args:
        prepared: the vehicle.
        rates: of every group, from which parts are off.
        conditions: road and speed.
        problem: whose goal is looked at.
        options: which vehicles.
        token: ends it.
        tell: told how far it is.

    Raises:
        ModevizError: the goal does not scatter.
        KeyboardInterrupt: it was cancelled before two vehicles were driven.
    """
    goal = prepare_goal(prepared.vehicle, problem, rates, conditions.speed)
    if not isinstance(goal, ResponseGoal):
        raise ModevizError(
            f"problem {problem.name!r}: its goal, {problem.goal}, does not scatter: only what is made "
            "of accelerations does; choose another problem"
        )
    points = () if options.point is None else (options.point,)
    parts = scattered_parts(prepared, rates, options.tolerance)
    with runner_at(options.scheduler) as runner:
        try:
            result = scatter(
                prepared,
                parts,
                conditions,
                goal,
                options.samples,
                options.seed,
                points,
                runner,
                token,
                lambda done: tell("scattering", done),
            )
        except CancelledError:
            raise KeyboardInterrupt from None
    worst = worst_corner(goal, parts, result.deviations[result.goal.argmax()])
    return Scattered(problem, conditions, options.seed, result, worst, _spread(result))


def _spread(result: Scatter) -> Spread | None:
    """What makes the goal's spread, where there are samples enough to tell."""
    try:
        return spread(result.deviations, result.goal)
    except SolveError:
        return None
