"""What of a plan, what a search is to look for, fits a vehicle."""

from dataclasses import replace

import numpy as np

from modeviz.errors import ModevizError
from modeviz.files.schema.decoding import LARGEST
from modeviz.optimise.starts import MOST_STARTS
from modeviz.vehicle.default_problem import problems
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DIRECTIONS, RATE_FIELDS, MountRates
from modeviz.vehicle.problem import DesignGroup
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.encoding.remarks import Remarks
from modeviz.viewer.session.planning.group_plan import GroupPlan, PlaceRanges, group_plan
from modeviz.viewer.session.planning.load_plan import LoadPlan
from modeviz.viewer.session.planning.plan import Plan

MOST_LOADS = 100

FARTHEST_MOVE, FARTHEST_TURN = 1e3, np.pi / 2
"""m and rad: how far a search may be allowed to place mounts elsewhere."""


def fitted_plan(
    plan: Plan | None, usual: Plan | None, vehicle: Vehicle, remarks: Remarks
) -> Plan | None:
    """Return what of a plan a vehicle can have.

    Args:
        plan: that is asked for.
        usual: of the vehicle; None where there is nothing to optimise for.
        vehicle: with its absorbers.
        remarks: told of what does not fit.
    """
    if usual is None:
        if plan is not None:
            remarks.say("there is nothing to optimise for any more")
        return None
    if plan is None:
        remarks.say("there was nothing to optimise for: the plan is the usual one")
        return usual
    names = [problem.name for problem in problems(vehicle)]
    if plan.problem not in names:
        remarks.one("problem", plan.problem, names, usual="")
        return usual
    return _of_search(_of_groups(_of_loads(plan, vehicle, remarks), vehicle, remarks), remarks)


def _of_groups(plan: Plan, vehicle: Vehicle, remarks: Remarks) -> Plan:
    """With one for every mount group, in their order."""
    mounts = {group.name: group for group in vehicle.mount_groups}
    asked = {group.group: group for group in plan.groups}
    remarks.some("mount group", (*asked, *sorted(plan.free)), mounts)
    if len(asked) < len(plan.groups):
        remarks.say("plan: a mount group is there twice")
    for name in mounts.keys() - asked.keys():
        remarks.say(f"plan: mount group {name!r} came later: it may change as usual")
    groups = tuple(
        _group(asked[name], group, remarks) if name in asked else group_plan(group, DesignGroup(name))
        for name, group in mounts.items()
    )
    shown = remarks.one("mount group", plan.shown_group, mounts, usual=groups[0].group)
    return replace(plan, groups=groups, free=plan.free.intersection(mounts), shown_group=shown)


def _group(plan: GroupPlan, mounts: MountGroup, remarks: Remarks) -> GroupPlan:
    where = f"plan of {mounts.name!r}"
    least, most = (remarks.within(f"{where}: ratio", v, 0.0, LARGEST) for v in plan.ratio_limits)
    return replace(
        plan,
        free=frozenset(remarks.some(f"rate of {mounts.name}", sorted(plan.free), mounts.fields)),
        softest=_bound(where, plan.softest, remarks),
        stiffest=_bound(where, plan.stiffest, remarks),
        ratio_limits=(least, most),
        offsets=_ranges(f"{where}: offset, m", plan.offsets, FARTHEST_MOVE, remarks),
        angles=_ranges(f"{where}: angle, rad", plan.angles, FARTHEST_TURN, remarks),
    )


def _bound(where: str, bound: MountRates, remarks: Remarks) -> MountRates:
    rates = bound.of(RATE_FIELDS)
    return replace(bound, **{f: remarks.within(where, rate, 0.0, LARGEST) for f, rate in rates.items()})


def _ranges(what: str, ranges: PlaceRanges, most: float, remarks: Remarks) -> PlaceRanges:
    x, y, z = (
        (remarks.within(what, low, -most, most), remarks.within(what, high, -most, most))
        for low, high in ranges
    )
    return x, y, z


def _of_loads(plan: Plan, vehicle: Vehicle, remarks: Remarks) -> Plan:
    """With loads that there are; one of them is shown."""
    loads = plan.loads
    if not remarks.few("accelerations to become small", loads, MOST_LOADS):
        loads = loads[:MOST_LOADS]
    shown = remarks.within("accelerations that are shown", plan.shown_load, 0, max(len(loads) - 1, 0))
    return replace(
        plan,
        loads=tuple(_load(load, vehicle, remarks) for load in loads),
        spare=_load(plan.spare, vehicle, remarks),
        shown_load=int(shown),
    )


def _load(plan: LoadPlan, vehicle: Vehicle, remarks: Remarks) -> LoadPlan:
    harmonic = [load.name for load in (*vehicle.harmonic_loads, *vehicle.engine_orders)]
    points = [point.name for point in vehicle.response_points]
    return LoadPlan(
        frozenset(road for road in sorted(plan.roads) if _is_load(road, vehicle, remarks)),
        frozenset(remarks.some("harmonic load", sorted(plan.wheel_loads), harmonic)),
        plan.frequencies,
        frozenset(remarks.some("response point", sorted(plan.points), points)),
        frozenset(remarks.some("direction", sorted(plan.directions), DIRECTIONS)),
        remarks.within("target", plan.target, 0.0, LARGEST),
        remarks.within("weight", plan.weight, 0.0, LARGEST),
    )


def _is_load(name: str, vehicle: Vehicle, remarks: Remarks) -> bool:
    try:
        vehicle.random_load(name)
    except ModevizError as error:
        remarks.say(error)
        return False
    return True


def _of_search(plan: Plan, remarks: Remarks) -> Plan:
    return replace(
        plan,
        low_hz=remarks.within("plan: lowest frequency, Hz", plan.low_hz, 0.0, LARGEST),
        high_hz=remarks.within("plan: highest frequency, Hz", plan.high_hz, 0.0, LARGEST),
        n_starts=int(remarks.within("plan: starts", plan.n_starts, 1, MOST_STARTS)),
    )
