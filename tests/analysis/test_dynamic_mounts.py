"""Responses and modes of mounts whose rates depend on frequency, against one solve a frequency."""

import numpy as np
import pytest
from dynamic_mounts import HYDRAULIC, MAXWELL, RATES, constant, frozen_at, measured, on_mounts
from scipy.optimize import brentq

from modeviz.analysis.batch import solve_many
from modeviz.analysis.deflection_shapes import complex_mode, road_shape, wheel_shape
from modeviz.analysis.driven import driven
from modeviz.analysis.force_peaks import force_participation
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.sensitivity import frequency_sensitivity, rate_variables, ride_sensitivity
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.galerkin import reduced
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.mounting.forces import solve_forces
from modeviz.optimise.objective import LoadCase, prepare_objective
from modeviz.ride.excitation import generalised_forces, input_spectrum
from modeviz.ride.psd import harmonic_acceleration
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.dynamic_rates import HydraulicRates
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

OTHER = MountRates(190e3, 240e3, 110e3)
RUBBERS = [MAXWELL, HYDRAULIC, measured(MAXWELL), measured(HYDRAULIC)]
IDS = ["maxwell", "hydraulic", "maxwell table", "hydraulic table"]


def frozen_response(vehicle, rates, load, outputs, frequency_hz):
    """One solve of a vehicle with plain springs at each frequency."""
    H = []
    for f in frequency_hz:
        system = assemble(frozen_at(vehicle, rates, f))
        line = np.array([f])
        forces = generalised_forces(system, load, line, vehicle.speed)
        H.append(direct_response(system, line, forces, outputs)[0])
    return np.array(H)


@pytest.mark.parametrize("rubber", RUBBERS, ids=IDS)
@pytest.mark.parametrize("load", ["shaker", "floor"])
def test_a_harmonic_response_is_that_of_springs_with_the_rates_of_each_frequency(rubber, load):
    vehicle = on_mounts(rubber)
    prepared = prepare(vehicle)
    found = solve_wheels(prepared, {"E": OTHER})
    number = [each.name for each in vehicle.harmonic_loads].index(load)
    some = slice(None, None, 7)
    f = found.frequency_hz[some]
    H = frozen_response(vehicle, OTHER, vehicle.harmonic_load(load), prepared.outputs, f)
    expected = harmonic_acceleration(f, H).reshape(len(f), 2, 3)
    assert np.abs(found.acceleration_g[some, number] - expected).max() < 1e-9 * expected.max()


@pytest.mark.parametrize("load", ["shaker", "floor"])
def test_the_full_model_has_the_rates_of_each_frequency(load):
    vehicle, lines = on_mounts(MAXWELL), np.array([3.0, 9.5, 31.0])
    prepared = prepare(vehicle)
    under = driven(prepared, [vehicle.harmonic_load(load)], vehicle.speed)
    found = under.exact_response(prepared.mount_stiffness({"E": OTHER}), lines)
    expected = frozen_response(vehicle, OTHER, vehicle.harmonic_load(load), prepared.outputs, lines)
    assert np.abs(found - expected).max() < 1e-9 * np.abs(expected).max()


@pytest.mark.parametrize("rubber", [MAXWELL, measured(HYDRAULIC)], ids=["maxwell", "table"])
def test_answers_near_other_rates_are_the_same(rubber):
    prepared = prepare(on_mounts(rubber))
    conditions = Conditions("random", 20.0)
    near = solve(prepared.near({"E": OTHER}), {"E": OTHER}, conditions)
    far = solve(prepared, {"E": OTHER}, conditions)
    assert np.abs(near.psd - far.psd).max() < 1e-9 * far.psd.max()


def test_a_constant_table_is_a_plain_rate():
    plain = solve(prepare(on_mounts(None, 0.17)), {"E": OTHER}, Conditions("random", 20.0))
    table = solve(prepare(on_mounts(constant(0.17))), {"E": OTHER}, Conditions("random", 20.0))
    assert np.abs(table.psd / plain.psd - 1).max() < 1e-12 * 1e3
    assert np.abs(table.modes.frequency_hz / plain.modes.frequency_hz - 1).max() < 1e-10
    assert np.abs(table.modes.damping_ratio / plain.modes.damping_ratio - 1).max() < 1e-9


@pytest.mark.parametrize("rubber", RUBBERS, ids=IDS)
def test_modes_are_those_of_springs_with_the_rates_of_their_own_frequency(rubber):
    vehicle = on_mounts(rubber)
    found = solve_modal(prepare_modes(vehicle), {"E": OTHER}).modes.frequency_hz

    def own(i, f):
        return solve_modes(assemble(frozen_at(vehicle, OTHER, f))).frequency_hz[i] - f

    grid = np.arange(0.05, vehicle.highest_frequency, 0.25)
    values = np.array(
        [solve_modes(assemble(frozen_at(vehicle, OTHER, f))).frequency_hz - f for f in grid]
    )
    expected = [
        brentq(lambda f, i=i: own(i, f), grid[at], grid[at + 1], xtol=1e-12)
        for i in range(12)
        for at in np.flatnonzero((values[:-1, i] > 0) & (values[1:, i] <= 0))
    ]
    assert len(found) == len(expected)
    assert np.abs(found / np.sort(expected) - 1).max() < 1e-9


