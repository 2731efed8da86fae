"""Modes recognised where it is known which is which: crossings, veerings, ties, a band that ends."""

from itertools import permutations

import numpy as np
import pytest
from small_systems import mass_on_a_string, spring

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.tracking import EQUAL, MAJORITY, WEAK_MAC, track_modes
from modeviz.vehicle.vehicle import Vehicle

N_FREE = 10
"""Two bodies that are held in z alone have ten free motions."""

FIXED, RISING = N_FREE, N_FREE + 1
"""The two that vibrate, in their order at the start."""


def system_of(springs, n_masses):
    """Unit masses a, b, c ... in a row of springs (ends, rate)."""
    bodies = tuple(mass_on_a_string(name, 1.0) for name in "abc"[:n_masses])
    return assemble(Vehicle("masses", bodies, tuple(spring(*s) for s in springs)))


def pair(k_b, coupling=0.0, k_a=1e4):
    """A unit mass on `k_a` and one on `k_b`, joined by a spring."""
    joined = [(("a", "b"), coupling)] if coupling else []
    return system_of([(("a", "ground"), k_a), (("b", "ground"), k_b), *joined], 2)


def track(one, other, n_modes=None):
    """From the modes of one system to those of another of the same masses."""
    start, present = (solve_modes(s, n_modes) for s in (one, other))
    return track_modes(one.momentum(start.shapes), start, present)


def track_shapes(start, present, frequency_hz=None):
    """From shapes to shapes of unit masses, by default at 1, 2, 3 ... Hz."""
    modes = [
        Modes(np.arange(1.0, s.shape[1] + 1) if f is None else np.array(f), s, np.zeros(s.shape[1]))
        for s, f in zip((start, present), frequency_hz or (None, None), strict=True)
    ]
    return track_modes(start, *modes)


def rotation(degrees):
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.array([[c, -s], [s, c]])


def turned(n_modes, seed):
    """Shapes of `n_modes` that are orthonormal, and no others."""
    return np.linalg.qr(np.random.default_rng(seed).standard_normal((n_modes, n_modes)))[0]


def inverse(index, n_present):
    """Which of the start's modes each present one is; -1 if none."""
    found = np.full(n_present, -1)
    found[index[index >= 0]] = np.flatnonzero(index >= 0)
    return found


@pytest.mark.parametrize("k", [0.5e4, 0.99e4, 1.01e4, 4e4])
def test_modes_that_cross_go_through_each_other(k):
    found = track(pair(2e4), pair(k))
    is_below = k < 1e4
    assert list(found.index[N_FREE:]) == ([RISING, FIXED] if is_below else [FIXED, RISING])
    np.testing.assert_allclose(found.mac, 1.0, rtol=1e-9)
    assert not found.weak.any()


@pytest.mark.parametrize("coupling", [2.0, 200.0, 2e3])
def test_modes_that_veer_share_their_shapes_and_then_have_gone_through_each_other(coupling):
    start = 2.5e4 * coupling**0.1
    for k in np.append(1e4 + coupling * np.array([30.0, 2, 0.5, -0.5, -2]), 50.0):
        found = track(pair(start, coupling), pair(k, coupling))
        # Of the lower branch from body a, tan 2θ = 2k_c / (k_b - k_a).
        angle = [np.arctan2(2 * coupling, k_b - 1e4) / 2 for k_b in (start, k)]
        share = np.cos(angle[1] - angle[0]) ** 2
        np.testing.assert_allclose(found.shares[FIXED, N_FREE:], [share, 1 - share], atol=1e-7)
        lower_first = share > MAJORITY
        assert list(found.index[N_FREE:]) == ([FIXED, RISING] if lower_first else [RISING, FIXED])
        assert list(found.weak[N_FREE:]) == [max(share, 1 - share) < WEAK_MAC] * 2


def test_who_has_the_majority_of_a_shape_is_it_whatever_that_leaves_to_others():
    # MAC [[.52, .47, .01], [.45, ...]]: the off-diagonal ones together would have more.
    first = np.sqrt([0.52, 0.47, 0.01])
    second = np.array([np.sqrt(0.45), 0.0, 0.0])
    second[1] = -(first[0] * second[0]) / first[1] * 0.98
    second[2] = -(first[:2] @ second[:2]) / first[2]
    present = np.vstack([first, second / np.linalg.norm(second)])
    present = np.vstack([present, np.cross(*present)])
    found = track_shapes(np.eye(3), present)
    assert found.index[0] == 0
    for seed in range(200):
        found = track_shapes(np.eye(6), turned(6, seed))
        rows, columns = np.nonzero(found.shares > MAJORITY + EQUAL)
        np.testing.assert_array_equal(found.index[rows], columns)


def test_no_identity_has_less_than_half_of_what_another_has():
    for seed in range(200):
        found = track_shapes(np.eye(8), turned(8, seed)[:, :6])
        rows = np.flatnonzero(found.index >= 0)
        mac, columns = found.mac[rows], found.index[rows]
        assert (mac >= found.shares[rows].max(axis=1) / 2 - EQUAL).all()
        assert (mac >= found.shares[:, columns].max(axis=0) / 2 - EQUAL).all()
        assert (mac >= (1 - found.shares[rows].sum(axis=1)) / 2 - EQUAL).all()
        assert len(set(columns)) == len(columns)


