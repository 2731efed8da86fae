from dataclasses import replace
from itertools import islice

import numpy as np
import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis import exact_check as checking
from modeviz.analysis.exact_check import check_exactly, classic_error
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.dynamics.modes import Modes
from modeviz.vehicle.mount_rates import MountRates

FLAT = Conditions("flat", 20.0)
RATES = {"A": MountRates(2e5, 1e5, 1e5)}


@pytest.fixture(scope="module")
def results():
    return solve(prepare(mounted_cabin(), np.linspace(0.5, 40, 80)), RATES, FLAT)


def last(checks):
    *_, check = checks
    return check


def with_modes(results, frequency_hz, n_modes):
    modes = results.modes
    changed = Modes(frequency_hz[:n_modes], modes.shapes[:, :n_modes], modes.damping_ratio[:n_modes])
    return replace(results, band=replace(results.band, modes=changed))


def test_a_true_answer_is_exact_within_rounding(results):
    check = last(check_exactly(results))
    assert check.is_complete
    assert check.n_lines == check.n_freqs == 80
    assert check.error < 1e-9


@pytest.mark.parametrize("line", [0, 37, 79])
def test_a_wrong_psd_is_found_wherever_it_is(results, line):
    psd = results.psd.copy()
    psd[line, 0, 2] += 1e-6 * psd[:, 0, 2].max()
    check = last(check_exactly(replace(results, psd=psd)))
    assert check.psd_error == pytest.approx(1e-6, rel=1e-3)
    assert check.error == check.psd_error
    assert check.frequency_error < 1e-9


def test_a_psd_that_is_wrong_throughout_is_so_by_its_factor(results):
    check = last(check_exactly(replace(results, psd=results.psd * (1 + 1e-6))))
    assert check.psd_error == pytest.approx(1e-6, rel=1e-3)


def test_a_wrong_frequency_is_found_before_any_response(results):
    f = results.modes.frequency_hz.copy()
    f[3] *= 1 + 1e-5
    check = next(check_exactly(with_modes(results, f, len(f))))
    assert check.frequency_error == pytest.approx(1e-5, rel=1e-3)
    assert check.n_lines == 0


def test_a_missing_mode_is_infinitely_wrong(results):
    f = results.modes.frequency_hz
    assert next(check_exactly(with_modes(results, f, len(f) - 1))).error == np.inf


def test_what_is_no_number_does_not_pass(results):
    psd = results.psd.copy()
    psd[5, 0, 1] = np.nan
    assert not last(check_exactly(replace(results, psd=psd))).error < 1


def test_a_response_that_should_not_be_zero_is_found(results):
    assert last(check_exactly(replace(results, psd=0 * results.psd))).psd_error > 1


def test_a_cab_on_no_mounts_stands_as_still_in_both(results):
    loose = dict.fromkeys("AB", MountRates(0.0, 0.0, 0.0))
    check = last(check_exactly(solve(results.prepared, loose, FLAT)))
    assert check.error < 1e-9


def test_lines_are_compared_once_each_and_coarse_ones_first(results, monkeypatch):
    asked = []

    def watched(system, frequency_hz, *others):
        asked.append(frequency_hz)
        return direct(system, frequency_hz, *others)

    direct = checking.direct_response
    monkeypatch.setattr(checking, "direct_response", watched)
    counts = [check.n_lines for check in check_exactly(results)]
    assert counts == list(range(0, 81, 10))
    np.testing.assert_array_equal(np.sort(np.concatenate(asked)), results.frequency_hz)
    assert all(np.ptp(lines) > 0.8 * np.ptp(results.frequency_hz) for lines in asked)


def test_whoever_has_seen_enough_stops(results, monkeypatch):
    list(islice(check_exactly(results), 1))

    def too_late(*_):
        raise AssertionError

    monkeypatch.setattr(checking, "direct_response", too_late)
    assert next(check_exactly(results)).n_lines == 0


def test_the_classic_method_is_exact_in_a_complete_basis(results):
    assert classic_error(results).error < 1e-9


def test_the_classic_error_is_that_of_the_worst_mode(results, monkeypatch):
    f = results.modes.frequency_hz
    off = f * (1 + np.where(np.arange(len(f)) == 4, 0.02, 0.001))
    monkeypatch.setattr(checking, "solve_modal", lambda *_: with_modes(results, off, len(f)))
    worst = classic_error(results)
    assert worst.mode == 4
    assert worst.frequency_hz == off[4]
    assert worst.error == pytest.approx(0.02)


def test_a_full_model_that_cannot_be_solved_that_exactly_is_said():
    """Beside a spring of 10¹⁵ N/m the equations of motion lose more digits than they promise."""
    prepared = prepare(mounted_cabin(), np.array([1.0, 5.0]))
    rates = {"A": MountRates(1e14, 1e14, 1e14)}
    check = last(check_exactly(solve(prepared, rates, FLAT)))
    assert check.is_complete
    assert "no accurate response at 1.0 Hz" in check.impossible