@pytest.mark.parametrize("method", ["enriched", "exact"])
def test_modes_agree_with_the_full_matrices(method):
    prepared = prepare_modes(on_mounts(MAXWELL))
    found = solve_modal(prepared, {"E": OTHER}, method)
    assert found.trust.n_missed == 0
    assert (found.trust.frequency_error_hz < 1e-6).all()


@pytest.mark.parametrize("rubber", [MAXWELL, HYDRAULIC], ids=["maxwell", "hydraulic"])
def test_a_damped_mode_is_a_root_of_the_equations_of_motion(rubber):
    vehicle = on_mounts(rubber)
    results = solve_modal(prepare_modes(vehicle), {"E": OTHER})
    system = results.system
    for i in range(6, 12):
        mode = complex_mode(results, i)
        f = np.array([mode.eigenvalue / (2j * np.pi)])
        kappa = (
            rubber.complex_rates(f)[0] / rubber.complex_rates(np.array([rubber.reference_hz]))[0].real
        )
        change = system.mount_stiffness * (np.tile(kappa, 8) / (1 + 1j * rubber.loss_factor) - 1)
        R = system.mount_motions
        K = system.stiffness + 1j * system.structural_damping + (R.T * change) @ R
        Z = K + mode.eigenvalue * system.damping + mode.eigenvalue**2 * system.mass
        scale = np.abs(mode.eigenvalue) ** 2 * np.linalg.norm(system.mass @ mode.shape)
        assert np.linalg.norm(Z @ mode.shape) < 1e-5 * scale


def test_derivatives_of_frequencies_follow_the_rates_at_them():
    prepared, h = prepare_modes(on_mounts(MAXWELL)), 1e-4
    own = {"E": OTHER}
    slopes = frequency_sensitivity(solve_modal(prepared, own))
    for number, variable in enumerate(rate_variables(prepared.vehicle)[:3]):
        k = getattr(OTHER, variable.direction)
        ends = [
            solve_modal(prepared, {"E": MountRates(**{**vars(OTHER), variable.direction: k * x})})
            for x in (1 + h, 1 - h)
        ]
        change = ends[0].modes.frequency_hz - ends[1].modes.frequency_hz
        expected = change / (2 * h * k)
        assert np.abs(slopes[:, number] - expected).max() < 1e-5 * np.abs(expected).max()


def test_derivatives_of_the_ride_follow_the_rates_at_each_frequency():
    prepared, h = prepare(on_mounts(measured(MAXWELL))), 1e-4
    conditions = Conditions("random", 20.0)
    found = ride_sensitivity(prepared, {"E": OTHER}, conditions)
    for number, variable in enumerate(rate_variables(prepared.vehicle)[:3]):
        k = getattr(OTHER, variable.direction)
        up, down = (
            solve(prepared, {"E": MountRates(**{**vars(OTHER), variable.direction: k * x})}, conditions)
            for x in (1 + h, 1 - h)
        )
        expected = (up.rms - down.rms) / (2 * h * k)
        assert np.abs(found.rms[..., number] - expected).max() < 1e-4 * np.abs(expected).max()


def test_many_sets_are_solved_as_each_alone():
    prepared = prepare(on_mounts(measured(HYDRAULIC)))
    sets = np.array([prepared.mount_stiffness(rates) for rates in ({}, {"E": OTHER})])
    conditions = Conditions("random", 20.0)
    batch = next(iter(solve_many(prepared, sets, conditions)))
    alone = solve(prepared, {"E": OTHER}, conditions)
    assert np.abs(batch.rms[1] / alone.rms - 1).max() < 1e-9
    receptances = prepared.excited([prepared.vehicle.random_load("random")], 20.0)
    expected = np.array([receptances.response(each) for each in sets])
    many, few = receptances.responses(sets), reduced(receptances, sets).responses(sets)
    assert np.abs(many - expected).max() < 1e-9 * np.abs(expected).max()
    assert np.abs(few - expected).max() < 1e-6 * np.abs(expected).max()


def test_operating_shapes_are_of_the_rates_at_their_frequency():
    vehicle = on_mounts(HYDRAULIC)
    prepared = prepare(vehicle)
    results = solve(prepared, {"E": RATES}, Conditions("random", 20.0))
    f = 11.0
    line = np.array([f])
    H = frozen_response(vehicle, RATES, vehicle.harmonic_load("shaker"), np.eye(12), line)[0, :, 0]
    assert np.abs(wheel_shape(results, "shaker", f) - H).max() < 1e-9 * np.abs(H).max()
    psd = results.psd[np.argmin(np.abs(results.frequency_hz - f)), 0, 2]
    shape = prepared.outputs[2] @ road_shape(results, f, 0, "vertical")
    omega = 2 * np.pi * f
    assert abs(shape) == pytest.approx(np.sqrt(psd) * 9.80665 / omega**2, rel=1e-6)