def test_the_rest_are_assigned_so_that_most_of_all_shapes_is_where_its_identity_is():
    for seed in range(50):
        found = track_shapes(np.eye(5), turned(5, seed))
        shares = found.shares
        half = np.maximum(shares.max(axis=1, keepdims=True), shares.max(axis=0)) / 2
        likeness = np.where(shares >= half, shares + (shares > MAJORITY), 0.0)
        best = max(likeness[range(5), list(order)].sum() for order in permutations(range(5)))
        rows = np.flatnonzero(found.index >= 0)
        # What equal shares go by, their order, may cost so much.
        assert likeness[rows, found.index[rows]].sum() > best - 20 * EQUAL


def test_the_other_way_round_it_is_the_same():
    for seed in range(100):
        one, other = np.eye(7)[:, :6], turned(7, seed)[:, :5]
        there, back = track_shapes(one, other), track_shapes(other, one)
        np.testing.assert_array_equal(back.index, inverse(there.index, 5))
        np.testing.assert_allclose(back.shares, there.shares.T, atol=1e-14)


@pytest.mark.parametrize("disturbed", [0.0, 1e-12, -1e-12, 1e-9, -1e-9])
def test_equal_shares_go_by_the_order_whatever_rounding_says(disturbed):
    """Two equal masses that are joined move together or against each other; apart, each alone."""
    found = track(pair(1e4 * (1 + disturbed), 1e3), pair(2e4))
    np.testing.assert_allclose(found.shares[N_FREE:, N_FREE:], 0.5, atol=1e-6)
    assert list(found.index[N_FREE:]) == [FIXED, RISING]
    assert found.weak[N_FREE:].all()
    for mode in (FIXED, RISING):
        assert [i for i, _ in found.holders(mode)] == [FIXED, RISING]
        assert [i for i, _ in found.sources(mode)] == [FIXED, RISING]


def test_three_that_move_as_one_and_then_alone_are_told_by_order_too():
    """Shares are 1/3, 1/2 and 1/6, 0 and 2/3: halves of each other, too."""
    joined = [(("a", "b"), 1e3), (("b", "c"), 1e3), (("a", "c"), 2e3)]
    alone = [((name, "ground"), k) for name, k in zip("abc", (1e4, 2e4, 3e4), strict=True)]
    equal = [((name, "ground"), 1e4) for name in "abc"]
    for disturbed in (0.0, 1e-12, -1e-12):
        equal[0] = (("a", "ground"), 1e4 * (1 + disturbed))
        found = track(system_of([*equal, *joined], 3), system_of(alone, 3))
        shares = found.shares[15:, 15:]
        np.testing.assert_allclose(np.sort(shares[0]), 1 / 3, atol=1e-6)
        assert list(found.index[15:]) == [15, 16, 17]


@pytest.mark.parametrize("degrees", [0, 30, 45, 75, 140])
def test_repeated_modes_keep_their_identity_however_the_solver_mixes_them(degrees):
    mixed = np.eye(4)
    mixed[1:3, 1:3] = rotation(degrees)
    same, apart = ([1.0, 2.0, 2.0, 3.0], [1.0, 2.0, 2.5, 3.0])
    for frequency_hz in ((same, same), (same, apart), (apart, same)):
        shapes = (np.eye(4), mixed) if frequency_hz[1] is same else (mixed, np.eye(4))
        found = track_shapes(*shapes, frequency_hz)
        np.testing.assert_array_equal(found.index, range(4))
        np.testing.assert_allclose(found.mac, 1.0, rtol=1e-12)


def test_of_a_repeated_set_that_is_mixed_with_another_mode_the_rest_keeps_its_shape():
    mixed = np.eye(4)
    mixed[np.ix_([1, 3], [1, 3])] = rotation(50)
    mixed[:, 1:3] = mixed[:, 1:3] @ rotation(70)
    frequency_hz = ([1.0, 2.0, 2.0, 3.0], [1.0, 2.0, 2.0, 3.0])
    there, back = (
        track_shapes(np.eye(4), mixed, frequency_hz),
        track_shapes(mixed, np.eye(4), frequency_hz),
    )
    for found in (there, back):
        assert np.sort(found.mac)[2:] == pytest.approx(1.0, rel=1e-12)
    np.testing.assert_array_equal(back.index, inverse(there.index, 4))


def three(k):
    """Three uncoupled unit masses on 1, `k` and 3 x 1e4 N/m."""
    names = zip("abc", (1e4, k * 1e4, 3e4), strict=True)
    return system_of([((name, "ground"), s) for name, s in names], 3)


def test_a_mode_that_leaves_the_band_gives_its_identity_to_nobody():
    n_free = 15
    found = track(three(2.0), three(4.0), n_free + 2)
    assert list(found.index[n_free:]) == [n_free, -1]
    assert found.mac[-1] == 0.0
    assert found.holders(n_free + 1) == []
    assert found.sources(n_free + 1) == []
    assert found.shares[-1].sum() == pytest.approx(0.0, abs=1e-9)
    assert list(found.weak[n_free:]) == [False, True]


def test_what_is_mostly_above_the_band_is_in_nothing_of_it():
    shares = np.array([0.3, 0.05, 0.65])
    for scale, n_holders in ((1.0, 0), (2.0, 1)):
        present = np.sqrt(shares * [scale, 1, (1 - 0.05 - 0.3 * scale) / 0.65])[:, None]
        found = track_shapes(np.eye(3)[:, :1], present)
        assert len(found.holders(0)) == n_holders


def test_a_band_without_modes_has_no_identities():
    found = track_shapes(np.eye(3), np.zeros((3, 0)))
    assert list(found.index) == [-1] * 3
    assert not found.mac.any()
