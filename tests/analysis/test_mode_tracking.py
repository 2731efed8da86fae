"""Which modes of two sets of rates are compared: by name, and namesakes by shape."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from builtin_truck import truck_modes

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.mode_tracking import Pair, follow, pair_modes, same_mode
from modeviz.dynamics.naming import ModeName
from modeviz.dynamics.tracking import EQUAL, WEAK_MAC, Track


def called(*names):
    """Results of which nothing counts but what their modes are called."""
    return SimpleNamespace(names=tuple(ModeName(name, 1.0) for name in names))


def led(*steps, n_present=3):
    """A track that leads to these modes, each (index, MAC)."""
    shares = np.zeros((len(steps), n_present))
    for row, (index, mac) in zip(shares, steps, strict=True):
        if index >= 0:
            row[index] = mac
    return Track(shares, np.array([index for index, _ in steps]))


def test_what_stands_once_is_compared_by_name_wherever_its_shape_went():
    base, now = called("cab yaw", "engine lateral"), called("engine lateral", "cab yaw")
    swapped = led((0, 1.0), (1, 1.0), n_present=2)
    assert set(pair_modes(base, now, swapped)) == {Pair(0, 1), Pair(1, 0)}


def test_a_namesake_that_is_left_is_compared_with_its_own_shape():
    base, now = called("hop", "hop 2", "yaw"), called("yaw", "hop")
    found = pair_modes(base, now, led((-1, 0.0), (1, 0.9), (0, 1.0), n_present=2))
    assert set(found) == {Pair(0, None), Pair(1, 1), Pair(2, 0)}


def test_namesakes_that_change_their_order_keep_their_shapes():
    base, now = called("hop", "hop 2"), called("hop", "hop 2")
    found = pair_modes(base, now, led((1, 0.9), (0, 0.6), n_present=2))
    assert set(found) == {Pair(0, 1), Pair(1, 0, is_weak=True)}


def test_namesakes_of_unclear_shape_are_compared_by_rising_frequency():
    """As many before as now; where a shape is clearly another mode, there is nothing to compare."""
    base, now = called("hop", "hop 2", "yaw"), called("hop", "hop 2", "yaw")
    unclear = led((-1, 0.0), (-1, 0.0), (2, 1.0))
    assert set(pair_modes(base, now, unclear)) == {Pair(0, 0, True), Pair(1, 1, True), Pair(2, 2)}
    elsewhere = led((-1, 0.0), (2, 0.9), (-1, 0.0))
    expected = {Pair(0, None), Pair(1, None), Pair(None, 0), Pair(None, 1), Pair(2, 2)}
    assert set(pair_modes(base, now, elsewhere)) == expected


@pytest.fixture(scope="module")
def prepared():
    return truck_modes()


@pytest.fixture(scope="module", params=["optimised", *np.geomspace(0.2, 5, 7)])
def both(request, prepared):
    """The truck with its own rates, and with others."""
    truck = prepared.vehicle
    if request.param == "optimised":
        rates = truck.rate_sets["optimised"]
    else:
        own = truck.rates["C1"]
        rates = {"C1": replace(own, vertical=own.vertical * request.param, lateral=own.lateral * 4)}
    return solve_modal(prepared, {}), solve_modal(prepared, rates)


def test_every_mode_is_there_once(both):
    pairs = pair_modes(*both, follow(*both))
    for results, found in zip(both, ([p.before for p in pairs], [p.after for p in pairs]), strict=True):
        assert sorted(i for i in found if i is not None) == list(range(len(results.names)))


def test_the_other_way_round_the_same_are_compared(both):
    base, now = both
    there = {(p.before, p.after) for p in pair_modes(base, now, follow(base, now))}
    back = {(p.after, p.before) for p in pair_modes(now, base, follow(now, base))}
    assert back == there


def test_namesakes_that_are_surely_paired_have_the_most_of_each_others_shape(both):
    base, now = both
    mac = (base.modes.shapes.T @ base.prepared.system.mass @ now.modes.shapes) ** 2
    motions = [[name.motion for name in results.names] for results in both]
    for p in pair_modes(base, now, follow(base, now)):
        if p.before is None or p.after is None:
            continue
        motion = base.names[p.before].motion
        assert now.names[p.after].motion == motion
        if [m.count(motion) for m in motions] != [1, 1] and not p.is_weak:
            assert mac[p.before, p.after] >= WEAK_MAC - EQUAL


def test_modes_with_the_same_rates_are_compared_with_themselves(prepared):
    base, now = (solve_modal(prepared, {}) for _ in range(2))
    found = pair_modes(base, now, follow(base, now))
    assert set(found) == {Pair(i, i) for i in range(len(base.names))}


def test_a_mode_of_another_set_is_that_which_it_is_compared_with(both):
    base, now = both
    for p in pair_modes(base, now, follow(base, now)):
        if p.before is not None:
            assert same_mode(base, p.before, now) == p.after
