"""Integrals, goals and peaks of vehicles that hardly damp their modes."""

from dataclasses import replace

import numpy as np
import pytest
from differences import central_difference
from mounted_cabin import mounted_cabin
from road_oscillator import LEVEL, oscillator, transmitted

from modeviz.analysis.batch import solve_many
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.sensitivity import rate_variables, ride_sensitivity
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.optimise.goals import prepare_goal
from modeviz.ride.psd import rms
from modeviz.ride.rating import squared_weights
from modeviz.scatter.monte_carlo import scatter
from modeviz.scatter.robust import robust
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.loads import Road
from modeviz.vehicle.problem import DesignGroup, Problem
from modeviz.vehicle.vehicle import Vehicle

ROAD = Conditions("road", 20.0)


def exact(natural_hz, zeta, slope=0.0, band=(0.1, 40.0), weights=np.ones_like) -> float:
    """Its mean square over a band: f = f_n + ζ f_n sinh u makes all of it smooth."""
    ends = np.arcsinh((np.array(band) - natural_hz) / (zeta * natural_hz))
    u = np.linspace(*ends, 40_001)
    f = natural_hz * (1 + zeta * np.sinh(u))
    S = weights(f) * transmitted(f, natural_hz, zeta, slope)
    return float(np.trapezoid(S * zeta * natural_hz * np.cosh(u), u))


@pytest.mark.parametrize("slope", [0.0, 2.0])
@pytest.mark.parametrize("zeta", [0.001, 0.005, 0.05])
@pytest.mark.parametrize("natural_hz", [1.5, 1.55, 12.345, 30.002])
def test_an_oscillator_has_its_exact_rms_wherever_it_is_between_lines(natural_hz, zeta, slope):
    results = solve(prepare(oscillator(natural_hz, zeta, slope)), {}, ROAD)
    assert results.rms[0, 2] ** 2 == pytest.approx(exact(natural_hz, zeta, slope), rel=1e-3)


@pytest.mark.parametrize("zeta", [0.001, 0.01])
def test_the_rms_is_the_closed_form_of_white_ground(zeta):
    """(π/2) f_n W (1 + 4ζ²) / 2ζ, less W times what of (1 - (f/f_n)²)⁻² lies out of the band."""
    natural_hz = 9.97
    results = solve(prepare(oscillator(natural_hz, zeta)), {}, ROAD)
    closed = np.pi / 2 * natural_hz * LEVEL * (1 + 4 * zeta**2) / (2 * zeta)
    beyond = LEVEL * (0.1 + natural_hz**4 / (3 * 40.0**3))
    assert results.rms[0, 2] ** 2 == pytest.approx(closed - beyond, rel=1e-3)


def test_bands_whose_ends_cut_a_peak_hold():
    natural_hz, zeta = 12.345, 0.001
    results = solve(prepare(oscillator(natural_hz, zeta)), {}, ROAD)
    for band in ((5.0, natural_hz), (natural_hz - 0.01, 20.0), (12.3, 12.4), (1.0, 12.0)):
        found = rms(results.frequency_hz, results.response(0, "vertical"), band)
        assert found**2 == pytest.approx(exact(natural_hz, zeta, band=band), rel=1e-3)


def test_the_rating_and_the_weighted_value_are_exact_too():
    natural_hz, zeta = 5.03, 0.002
    rating = solve(prepare(oscillator(natural_hz, zeta)), {}, ROAD).rating
    combined = np.sqrt(exact(natural_hz, zeta))
    assert rating.combined_g == pytest.approx(combined, rel=5e-4)
    assert rating.mean_personal_rating == pytest.approx(10.9 - 80 * combined, rel=1e-3)
    weighted = exact(natural_hz, zeta, weights=lambda f: squared_weights(f)[:, 2])
    assert rating.weighted_rms[2] == pytest.approx(np.sqrt(weighted) * STANDARD_GRAVITY, rel=5e-4)


@pytest.mark.parametrize("natural_hz", [1.55, 12.345, 30.002])
@pytest.mark.parametrize("zeta", [0.001, 0.004])
def test_the_spectrum_reaches_the_height_of_the_peak(natural_hz, zeta):
    results = solve(prepare(oscillator(natural_hz, zeta)), {}, ROAD)
    near = natural_hz * np.linspace(1 - zeta, 1 + zeta, 2001)
    height = transmitted(near, natural_hz, zeta).max()
    assert results.response(0, "vertical").max() == pytest.approx(height, rel=0.015)
    (peak,) = results.peaks(0, "vertical", 1)
    assert peak.frequency_hz == pytest.approx(natural_hz, rel=zeta / 5)


def light_cabin() -> Vehicle:
    """The cabin with modes damped by 0.1 to 0.2 percent."""
    cabin = mounted_cabin()
    tyres = tuple(replace(t, damping=np.full(3, 20.0)) for t in cabin.tyres)
    groups = tuple(replace(g, loss_factor=0.003) for g in cabin.mount_groups)
    f = np.geomspace(1e-3, 1e3, 50)
    spectrum = np.zeros((50, 2, 2))
    spectrum[:, 0, 0], spectrum[:, 1, 1] = 1e-5 / f**2, 2e-5 / f**2
    return replace(
        cabin, connections=tyres, mount_groups=groups, roads=(Road("road", "Road", 20.0, f, spectrum),)
    )


