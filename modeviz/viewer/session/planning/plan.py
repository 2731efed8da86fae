"""What somebody on the page wants optimised: a problem of the vehicle, and what is to be different.

It is part of the state of a session, so that every page shows the same and undo brings it back. It
may ask for what cannot be, as while somebody types; the problem that is made of it cannot.
"""

import math
from dataclasses import dataclass, field, replace
from typing import Any

from modeviz.errors import VehicleError
from modeviz.vehicle.default_problem import problem_called, problems
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, GoalKind, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.planning.group_plan import GroupPlan, group_plan
from modeviz.viewer.session.planning.load_plan import LoadPlan, load_plan, spare_load

N_STARTS = 20


@dataclass(frozen=True)
class Plan:
    """A problem as it was chosen and changed on the page."""

    problem: str
    """The name of the problem that it came from."""
    goal: GoalKind
    is_normalised: bool
    free: frozenset[str]
    """Mount groups whose rates may change."""
    groups: tuple[GroupPlan, ...]
    """Of every mount group, also while it is held."""
    loads: tuple[LoadPlan, ...]
    spare: LoadPlan
    """What is added where there is none."""
    high_hz: float
    """At the end of the vehicle's band and beyond there is no limit."""
    shown_group: str = field(compare=False)
    """The one of which the page shows what it may become."""
    shown_load: int = field(default=0, compare=False)
    mode: str = ""
    """The mode whose frequency is held, or none."""
    low_hz: float = 0.0
    is_inside: bool = True
    """Whether the mode is held in that band, or out of it."""
    n_starts: int = N_STARTS
    is_robust: bool = False
    """Whether the search goes on for most vehicles that are built, not for the one as drawn."""

    @property
    def group(self) -> GroupPlan:
        """The one that the page shows."""
        return next(group for group in self.groups if group.group == self.shown_group)

    @property
    def load(self) -> LoadPlan:
        """The one that the page shows or, where there is none, would add."""
        return self.loads[self.shown_load] if self.loads else self.spare

    def with_group(self, **fields: Any) -> "Plan":
        """With something else in the group that is shown."""
        groups = (replace(g, **fields) if g is self.group else g for g in self.groups)
        return replace(self, groups=tuple(groups))

    def with_mounts(self, mounts: MountGroup) -> "Plan":
        """With a mount group that came later, whose rates may change; one of its name as it was."""
        if mounts.name in (group.group for group in self.groups):
            return self
        added = group_plan(mounts, DesignGroup(mounts.name))
        return replace(self, groups=(*self.groups, added), free=self.free | {mounts.name})

    def without_mounts(self, name: str) -> "Plan":
        """Without a mount group that is gone; the first is shown if that was."""
        left = tuple(group for group in self.groups if group.group != name)
        shown = left[0].group if self.shown_group == name else self.shown_group
        return replace(self, groups=left, free=self.free - {name}, shown_group=shown)

    def with_load(self, **fields: Any) -> "Plan":
        """With something else in the accelerations that are shown."""
        changed = replace(self.load, **fields)
        loads = (changed if i == self.shown_load else load for i, load in enumerate(self.loads))
        return replace(self, loads=tuple(loads))

    def with_one_more_load(self) -> "Plan":
        """With the accelerations that are shown once more, to be changed, and these shown."""
        return replace(self, loads=(*self.loads, self.load), shown_load=len(self.loads))

    def without_load(self) -> "Plan":
        """Without the accelerations that are shown."""
        loads = (*self.loads[: self.shown_load], *self.loads[self.shown_load + 1 :])
        return replace(self, loads=loads, shown_load=max(0, self.shown_load - 1))


def first_plan(vehicle: Vehicle) -> Plan | None:
    """To solve a vehicle's usual problem; None where there is none."""
    try:
        return plan_of(vehicle, problems(vehicle)[0])
    except VehicleError:
        return None


def plan_of(vehicle: Vehicle, problem: Problem) -> Plan:
    """To solve a problem as it is."""
    own = _own_groups(problem)
    plan = Plan(
        problem.name,
        problem.goal,
        problem.is_normalised,
        frozenset(own),
        tuple(group_plan(g, own.get(g.name) or DesignGroup(g.name)) for g in vehicle.mount_groups),
        tuple(load_plan(vehicle, performance) for performance in problem.performance),
        spare_load(vehicle),
        vehicle.highest_frequency,
        problem.groups[0].group,
    )
    if not problem.windows:
        return plan
    window = problem.windows[0]
    high = min(window.high_hz, vehicle.highest_frequency)
    return replace(
        plan, mode=window.mode, low_hz=window.low_hz, high_hz=high, is_inside=window.is_inside
    )


def planned(vehicle: Vehicle, plan: Plan) -> Problem:
    """The problem that a plan is to solve; what was not changed is that of the problem it came from.

    Raises:
        VehicleError: nothing may change, or what that is, accelerations or a window cannot be.
    """
    problem = problem_called(vehicle, plan.problem)
    if not plan.free:
        raise VehicleError("no group of mounts may change: choose one or more")
    return replace(
        problem,
        goal=plan.goal,
        is_normalised=plan.is_normalised,
        groups=_groups(vehicle, plan, problem),
        performance=_performance(vehicle, plan, problem),
        windows=(*_window(vehicle, plan), *problem.windows[1:]),
    )


def _own_groups(problem: Problem) -> dict[str, DesignGroup]:
    return {group.group: group for group in problem.groups}


def _groups(vehicle: Vehicle, plan: Plan, problem: Problem) -> tuple[DesignGroup, ...]:
    """Those that may change."""
    own, found = _own_groups(problem), []
    every = {group.group: group for group in plan.groups}
    for mounts in vehicle.mount_groups:
        if mounts.name in plan.free:
            asked, before = every[mounts.name], own.get(mounts.name)
            is_as_before = before is not None and asked == group_plan(mounts, before)
            found.append(before if is_as_before else asked.design(mounts))
    return tuple(found)


def _performance(vehicle: Vehicle, plan: Plan, problem: Problem) -> tuple[Performance, ...]:
    own = {load_plan(vehicle, performance): performance for performance in problem.performance}
    return tuple(own.get(load) or load.performance(vehicle) for load in plan.loads)


def _window(vehicle: Vehicle, plan: Plan) -> tuple[FrequencyWindow, ...]:
    if not plan.mode:
        return ()
    is_open = plan.is_inside and plan.high_hz >= vehicle.highest_frequency
    high = math.inf if is_open else plan.high_hz
    return (FrequencyWindow(plan.mode, plan.low_hz, high, plan.is_inside),)
