"""What somebody on the page wants optimised: a problem of the vehicle, and what is to be different.

It is part of the state of a session, so that every page shows the same and undo brings it back.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace

from modeviz.dynamics.basis import TOP_HZ
from modeviz.errors import VehicleError
from modeviz.tuning.default_problem import default_problem
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, Goal, Problem
from modeviz.vehicle.vehicle import Vehicle

N_STARTS = 20


@dataclass(frozen=True)
class Plan:
    """A problem as it was chosen and changed on the page."""

    problem: str
    """The name of the problem that it came from."""
    goal: Goal
    is_normalised: bool
    groups: frozenset[str]
    """Mount groups whose rates may change."""
    mode: str = ""
    """The mode whose frequency is held, or none."""
    low_hz: float = 0.0
    high_hz: float = TOP_HZ
    """From `TOP_HZ` on there is no limit."""
    is_inside: bool = True
    """Whether the mode is held in that band, or out of it."""
    n_starts: int = N_STARTS


def problems(vehicle: Vehicle) -> Mapping[str, Problem]:
    """The problems of a vehicle by name, or else one that is made of what it has.

    Raises:
        VehicleError: it has none, and lacks what one is made of.
    """
    found = vehicle.problems or (default_problem(vehicle),)
    return {problem.name: problem for problem in found}


def first_plan(vehicle: Vehicle) -> Plan | None:
    """To solve a vehicle's usual problem; None where there is none."""
    try:
        return plan_of(next(iter(problems(vehicle).values())))
    except VehicleError:
        return None


def plan_of(problem: Problem) -> Plan:
    """To solve a problem as it is."""
    groups = frozenset(group.group for group in problem.groups)
    plan = Plan(problem.name, problem.goal, problem.is_normalised, groups)
    if not problem.windows:
        return plan
    window = problem.windows[0]
    high = min(window.high_hz, TOP_HZ)
    return replace(
        plan, mode=window.mode, low_hz=window.low_hz, high_hz=high, is_inside=window.is_inside
    )


def planned(vehicle: Vehicle, plan: Plan) -> Problem:
    """The problem that a plan is to solve.

    Raises:
        VehicleError: nothing may change, or a frequency window that cannot be.
    """
    problem = problems(vehicle)[plan.problem]
    if not plan.groups:
        raise VehicleError("no group of mounts may change: choose one or more")
    own = {group.group: group for group in problem.groups}
    groups = tuple(
        own.get(group.name) or DesignGroup(group.name)
        for group in vehicle.mount_groups
        if group.name in plan.groups
    )
    return replace(
        problem,
        goal=plan.goal,
        is_normalised=plan.is_normalised,
        groups=groups,
        windows=(*_window(plan), *problem.windows[1:]),
    )


def _window(plan: Plan) -> tuple[FrequencyWindow, ...]:
    if not plan.mode:
        return ()
    high = math.inf if plan.is_inside and plan.high_hz >= TOP_HZ else plan.high_hz
    return (FrequencyWindow(plan.mode, plan.low_hz, high, plan.is_inside),)
