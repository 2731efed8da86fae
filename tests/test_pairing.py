"""Which modes of two sets of rates are compared, on the built-in truck."""

from dataclasses import replace

import numpy as np
import pytest

import modeviz as mv
from modeviz.dynamics.naming import ModeName
from modeviz.tuning.following import accept, follow_rates
from modeviz.tuning.pairing import Pair, pair_modes, same_mode


@pytest.fixture(scope="module")
def prepared():
    return mv.prepare_modes(mv.read_vehicle(mv.builtin_vehicle()))


@pytest.fixture(scope="module")
def stiffer(prepared):
    """The rates with C1 at 1900 N/mm vertical and 1905 N/mm lateral."""
    return {"C1": replace(prepared.vehicle.rates["C1"], vertical=1.9e6, lateral=1.905e6)}


def paired(prepared, rates):
    """Name and frequency with both sets of each pair, and the pairs."""
    base, now = (mv.solve_modal(prepared, r) for r in ({}, rates))
    pairs = pair_modes(base, now, follow_rates(accept(base), base, now))
    return base, now, pairs


def told(results, mode):
    """Name and frequency."""
    return (
        mode if mode is None else (results.names[mode].name, f"{results.modes.frequency_hz[mode]:.2f}")
    )


def mac(base, now):
    """Of all modes with all, from the matrices of the vehicle alone."""
    return (base.modes.shapes.T @ base.prepared.system.mass @ now.modes.shapes) ** 2


def test_a_namesake_that_is_left_is_compared_with_its_own_shape(prepared, stiffer):
    base, now, pairs = paired(prepared, stiffer)
    found = {told(now, p.after): told(base, p.before) for p in pairs}
    assert found["rear axle fore-aft", "17.88"] == ("rear axle fore-aft 2", "17.88")
    assert found["front wheels yaw 2", "20.26"] == ("front wheels yaw", "19.84")
    assert found["front wheels yaw", "18.98"] is None
    assert found["cab fore-aft", "15.19"] is None
    one, two = (base.mode_index(n) for n in ("rear axle fore-aft", "rear axle fore-aft 2"))
    alike = mac(base, now)[:, now.mode_index("rear axle fore-aft")]
    assert alike[two] > 0.99 > 0.01 > alike[one]
    yaws = [now.mode_index(n) for n in ("front wheels yaw", "front wheels yaw 2")]
    first, second = mac(base, now)[base.mode_index("front wheels yaw"), yaws]
    assert second > 1.5 * first


def test_namesakes_whose_shapes_are_alike_in_part_are_a_weak_pair(prepared, stiffer):
    _, now, pairs = paired(prepared, stiffer)
    listed = [p for p in pairs if p.after is not None and now.modes.frequency_hz[p.after] < 21]
    assert [told(now, p.after)[0] for p in listed if p.is_weak] == ["front wheels yaw 2"]


@pytest.mark.parametrize("rates", ["stiffer", "optimised"])
def test_every_mode_is_there_once(prepared, stiffer, rates):
    base, now, pairs = paired(prepared, stiffer if rates == "stiffer" else optimised(prepared))
    for results, found in ((base, [p.before for p in pairs]), (now, [p.after for p in pairs])):
        assert sorted(i for i in found if i is not None) == list(range(len(results.names)))


def optimised(prepared):
    return prepared.vehicle.rate_sets["optimised"]


def test_what_stands_once_is_compared_by_name_wherever_its_shape_went(prepared):
    base, now, pairs = paired(prepared, optimised(prepared))
    found = {told(base, p.before): told(now, p.after) for p in pairs}
    assert found["cab yaw", "11.69"] == ("cab yaw", "9.78")
    assert found["rear axle fore-aft 2", "17.88"] == ("rear axle fore-aft", "17.63")
    assert found["rear axle fore-aft", "15.12"] is None


def test_modes_with_the_same_rates_are_compared_with_themselves(prepared):
    base, now, pairs = paired(prepared, {})
    assert set(pairs) == {Pair(i, i) for i in range(len(base.names))}
    np.testing.assert_allclose(now.modes.frequency_hz, base.modes.frequency_hz, rtol=1e-9, atol=1e-3)


def test_namesakes_of_unclear_shape_are_compared_by_rising_frequency(prepared):
    """As many before as now; where a shape is clearly another mode, there is nothing to compare."""
    base, track = start_of(prepared)
    one, two = (base.mode_index(n) for n in ("rear axle fore-aft", "rear axle fore-aft 2"))
    unclear = unknown(track, (one, two), 0.0)
    assert {Pair(one, one, True), Pair(two, two, True)} <= set(pair_modes(base, base, unclear))
    other = base.mode_index("cab roll")
    clear = unknown(track, (one, two), 1.0, other)
    found = set(pair_modes(base, base, clear))
    assert {Pair(one, None), Pair(None, one), Pair(two, None), Pair(None, two)} <= found


def test_a_mode_of_another_set_is_found_by_name_and_namesakes_by_shape(prepared):
    base, now = mv.solve_modal(prepared, {}), mv.solve_modal(prepared, optimised(prepared))
    for name, found in (
        ("cab yaw", "cab yaw"),
        ("rear axle fore-aft", "rear axle fore-aft"),
        ("rear axle fore-aft 2", "rear axle fore-aft"),
    ):
        i = base.mode_index(name)
        assert same_mode(now, base.names[i], base.modes.shapes[:, i]) == now.mode_index(found)
    assert same_mode(now, ModeName("nothing", 1.0), base.modes.shapes[:, 0]) is None


def start_of(prepared):
    base = mv.solve_modal(prepared, {})
    return base, accept(base)


def unknown(track, modes, share, other=-1):
    """A track on which some modes went to another, or out of the band."""
    modes = list(modes)
    index, shares, step_mac = track.index.copy(), track.shares.copy(), track.step_mac.copy()
    index[modes], shares[modes] = other, 0.0
    shares[modes, other] = share
    step_mac[modes] = share
    return replace(track, index=index, shares=shares, step_mac=step_mac)
