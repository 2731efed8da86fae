import tracemalloc
from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from rounding import assert_near, of_powers
from small_systems import resonant_rate, two_masses

from modeviz.analysis.batch import solve_many
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.dynamics.assembly import assemble
from modeviz.errors import SolveError, VehicleError
from modeviz.vehicle.loads import Road
from modeviz.vehicle.mount_rates import MountRates

FLAT = Conditions("flat", 20.0)
FREQUENCY_HZ = np.linspace(0.5, 40, 80)
BYTES = 8 * (12 + 81 * 3)
"""Of the results of one set: 12 frequencies, 80 lines and an RMS of three directions."""


@pytest.fixture(scope="module")
def prepared():
    return prepare(mounted_cabin(), FREQUENCY_HZ)


def random_sets(n_sets):
    rng = np.random.default_rng(1)
    rates = [
        [MountRates(*rates, rng.uniform(0, 0.5)) for rates in 10 ** rng.uniform(4, 7, (2, 3))]
        for _ in range(n_sets)
    ]
    return [dict(zip("AB", both, strict=True)) for both in rates]


def stiffness_of(prepared, sets):
    return np.array([prepared.mount_stiffness(rates) for rates in sets])


def test_many_are_the_same_as_one_by_one(prepared):
    sets = random_sets(7)
    (batch,) = solve_many(prepared, stiffness_of(prepared, sets), FLAT)
    for i, rates in enumerate(sets):
        single = solve(prepared, rates, FLAT)
        within = of_powers(assemble(prepared.vehicle.with_rates(rates)), FREQUENCY_HZ)
        assert_near(batch.psd[i], single.psd, within)
        assert_near(batch.rms[i], single.rms, within)
        assert batch.mean_personal_rating[i] == pytest.approx(
            single.rating.mean_personal_rating, rel=1e-12
        )
        n = len(single.modes.frequency_hz)
        np.testing.assert_allclose(batch.frequency_hz[i, :n], single.modes.frequency_hz, rtol=1e-9)


def test_chunks_change_nothing(prepared):
    stiffness = stiffness_of(prepared, random_sets(7))
    (whole,) = solve_many(prepared, stiffness, FLAT)
    parts = list(solve_many(prepared, stiffness, FLAT, memory=2 * 3 * BYTES))
    assert [p.start for p in parts] == [0, 3, 6]
    vehicles = [assemble(prepared.vehicle.with_rates(rates)) for rates in random_sets(7)]
    within = max(of_powers(system, FREQUENCY_HZ) for system in vehicles)
    assert_near(np.concatenate([p.psd for p in parts]), whole.psd, within, lines=1)
    frequency_hz = np.concatenate([p.frequency_hz for p in parts])
    np.testing.assert_allclose(frequency_hz, whole.frequency_hz, rtol=1e-9)


def peak_bytes(batches):
    tracemalloc.start()
    for batch in batches:
        assert np.isfinite(batch.mean_personal_rating).all()
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    return peak


def test_the_memory_stated_is_kept(prepared):
    stiffness = np.tile(prepared.mount_stiffness({}), (1500, 1))
    memory = 2 * 2**20
    one = peak_bytes(solve_many(prepared, stiffness[:1], FLAT))
    assert memory < 1500 * BYTES
    assert peak_bytes(solve_many(prepared, stiffness, FLAT, memory)) < memory + 1.5 * one


def test_one_set_is_solved_in_whatever_memory(prepared):
    stiffness = stiffness_of(prepared, random_sets(2))
    assert len(list(solve_many(prepared, stiffness, FLAT, memory=1))) == 2


def test_springs_of_a_group_may_differ(prepared):
    """A mount that is softer on the left makes a cab roll as it heaves, and one on the right too."""
    left, right = np.tile(prepared.mount_stiffness({}), (2, 1))
    left[:3] *= 0.2
    right[3:6] *= 0.2
    (batch,) = solve_many(prepared, np.array([left, right]), FLAT)
    assert not np.allclose(batch.psd[0], batch.psd[1], rtol=1e-3)
    two = prepared.vehicle.mount_groups[0]
    front = [
        replace(two, name=name, mounts=(mount,)) for name, mount in zip("LR", two.mounts, strict=True)
    ]
    groups = (*front, prepared.vehicle.mount_groups[1])
    apart = prepare(replace(prepared.vehicle, mount_groups=groups, rate_sets={}), FREQUENCY_HZ)
    soft = MountRates(*(0.2 * rate for rate in two.rates.as_tuple()))
    for psd, name in zip(batch.psd, "LR", strict=True):
        np.testing.assert_allclose(psd, solve(apart, {name: soft}, FLAT).psd, rtol=1e-9)


def test_no_sets_have_no_results(prepared):
    assert list(solve_many(prepared, np.zeros((0, 12), complex), FLAT)) == []


@pytest.mark.parametrize("rate", [-1.0, np.nan, np.inf])
def test_a_rate_that_cannot_be_is_named_with_its_set(prepared, rate):
    stiffness = stiffness_of(prepared, random_sets(3))
    stiffness[1, 7] = rate
    with pytest.raises(SolveError, match=rf"^set 2, mount spring 8: found a rate of {rate:g} N/m"):
        next(solve_many(prepared, stiffness, FLAT))


@pytest.mark.parametrize("shape", [(12,), (2, 5)])
def test_rates_of_another_shape_are_an_error(prepared, shape):
    with pytest.raises(SolveError, match=r"found shape .*, expected \(n_sets, 12\)"):
        next(solve_many(prepared, np.ones(shape, complex), FLAT))


def test_an_undamped_resonance_is_named_with_its_set():
    f = np.array([1.0, 4.0])
    road = Road("flat", "Flat", 20.0, np.array([0.1, 50.0]), np.tile(np.eye(2), (2, 1, 1)))
    prepared = prepare(replace(two_masses(1.0).vehicle, roads=(road,)), f)
    stiffness = np.zeros((3, 3), complex)
    stiffness[:, 2] = 50.0, 60.0, resonant_rate(4.0)
    with pytest.raises(SolveError, match=r"^set 3: no accurate response at 4\.0 Hz"):
        list(solve_many(prepared, stiffness, FLAT))


def test_a_road_that_is_not_there_is_an_error(prepared):
    with pytest.raises(VehicleError, match=r"unknown random load 'moon'"):
        next(solve_many(prepared, np.ones((1, 12), complex), Conditions("moon", 20.0)))
