"""The built-in pickup against the paper's published numbers."""

from pathlib import Path

import numpy as np
import pytest
from compare_with_paper import (
    ACCELERATION_FALL,
    CAB_YAW_OPTIMISED,
    FREQUENCIES,
    compare,
    markdown,
)

from modeviz.dynamics.response import direct_response
from modeviz.ride.roads import track_forces


@pytest.fixture(scope="module")
def comparison():
    return compare()


@pytest.mark.parametrize("name", FREQUENCIES)
def test_each_mode_of_table_1_is_found_by_its_name_within_1_2_percent(comparison, name):
    assert comparison.frequency(name) == pytest.approx(FREQUENCIES[name], rel=0.012)


def test_table_1_is_met_within_0_6_percent_rms(comparison):
    assert np.sqrt(np.mean(comparison.frequency_errors**2)) < 0.006


def test_cab_yaw_moves_where_the_paper_says(comparison):
    assert comparison.cab_yaw_optimised == pytest.approx(CAB_YAW_OPTIMISED, abs=0.15)


def test_lateral_acceleration_falls_by_a_third(comparison):
    assert comparison.lateral_change <= -0.35


def test_the_combined_acceleration_falls_as_the_paper_says(comparison):
    before, after = (r.rating.combined_g for r in (comparison.original, comparison.optimised))
    assert before - after == pytest.approx(ACCELERATION_FALL, rel=0.01)


def test_wheel_responses_change_as_in_tables_5_and_6(comparison):
    assert comparison.right_signs >= 14


@pytest.mark.parametrize("rates", ["original", "optimised"])
def test_the_modes_kept_in_a_response_miss_at_most_1_2_percent(comparison, rates):
    """At every response point, against the direct solution of the whole system."""
    results = getattr(comparison, rates)
    system, kept = results.system, results.modes
    indices = np.array([9, 15, 20, 49, 85, 109, 115, 119, 129, 139, 154, 169, 209, 259, 299, 399])
    f = results.frequency_hz[indices]
    rows = [system.motion(p.body, p.position)[:3] for p in system.vehicle.response_points]
    read = np.vstack(rows)
    direct = direct_response(system, f, track_forces(system, f, 20.0), read)
    modal = (read @ kept.shapes) @ results.coordinates[indices]
    scale = np.abs(direct).max(axis=(1, 2), keepdims=True)
    assert (np.abs(modal - direct) / scale).max() < 0.012


def test_the_readme_shows_what_the_comparison_prints(comparison):
    readme = Path(__file__).parents[1].joinpath("README.md").read_text().splitlines()
    assert [line for line in markdown(comparison).splitlines() if line not in readme] == []
