"""[[problem]] in a vehicle file: what is written comes back, and what is wrong in it is said."""

import tomllib
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mounted_cabin import SOFT, mounted_cabin

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.records.problems import MOST_FREQUENCIES, ProblemRecord, SpacedRecord
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DeflectionLimit, DesignGroup, FrequencyWindow, Performance, Problem

THIRDS = np.linspace(6.0, 14.0, 25)
LISTED = np.array([11.0, 13.25, 47 / 3])
EVERYTHING = Problem(
    "everything",
    (
        DesignGroup("A", ("lateral", "fore-aft"), (SOFT, MountRates(1e6, 2e6, 1e6 / 3)), (0.25, 0.8)),
        DesignGroup("B", fixed_ratios=True),
    ),
    (
        Performance(THIRDS, ("flat", "rough")),
        Performance(
            LISTED, (), ("front left radial force",), ("seat",), ("fore-aft",), target=0.1, weight=1 / 3
        ),
    ),
    "rms",
    is_normalised=False,
    windows=(
        FrequencyWindow("cab yaw", high_hz=10.0),
        FrequencyWindow("cab roll", 5.0, 7.0, is_inside=False),
    ),
    reference="soft",
    deflections=(DeflectionLimit("A 0.5", "lateral", 0.01 / 3, "bump 3 g"),),
)
PLAIN = Problem("plain", (DesignGroup("A"),), goal="change")


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    write_vehicle(replace(mounted_cabin(), problems=(EVERYTHING, PLAIN)), tmp_path / "cabin")
    return tmp_path / "cabin"


def edit(folder: Path, old: str, new: str) -> None:
    """Changes the first `old` of the problems in vehicle.toml."""
    path = folder / "vehicle.toml"
    rest, mark, problems = path.read_text().partition("[[problem]]")
    assert old in problems
    path.write_text(rest + mark + problems.replace(old, new, 1))


def test_problems_come_back_to_the_last_bit(folder):
    everything, plain = read_vehicle(folder).problems
    assert ProblemRecord.of(everything) == ProblemRecord.of(EVERYTHING)
    assert ProblemRecord.of(plain) == ProblemRecord.of(PLAIN)
    for found, written in zip(everything.performance, EVERYTHING.performance, strict=True):
        np.testing.assert_array_equal(found.frequency_hz, written.frequency_hz)
    assert everything.groups[0].bounds == EVERYTHING.groups[0].bounds
    assert everything.windows[0].high_hz == 10.0
    assert everything.windows[1].is_inside is False


def test_even_spacing_is_three_numbers_and_the_rest_is_listed(folder):
    data = tomllib.loads((folder / "vehicle.toml").read_text())
    on_road, on_wheel = data["problem"][0]["performance"]
    assert on_road["frequency_hz"] == {"first": 6.0, "last": 14.0, "count": 25}
    assert on_wheel["frequency_hz"] == LISTED.tolist()


@pytest.mark.parametrize("n", [1, 2, MOST_FREQUENCIES + 1])
def test_frequencies_that_three_numbers_cannot_say_are_listed(n):
    f = np.linspace(1.0, 2.0, n)
    assert SpacedRecord.of(f) is None
    performance = Performance(f, ("flat",))
    record = ProblemRecord.of(Problem("p", (DesignGroup("A"),), (performance,)))
    np.testing.assert_array_equal(record.build().performance[0].frequency_hz, f)


def test_frequencies_that_are_not_evenly_spaced_to_the_bit_are_listed():
    f = np.linspace(6.0, 14.0, 25)
    f[7] = np.nextafter(f[7], 0)
    assert SpacedRecord.of(f) is None


def test_bounds_are_in_the_units_of_the_file(folder):
    data = tomllib.loads((folder / "vehicle.toml").read_text())
    assert data["units"]["stiffness"] == "N/mm"
    assert data["problem"][0]["group"][0]["stiffest"]["lateral"] == 2000.0
    path = folder / "vehicle.toml"
    path.write_text(path.read_text().replace('"N/mm"', '"kN/mm"'))
    problem = read_vehicle(folder).problem("everything")
    bounds, before = problem.groups[0].bounds, EVERYTHING.groups[0].bounds
    assert bounds is not None
    assert before is not None
    for found, written in zip(bounds, before, strict=True):
        assert found.as_tuple() == pytest.approx([1000 * k for k in written.as_tuple()], rel=1e-15)
    assert problem.groups[0].ratio_limits == (0.25, 0.8)
    assert problem.performance[1].weight == 1 / 3


