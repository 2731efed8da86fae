"""An absorber's rate and damping as variables of the optimiser."""

from dataclasses import replace

import numpy as np
import pytest
from absorber import MAIN_HZ, MASS, MASS_RATIO, STIFFNESS, absorber, amplification
from cabin_problem import PROBLEM
from differences import central_difference
from mounted_cabin import mounted_cabin

from modeviz.analysis.sensitivity import rate_variables
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.run import optimise
from modeviz.optimise.search import prepare_search
from modeviz.optimise.starts import start_points
from modeviz.vehicle.absorber import Absorber, den_hartog
from modeviz.vehicle.absorber_parts import absorbers_of
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.problem import DesignGroup

SOUGHT = "vertical", "damping_vertical"
SEAT = Absorber("seat", "cab", (1.2, -0.4, 0.9), 12.0, 11.0, 0.1)


@pytest.fixture(scope="module")
def vehicle():
    return with_absorbers(mounted_cabin(), [SEAT])


@pytest.mark.parametrize("field", ["vertical", "damping_vertical"])
@pytest.mark.parametrize("goal", ["accelerations", "peak"])
def test_derivatives_by_its_rates_are_those_of_differences(vehicle, goal, field):
    worth = prepare_goal(vehicle, replace(PROBLEM, goal=goal), vehicle.rates, vehicle.speed)
    own = vehicle.rates["seat"]
    number = [(v.group, v.direction) for v in rate_variables(vehicle)].index(("seat", field))
    found = worth.value_and_gradient({})[1][number]
    expected = central_difference(
        lambda rate: worth.value({"seat": replace(own, **{field: rate})}), getattr(own, field), 1e-3
    )
    assert found != 0
    assert found == pytest.approx(expected, rel=1e-5)


def test_its_rate_alone_is_what_a_search_chooses(vehicle):
    problem = replace(PROBLEM, groups=(DesignGroup("seat", ("vertical",)),), reference="")
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    (variable,) = search.space.variables
    assert (variable.group, variable.fields) == ("seat", ("vertical",))
    space = search.space
    low, high = (space.rates(ends)["seat"] for ends in (space.lower, space.upper))
    # half its frequency to twice it
    assert low.vertical == pytest.approx(vehicle.rates["seat"].vertical / 4)
    assert high.vertical == pytest.approx(4 * vehicle.rates["seat"].vertical)
    assert low.lateral == high.fore_aft == 0


def test_the_optimiser_finds_its_rate_and_damping_as_theory_does():
    """Of a mass shaken on a spring: the exact optimum is near J. P. Den Hartog's.

    (O. Nishihara and T. Asami, "Closed-form solutions to the exact optimizations of dynamic vibration
    absorbers (minimizations of the maximum amplitude magnification factors)", J. Vib. Acoust. 124(4),
    2002.)
    """
    shaken = main_on_the_shaker()
    off = Absorber("small", "main", (0.0, 0.0, 0.0), MASS_RATIO * MASS, 0.9 * MAIN_HZ, 0.06)
    vehicle = with_absorbers(shaken, [off])
    (problem,) = absorber().problems
    problem = replace(problem, groups=(DesignGroup("small"),))
    search = prepare_search(vehicle, problem, vehicle.rates, vehicle.speed)
    assert [field for v in search.space.variables for field in v.fields] == list(SOUGHT)
    found = optimise(search, start_points(search, {}, 1))
    (tuned,) = absorbers_of(vehicle.with_rates(found.rates))
    frequency_hz, damping_ratio, peak = exact_optimum(MASS_RATIO)
    assert found.converged
    # flat at the optimum as it is, the peaks are what is met, both at once
    assert np.sqrt(found.value) == pytest.approx(peak, rel=1e-6)
    assert tuned.frequency_hz == pytest.approx(MAIN_HZ * frequency_hz, rel=1e-4)
    assert tuned.damping_ratio == pytest.approx(damping_ratio, rel=1e-2)
    near = den_hartog(MASS_RATIO, MAIN_HZ)
    assert tuned.frequency_hz == pytest.approx(near.frequency_hz, rel=1e-3)
    assert tuned.damping_ratio == pytest.approx(near.damping_ratio, rel=1e-2)


def main_on_the_shaker():
    """The main mass of `absorber`, without what is on it."""
    whole = absorber()
    main, _ = whole.bodies
    return replace(whole, bodies=(main,), mount_groups=(), problems=())


def exact_optimum(mass_ratio):
    """Its frequency by that of the main mass, its damping ratio, and the peak by what is static."""
    m, root = mass_ratio, np.sqrt(4 + 3 * mass_ratio)
    inner = 16 + 23 * m + 9 * m**2 + 2 * (2 + m) * root
    frequency = 2 / (1 + m) * np.sqrt(2 * inner / (3 * (64 + 80 * m + 27 * m**2)))
    damping = np.sqrt((8 + 9 * m - 4 * root) / (1 + m)) / 4
    stiffness = m * STIFFNESS * frequency**2
    c = 2 * damping * m * MASS * 2 * np.pi * MAIN_HZ * frequency
    f = np.linspace(8, 12, 400_001)
    return frequency, damping, amplification(f, stiffness, c).max()
