"""The searches of a study: for which problem, who follows them, and what they give."""

from collections.abc import Callable
from pathlib import Path

from modeviz.compute.cancel import CancelToken
from modeviz.files.problem_file import ENDING, read_problem
from modeviz.optimise.pareto import Front, FrontProgress, find_front
from modeviz.optimise.run import Progress
from modeviz.optimise.search import prepare_search
from modeviz.optimise.trade_off import TradeOff, chosen_sides, prepare_trade_off
from modeviz.scatter.searching import SearchOptions, find_best
from modeviz.study.optimum import OptimiseResult
from modeviz.study.telling import Tell, cancelled_by_ctrl_c
from modeviz.study.trade_off import FrontResult
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.text.wording import significant
from modeviz.vehicle.default_problem import problems
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


def chosen_problem(vehicle: Vehicle, problem: "str | Path | Problem | None") -> Problem:
    """Return a problem of the vehicle or of a file by its name, or the vehicle's usual one.

    Args:
        vehicle: that has it.
        problem: itself, its name, or that of a .toml file; None: the usual one.

    Raises:
        VehicleError: there is none of that name, or not in that file, or nothing to make one of.
    """
    if problem is None:
        return problems(vehicle)[0]
    if isinstance(problem, Problem):
        vehicle.check_problem(problem)
        return problem
    path = Path(problem)
    return read_problem(path, vehicle) if path.suffix == ENDING else vehicle.problem(str(problem))


def better_rates(
    tuned: TunedVehicle, problem: "str | Path | Problem | None", options: SearchOptions, tell: Tell
) -> OptimiseResult:
    """Return better rates of a vehicle, or the best until Ctrl+C; errors as of `Study.optimise`.

    Args:
        tuned: with the rates to begin with.
        problem: as of `chosen_problem`.
        options: how to search.
        tell: told how far it is.
    """
    vehicle, rates = tuned.vehicle, tuned.rates.by_group
    chosen = chosen_problem(vehicle, problem)
    search = prepare_search(vehicle, chosen, rates, tuned.speed)
    with cancelled_by_ctrl_c() as token:
        tell("choosing where to start", 0.0)
        search, optimum = find_best(search, rates, options, token, _telling(tell, token))
    return OptimiseResult(chosen, search, optimum)


def designs_between(
    tuned: TunedVehicle,
    goals: str,
    problem: "str | Path | Problem | None",
    options: SearchOptions,
    tell: Tell,
) -> FrontResult:
    """Return designs between two goals, or those found until Ctrl+C; errors as of `Study.front`.

    Args:
        tuned: with the rates to begin with.
        goals: such as "lateral against vertical".
        problem: as of `chosen_problem`.
        options: how to search.
        tell: told how far it is.
    """
    vehicle, rates = tuned.vehicle, tuned.rates.by_group
    chosen = chosen_problem(vehicle, problem)
    pair = chosen_sides(vehicle, chosen, goals)
    trade_off = prepare_trade_off(vehicle, chosen, pair, rates, tuned.speed)
    with cancelled_by_ctrl_c() as token:
        front = _find_designs(trade_off, rates, options, token, tell)
    return FrontResult(chosen, trade_off, front)


def _find_designs(
    trade_off: TradeOff, rates: Rates, options: SearchOptions, token: CancelToken, tell: Tell
) -> Front:
    """Return designs between two goals, or those that were found until it is cancelled.

    Args:
        trade_off: both goals.
        rates: to begin with, of every group.
        options: how.
        token: ends it.
        tell: told how far it is.

    Raises:
        SolveError: a design that cannot be solved.
    """

    def follow(where: FrontProgress) -> None:
        if not token.is_cancelled:
            tell(f"searching, {len(where.designs)} designs on the front", where.done)

    return find_front(
        trade_off,
        [rates],
        n_starts=options.starts,
        seed=options.seed,
        budget=options.budget,
        token=token,
        tell=follow,
    )


def _telling(tell: Tell, token: CancelToken) -> Callable[[Progress], None]:
    """Return what tells how far a search is, until it is cancelled."""

    def follow(where: Progress) -> None:
        if token.is_cancelled:
            return
        if where.is_checking:
            tell("solving the model as given from scratch", 1.0)
            return
        what = f"search {where.start} of {where.n_starts}, objective {significant(where.value)}"
        tell(what, (where.start - 1) / where.n_starts)

    return follow
