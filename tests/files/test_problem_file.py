"""A problem in a file of its own."""

import tomllib
from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import SOFT, mounted_cabin

from modeviz.errors import VehicleError
from modeviz.files.problem_file import problem_text, read_problem
from modeviz.files.records.problems import ProblemRecord
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import UNLIMITED, DesignGroup, Performance, Problem

STIFF = MountRates(1e6, 2e6, 1e6 / 3)
PROBLEM = Problem(
    "mine",
    (DesignGroup("A", ("lateral",), (SOFT, STIFF), UNLIMITED), DesignGroup("B", fixed_ratios=True)),
    (Performance(np.linspace(6, 14, 25), ("flat",), points=("seat",), weight=1 / 3),),
    is_normalised=False,
)


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "mine.toml"
    path.write_text(problem_text(PROBLEM))
    return path


def test_what_is_written_comes_back_to_the_last_bit(path):
    found = read_problem(path, mounted_cabin())
    assert ProblemRecord.of(found) == ProblemRecord.of(PROBLEM)
    assert found.groups[0].ratio_limits == UNLIMITED
    assert (found.performance[0].frequency_hz == PROBLEM.performance[0].frequency_hz).all()


def test_its_numbers_are_in_the_unit_that_it_says(path):
    data = tomllib.loads(path.read_text())
    assert data["units"] == {"stiffness": "N/mm"}
    assert data["problem"][0]["group"][0]["stiffest"]["lateral"] == 2000
    path.write_text(path.read_text().replace("N/mm", "N/cm"))
    (_, stiffest) = read_problem(path, mounted_cabin()).groups[0].bounds
    assert stiffest.lateral == 2e5


def test_what_the_vehicle_does_not_have_is_named_with_the_file(path):
    cabin = mounted_cabin()
    seat = replace(cabin.response_points[0], name="bench")
    with pytest.raises(VehicleError, match=r"mine\.toml: .*response point 'seat'.*bench"):
        read_problem(path, replace(cabin, response_points=(seat,)))


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("", "problem: missing"),
        ("problem = []", "problem: "),
        ("problem = 3", "problem: "),
        ("x =", "not TOML"),
        ("[[problem]]\nname = 'a'", "problem[0].group: missing"),
        ("[[problem]]\nname = 'a'\ngroup = [{group = 'A', rates = 3}]", "rates"),
    ],
)
def test_what_is_wrong_in_it_is_said(tmp_path, text, said):
    path = tmp_path / "wrong.toml"
    path.write_text(text)
    with pytest.raises(VehicleError) as caught:
        read_problem(path, mounted_cabin())
    assert said in str(caught.value)
    assert str(caught.value).startswith(str(path))


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(VehicleError, match=r"nowhere\.toml"):
        read_problem(tmp_path / "nowhere.toml", mounted_cabin())
