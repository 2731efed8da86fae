"""What a report says of bodies on their mounts."""

from dataclasses import replace
from datetime import date

import pytest
from dynamic_mounts import MAXWELL, OTHER_RATES, on_mounts
from four_cylinder import FREQUENCIES, four_cylinder
from html_documents import Document
from small_systems import oscillator

from modeviz.analysis.preparation import prepare
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import report
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, Problem

TODAY = date(2026, 11, 22)
STIFF = RateSet("stiff", {"M1": MountRates(9e5, 1e5, 2e5)})


@pytest.fixture(scope="module")
def document():
    found = compare(prepare(four_cylinder()), RateSet("original", {}), STIFF, None)
    return Document(report(found, TODAY))


def test_each_direction_has_frequency_and_purity_with_both_sets(document):
    header, name, *rows = document.tables["Bodies on their mounts"]
    assert header[:5] == [
        "Body",
        "Hz, original",
        "Hz, stiff",
        "Purity, %, original",
        "Purity, %, stiff",
    ]
    assert name == ["Engine"]
    assert [row[0] for row in rows] == ["x", "y", "z", "rx", "ry", "rz"]
    assert [float(row[1]) for row in rows] == pytest.approx(
        [FREQUENCIES[i] for i in (1, 0, 3, 4, 5, 2)], abs=0.006
    )
    assert rows[1][3] == "98.5"
    assert rows[2][1] != rows[2][2]


def test_axes_are_those_of_both_sets(document):
    rows = {row[0]: row[1:] for row in document.tables["Axes and centres"]}
    assert rows["torque roll axis"] == ["-0.1320 0.9912 -0.0123"] * 2
    assert rows["elastic torque axis"][0] == "-0.1630 0.9674 0.1938"
    assert rows["between them"][0] == "12.04°, 86 mm"
    assert rows["elastic centre, m"][0] != rows["elastic centre, m"][1]


def test_a_vehicle_without_mounts_has_no_such_section():
    vehicle = replace(oscillator().vehicle, name="no mounts")
    plain = RateSet("original", {})
    text = report(compare(prepare(vehicle), plain, plain, None), TODAY)
    assert "Bodies on their mounts" not in text


def test_a_goal_that_cannot_be_told_of_rates_over_frequency_is_left_out():
    problem = Problem("pure", (DesignGroup("E"),), goal="purity")
    vehicle = replace(on_mounts(MAXWELL), problems=(problem,))
    found = compare(prepare(vehicle), RateSet("drawn", {}), RateSet("stiff", {"E": OTHER_RATES}), None)
    assert found.worth is None
    assert "Objective" not in Document(report(found, TODAY)).tables