EDITS = {
    "one bound": (
        "stiffest = ",
        "#",
        "problem[0].group[0]: softest and stiffest: found one of them, expected both or neither",
    ),
    "bounds the wrong way round": (
        "lateral = 2000.0",
        "lateral = 1.0",
        "problem[0].group[0]: design group 'A': bounds: lateral: found 10 to 1 N/mm",
    ),
    "negative rate": (
        "vertical = 10.0",
        "vertical = -10.0",
        "problem[0].group[0].softest.vertical: found -10.0, expected a number of zero or more",
    ),
    "limits the wrong way round": (
        "[0.25, 0.8]",
        "[0.8, 0.25]",
        "problem[0].group[0]: design group 'A': ratio limits: found 0.8 to 0.25",
    ),
    "three limits": (
        "[0.25, 0.8]",
        "[0.25, 0.8, 1.0]",
        "problem[0].group[0].ratio_limits: found [0.25, 0.8, 1.0], expected a list",
    ),
    "fixed and free": (
        "ratio_limits = [0.25, 0.8]",
        "fixed_ratios = true",
        "problem[0].group[0]: design group 'A': directions: found lateral, fore-aft with fixed ratios",
    ),
    "unknown direction": ('"fore-aft"]', '"fore aft"]', "unknown direction 'fore aft': did you mean"),
    "unknown goal": (
        'goal = "rms"',
        'goal = "rmz"',
        "problem[0].goal: unknown value 'rmz': did you mean 'rms'? there are accelerations",
    ),
    "unknown key": (
        "first = 6.0",
        "frist = 6.0",
        "problem[0].performance[0].frequency_hz.frist: unknown key 'frist': did you mean 'first'?",
    ),
    "missing key": (
        "first = 6.0, ",
        "",
        "problem[0].performance[0].frequency_hz.first: missing",
    ),
    "too many": (
        "count = 25",
        "count = 99999999",
        "problem[0].performance[0].frequency_hz.count: found 99999999, expected a whole number at most",
    ),
    "no frequencies": (
        "[11.0, 13.25, 15.666666666666666]",
        "[]",
        "performance: frequencies (frequency_hz): found none, expected rising values above zero",
    ),
    "text for frequencies": (
        "[11.0, 13.25, 15.666666666666666]",
        '"all"',
        "problem[0].performance[1].frequency_hz: found 'all', expected a table or a list",
    ),
    "text for a frequency": (
        "[11.0, 13.25,",
        '[11.0, "x",',
        "problem[0].performance[1].frequency_hz[1]: found 'x', expected a number",
    ),
    "negative weight": (
        "weight = 0.333",
        "weight = -0.333",
        "problem[0].performance[1].weight: found -0.33",
    ),
    "not a target": ("target = 0.1", "target = nan", "performance[1].target: found nan, expected a"),
    "no load": (
        'roads = ["flat", "rough"]',
        "",
        "problem[0].performance[0]: performance: found neither roads nor wheel_loads",
    ),
    "window of nothing": (
        "high_hz = 10.0",
        "",
        "problem[0].window[0]: window of 'cab yaw': found neither low_hz nor high_hz",
    ),
    "unknown group": (
        'group = "A"',
        'group = "C"',
        "problem 'everything': unknown mount group 'C': there are A, B",
    ),
    "unknown road": (
        '"rough"',
        '"rugh"',
        "problem 'everything': unknown random load 'rugh': did you mean 'rough'? there are flat, rough",
    ),
    "unknown set": (
        'reference = "soft"',
        'reference = "best"',
        "problem 'everything': unknown set of rates 'best': there are soft",
    ),
}


@pytest.mark.parametrize("case", EDITS)
def test_a_wrong_problem_is_explained(folder, case):
    old, new, words = EDITS[case]
    edit(folder, old, new)
    with pytest.raises(VehicleError) as caught:
        read_vehicle(folder)
    text = str(caught.value)
    assert text.startswith(f"{folder / 'vehicle.toml'}: ")
    assert words in text
    assert "\n" not in text
