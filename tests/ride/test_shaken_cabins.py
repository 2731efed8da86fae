"""The cabin on ground that moves its mounts, and on a shaken table that moves its joints, too."""

from dataclasses import replace

import numpy as np
import pytest
from differences import central_difference
from shaken_blocks import cabin_on_table, changed, shaken_cabin

from modeviz.analysis.deflection_shapes import road_shape, wheel_shape
from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import AXIS, Conditions, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.response import direct_response
from modeviz.optimise.goals import prepare_goal
from modeviz.ride.excitation import generalised_forces
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.problem import DesignGroup, Performance, Problem

RANDOM = Conditions("random floor", 20.0)


@pytest.fixture(params=[shaken_cabin, cabin_on_table], ids=["on ground", "on a table"])
def vehicle(request):
    return request.param()


@pytest.mark.parametrize("near", [False, True])
def test_every_way_to_solve_agrees(vehicle, near):
    rates = changed(vehicle)
    prepared = prepare(vehicle).near(rates) if near else prepare(vehicle)
    system = assemble(vehicle.with_rates(rates))
    wheels = solve_wheels(prepared, rates)
    found, f = wheels.acceleration_g, wheels.frequency_hz
    for i, load in enumerate(vehicle.harmonic_loads):
        actions = generalised_forces(system, load, f, vehicle.speed)
        H = direct_response(system, f, actions, prepared.outputs)[:, :, 0]
        expected = np.abs(H) * (2 * np.pi * f[:, None]) ** 2 / STANDARD_GRAVITY
        assert np.abs(found[:, i].reshape(len(f), -1) - expected).max() < 1e-9 * expected.max()
    *_, check = check_exactly(solve(prepared, rates, RANDOM))
    assert check.error < 1e-8


def test_what_is_shown_moving_is_what_the_response_is_of(vehicle):
    rates = changed(vehicle)
    prepared = prepare(vehicle, vehicle.frequency_hz)
    results = solve(prepared, rates, RANDOM)
    omega, line = 2 * np.pi * 9.0, 89
    shapes = road_shape(results, 9.0, 0, "vertical"), wheel_shape(results, "floor", 9.0)
    at_random, harmonic = (np.abs(omega**2 * prepared.outputs @ x) / STANDARD_GRAVITY for x in shapes)
    psd = results.response(0, "vertical")[line]
    assert at_random[AXIS["vertical"]] ** 2 == pytest.approx(psd, rel=1e-8)
    number = [load.name for load in vehicle.harmonic_loads].index("floor")
    peaks = solve_wheels(prepared, rates).acceleration_g[line, number].ravel()
    np.testing.assert_allclose(harmonic, peaks, rtol=1e-8, atol=1e-10 * peaks.max())


def test_a_goal_has_its_true_derivatives(vehicle):
    groups = tuple(DesignGroup(g.name) for g in vehicle.mount_groups)
    performance = Performance(np.arange(2.0, 20.0), ("random floor",), ("floor", "fan"), ("seat",))
    goal = prepare_goal(vehicle, Problem("p", groups, (performance,)), vehicle.rates, 20.0)
    rates = changed(vehicle)
    value, gradient = goal.value_and_gradient(rates)
    assert goal.exact_value(rates) == pytest.approx(value, rel=1e-8)
    group = vehicle.mount_groups[0].name
    expected = central_difference(
        lambda k: goal.value({**rates, group: replace(rates[group], vertical=k)}),
        rates[group].vertical,
        step=1e-3,
    )
    assert gradient[0] == pytest.approx(expected, rel=1e-6)
