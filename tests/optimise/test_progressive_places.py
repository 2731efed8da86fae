"""Places as variables of a search where mounts are progressive, and work elsewhere then."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from test_places import SHAKEN, assert_derivatives_hold, derivatives, design, engine, search_of

from modeviz.files import read_vehicle, write_vehicle
from modeviz.mounting.working_point import working_point
from modeviz.optimise.goals import prepare_goal
from modeviz.study.study import Study
from modeviz.vehicle.problem import DeflectionLimit, DesignGroup, Problem
from modeviz.vehicle.progressive import ForceCurve

CURVE = ForceCurve(
    np.array([-0.02, -0.003, -0.0001, 0.0, 0.01]), np.array([-1.817e5, -1.17e4, -100.0, 0.0, 1e4])
)
"""Where the engine stands mounts are four times as stiff as unloaded."""

GROUPS = (
    DesignGroup("M1", (), offsets={"x": (-0.03, 0.03)}, angles={"y": (-0.3, 0.5)}),
    DesignGroup("M2", (), offsets={"x": (-0.03, 0.03)}, angles={"x": (-0.3, 0.3)}),
)
LIMITS = (
    DeflectionLimit("M1", "vertical", 0.01),
    DeflectionLimit("M2", "vertical", 0.01),
    DeflectionLimit("M1", "lateral", 0.01),
)


@cache
def curved():
    """An engine on three mounts of which two are progressive."""
    first, second, third = engine().mount_groups
    groups = (replace(group, curves={"vertical": CURVE}) for group in (first, second))
    return replace(engine(), mount_groups=(*groups, third))


@pytest.mark.parametrize("goal", ["accelerations", "forces", "purity"])
def test_derivatives_to_places_are_those_of_vehicles_made_anew(goal):
    search = search_of(curved(), goal, GROUPS)
    built = search.space.built(design(search))
    assert np.unique(working_point(built).tangents({})) == pytest.approx([1.0, 4.0])
    assert_derivatives_hold(search)


def test_deflections_on_curves_have_derivatives_to_places():
    search = search_of(curved(), "purity", GROUPS, deflections=LIMITS)
    x = design(search)
    slopes = search.margins(x)[1]
    expected = derivatives(lambda x: search.margins(x)[0], x)
    assert (np.abs(slopes - expected).max(axis=1) < 1e-5 * np.abs(expected).max(axis=1)).all()


def test_a_design_is_worth_what_the_folder_written_with_it_is(tmp_path):
    search = search_of(curved(), "rms", GROUPS)
    x = design(search)
    write_vehicle(search.space.built(x), tmp_path / "found")
    anew = read_vehicle(tmp_path / "found")
    problem = Problem("p", (DesignGroup("M1"),), goal="rms", performance=SHAKEN, is_normalised=False)
    there, own = (prepare_goal(v, problem, v.rates, 20.0).exact_value({}) for v in (anew, curved()))
    assert search.value(x) == pytest.approx(there / own, rel=1e-7)


def test_a_search_ends_where_no_place_that_was_tried_is_better():
    group = DesignGroup("M2", (), offsets={"x": (-0.03, 0.03)})
    search = search_of(curved(), "accelerations", (group,))
    found = Study(curved()).optimise(Problem("p", (group,), performance=SHAKEN), 1)
    tried = [search.value(np.array([part])) for part in np.linspace(-0.5, 0.5, 9)]
    assert found.value <= min(tried) * (1 + 1e-6)
    assert found.value < 0.999
