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


def test_the_readme_shows_what_the_comparison_prints(comparison):
    readme = Path(__file__).parents[1].joinpath("README.md").read_text().splitlines()
    assert [line for line in markdown(comparison).splitlines() if line not in readme] == []
