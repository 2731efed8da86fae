"""Modes of one set of rates recognised with another: the same on every way there and back."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck, truck_modes
from mounted_cabin import mounted_cabin

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.mode_tracking import follow, solve_followed
from modeviz.analysis.preparation import prepare_modes
from modeviz.dynamics.tracking import EQUAL, MAJORITY
from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS

GROUPS = ("F", "C1", "C2", "E", "T")
RATES = [(group, field) for group in GROUPS for field in STIFFNESS_FIELDS]
FACTORS = np.geomspace(0.1, 10, 25)


@pytest.fixture(scope="module")
def prepared():
    assert tuple(group.name for group in builtin_truck().mount_groups) == GROUPS
    return truck_modes()


@pytest.fixture(scope="module")
def original(prepared):
    return solve_modal(prepared, {})


def at(prepared, group, field, factor):
    """The modes with one rate multiplied."""
    own = builtin_truck().rates[group]
    return solve_modal(prepared, {group: replace(own, **{field: getattr(own, field) * factor})})


@pytest.mark.parametrize(("group", "field"), RATES)
def test_along_every_rate_no_identity_has_less_than_half_of_what_another_has(
    prepared, original, group, field
):
    for factor in FACTORS:
        now = at(prepared, group, field, factor)
        found = follow(original, now)
        # From the mass matrix alone.
        mac = (original.modes.shapes.T @ prepared.system.mass @ now.modes.shapes) ** 2
        start = np.flatnonzero(found.index >= 0)
        own = mac[start, found.index[start]]
        assert (own >= mac[start].max(axis=1) / 2 - EQUAL).all()
        assert (own >= mac[:, found.index[start]].max(axis=0) / 2 - EQUAL).all()
        majority, holder = np.nonzero(mac > MAJORITY + EQUAL)
        np.testing.assert_array_equal(found.index[majority], holder)


@pytest.mark.parametrize(("group", "field"), RATES)
def test_along_every_rate_the_way_back_is_the_way_there(prepared, original, group, field):
    for factor in FACTORS[::3]:
        now = at(prepared, group, field, factor)
        there, back = follow(original, now), follow(now, original)
        start = np.flatnonzero(there.index >= 0)
        np.testing.assert_array_equal(back.index[there.index[start]], start)
        assert (back.index >= 0).sum() == len(start)


@pytest.mark.parametrize(("group", "field"), RATES)
def test_along_every_rate_rounding_decides_nothing(prepared, original, group, field):
    for factor in FACTORS[::3]:
        found = [
            follow(original, at(prepared, group, field, factor * (1 + disturbed)))
            for disturbed in (0.0, 1e-12, -1e-12)
        ]
        for other in found[1:]:
            np.testing.assert_array_equal(other.index, found[0].index)
            np.testing.assert_allclose(other.shares, found[0].shares, atol=1e-6)


def test_a_loss_factor_alone_moves_no_mode():
    own = mounted_cabin().rates
    rates = {group: replace(r, loss_factor=0.4) for group, r in own.items()}
    followed = solve_followed(prepare_modes(mounted_cabin()), rates)
    n = len(followed.base.modes.frequency_hz)
    np.testing.assert_array_equal(followed.track.index, np.arange(n))
    np.testing.assert_allclose(followed.track.mac, 1.0, rtol=1e-12)
    assert (followed.now.modes.damping_ratio > followed.base.modes.damping_ratio).all()
