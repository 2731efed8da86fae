"""Integrals over loads whose spectra change between the lines of the band."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from road_oscillator import LEVEL, oscillator, transmitted

from modeviz.analysis.batch import solve_many
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, Results, drive, solve
from modeviz.optimise.goals import prepare_goal
from modeviz.ride.averaging import averaged_spectrum
from modeviz.ride.roads import road_spectrum
from modeviz.scatter.monte_carlo import scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint, Road, Spectrum
from modeviz.vehicle.problem import DesignGroup, Problem
from modeviz.vehicle.vehicle import Vehicle

ROAD_SPEED = 20.0
"""m/s, of the table."""
KMH = 1 / 3.6


def humped_road() -> Road:
    """Humps every 3 m on both tracks: at 20 m/s spikes 6.7 Hz apart and 0.3 Hz wide."""
    f = np.arange(1, 3001) * 0.05
    spikes = sum(np.exp(-(((f - 20 / 3 * n) / 0.2) ** 2)) for n in range(1, 20))
    power = 1e-6 * (0.05 + spikes) / f**2
    spectrum = np.zeros((len(f), 2, 2))
    spectrum[:, 0, 0], spectrum[:, 1, 1] = power, 2 * power
    spectrum[:, 0, 1] = spectrum[:, 1, 0] = power
    return Road("road", "Road", ROAD_SPEED, f, spectrum)


def acceleration_of(road: Road, f: np.ndarray, speed: float) -> np.ndarray:
    """PSD of the right track's acceleration, g²/Hz."""
    height = road_spectrum(road, f, speed)[:, 1, 1].real
    return height * (2 * np.pi * f) ** 4 / STANDARD_GRAVITY**2


@pytest.mark.parametrize("kmh", [3, 5, 10, 20, 72])
def test_a_road_met_slowly_has_its_exact_rms(kmh):
    """Summed at 200 000 places, where the lines of the band are up to 40 times as far apart."""
    natural_hz, zeta, speed = 1.55, 0.05, kmh * KMH
    road = humped_road()
    vehicle = replace(oscillator(natural_hz, zeta), roads=(road,))
    results = solve(prepare(vehicle), {}, Conditions("road", speed))
    f = np.linspace(*results.drive.known, 200_001)
    through = transmitted(f, natural_hz, zeta) / LEVEL
    expected = np.trapezoid(through * acceleration_of(road, f, speed), f)
    assert results.rms[0, 2] == pytest.approx(np.sqrt(expected), rel=1e-3)


@pytest.mark.parametrize("kmh", [2, 5, 10])
def test_lines_resolve_what_lies_between_the_axles(kmh):
    """Eight lines a turn of 2πfτ, the lines of the band among them."""
    cabin, speed = replace(mounted_cabin(), roads=(humped_road(),)), kmh * KMH
    lines = drive(prepare(cabin), Conditions("road", speed)).frequency_hz
    wheelbase = np.ptp([tyre.points[1, 0] for tyre in cabin.tyres])
    assert np.diff(lines).max() <= speed / wheelbase / 8
    known = cabin.frequency_hz[cabin.frequency_hz <= 150 * speed / ROAD_SPEED]
    assert set(known) <= set(lines)


@pytest.mark.parametrize("kmh", [2, 5, 10, 20])
def test_a_vehicle_with_two_axles_has_the_rms_of_very_fine_lines(kmh):
    cabin, conditions = replace(mounted_cabin(), roads=(humped_road(),)), Conditions("road", kmh * KMH)
    prepared = prepare(cabin)
    results = solve(prepared, {}, conditions)
    low, high = results.drive.known
    fine = solve(prepared.on(np.linspace(low, high, 40_001)), {}, conditions)
    expected = np.sqrt(np.trapezoid(fine.psd, fine.frequency_hz, axis=0))
    np.testing.assert_allclose(results.rms, expected, rtol=1e-3, atol=1e-9)


def free_mass(spectrum: Spectrum) -> Vehicle:
    """A mass that hardly anything holds, pushed up by a force."""
    held = oscillator(0.2, 0.3)
    (body,) = held.bodies
    force = Force("push", "wheel", body.center_of_gravity, np.array([0.0, 0.0, 1.0]), spectrum)
    point = ResponsePoint("hub", "wheel", body.center_of_gravity)
    return replace(held, roads=(), forces=(force,), response_points=(point,))


def accelerance(f: np.ndarray, mass: float) -> np.ndarray:
    """|a / F|² of the mass, 1/kg²."""
    r = f / 0.2
    return r**4 / ((1 - r**2) ** 2 + (0.6 * r) ** 2) / mass**2


