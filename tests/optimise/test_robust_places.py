"""A percentile over parts that scatter, as a goal of a search that moves and turns mounts."""

from dataclasses import replace

import numpy as np
import pytest
from test_carried_places import TWO, on_the_engine
from test_places import (
    ENGINE,
    RUBBER,
    RUBBER_GOALS,
    assert_derivatives_hold,
    design,
    engine,
    search_of,
    symmetric,
)

from modeviz.optimise.run import optimise
from modeviz.scatter.robust import Robust, optimise_robustly, robust, robust_search
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import goals
from modeviz.vehicle.problem import DesignGroup

WIDE = Tolerance(rates=0.3, loss_factor=0.5)


def robustly(search, n_samples=5):
    """The robust search with fewer samples than usual."""
    found = robust_search(search, WIDE)
    assert isinstance(found.goal, Robust)
    few = robust(search.goal, WIDE, n_samples=n_samples)
    return replace(found, goal=replace(few, probed=found.goal.probed))


@pytest.mark.parametrize("goal", ["accelerations", "peak", "rms"])
def test_derivatives_to_places_are_those_of_vehicles_made_anew(goal):
    groups = ENGINE[:1] if goal == "peak" else ENGINE
    assert_derivatives_hold(robustly(search_of(engine(), goal, groups)))


def test_mirrored_mounts_of_rubber_over_frequency_have_derivatives_too():
    fields = {"performance": (), "groups": RUBBER, **RUBBER_GOALS["accelerations"]}
    assert_derivatives_hold(robustly(search_of(symmetric(), "accelerations", **fields)))


def test_the_value_of_a_design_is_the_percentile_of_the_vehicle_made_with_it():
    search = robustly(search_of(engine(), "accelerations"))
    x = design(search)
    moved = search.at(x).goal.objective
    assert len(moved.prepared.vehicle.mounts) == len(engine().mounts)
    parts = scattered_parts(moved.prepared, search.space.rates(x), WIDE)
    values = np.sort(goals(moved, parts, search.goal.deviations))
    assert search.value(x) == pytest.approx(float(search.goal.weights @ values), rel=1e-12)


def test_a_robust_optimum_of_places_is_no_worse_than_the_one_as_drawn():
    group = DesignGroup("M1", ("vertical",), offsets={"x": (-0.03, 0.03)})
    search = search_of(engine(), "accelerations", (group,))
    found = optimise(search, [np.zeros(2)], 60)
    again = robustly(search)
    best = optimise_robustly(again, found, 120)
    assert best.converged
    assert best.value <= again.value(found.x) * (1 + 1e-9)
    assert best.placements


def test_the_mass_of_an_absorber_that_is_moved_does_not_scatter():
    assert_derivatives_hold(robustly(search_of(on_the_engine(), "accelerations", (TWO,))))
