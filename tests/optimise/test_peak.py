"""Min-max: J. P. Den Hartog's absorber, found by the optimiser that tunes the truck."""

from dataclasses import replace

import numpy as np
import pytest
from absorber import (
    FIXED_POINTS,
    MASS,
    OPTIMAL_DAMPING,
    TUNED,
    absorber,
    amplification,
)
from cabin_problem import cabin_search
from limits_kept import excess
from rounding import CABIN, assert_near
from scipy.optimize import brentq, minimize_scalar

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.run import optimise
from modeviz.optimise.search import prepare_search
from modeviz.optimise.starts import start_points
from modeviz.scatter.monte_carlo import scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.loads import BaseMotion, ResponsePoint, Spectrum
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle

X = np.array([0.3, 0.1, -0.2, 0.4])


def absorber_search(damping=OPTIMAL_DAMPING, group=None):
    vehicle = absorber(damping)
    (problem,) = vehicle.problems
    if group:
        problem = replace(problem, groups=(group,))
    return prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)


def found(search, n_starts=3):
    return optimise(search, start_points(search, {}, n_starts))


@pytest.fixture(scope="module")
def optimum():
    return found(absorber_search())


def test_the_absorber_is_tuned_as_den_hartog_says(optimum):
    stiffness = optimum.rates["absorber"].vertical
    assert optimum.converged
    assert stiffness == pytest.approx(TUNED, rel=1e-3)
    assert np.sqrt(optimum.value) == pytest.approx(6.41, abs=0.005)
    assert np.sqrt(optimum.value) == pytest.approx(FIXED_POINTS, rel=1e-3)
    assert optimum.verification.difference < 1e-9
    assert optimum.evaluations < 40  # a wrong derivative of the auxiliary variable takes 57


def two_peaks(stiffness):
    """Of two masses, below and above the dip at 9.7 Hz."""
    found = (
        minimize_scalar(lambda f: -amplification(f, stiffness), bounds=bounds, options={"xatol": 1e-10})
        for bounds in ((8.5, 9.7), (9.7, 11.0))
    )
    return np.array([-float(one.fun) for one in found])


def test_its_peak_is_that_of_two_masses(optimum):
    peaks = two_peaks(optimum.rates["absorber"].vertical)
    assert np.sqrt(optimum.value) == pytest.approx(peaks.max(), rel=1e-9)
    equal = brentq(lambda k: np.diff(two_peaks(k * TUNED))[0], 0.95, 1.05, xtol=1e-12)
    assert optimum.rates["absorber"].vertical == pytest.approx(equal * TUNED, rel=1e-7)


def test_its_two_peaks_are_as_high(optimum):
    low, high = two_peaks(optimum.rates["absorber"].vertical)
    assert low == pytest.approx(high, rel=1e-8)


@pytest.mark.parametrize("factor", [0.8, 1.25])
def test_with_other_damping_the_best_peak_is_higher(optimum, factor):
    other = found(absorber_search(factor * OPTIMAL_DAMPING))
    assert other.value > 1.02 * optimum.value


def test_a_peak_has_the_derivatives_of_its_largest_square():
    search = cabin_search(goal="peak")
    value, gradient = search.evaluate(X)
    squares, gradients = search.parts(X)
    assert value == pytest.approx(search.value(X), rel=1e-12)
    assert value == pytest.approx(squares.max(), rel=CABIN)
    assert_near(gradient, gradients[squares.argmax()], CABIN, lines=-1)


def test_of_normalised_cases_the_largest_is_one_with_the_original_rates():
    search = cabin_search(goal="peak")
    assert search.goal.value({}) == pytest.approx(1.0, rel=1e-12)
    cases = search.goal.values({})
    np.testing.assert_allclose(cases, [0.5, 1.0], rtol=1e-12)


