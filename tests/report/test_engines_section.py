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
VEHICLE = replace(on_mounts(None), engines=(RUNNING,))
STIFF = {"E": OTHER_RATES}


def section_of(vehicle):
    return engines(compare(prepare(vehicle), RateSet("drawn", {}), RateSet("stiff", STIFF), None))


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
    assert len(re.findall("<h3>", html)) == 2


@pytest.mark.parametrize("missing", [{"engines": ()}, {"response_points": ()}])
def test_what_has_nothing_to_say_is_not_there(missing):
    assert section_of(replace(VEHICLE, **missing)) == ""
