"""The report's section on sag, static forces and travel."""

import re
from dataclasses import replace
from html import unescape

import pytest
from engine_on_mounts import engine_on_mounts, limited_engine
from small_systems import block

from modeviz.analysis.preparation import prepare
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html.statics import statics
from modeviz.report.statics import carried_cells
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

STIFF = {"M3": MountRates(8e5, 2e5, 1e5)}


def section_of(vehicle):
    rates = STIFF if vehicle.mounts else {}
    return statics(compare(prepare(vehicle), RateSet("drawn", {}), RateSet("stiff", rates), None))


def rows_of(html):
    rows = re.findall(r"<tr[^>]*>(.*?)</tr>", html)
    cells = (re.findall(r"<t[dh][^>]*>(.*?)</t[dh]>", row) for row in rows)
    return [[unescape(re.sub(r"<[^>]*>", "", cell)) for cell in row] for row in cells]


def test_mounts_and_bodies_have_both_sets_side_by_side():
    rows = rows_of(section_of(engine_on_mounts()))
    prepared = prepare_statics(prepare(engine_on_mounts()).system)
    cases = [solve_statics(prepared, rates).case("standing") for rates in ({}, STIFF)]
    expected = [cell for case in cases for cell in carried_cells(case.connections["M3"])]
    assert ["M3", *expected] in rows
    at = next(i for i, row in enumerate(rows) if row[0] == "Engine")
    assert rows[at][1:5] == ["drawn", "0.074", "0.049", "−1.238"]
    assert rows[at + 1][:2] == ["", "stiff"]
    assert rows[at + 1][4] != "−1.238"


def test_travel_has_margins_in_every_case():
    html = section_of(limited_engine())
    rows = [row for row in rows_of(html) if row[0] == "M3 vertical"]
    assert [row[3:5] for row in rows] == [["−1.00", "1.00"]] * 2
    assert rows[0][5] == "−0.59"
    assert float(rows[0][6].replace("−", "-")) > -0.59
    assert "Travel" not in section_of(engine_on_mounts())


@pytest.mark.parametrize(
    "vehicle",
    [
        Vehicle("no mounts", (block("block"),), ()),
        replace(
            engine_on_mounts(),
            load_cases=limited_engine().load_cases[-1:],
            bodies=limited_engine().bodies,
        ),
    ],
)
def test_there_is_no_section_where_there_is_nothing_to_say(vehicle):
    assert section_of(vehicle) == ""
