"""The report's sections on forces and paths."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from html_documents import Document
from mounted_cabin import mounted_cabin
from mounted_machine import mounted_machine

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import report
from modeviz.study.study import Study
from modeviz.vehicle.mount_rates import MountRates

TODAY = date(2026, 11, 29)
ORIGINAL, STIFF = RateSet("original", {}), RateSet("stiff", {"E": MountRates(6e5, 2e5, 4e5)})


def reported(vehicle, conditions):
    return Document(report(compare(prepare(vehicle), ORIGINAL, STIFF, conditions), TODAY))


@pytest.fixture(scope="module")
def machine():
    return mounted_machine()


@pytest.fixture(scope="module")
def document(machine):
    return reported(machine, Conditions("road", machine.speed))


def test_forces_of_mounts_are_rms_with_both_sets(document):
    _, *rows = document.tables["Forces of mounts"]
    study = Study(mounted_machine())
    forces = study.forces("road")
    front = next(row for row in rows if row[0] == "Front")
    assert front[1] == f"{forces.rms('front', 'z'):.1f}"
    study.rates["E.vertical"], study.rates["E.lateral"] = "600 N/mm", "200 N/mm"
    study.rates["E.fore-aft"] = "400 N/mm"
    assert front[2] == f"{study.forces('road').rms('front', 'z'):.1f}"


def test_paths_at_the_highest_peak_add_up(document):
    tables = [t for name, t in document.tables.items() if name.startswith(("Lateral, ", "Vertical, "))]
    assert len(tables) == 2
    for header, *rows in tables:
        assert header == ["Through", "original", "stiff"]
        for column in (1, 2):
            shares = [float(row[column].removesuffix(" %").replace("−", "-")) for row in rows]
            assert np.isclose(sum(shares), 100, atol=3)


def test_a_vehicle_without_a_ride_has_the_forces_of_its_first_harmonic_load(machine):
    document = reported(machine, None)
    assert "Largest peak, N, under unbalance" in document.words
    _, *rows = document.tables["Forces of mounts"]
    assert [row[0] for row in rows][-3:] == ["Front", "Rear", "Foot"]


def test_sections_that_have_nothing_to_say_are_not_there():
    quiet = replace(mounted_cabin(), wheel_loads=())
    found = compare(prepare(quiet), ORIGINAL, RateSet("same", {}), None)
    text = report(found, TODAY)
    assert "Forces of mounts" not in text
    assert "Paths to" not in text
