"""Scatter from start to end: many vehicles, the worst corner, and which mounts make the spread."""

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions
from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.compute.cluster import runner_at
from modeviz.errors import ModevizError, SolveError
from modeviz.optimise.goals import ResponseGoal, prepare_goal
from modeviz.scatter.monte_carlo import CHUNK, Scatter, scatter
from modeviz.scatter.searching import check_whole
from modeviz.scatter.sobol import Spread, spread
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import WorstCase, worst_corner
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

MOST_SAMPLES = 1_000_000
"""Their results would not fit the memory of most machines."""


@dataclass(frozen=True)
class ScatterOptions:
    """Which vehicles are driven."""

    samples: int
    """How many, two or more."""
    tolerance: Tolerance
    """Of their parts."""
    seed: int = 0
    """The same gives the same vehicles."""
    points: tuple[str, ...] = ()
    """The response points that are looked at, the first is rated; none: the vehicle's first."""
    scheduler: str | None = None
    """Address of the dask cluster where they are computed; None: here."""

    def __post_init__(self) -> None:
        check_whole("samples", self.samples, 2, MOST_SAMPLES)
        check_whole("seed", self.seed, 0)


@dataclass(frozen=True, eq=False)
class Scattered:
    """What there is to tell of a scatter."""

    problem: Problem
    conditions: Conditions
    seed: int
    scatter: Scatter
    worst: WorstCase
    spread: Spread | None
    """Of the goal; None of too few samples."""


def drive_many(
    vehicle: Vehicle,
    prepare: Callable[[], Prepared],
    rates: Rates,
    conditions: Conditions,
    problem: Problem,
    options: ScatterOptions,
    token: CancelToken,
    tell: Callable[[float], None],
    at_least: int = CHUNK,
) -> Scattered:
    """Return what vehicles do whose mounts scatter, or those driven until it is cancelled.

    Args:
        vehicle: with its own rates.
        prepare: makes it ready, which is asked for once nothing else can be wrong.
        rates: of every group, from which parts are off.
        conditions: road and speed.
        problem: whose goal is looked at.
        options: which vehicles.
        token: lets somebody end it.
        tell: told the fraction that is done.
        at_least: so many vehicles are driven even if it is cancelled; of none nothing is kept.

    Raises:
        CancelledError: it was told to end, and nothing is to be kept.
        ModevizError: the goal does not scatter, or nobody answers for the scheduler.
        VehicleError: a road or point that the vehicle does not have.
        SolveError: an undamped resonance on a frequency.
    """
    goal = prepare_goal(vehicle, problem, rates, conditions.speed)
    if not isinstance(goal, ResponseGoal):
        raise ModevizError(
            f"problem {problem.name!r}: its goal, {problem.goal}, does not scatter: only what is made "
            "of accelerations does; choose another problem"
        )
    with runner_at(options.scheduler) as runner:
        prepared = prepare()
        parts = scattered_parts(prepared, rates, options.tolerance)
        given = prepared, parts, conditions, goal
        drive = partial(scatter, *given, seed=options.seed, points=options.points)
        try:
            result = drive(options.samples, runner=runner, token=token, tell=tell)
        except CancelledError:
            if not at_least:
                raise
            result = drive(min(options.samples, at_least))
    if not at_least:
        token.check()
    worst = worst_corner(goal, parts, result.deviations[result.goal.argmax()])
    return Scattered(problem, conditions, options.seed, result, worst, _spread(result))


def _spread(result: Scatter) -> Spread | None:
    """Return what makes the goal's spread, where there are samples enough to tell."""
    try:
        return spread(result.deviations, result.goal)
    except SolveError:
        return None
