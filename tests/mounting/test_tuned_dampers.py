"""Forces, energies, sag and reduced responses of vehicles with tuned dampers and rotational rates."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from tuned_vehicle import OTHER, tuned_vehicle

from modeviz.analysis.driven import driven
from modeviz.analysis.preparation import prepare
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.energy import strain_energy
from modeviz.dynamics.galerkin import reduced
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.mount_rates import MountSprings
from modeviz.dynamics.spring_law import spring_law
from modeviz.mounting.dissipation import dissipated_energy, dissipation
from modeviz.mounting.forces import solve_forces
from modeviz.mounting.free_bodies import free_stiffness
from modeviz.mounting.levels import input_spectra
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.ride.excitation import generalised_forces
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.load_cases import LoadCase, StaticLoad
from modeviz.vehicle.loads import Force
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

F = np.array([0.7, 3.0, 9.5, 14.0, 22.0, 37.0])
MADE = tuned_vehicle().with_rates(OTHER)
LOADS = ["shaker", "floor"]
ALONG = MountRates(0, 0, 40e3, rx=300.0, damping_vertical=250.0)
C, MASS = 250.0, 12.0


@cache
def system():
    """The vehicle as given, with other rates."""
    return assemble(tuned_vehicle()).with_rates(OTHER)


@cache
def modes():
    return solve_modes(system(), below_hz=60.0)


@pytest.mark.parametrize("name", LOADS)
def test_forces_on_each_body_are_its_mass_times_acceleration(name):
    load = MADE.harmonic_load(name)
    forces, Z = solve_forces(system(), load, F, 20.0), []
    for f in F:
        omega = 2 * np.pi * f
        K_g = system().stiffness + 1j * system().structural_damping
        Z.append(K_g + 1j * omega * system().damping - omega**2 * system().mass)
    x = np.linalg.solve(np.array(Z), generalised_forces(system(), load, F, 20.0))
    for body, own in system().dofs.items():
        inertia = free_stiffness(system(), body, F) @ x[:, own]
        parts = np.abs(system().connection_motions[:, own].T) @ np.abs(forces.force)
        scale = (parts + np.abs(forces.loads[:, own])).max(axis=1, keepdims=True)
        assert (np.abs(forces.on_bodies[:, own] - inertia) <= 1e-9 * scale).all(), body


@pytest.mark.parametrize("name", LOADS)
def test_forces_and_losses_are_those_of_a_vehicle_made_with_the_rates(name):
    load = MADE.harmonic_load(name)
    found, expected = (solve_forces(s, load, F, 20.0) for s in (system(), assemble(MADE)))
    scale = np.abs(expected.force).max(axis=1, keepdims=True)
    assert (np.abs(found.force - expected.force) <= 1e-9 * scale).all()
    spectra = input_spectra(load, F, 20.0)
    lost = [dissipation(each, spectra, False) for each in (found, expected)]
    assert "S0" in lost[0].by_place
    for place, energy in lost[1].by_place.items():
        np.testing.assert_allclose(lost[0].by_place[place], energy, rtol=1e-8)


@pytest.mark.parametrize("name", LOADS)
def test_dissipated_energy_is_the_work_put_in(name):
    load = MADE.harmonic_load(name)
    found = dissipation(solve_forces(system(), load, F, 20.0), input_spectra(load, F, 20.0), False)
    total = np.sum(list(found.by_place.values()), axis=0)
    assert (total > 0).all()
    np.testing.assert_allclose(total, found.work, rtol=1e-9)


def block(rates=ALONG):
    """A block at its mount, with a damper along z and no spring there."""
    mount = Mount("m", "m", ("block", GROUND), np.zeros((2, 3)))
    most = MountRates(4e5, 4e5, 4e5, rx=1e4, ry=1e4, rz=1e4, damping_vertical=1e4)
    return Vehicle(
        "block",
        (RigidBody("block", "other", "block", MASS, np.zeros(3), np.diag([2.0, 3.0, 4.0])),),
        (),
        (MountGroup("m", "m", rates, 0.0, (MountRates(0, 0, 0), most), (mount,)),),
        forces=(Force("push", "block", np.zeros(3), np.array([0.0, 0.0, 1.0]), 5.0),),
        load_cases=(
            LoadCase("torque", (0.0, 0.0, 0.0), (StaticLoad("block", torque=np.array([6.0, 0, 0])),)),
        ),
    )


def test_a_tuned_damper_alone_loses_half_its_rate_times_the_squared_speed():
    """x = F/(jωc - ω²m) along z, on a vehicle that was prepared with another damper."""
    rates = {"m": replace(ALONG, damping_vertical=C)}
    weak = assemble(block(replace(ALONG, damping_vertical=10.0))).with_rates(rates)
    push = weak.vehicle.forces[0]
    omega = 2 * np.pi * F
    x = 5.0 / (1j * omega * C - omega**2 * MASS)
    forces = solve_forces(weak, push, F, 1.0)
    lost = dissipation(forces, input_spectra(push, F, 1.0), False)
    np.testing.assert_allclose(lost.by_place["m"], 0.5 * C * np.abs(omega * x) ** 2, rtol=1e-9)
    np.testing.assert_allclose(np.abs(forces.force[:, 2, 0]), np.abs(omega * C * x), rtol=1e-9)


def test_strain_energy_with_other_rates_is_that_of_a_vehicle_that_has_them():
    stiffness = MountSprings(tuned_vehicle()).elastic(OTHER)[:, None]
    phi = modes().shapes
    found = strain_energy(assemble(tuned_vehicle()), phi, stiffness)
    expected = strain_energy(assemble(MADE), phi)
    elastic = modes().frequency_hz > 1
    np.testing.assert_allclose(sum(found.values())[elastic], 1.0, rtol=1e-9)
    assert not found["S"].any()
    for name, shares in expected.items():
        np.testing.assert_allclose(found[name], shares, rtol=1e-9, atol=1e-12)


def test_so_is_what_modes_lose_with_dampers_among_it():
    given, made = assemble(tuned_vehicle()), assemble(MADE)
    phi, f = modes().shapes, modes().frequency_hz
    law = spring_law(tuned_vehicle())
    there = law.stiffness(MountSprings(tuned_vehicle()).stiffness(OTHER), f)
    found, expected = dissipated_energy(given, phi, f, there), dissipated_energy(made, phi, f)
    assert expected["S"].max() > 0.2
    for name, shares in expected.items():
        np.testing.assert_allclose(found[name], shares, rtol=1e-9, atol=1e-12)


def test_standing_still_at_other_rates_it_is_as_a_vehicle_made_with_them():
    found = solve_statics(prepare_statics(assemble(tuned_vehicle())), OTHER)
    expected = solve_statics(prepare_statics(assemble(MADE)), {})
    for case, its in zip(found.cases, expected.cases, strict=True):
        for body, motion in its.bodies.items():
            scale = np.abs(motion).max()
            np.testing.assert_allclose(case.bodies[body], motion, rtol=1e-9, atol=1e-9 * scale)


@pytest.mark.parametrize("rx", [300.0, 900.0])
def test_a_torque_turns_a_block_by_what_its_rotational_rate_gives_at_rest(rx):
    """θ = T/(k/1.3): rubber is 1.3 times as stiff where it vibrates."""
    full = MountRates(1e5, 1e5, 1e5, rx=300.0, ry=50.0, rz=50.0, damping_vertical=250.0)
    statics = solve_statics(prepare_statics(assemble(block(full))), {"m": replace(full, rx=rx)})
    assert statics.cases[0].bodies["block"][3] == pytest.approx(6.0 * 1.3 / rx, rel=1e-12)


@pytest.mark.parametrize("name", LOADS)
def test_a_few_stretches_tell_responses_of_scattered_rubber_beside_tuned_dampers(name):
    prepared = prepare(tuned_vehicle(), F, is_graded=False)
    receptances = driven(prepared, [prepared.vehicle.harmonic_load(name)], 20.0).at(F)
    parts = scattered_parts(prepared, OTHER, Tolerance())
    few = reduced(receptances, parts.stiffness(parts.samples(64, 0)))
    others = parts.stiffness(parts.samples(10, 1))
    exact = receptances.responses(others)
    scale = np.abs(exact).max(axis=(-2, -1), keepdims=True)
    assert (np.abs(few.responses(others) - exact) <= 1e-3 * scale).all()
