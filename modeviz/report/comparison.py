"""Two sets of rates of one vehicle, solved side by side."""

from dataclasses import dataclass, field

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.mode_tracking import follow
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions, Results, drive, solve_on
from modeviz.analysis.wheel_results import WheelResults, solve_wheels
from modeviz.dynamics.tracking import Track
from modeviz.errors import VehicleError
from modeviz.optimise.design_space import DesignSpace, design_space
from modeviz.optimise.goals import Goal, prepare_goal
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements
from modeviz.vehicle.problem import UNSHAKEN, Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class RateSet:
    """Rates with a name."""

    name: str
    rates: Rates
    """Of the groups that differ from the vehicle's own."""
    placements: Placements = field(default_factory=dict)
    """Where the mounts of groups are with them, if elsewhere."""


@dataclass(frozen=True)
class ObjectiveValues:
    """Values of a problem's goal with several sets of rates."""

    problem: Problem
    original: float
    """With the vehicle's own rates."""
    base: float
    now: float
    """With the sets that are compared."""
    reference: float | None
    """With the problem's set to compare with, if it has one."""
    space: DesignSpace | None
    """Of the designs that a search from the vehicle's own rates could find; None if there are none."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """A vehicle with two sets of rates, solved."""

    names: tuple[str, str]
    """Of the set that is compared with, and of the other."""
    base: ModalResults
    """`Results` if the vehicle has a road and someone to feel it."""
    now: ModalResults
    track: Track
    """Where the modes of `base` went."""
    wheels: tuple[WheelResults, WheelResults] | None
    """The response to harmonic loads, if there are any."""
    worth: ObjectiveValues | None
    """By the vehicle's usual problem, its first; None if it has none, or none of its goal."""

    @property
    def vehicle(self) -> Vehicle:
        """The second one, with the rates it has in its file."""
        return self.now.prepared.vehicle

    @property
    def rides(self) -> tuple[Results, Results] | None:
        """Both on the road, if there is one."""
        if isinstance(self.base, Results) and isinstance(self.now, Results):
            return self.base, self.now
        return None


def compare(
    prepared: Prepared,
    base: RateSet,
    now: RateSet,
    conditions: Conditions | None,
    prepared_base: Prepared | None = None,
    given: Vehicle | None = None,
) -> Comparison:
    """Solves a vehicle with two sets of rates, all that it has loads for.

    Args:
        prepared: see `prepare`.
        base: what is compared with.
        now: the other.
        conditions: road and speed; None for a vehicle that has no roads or no response points.
        prepared_base: the vehicle that is compared with, if its mounts are elsewhere or it has other
            absorbers.
        given: the vehicle as in its file, by which goals are measured; None: that compared with.

    Raises:
        VehicleError: a group or a road that the vehicle does not have.
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    sets = (prepared_base or prepared, base.rates), (prepared, now.rates)
    if conditions is None:
        first, second = (solve_modal(*each) for each in sets)
    else:
        first, second = (solve_on(drive(vehicle, conditions), rates) for vehicle, rates in sets)
    vehicle = prepared.vehicle
    wheels = None
    if vehicle.harmonic_loads and vehicle.response_points:
        wheels = solve_wheels(*sets[0]), solve_wheels(*sets[1])
    track = follow(first, second)
    speed = conditions.speed if conditions else vehicle.speed
    worth = _worth(given or first.prepared.vehicle, first, second, speed)
    return Comparison((base.name, now.name), first, second, track, wheels, worth)


def _worth(
    given: Vehicle, base: ModalResults, now: ModalResults, speed: float
) -> ObjectiveValues | None:
    if not given.problems:
        return None
    problem = given.problems[0]
    try:
        goal = prepare_goal(given, problem, given.rates, speed)
    except VehicleError:
        if problem.goal in UNSHAKEN:
            return None  # as of mounts whose rates depend on frequency: a search says why
        raise
    reference = goal.value(given.rate_sets[problem.reference]) if problem.reference else None
    before, after = (_value(goal, given, results) for results in (base, now))
    space = _space(now.prepared.vehicle, problem)
    return ObjectiveValues(problem, goal.value({}), before, after, reference, space)


def _value(goal: Goal, given: Vehicle, results: ModalResults) -> float:
    """A goal of one vehicle for another that has its mounts elsewhere, or absorbers besides."""
    vehicle = results.prepared.vehicle
    own = goal if vehicle is given else goal.of_vehicle(vehicle)
    return own.value(results.rates)


def _space(vehicle: Vehicle, problem: Problem) -> DesignSpace | None:
    try:
        return design_space(vehicle, problem.groups)
    except VehicleError:
        return None