def test_the_gain_of_a_limit_is_what_relaxing_it_takes_off_the_peak():
    def limited(factor):
        bounds = MountRates(0.1 * TUNED, 1e4, 1e4), MountRates(0.9 * factor * TUNED, 1e6, 1e6)
        return absorber_search(group=DesignGroup("absorber", ("vertical",), bounds))

    at, relaxed = found(limited(1.0)), found(limited(1.001))
    (limit,) = at.active
    assert limit.name == "absorber vertical: upper bound"
    gained = (at.value - relaxed.value) / at.value
    assert limit.gain * np.log(1.001) / np.log(1.1) == pytest.approx(gained, rel=1e-2)


def test_nothing_near_a_smallest_peak_is_smaller():
    search = cabin_search(goal="peak")
    best = found(search)
    assert best.converged
    assert best.value < 0.9
    assert excess(search.space, best.x) < 1e-12
    random = np.random.default_rng(0)
    for size in (1e-1, 1e-2, 1e-3):
        for move in random.normal(scale=size, size=(30, 4)):
            assert search.value(search.space.admitted(best.x + move)) >= best.value


SHARP = 1e-3
"""Damping ratio: a peak is 500 times the ground's motion, within 0.02 Hz."""

ONE_G = 9.80665


def hung(natural_hz, frequency_hz, damping_ratio=SHARP, **fields):
    """A mass on a mount whose ground shakes with 1 g, and the peak of its acceleration as a goal."""
    omega = 2 * np.pi * natural_hz
    body = RigidBody("mass", "cabin", "mass", MASS, np.zeros(3), np.eye(3))
    mount = Mount(
        "mount",
        "hanger",
        ("mass", GROUND),
        np.zeros((2, 3)),
        rotational_stiffness=np.full(3, 1e4),
        damping=np.array([0.0, 0, 2 * damping_ratio * MASS * omega]),
    )
    rates = MountRates(stiffness_of(natural_hz), 1e6, 1e6)
    bounds = MountRates(1e4, 1e5, 1e5), MountRates(1e8, 1e7, 1e7)
    f = np.array([1.0, 10.03, 100.0])
    random = Spectrum(f, ONE_G**2 * np.array([1.0, 3.0, 0.5]))
    loads = {} if "roads" in fields else {"wheel_loads": ("shaker",)}
    problem = Problem(
        "hung",
        (DesignGroup("hanger", ("vertical",)),),
        (Performance(np.asarray(frequency_hz), directions=("vertical",), **loads, **fields),),
        goal="peak",
        is_normalised=False,
    )
    vehicle = Vehicle(
        "hung",
        (body,),
        (),
        (MountGroup("hanger", "hanger", rates, 0.0, bounds, (mount,)),),
        response_points=(ResponsePoint("mass", "mass", np.zeros(3)),),
        base_motions=(
            BaseMotion("shaker", np.array([0.0, 0, 1]), "acceleration", ONE_G),
            BaseMotion("noise", np.array([0.0, 0, 1]), "acceleration", random),
        ),
        problems=(problem,),
    )
    return vehicle, prepare_goal(vehicle, problem, vehicle.rates, vehicle.speed)


def stiffness_of(natural_hz):
    return MASS * (2 * np.pi * natural_hz) ** 2


def square(frequency_hz, natural_hz, damping_ratio=SHARP):
    """|T|² of a shaken mass: (1 + (2ζr)²) / ((1 - r²)² + (2ζr)²)."""
    r, z = frequency_hz / natural_hz, 2 * damping_ratio
    return (1 + (z * r) ** 2) / ((1 - r**2) ** 2 + (z * r) ** 2)


def summit(natural_hz, damping_ratio=SHARP):
    """Its largest: at r² = (√(1 + 8ζ²) - 1)/(4ζ²)."""
    r = np.sqrt((np.sqrt(1 + 8 * damping_ratio**2) - 1) / (4 * damping_ratio**2))
    return square(r * natural_hz, natural_hz, damping_ratio)