def test_forces_of_mounts_are_those_with_the_rates_of_each_frequency():
    vehicle = on_mounts(MAXWELL).with_rates({"E": OTHER})
    load, f = vehicle.harmonic_load("shaker"), np.array([4.0, 11.0, 23.0])
    found = solve_forces(assemble(vehicle), load, f, vehicle.speed)
    for i, line in enumerate(f):
        plain = assemble(frozen_at(vehicle, OTHER, line))
        alone = solve_forces(plain, load, f[i : i + 1], vehicle.speed)
        by_spring = alone.force[0, :, 0].reshape(-1, 6)[:12]
        expected = by_spring[:, :3].reshape(4, 3, 3).diagonal(axis1=1, axis2=2)
        own = found.force[i, :, 0].reshape(-1, 6)[:4, :3]
        assert np.abs(own - expected).max() < 1e-9 * np.abs(expected).max()


def test_an_optimiser_goes_by_the_rates_of_each_frequency():
    vehicle = on_mounts(measured(HYDRAULIC))
    conditions = Conditions("random", vehicle.speed)
    cases = [LoadCase(conditions, np.arange(2.0, 30.0, 1.5)), LoadCase(vehicle.forces[1], (5.0, 17.0))]
    objective = prepare_objective(vehicle, cases)
    value, gradient = objective.value_and_gradient({"E": OTHER})
    assert objective.exact_value({"E": OTHER}) == pytest.approx(value, rel=1e-9)
    for number, variable in enumerate(rate_variables(vehicle)[:3]):
        k, h = getattr(OTHER, variable.direction), 1e-5
        up, down = (
            objective.value({"E": MountRates(**{**vars(OTHER), variable.direction: k * x})})
            for x in (1 + h, 1 - h)
        )
        assert gradient[number] == pytest.approx((up - down) / (2 * h * k), rel=1e-5)


@pytest.mark.parametrize("track_damping", [0.002, 0.01, 0.05, 0.3])
@pytest.mark.parametrize("highest_hz", [15.0, 40.0, 120.0, 400.0])
def test_no_mode_is_missed_however_wide_the_band(track_damping, highest_hz):
    """A mass on a mount whose fluid swings meets its own frequency up to three times."""
    fluid = HydraulicRates(
        reference_hz=0.1,
        rubber=200e3,
        rubber_loss=0.05,
        bulge_stiffness=100e3,
        track_mass=0.05,
        track_damping=track_damping,
        area_ratio=60.0,
    )
    body = RigidBody("mass", "other", "mass", 100.0, np.zeros(3), 10 * np.eye(3))
    place, rates = np.zeros((2, 3)), MountRates(200e3, 5e3, 5e3)
    side = np.array([5e8, 5e8, 0.0])
    held = Spring("side", "side", ("mass", GROUND), place, side, np.full(3, 5e8))
    mount = Mount("m", "H", ("mass", GROUND), place)
    group = MountGroup("H", "H", rates, fluid.loss_factor, usual_bounds(rates), (mount,), dynamic=fluid)
    vehicle = Vehicle("mass", (body,), (held,), (group,), highest_frequency=highest_hz)
    found = solve_modal(prepare_modes(vehicle), {}).modes

    def misses(f):
        reference = fluid.complex_rates(np.array([0.1]))[0, 2].real
        k = 200e3 * fluid.complex_rates(np.atleast_1d(f))[:, 2].real / reference
        return k - 100.0 * (2 * np.pi * np.atleast_1d(f)) ** 2

    grid = np.linspace(0.02, highest_hz, 200_001)
    values = misses(grid)
    expected = [
        brentq(lambda f: misses(f)[0], grid[at], grid[at + 1])
        for at in np.flatnonzero((values[:-1] > 0) & (values[1:] <= 0))
    ]
    vertical = found.frequency_hz[np.abs(found.shapes[2]) > 0.05]
    assert len(vertical) == len(expected)
    np.testing.assert_allclose(vertical, expected, rtol=1e-9)


def test_modes_make_a_force_by_the_rates_at_its_frequency():
    """Along one spring it is its rate there times what they make of its stretch."""
    vehicle, f = on_mounts(MAXWELL), np.array([4.0, 21.0])
    results = solve(prepare(vehicle), {"E": OTHER}, Conditions("random", 20.0))
    load = vehicle.random_load("random")
    found = force_participation(results, load, f, 0, "z")
    S = input_spectrum(load, f, 20.0)
    row = results.prepared.system.mount_motions[2]
    none = np.zeros((2, 1), complex)
    stretch = results.participation(row, load, f, S, none)
    reference = MAXWELL.complex_rates(np.array([MAXWELL.reference_hz]))[0, 2].real
    k = OTHER.vertical * MAXWELL.complex_rates(f)[:, 2] / reference
    np.testing.assert_allclose(found, np.abs(k)[:, None] * stretch, rtol=1e-9)