@pytest.mark.parametrize("width", [0.3, 0.06])
@pytest.mark.parametrize("at", [12.0, 12.04])
def test_a_spike_narrower_than_the_lines_counts_in_full(width, at):
    f = np.union1d(np.linspace(0.05, 50, 200), np.linspace(at - 4 * width, at + 4 * width, 161))
    power = 1e-4 + np.exp(-(((f - at) / width) ** 2))
    vehicle = free_mass(Spectrum(f, power))
    results = solve(prepare(vehicle), {}, Conditions("push", 20.0))
    fine = np.linspace(0.1, 40, 400_001)
    S = np.exp(np.interp(np.log(fine), np.log(f), np.log(power)))
    expected = np.trapezoid(accelerance(fine, vehicle.bodies[0].mass) * S, fine)
    assert results.rms[0, 2] * STANDARD_GRAVITY == pytest.approx(np.sqrt(expected), rel=1e-3)


TABLES = {
    "notch": ([0.05, 1.4499, 1.45, 1.55, 1.5501, 50.0], [1.0, 1.0, 1e-3, 1e-3, 1.0, 1.0]),
    "spike": ([0.05, 1.4929, 1.493, 1.513, 1.5131, 50.0], [1.0, 1.0, 100.0, 100.0, 1.0, 1.0]),
    "far spike": ([0.05, 20.0229, 20.023, 20.043, 20.0431, 50.0], [1e-6, 1e-6, 1.0, 1.0, 1e-6, 1e-6]),
}


@pytest.mark.parametrize("zeta", [0.001, 0.005, 0.03])
@pytest.mark.parametrize("table", TABLES)
def test_what_a_table_says_beside_a_sharp_resonance_counts_in_full(table, zeta):
    """Acceleration of the ground under an oscillator, integrated at places that graze every corner."""
    known, power = (np.array(values) for values in TABLES[table])
    held = oscillator(1.5, zeta)
    motion = BaseMotion("shake", np.array([0.0, 0.0, 1.0]), "acceleration", Spectrum(known, power))
    vehicle = replace(held, roads=(), base_motions=(motion,))
    results = solve(prepare(vehicle), {}, Conditions("shake", 20.0))
    near = 1.5 * (1 + zeta * np.sinh(np.linspace(-9, 9, 200_001)))
    f = np.unique(np.concatenate([np.linspace(0.1, 40, 400_001), near, known]))
    f = f[(f >= 0.1) & (f <= 40)]
    S = np.exp(np.interp(np.log(f), np.log(known), np.log(power)))
    expected = np.trapezoid(transmitted(f, 1.5, zeta) / LEVEL * S, f)
    found = results.rms[0, 2] * STANDARD_GRAVITY
    assert found == pytest.approx(np.sqrt(expected), rel=1e-3)


def test_where_a_table_is_smooth_an_average_is_the_spectrum():
    load = oscillator(1.5, 0.01).roads[0]
    lines = np.arange(10, 400) / 10
    np.testing.assert_allclose(
        averaged_spectrum(load, lines, 20.0)[6:-6, 1, 1],
        road_spectrum(load, lines, 20.0)[6:-6, 1, 1],
        rtol=2e-4,
    )


def test_a_steep_slope_at_the_first_line_counts_in_full():
    """White acceleration over f² of ground under a stiff oscillator: ∫ f⁻² = 1/f₁ - 1/f₂."""
    vehicle = oscillator(60.0, 0.5, slope=-2.0)
    results = solve(prepare(vehicle), {}, Conditions("road", 20.0))
    f = np.linspace(0.1, 40, 400_001)
    expected = np.trapezoid(transmitted(f, 60.0, 0.5, -2.0), f)
    assert results.rms[0, 2] ** 2 == pytest.approx(expected, rel=2e-3)


@pytest.fixture(scope="module")
def slow() -> tuple[Vehicle, Conditions, Results]:
    """A cabin on that road at 10 km/h."""
    cabin = replace(mounted_cabin(), roads=(humped_road(),))
    conditions = Conditions("road", 10 * KMH)
    return cabin, conditions, solve(prepare(cabin), {}, conditions)


def test_batches_goals_and_scatter_hold_it_too(slow):
    cabin, conditions, results = slow
    prepared = prepare(cabin)
    (batch,) = solve_many(prepared, prepared.mount_stiffness({})[None], conditions)
    np.testing.assert_allclose(batch.rms[0], results.rms, rtol=1e-6)
    problem = Problem("quiet", (DesignGroup("A"),), goal="rms", is_normalised=False)
    goal = prepare_goal(cabin, problem, cabin.rates, conditions.speed)
    assert goal.value({}) == pytest.approx((results.rms[0, 1:] ** 2).sum(), rel=1e-6)
    parts = scattered_parts(prepared, {}, Tolerance(rates=1e-6, loss_factor=1e-6))
    scattered = scatter(prepared, parts, conditions, goal, 3)
    np.testing.assert_allclose(scattered.rms[:, 0], [results.rms[0]] * 3, rtol=1e-3)
    np.testing.assert_allclose(scattered.goal, goal.value({}), rtol=2e-3)
