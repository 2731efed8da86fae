from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from oracles import Beam
from rounding import EPSILON
from small_systems import block

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.errors import SolveError, VehicleError
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

FLAT = Conditions("flat", 20.0)
SOFT = {"A": MountRates(2e5, 1e5, 1e5)}
LINES = np.array([1.0, 5.0, 12.0])


@pytest.fixture(scope="module")
def prepared():
    return prepare(mounted_cabin(), LINES)


def test_spring_rates_are_the_tuned_vehicles(prepared):
    expected = mount_stiffness(mounted_cabin().with_rates(SOFT))
    np.testing.assert_allclose(prepared.mount_stiffness(SOFT), expected, rtol=8 * EPSILON)


def test_rates_that_are_not_given_are_the_vehicles_own(prepared):
    assert prepared.all_rates(SOFT) == {**mounted_cabin().rates, **SOFT}


def test_a_loss_factor_is_among_all_rates_only_where_it_is_not_the_vehicles_own(prepared):
    own = prepared.vehicle.rates
    same, other = (replace(own["A"], loss_factor=g) for g in (0.15, 0.2))
    assert prepared.all_rates({"A": same}) == own
    assert prepared.all_rates({"A": other}) == {**own, "A": other}


@pytest.mark.parametrize("loss_factor", [0.0, 0.3])
def test_a_loss_factor_is_that_of_the_groups_springs(prepared, loss_factor):
    rates = {"B": replace(SOFT["A"], loss_factor=loss_factor)}
    stiffness = prepared.mount_stiffness(rates)
    rear = np.tile([1e5, 1e5, 2e5], 2) * (1 + 1j * loss_factor)
    np.testing.assert_allclose(stiffness[6:], rear, rtol=8 * EPSILON)
    expected = mount_stiffness(mounted_cabin().with_rates(rates))
    np.testing.assert_allclose(stiffness, expected, rtol=8 * EPSILON)


def test_a_group_that_is_not_there_is_an_error(prepared):
    for use in (prepared.all_rates, prepared.mount_stiffness, prepared.springs.loss, prepared.near):
        with pytest.raises(VehicleError, match=r"unknown mount group 'C'.*there are A, B"):
            use({"C": MountRates(1.0, 1.0, 1.0)})


@pytest.mark.parametrize("rate", [-1.0, np.nan, np.inf])
def test_a_rate_that_cannot_be_is_an_error(rate):
    with pytest.raises(VehicleError, match=rf"lateral rate: found {rate} N/m, expected zero or more"):
        MountRates(1.0, rate, 1.0)


def test_receptances_hold_at_the_softest_rates(prepared):
    softest = mounted_cabin().with_rates({g.name: g.bounds[0] for g in mounted_cabin().mount_groups})
    found = prepared.receptances.mount_stiffness
    np.testing.assert_allclose(found, mount_stiffness(softest), rtol=8 * EPSILON)


def test_answers_near_other_rates_are_the_same(prepared):
    lossy = {"A": replace(SOFT["A"], loss_factor=0.3)}
    near = prepared.near(lossy)
    found, expected = near.receptances.mount_stiffness, prepared.mount_stiffness(lossy)
    np.testing.assert_allclose(found, expected, rtol=8 * EPSILON)
    for rates in ({}, SOFT, lossy, {"B": MountRates(0.0, 1e8, 0.0)}):
        np.testing.assert_allclose(
            solve(near, rates, FLAT).psd, solve(prepared, rates, FLAT).psd, rtol=1e-10
        )


def test_memory_is_at_least_that_of_receptances_and_basis(prepared):
    assert prepared.n_bytes > prepared.receptances.n_bytes + prepared.basis.n_bytes
    assert prepared.basis.n_bytes > prepared.basis.vectors.nbytes


def test_progress_rises_to_one():
    told = []
    prepare(mounted_cabin(), LINES, progress=told.append)
    assert told == pytest.approx([1 / 3, 2 / 3, 1])