@pytest.mark.parametrize("natural_hz", [9.0, 10.0, 10.17, 10.5, 12.9])
@pytest.mark.parametrize("damping_ratio", [1e-3, 3e-3, 3e-2, 0.1])
def test_a_resonance_between_listed_frequencies_counts(natural_hz, damping_ratio):
    _, goal = hung(natural_hz, [6.0, 8.0, 11.0, 14.0], damping_ratio)
    assert goal.value({}) == pytest.approx(summit(natural_hz, damping_ratio), rel=1e-6)
    assert goal.exact_value({}) == pytest.approx(goal.value({}), rel=1e-6)


def test_of_a_resonance_beyond_the_range_its_slope_counts():
    _, goal = hung(10.0, [10.05, 14.0])
    assert goal.value({}) == pytest.approx(square(10.05, 10.0), rel=1e-6)
    assert goal.value_and_gradient({})[0] == goal.value({})


def test_a_single_frequency_stays_that_frequency():
    _, goal = hung(10.0, [10.1])
    assert goal.value({}) == pytest.approx(square(10.1, 10.0), rel=1e-6)
    _, two = hung(10.0, [10.1, 10.2])
    assert two.value({}) == pytest.approx(square(10.1, 10.0), rel=1e-6)


@pytest.mark.parametrize("natural_hz", [10.0, 10.17])
def test_the_height_has_the_derivatives_of_the_number_shown(natural_hz):
    """To 1e-4 though the peak moves by 500 of its half widths as the rate doubles."""
    vehicle, goal = hung(natural_hz, [6.0, 14.0])
    k = vehicle.rates["hanger"].vertical

    def value(k):
        return goal.value({"hanger": MountRates(k, 1e6, 1e6)})

    _, gradient = goal.value_and_gradient({})
    numerical = (value(k * 1.001) - value(k * 0.999)) / (0.002 * k)
    assert gradient[0] == pytest.approx(numerical, rel=1e-4)


def test_a_resonance_cannot_be_hidden_between_two_lines():
    """Of lines at 8 and 12 Hz the best is near 10 Hz, with the peak between them; of the range it is
    the stiffest, with the peak above."""
    vehicle, _ = hung(11.0, [8.0, 12.0])
    (problem,) = vehicle.problems
    bounds = tuple(MountRates(stiffness_of(f), 1e6, 1e6) for f in (9.0, 12.5))
    group = DesignGroup("hanger", ("vertical",), bounds)
    search = prepare_search(vehicle, replace(problem, groups=(group,)), vehicle.rates, vehicle.speed)
    best = found(search, 4)
    assert best.value == pytest.approx(square(12.0, 12.5, SHARP * 11 / 12.5), rel=1e-6)


def test_a_spectrum_has_its_peaks_at_its_own_lines():
    """Away from the resonance the response follows the noise, which is largest at 10.03 Hz."""
    _, goal = hung(60.0, [6.0, 14.0], 0.02, roads=("noise",))
    assert goal.value({}) == pytest.approx(3 * square(10.03, 60.0, 0.02), rel=1e-6)


def test_what_falls_short_of_its_target_counts():
    _, goal = hung(10.0, [20.0, 30.0], target=5.0)
    assert goal.value({}) == pytest.approx((np.sqrt(square(30.0, 10.0)) - 5) ** 2, rel=1e-6)


@pytest.mark.parametrize("damping_ratio", [1e-3, 1e-2, 5e-2])
def test_scattered_peaks_are_those_of_each_vehicle_by_itself(damping_ratio):
    """Squares to twice 0.1 %, wherever between shared lines each vehicle's peak is."""
    vehicle, goal = hung(10.0, [6.0, 14.0], damping_ratio)
    prepared = prepare(vehicle)
    parts = scattered_parts(prepared, {}, Tolerance())
    found = scatter(prepared, parts, Conditions("noise", 20.0), goal, 50, points=["mass"])
    expected = goal.totals(parts.stiffness(found.deviations))
    np.testing.assert_allclose(found.goal, expected, rtol=2e-3)
