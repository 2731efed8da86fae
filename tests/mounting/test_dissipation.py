"""Energy that is lost is the work put in."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_machine import mounted_machine
from small_systems import oscillator

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mode_damping import with_mode_damping
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.mount_rates import MountSprings
from modeviz.mounting.dissipation import MODE_DAMPING, dissipated_energy, dissipation
from modeviz.mounting.forces import solve_forces
from modeviz.mounting.levels import input_spectra
from modeviz.ride.excitation import generalised_forces
from modeviz.vehicle.loads import Force
from modeviz.vehicle.mount_rates import MountRates

F = np.array([0.7, 3.0, 9.5, 14.0, 22.0, 37.0])
MACHINE = mounted_machine()
SYSTEM = with_mode_damping(assemble(MACHINE), 60.0)


def lost(load, lines=F):
    forces = solve_forces(SYSTEM, load, lines, MACHINE.speed)
    spectra = input_spectra(load, lines, MACHINE.speed)
    return dissipation(forces, spectra, load in MACHINE.random_loads)


@pytest.mark.parametrize(
    "load", [*MACHINE.random_loads, *MACHINE.harmonic_loads], ids=lambda load: load.name
)
def test_dissipated_energy_is_the_work_put_in(load):
    found = lost(load)
    total = np.sum(list(found.by_place.values()), axis=0)
    assert (total > 0).all()
    np.testing.assert_allclose(total, found.work, rtol=1e-9)


def test_every_place_that_damps_is_named():
    found = lost(MACHINE.harmonic_load("firing"))
    names = ["front", "rear", "foot", "spring", "damper", "tyre", "frame", MODE_DAMPING]
    assert list(found.by_place) == names


def test_an_oscillator_loses_half_omega_times_its_loss_times_the_squared_peak():
    """x = F/(k(1 + jg) + jωc - ω²m), so it loses ½ ω (gk + ωc) |x|²."""
    base = oscillator(mass=2.0, k=800.0, c=3.0, loss_factor=0.1)
    push = Force("push", "m", np.zeros(3), np.array([0.0, 0.0, 1.0]), 5.0)
    system = assemble(replace(base.vehicle, forces=(push,)))
    omega = 2 * np.pi * F
    x = 5.0 / (800 * (1 + 0.1j) + 3j * omega - 2 * omega**2)
    found = dissipation(solve_forces(system, push, F, 1.0), input_spectra(push, F, 1.0), False)
    loss = np.sum(list(found.by_place.values()), axis=0)
    np.testing.assert_allclose(loss, 0.5 * omega * (80 + 3 * omega) * np.abs(x) ** 2, rtol=1e-9)


def test_power_under_a_random_load_is_the_integral_of_its_spectrum():
    load = MACHINE.random_load("noise")
    lines = np.linspace(0.5, 40, 400)
    found = lost(load, lines)
    for name, power in found.power.items():
        expected = np.trapezoid(found.by_place[name], lines)
        np.testing.assert_allclose(power, expected, rtol=2e-3)


def test_what_a_mode_loses_is_shared_by_groups_and_bodies_and_adds_up_to_its_damping():
    """All of it over the modal stiffness is 2ζ ω²."""
    plain = assemble(replace(MACHINE, mode_damping=()))
    modes = solve_modes(plain, below_hz=60.0)
    elastic = modes.frequency_hz > 1
    shares = dissipated_energy(plain, modes.shapes, modes.frequency_hz)
    total = np.sum(list(shares.values()), axis=0)
    np.testing.assert_allclose(total[elastic], 1.0, rtol=1e-12)
    omega = 2 * np.pi * modes.frequency_hz
    phi = modes.shapes
    whole = np.einsum("im,ij,jm->m", phi, plain.structural_damping, phi)
    whole += omega * np.einsum("im,ij,jm->m", phi, plain.damping, phi)
    np.testing.assert_allclose(
        (whole / (2 * omega**2))[elastic], modes.damping_ratio[elastic], rtol=1e-9
    )


def test_shares_with_other_rates_are_those_of_a_vehicle_that_has_them():
    rates = {"E": MountRates(6e5, 1e5, 3e5, loss_factor=0.3)}
    changed = SYSTEM.with_rates(rates)
    modes = solve_modes(changed, below_hz=60.0)
    stiffness = MountSprings(MACHINE).stiffness(rates)
    found = dissipated_energy(SYSTEM, modes.shapes, modes.frequency_hz, stiffness[None])
    expected = dissipated_energy(changed, modes.shapes, modes.frequency_hz)
    for name, shares in expected.items():
        np.testing.assert_allclose(found[name], shares, rtol=1e-9, atol=1e-12)


def test_work_is_that_of_the_forces_times_the_speed_of_where_they_act():
    load = MACHINE.harmonic_load("firing")
    forces = solve_forces(SYSTEM, load, F, MACHINE.speed)
    x = np.stack([
        np.linalg.solve(
            np.block([
                [
                    SYSTEM.stiffness + 1j * SYSTEM.structural_damping
                    + 2j * np.pi * f * SYSTEM.damping - (2 * np.pi * f) ** 2 * SYSTEM.mass,
                    SYSTEM.held_motions.T,
                ],
                [SYSTEM.held_motions, np.zeros((7, 7))],
            ]),
            action,
        )[: SYSTEM.n_dofs, 0]
        for f, action in zip(F, generalised_forces(SYSTEM, load, F, 1.0), strict=True)
    ])  # fmt: skip
    speed = 2j * np.pi * F[:, None] * x
    power = 0.5 * (forces.loads[:, :, 0] * speed.conj()).real.sum(axis=1)
    np.testing.assert_allclose(lost(load).work, power, rtol=1e-9)
