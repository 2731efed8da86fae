import threading

import numpy as np
import pytest
from scattered_cabin import FLAT, cabin_objective, prepared_cabin

from modeviz.analysis.batch import solve_many
from modeviz.analysis.results import solve
from modeviz.compute.cancel import CancelledError, CancelToken
from modeviz.errors import SolveError, VehicleError
from modeviz.optimise.peak import prepare_peak
from modeviz.scatter.monte_carlo import CHUNK, scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts

N_SAMPLES = 2 * CHUNK + 50


@pytest.fixture(scope="module")
def prepared():
    return prepared_cabin()


@pytest.fixture(scope="module")
def objective():
    return cabin_objective()


@pytest.fixture(scope="module")
def parts(prepared):
    return scattered_parts(prepared, {}, Tolerance())


@pytest.fixture(scope="module")
def result(prepared, parts, objective):
    return scatter(prepared, parts, FLAT, objective, N_SAMPLES, seed=3, points=("seat", "rear"))


def test_every_sample_is_the_ride_of_its_parts(prepared, parts, result):
    (batch,) = solve_many(prepared, parts.stiffness(result.deviations), FLAT)
    np.testing.assert_allclose(result.rms, batch.rms, rtol=1e-4)
    off = np.abs(result.psd / batch.psd - 1).max()
    assert off < 5e-3
    assert result.psd_error < 5e-3
    np.testing.assert_allclose(result.mean_personal_rating, batch.mean_personal_rating, rtol=1e-3)


def test_every_goal_is_the_objective_of_its_parts(parts, objective, result):
    stiffness = parts.stiffness(result.deviations[:20])
    shares = np.zeros((stiffness.shape[1], 0))
    expected = [objective.of_springs(k, shares)[0] for k in stiffness]
    np.testing.assert_allclose(result.goal[:20], expected, rtol=1e-3)
    assert result.goal_error < 1e-3


def test_a_peak_scatters_too(prepared, parts):
    peak = cabin_objective(prepare_peak)
    result = scatter(prepared, parts, FLAT, peak, 20)
    stiffness = parts.stiffness(result.deviations)
    expected = peak.totals(stiffness)
    np.testing.assert_allclose(result.goal, expected, rtol=1e-3)
    assert result.nominal_goal == pytest.approx(peak.value({}), rel=1e-12)


def test_parts_as_drawn_are_the_vehicle_itself(prepared, objective, result):
    single = solve(prepared, {}, FLAT)
    np.testing.assert_allclose(result.nominal_rms, single.rms, rtol=1e-12)
    assert result.nominal_goal == pytest.approx(objective.value({}), rel=1e-12)


def test_bands_are_percentiles_of_the_samples_psds(prepared, parts, result):
    (batch,) = solve_many(prepared, parts.stiffness(result.deviations), FLAT)
    low, high = result.psd_percentiles((5, 95))
    expected = np.sort(batch.psd, axis=0)
    at = 0.05 * (N_SAMPLES - 1)
    below = int(at)
    between = expected[below] + (at - below) * (expected[below + 1] - expected[below])
    np.testing.assert_allclose(low, between, rtol=5e-3)
    assert (low < high).all()


@pytest.mark.bitwise
def test_a_seed_repeats_its_numbers_and_another_has_others(prepared, parts, objective, result):
    again = scatter(prepared, parts, FLAT, objective, N_SAMPLES, seed=3, points=("seat", "rear"))
    for name in ("rms", "psd", "goal", "deviations"):
        np.testing.assert_array_equal(getattr(again, name), getattr(result, name))
    other = scatter(prepared, parts, FLAT, objective, 5, seed=4)
    assert not np.isin(other.goal, result.goal).any()


def test_small_tolerances_propagate_linearly(prepared, objective):
    """σ² = Σ (∂F/∂d)²/3, for a deviation evenly spread over -1 to 1 has the variance 1/3."""
    parts = scattered_parts(prepared, {}, Tolerance(1e-4, 1e-4))
    found = scatter(prepared, parts, FLAT, objective, 2000)
    drawn = np.zeros(parts.n_deviations)
    value, slope = objective.of_springs(parts.stiffness(drawn), parts.slopes(drawn))
    assert value == pytest.approx(found.nominal_goal, rel=1e-12)
    # The sample's own correlations are of the order of 1/√2000.
    assert found.goal.var() == pytest.approx((slope**2).sum() / 3, rel=0.05)
    linear = value + found.deviations @ slope
    np.testing.assert_allclose(found.goal - value, linear - value, atol=2e-3 * np.ptp(linear))


def test_progress_ends_with_one(prepared, parts, objective):
    told = []
    scatter(prepared, parts, FLAT, objective, 250, tell=told.append)
    assert told == pytest.approx([0.4, 0.8, 1.0])


def test_it_ends_when_told_to_with_the_vehicles_so_far(prepared, parts, objective):
    token = CancelToken()
    told = []

    def tell(done):
        told.append(done)
        token.cancel()

    found = scatter(prepared, parts, FLAT, objective, 10_000, token=token, tell=tell)
    assert len(told) == 1
    whole = scatter(prepared, parts, FLAT, objective, 10_000 // 50)
    assert len(found.goal) == len(found.deviations) == len(found.rms) == len(found.psd) == CHUNK
    assert found.goal.mean() == pytest.approx(whole.goal.mean(), rel=0.05)


def test_it_ends_also_before_it_has_a_sample(monkeypatch, prepared, parts, objective):
    token, may_end, ended = CancelToken(), threading.Event(), []

    def held(*_):
        token.cancel()
        may_end.wait(20)
        ended.append(True)

    monkeypatch.setattr("modeviz.scatter.monte_carlo.few_lines", held)
    with pytest.raises(CancelledError):
        scatter(prepared, parts, FLAT, objective, 250, token=token)
    assert not ended
    may_end.set()


def test_one_sample_does_not_scatter(prepared, parts, objective):
    with pytest.raises(SolveError, match=r"samples: found 1, expected 2 or more"):
        scatter(prepared, parts, FLAT, objective, 1)


def test_an_unknown_point_is_named(prepared, parts, objective):
    with pytest.raises(VehicleError, match=r"unknown response point 'seet': did you mean 'seat'\?"):
        scatter(prepared, parts, FLAT, objective, 10, points=("seet",))
