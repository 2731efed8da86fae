"""The report's section on running engines."""

import re
from dataclasses import replace

import numpy as np
import pytest
from dynamic_mounts import OTHER_RATES, on_mounts

from modeviz.analysis.engine_results import solve_engine
from modeviz.analysis.preparation import prepare
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html.engines import engines
from modeviz.report.html.forces import forces, paths
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.engine import Engine, EngineOrder

SPEEDS = np.linspace(10.0, 15.0, 6)
RUNNING = Engine(
    "four",
    "engine",
    np.array([0.1, 0.0, 0.95]),
    SPEEDS,
    12.0,
    tuple(
        EngineOrder(f"four order {order:g}", "four", order, order * SPEEDS, np.full((6, 6), 5.0 + 0j))
        for order in (2.0, 4.0)
    ),
)
HELD = (Spring("held", "springs", ("engine", GROUND), np.zeros((2, 3)), np.full(3, 1e5)),)
VEHICLE = replace(on_mounts(None), engines=(RUNNING,))
NOTHING_SEEN = {"response_points": (), "mount_groups": (), "base_motions": (), "connections": HELD}
STIFF = {"E": OTHER_RATES}


def section_of(vehicle, rates=STIFF):
    return engines(compare(prepare(vehicle), RateSet("drawn", {}), RateSet("stiff", rates), None))


def test_orders_at_idle_and_the_most_over_speed_stand_side_by_side():
    html = section_of(VEHICLE)
    assert "idle at 720 rpm" in html
    assert "Order 2" in html
    assert "Order 4" not in html, "at 48 Hz it is beyond the band"
    prepared = prepare(VEHICLE)
    for rates in ({}, STIFF):
        found = solve_engine(prepared, rates, RUNNING)
        for value in (found.acceleration_g[found.idle, 0, 0, 2], found.rms[:, 0, 2].max()):
            assert f"{1000 * value:.2f}" in html
    assert len(re.findall("<h3>", html)) == 2 + 2
    assert html.count("<figure>") == 2


def test_forces_of_mounts_are_told_without_a_point():
    vehicle = replace(VEHICLE, response_points=())
    html = section_of(vehicle)
    prepared = prepare(vehicle)
    for rates in ({}, STIFF):
        found = solve_engine(prepared, rates, RUNNING)
        for value in (found.force_rms[found.idle, 0, 2], found.force_rms[:, 0, 2].max()):
            assert f"{value:.2f}" in html
    assert "<figure>" not in html


def test_paths_under_an_order_are_told_where_the_engine_idles():
    quiet = replace(VEHICLE, forces=(), base_motions=())
    sets = RateSet("drawn", {}), RateSet("stiff", STIFF)
    comparison = compare(prepare(quiet), *sets, None)
    html = paths(comparison)
    assert "Under four order 2, where the engine idles" in html
    assert "Vertical, 24.00 Hz" in html
    assert "under four order 2" in forces(comparison)


@pytest.mark.parametrize("missing", [{"engines": ()}, NOTHING_SEEN])
def test_what_has_nothing_to_say_is_not_there(missing):
    assert section_of(replace(VEHICLE, **missing), {}) == ""