@pytest.fixture(scope="module")
def cabin() -> Vehicle:
    return light_cabin()


@pytest.fixture(scope="module")
def prepared(cabin):
    return prepare(cabin)


def fine_rms(vehicle: Vehicle, rates) -> np.ndarray:
    """By lines a third of the sharpest half width apart, wherever a mode may be felt."""
    modes = solve(prepare(vehicle, np.array([5.0, 9.0])), rates, ROAD).modes
    gamma = modes.damping_ratio * modes.frequency_hz
    near = [
        np.clip(f + g * np.sinh(np.linspace(-8, 8, 300)), 0.1, 40)
        for f, g in zip(modes.frequency_hz, gamma, strict=True)
        if f > 0.1
    ]
    f = np.unique(np.round(np.concatenate([np.linspace(0.1, 40, 400), *near]), 9))
    results = solve(prepare(vehicle, f), rates, ROAD)
    mean_square = np.trapezoid(results.psd, f, axis=0)
    return np.sqrt(mean_square)


@pytest.mark.parametrize("factor", [1.0, 1.013, 0.7])
def test_a_lightly_damped_vehicle_has_the_rms_of_very_fine_lines(cabin, prepared, factor):
    rates = {"A": replace(cabin.rates["A"], vertical=factor * cabin.rates["A"].vertical)}
    expected = fine_rms(cabin, rates)
    for way in (prepared, prepared.near(rates), prepared.near({})):
        np.testing.assert_allclose(solve(way, rates, ROAD).rms, expected, rtol=1e-3)


def test_batches_goals_and_the_ride_agree(cabin, prepared):
    rates = {"A": replace(cabin.rates["A"], lateral=4e5)}
    results = solve(prepared, rates, ROAD)
    (batch,) = solve_many(prepared, prepared.mount_stiffness(rates)[None], ROAD)
    np.testing.assert_allclose(batch.rms[0], results.rms, rtol=1e-6)
    goal = prepare_goal(cabin, rms_problem(), cabin.rates, 20.0)
    assert goal.value(rates) == pytest.approx((results.rms[0, 1:] ** 2).sum(), rel=1e-6)


def rms_problem() -> Problem:
    return Problem("quiet", (DesignGroup("A"),), goal="rms", is_normalised=False)


def test_derivatives_are_those_of_the_numbers_shown(cabin, prepared):
    rates = {"A": replace(cabin.rates["A"], lateral=4e5)}
    goal = prepare_goal(cabin, rms_problem(), cabin.rates, 20.0)
    value, gradient = goal.value_and_gradient(rates)
    assert value == pytest.approx(goal.value(rates), rel=1e-12)
    found = ride_sensitivity(prepared, rates, ROAD).rms[0, 2]
    for i, variable in enumerate(rate_variables(cabin)):

        def changed(k, variable=variable):
            own = cabin.all_rates(rates)[variable.group]
            return {**rates, variable.group: replace(own, **{variable.direction: k})}

        at = getattr(cabin.all_rates(rates)[variable.group], variable.direction)
        slope = central_difference(lambda k: goal.value(changed(k)), at, step=1e-6)
        assert gradient[i] == pytest.approx(slope, rel=1e-3, abs=1e-4 * np.abs(gradient).max())
        slope = central_difference(lambda k: solve(prepared, changed(k), ROAD).rms[0, 2], at, step=1e-6)
        assert found[i] == pytest.approx(slope, rel=1e-3, abs=1e-4 * np.abs(found).max())


def test_scattered_vehicles_have_the_rms_of_their_own_lines(cabin, prepared):
    parts = scattered_parts(prepared, {}, Tolerance(rates=0.05, loss_factor=0.1))
    goal = prepare_goal(cabin, rms_problem(), cabin.rates, 20.0)
    result = scatter(prepared, parts, ROAD, goal, 6)
    stiffness = parts.stiffness(result.deviations)
    (batch,) = solve_many(prepared, stiffness, ROAD)
    np.testing.assert_allclose(result.rms[:, 0], batch.rms[:, 0], rtol=1e-3)
    np.testing.assert_allclose(result.goal, goal.totals(stiffness), rtol=2e-3)


def test_a_robust_percentile_has_its_own_derivatives(cabin, prepared):
    goal = robust(prepare_goal(cabin, rms_problem(), cabin.rates, 20.0), Tolerance(), n_samples=6)
    rates = {"A": replace(cabin.rates["A"], lateral=4e5)}
    value, gradient = goal.value_and_gradient(rates)
    assert value == pytest.approx(goal.value(rates), rel=1e-9)
    slope = central_difference(
        lambda k: goal.value({"A": replace(rates["A"], lateral=k)}), 4e5, step=1e-6
    )
    at = [(v.group, v.direction) for v in rate_variables(cabin)].index(("A", "lateral"))
    assert gradient[at] == pytest.approx(slope, rel=1e-3)


def test_wheel_loads_show_resonances_between_the_lines_at_their_height(cabin, prepared):
    wheels = solve_wheels(prepared, {})
    shifted = [wheels.frequency_hz * (1 + d) for d in (-2e-4, 0, 2e-4)]
    f = np.unique(np.clip(np.concatenate(shifted), 0.1, 40))
    closer = solve_wheels(prepare(cabin, f), {})
    np.testing.assert_allclose(
        wheels.acceleration_g.max(axis=0), closer.acceleration_g.max(axis=0), rtol=0.02
    )