def test_a_vehicle_without_mounts_rides_as_it_is():
    vehicle = mounted_cabin()
    held = tuple(
        Spring(m.name, "fixed", m.bodies, m.points, m.stiffness, loss_factor=m.loss_factor)
        for m in vehicle.mounts
    )
    fixed = replace(vehicle, connections=(*vehicle.connections, *held), mount_groups=(), rate_sets={})
    found = solve(prepare(fixed), {}, FLAT)
    expected = solve(prepare(vehicle), {}, FLAT)
    assert (np.abs(found.psd - expected.psd) < 1e-8 * expected.psd.max(axis=0)).all()
    np.testing.assert_allclose(found.modes.frequency_hz, expected.modes.frequency_hz, rtol=1e-10)
    assert found.rates == {}


def test_a_vehicle_without_response_points_has_modes_and_no_responses():
    results = solve(prepare(replace(mounted_cabin(), response_points=())), SOFT, FLAT)
    assert len(results.names) == 12
    assert results.psd.shape == (len(results.vehicle.frequency_hz), 0, 3)
    assert results.rms.shape == (0, 3)


def test_a_vehicle_without_wheel_loads_has_no_responses_to_them():
    prepared = prepare(replace(mounted_cabin(), wheel_loads=()), LINES)
    assert solve_wheels(prepared, {}).acceleration_g.shape == (3, 0, 1, 3)


def test_a_vehicle_on_nothing_has_modes_and_stands_still():
    free = replace(mounted_cabin(), connections=(), wheel_loads=())
    results = solve(prepare(free, LINES), SOFT, FLAT)
    np.testing.assert_allclose(results.modes.frequency_hz[:6], 0, atol=1e-4)
    np.testing.assert_array_equal(results.psd, 0)


def test_a_vehicle_without_modes_in_the_band_has_none():
    ends = np.zeros((2, 3))
    foot = Spring("foot", "feet", ("a", GROUND), ends, np.full(3, 1e9), np.full(3, 1e9))
    prepared = prepare_modes(Vehicle("stiff", (block("a", 10.0),), (foot,)))
    for method in ("enriched", "classic", "exact"):
        modal = solve_modal(prepared, {}, method)
        assert len(modal.names) == len(modal.modes.frequency_hz) == modal.trust.n_missed == 0


def test_frequencies_are_checked():
    with pytest.raises(SolveError, match="0 Hz at place 1"):
        prepare(mounted_cabin(), np.array([0.0, 1.0]))


def stiffly_bounded(lower: float) -> Vehicle:
    cabin = mounted_cabin()
    bounds = (MountRates(lower, lower, lower), MountRates(9 * lower, 9 * lower, 9 * lower))
    return replace(cabin, mount_groups=tuple(replace(g, bounds=bounds) for g in cabin.mount_groups))


@pytest.mark.parametrize("lower", [1e4, 1e9, 1e12])
def test_stiff_bounds_cost_soft_rates_no_digits(lower):
    f = np.array([1.0, 5.0, 12.0])
    road = Conditions("flat", 20.0)
    soft = {g: MountRates(2e5, 1e5, 1e5) for g in "AB"}
    expected = solve(prepare(mounted_cabin(), f), soft, road).psd
    found = solve(prepare(stiffly_bounded(lower), f), soft, road).psd
    np.testing.assert_allclose(found, expected, rtol=1e-9)


@pytest.mark.parametrize("rate", [1e9, 1e12, 1e15])
def test_from_near_rigid_rates_there_is_a_way_back(rate):
    f = np.array([1.0, 5.0, 12.0])
    road = Conditions("flat", 20.0)
    prepared = prepare(mounted_cabin(), f)
    moved = prepared.near({"A": MountRates(rate, rate, rate)})
    np.testing.assert_allclose(solve(moved, {}, road).psd, solve(prepared, {}, road).psd, rtol=1e-10)


def test_a_body_alone_on_nothing_is_prepared_near_its_rates():
    beam = prepare(Vehicle("beam", (Beam(4).body("beam"),), ()))
    assert beam.near({}).vehicle is beam.vehicle
