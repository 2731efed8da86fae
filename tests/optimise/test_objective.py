import numpy as np
import pytest
from differences import rate_derivatives, relative_to_largest
from mounted_cabin import mounted_cabin
from rounding import CABIN

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.errors import SolveError, VehicleError
from modeviz.optimise.objective import LoadCase, prepare_objective
from modeviz.vehicle.mount_rates import MountRates

FLAT, ROUGH = Conditions("flat", 20.0), Conditions("rough", 25.0)
RATES = {"A": MountRates(2e5, 1e5, 3e5, loss_factor=0.4), "B": MountRates(9e5, 4e5, 2e5)}


@pytest.fixture(scope="module")
def cases():
    (load,) = mounted_cabin().wheel_loads
    return (
        LoadCase(FLAT, (2.0, 7.0, 11.0), weight=3.0),
        LoadCase(load, (7.0, 13.25), weight=0.5),
        LoadCase(ROUGH, (1.0, 11.0 + 1e-12)),
    )


@pytest.fixture(scope="module")
def objective(cases):
    return prepare_objective(mounted_cabin(), cases)


def psd(conditions, frequency_hz):
    """Sum over lines of lateral and vertical."""
    results = solve(prepare(mounted_cabin(), np.array(frequency_hz)), RATES, conditions)
    return results.psd[:, :, 1:].sum()


def test_the_value_is_the_weighted_sum_over_cases_lines_and_directions(objective):
    wheels = solve_wheels(prepare(mounted_cabin(), np.array([7.0, 13.25])), RATES)
    expected = (
        3.0 * psd(FLAT, (2.0, 7.0, 11.0))
        + 0.5 * (wheels.acceleration_g[..., 1:] ** 2).sum()
        + psd(ROUGH, (1.0, 11.0))
    )
    assert objective.value(RATES) == pytest.approx(expected, rel=1e-9)


def test_the_gradient_is_central_differences(objective):
    value, gradient = objective.value_and_gradient(RATES)
    assert value == pytest.approx(objective.value(RATES), rel=CABIN)
    expected = rate_derivatives(objective.value, RATES)
    assert relative_to_largest(gradient, expected, over=0).max() < 1e-6


def test_frequencies_that_cases_share_are_solved_once(objective):
    np.testing.assert_allclose(objective.prepared.frequency_hz, [1.0, 2.0, 7.0, 11.0, 13.25])


def test_without_cases_there_is_no_objective():
    with pytest.raises(SolveError, match="no load cases"):
        prepare_objective(mounted_cabin(), [])


@pytest.mark.parametrize(
    ("frequency_hz", "found"),
    [((0.0, 1.0), "0 Hz at place 1"), ((1.0, 1.0), "1 Hz twice"), ((1.0, np.nan), "nan Hz at place 2"),
     ((2.0, 1.0), "2 Hz before 1 Hz")],
)  # fmt: skip
def test_the_frequencies_of_a_case_are_checked(frequency_hz, found):
    with pytest.raises(SolveError, match=rf"^frequency_hz: found {found}"):
        prepare_objective(mounted_cabin(), [LoadCase(FLAT, frequency_hz)])


def test_a_road_that_is_not_there_is_an_error():
    with pytest.raises(VehicleError, match=r"unknown random load 'moon'.*flat, rough"):
        prepare_objective(mounted_cabin(), [LoadCase(Conditions("moon", 20.0), (1.0,))])
