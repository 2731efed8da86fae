"""Derivatives of goals to rotational rates and dampers that are tuned, against finite differences."""

from dataclasses import replace

import numpy as np
import pytest
from differences import central_difference, relative_to_largest
from tuned_vehicle import OTHER, tuned_vehicle

from modeviz.analysis.sensitivity import rate_variables
from modeviz.optimise.goals import prepare_goal
from modeviz.vehicle.decoupling import DecoupledBody
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import DesignGroup, Performance, Problem

TARGET = MountTarget(("E0", "F1", "S0"), loads=("shaker", "floor"))
SHAKEN = Performance(np.array([4.0, 7.5, 12.0, 21.0]), wheel_loads=("shaker", "floor"))
BODIES = (DecoupledBody("engine"),)
PARTS = {
    "forces": {"mounts": (TARGET,)},
    "accelerations": {"performance": (SHAKEN,)},
    "decoupling": {"decoupling": BODIES},
    "peak": {"performance": (replace(SHAKEN, frequency_hz=np.array([4.0, 21.0])),)},
    "purity": {"decoupling": BODIES},
}

LOOKED_AT = {"peak": ("S",)}
"""Groups to whose rates derivatives are looked at, where not all are."""


@pytest.mark.parametrize(
    "goal", [pytest.param(g, marks=pytest.mark.slow) if g == "forces" else g for g in PARTS]
)
def test_derivatives_are_those_of_finite_differences(goal):
    vehicle, rates = replace(tuned_vehicle(), highest_frequency=24.0, frequency_step=0.5), OTHER
    groups = tuple(DesignGroup(group.name) for group in vehicle.mount_groups)
    wanted = prepare_goal(vehicle, Problem("p", groups, goal=goal, **PARTS[goal]), vehicle.rates, 20.0)
    _, gradient = wanted.value_and_gradient(rates)
    variables = [
        (i, v, getattr(rates[v.group], v.direction))
        for i, v in enumerate(rate_variables(vehicle))
        if getattr(rates[v.group], v.direction) and v.group in LOOKED_AT.get(goal, rates)
    ]
    expected = [
        central_difference(
            lambda k, v=v: wanted.value(
                {**rates, v.group: replace(rates[v.group], **{v.direction: k})}
            ),
            own,
            step=1e-3,
        )
        for _, v, own in variables
    ]
    k = np.array([own for _, _, own in variables])
    gradient = np.array(gradient)[[i for i, _, _ in variables]]
    scaled = k * gradient, k * np.array(expected)
    assert relative_to_largest(*scaled, over=0).max() < 1e-5


def test_the_least_change_is_a_mean_over_the_rates_that_are_tuned():
    vehicle, doubled = tuned_vehicle(), {}
    groups = tuple(DesignGroup(group.name) for group in vehicle.mount_groups)
    for group in vehicle.mount_groups:
        doubled[group.name] = group.rates.scaled(dict.fromkeys(group.fields, 2.0))
    goal = prepare_goal(vehicle, Problem("p", groups, goal="change"), vehicle.rates, 20.0)
    assert goal.value(doubled) == pytest.approx(np.log(2) ** 2, rel=1e-12)
