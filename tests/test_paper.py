"""The built-in pickup against the paper's published numbers."""

import re
from dataclasses import fields
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
from pickup.parameters import Parameters
from pickup.roads import RoadShapes, roads

README = Path(__file__).parents[1].joinpath("README.md").read_text()


@pytest.fixture(scope="module")
def comparison():
    return compare()


@pytest.mark.parametrize("name", FREQUENCIES)
def test_each_mode_of_table_1_is_found_by_its_name_within_1_percent(comparison, name):
    assert comparison.frequency(name) == pytest.approx(FREQUENCIES[name], rel=0.01)


def test_table_1_is_met_within_0_6_percent_rms(comparison):
    assert np.sqrt(np.mean(comparison.frequency_errors**2)) < 0.006


def test_cab_yaw_moves_where_the_paper_says(comparison):
    assert comparison.cab_yaw_optimised == pytest.approx(CAB_YAW_OPTIMISED, abs=0.15)


def test_lateral_acceleration_falls_by_a_third(comparison):
    assert comparison.lateral_change <= -0.35


def test_the_combined_acceleration_falls_as_the_paper_says(comparison):
    assert comparison.acceleration_fall == pytest.approx(ACCELERATION_FALL, rel=0.01)


def test_wheel_responses_change_as_in_tables_5_and_6(comparison):
    assert comparison.right_signs == 16


def test_the_readme_tells_how_many_modes_of_tables_2_and_3_are_in_their_place(comparison):
    (told,) = re.findall(r"of the 18 modes that the paper names, (\d+) are in their place", README)
    assert comparison.right_contributors == int(told)


def test_the_readme_tells_how_many_fitted_numbers_lie_on_their_bounds():
    """Within 2 % of its range."""
    on_bounds = 0
    for part in (Parameters(), RoadShapes()):
        for field in fields(part):
            low, high = field.metadata["bounds"]
            value = getattr(part, field.name)
            on_bounds += not low + 0.02 * (high - low) <= value <= high - 0.02 * (high - low)
            assert low <= value <= high, field.name
    count = len(fields(Parameters)) + len(fields(RoadShapes))
    (told,) = re.findall(rf"{count} numbers of which (\d+) lie on a bound", README.replace("\n", " "))
    assert on_bounds == int(told) < 24


def test_the_roads_are_what_the_paper_says_of_its_figures_6_and_7():
    f = np.arange(0.5, 20.0, 0.1)
    tracks = {road.name: road.spectrum for road in roads(RoadShapes())}
    at = {road.name: road.frequency_hz for road in roads(RoadShapes())}
    left, right = (np.interp(f, at["road 1"], tracks["road 1"][:, i, i].real) for i in (0, 1))
    most = (f > 5.5) & (f < 9.5)
    assert (right[most] > 1.8 * left[most]).all()
    assert (right / left)[most].mean() > (right / left)[~most].mean()
    left, right = (np.interp(f, at["road 2"], tracks["road 2"][:, i, i].real) for i in (0, 1))
    assert np.abs(np.log(right / left)).max() < np.log(1.25)


def test_the_readme_shows_what_the_comparison_prints(comparison):
    readme = README.splitlines()
    assert [line for line in markdown(comparison).splitlines() if line not in readme] == []
