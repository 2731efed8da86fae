"""Forces of mounts by reanalysis are those of the vehicle solved anew."""

import numpy as np
import pytest
from dynamic_mounts import MAXWELL, on_mounts
from mounted_machine import mounted_machine

from modeviz.analysis.driven import driven, load_lines
from modeviz.analysis.forces import solve_loaded
from modeviz.analysis.line_forces import prepare_line
from modeviz.analysis.mount_forces import mount_forces
from modeviz.analysis.preparation import prepare
from modeviz.dynamics.resonances import resonances_at
from modeviz.mounting.levels import input_spectra
from modeviz.vehicle.mount_rates import MountRates

MACHINE = mounted_machine()
PREPARED = prepare(MACHINE)
RATES = {"E": MountRates(5e5, 2e5, 1e5, loss_factor=0.25), "F": MountRates(2e5, 3e5, 6e5)}


@pytest.mark.parametrize("near", [False, True], ids=["from the softest rates", "from close by"])
@pytest.mark.parametrize("name", ["road", "noise", "random floor", "firing", "floor", "unbalance"])
def test_forces_of_mounts_are_those_of_the_vehicle_solved_anew(name, near):
    is_random = name in {load.name for load in MACHINE.random_loads}
    load = MACHINE.random_load(name) if is_random else MACHINE.harmonic_load(name)
    prepared = PREPARED.near({"E": RATES["E"]}) if near else PREPARED
    grid = load_lines(prepared, [(load, MACHINE.speed)]) if is_random else None
    under = driven(prepared, [load], MACHINE.speed, grid)
    stiffness = prepared.mount_stiffness(RATES)
    lines = under.lines(resonances_at(prepared.basis, stiffness))
    spectra = input_spectra(load, lines, MACHINE.speed)
    found = mount_forces(under, stiffness, lines, spectra, is_random)
    anew = solve_loaded(prepared, RATES, load, MACHINE.speed, lines)
    n = len(MACHINE.mounts)
    expected = anew.forces.force[:, : 6 * n].reshape(len(lines), n, 6, -1)
    scale = np.abs(expected[:, :, :3]).max(axis=(1, 2), keepdims=True)
    assert (np.abs(found.force - expected)[:, :, :3] <= 1e-6 * scale).all()
    front, _, foot = range(3)
    turning = np.abs(found.force - expected)[:, front, 3:]
    assert (turning <= 1e-6 * np.abs(expected[:, front, 3:]).max(axis=1, keepdims=True)).all()
    np.testing.assert_allclose(found.rms[:, :3], anew.rms[0, :n, :3], rtol=1e-6)
    np.testing.assert_allclose(found.vehicle_rms[:2], anew.rms[1, :2], rtol=1e-6)
    np.testing.assert_allclose(
        found.level(foot, "z"), anew.spectra.psd(anew.force(2, "z"))[:, 0] ** (1 if is_random else 0.5),
        rtol=1e-6,
    )  # fmt: skip


@pytest.mark.parametrize("name", ["random", "shaker", "floor"])
def test_rates_that_depend_on_frequency_are_those_that_mounts_have_there(name):
    vehicle, rates = on_mounts(MAXWELL), {"E": MountRates(4e5, 1e5, 2e5)}
    prepared = prepare(vehicle)
    is_random = name == "random"
    load = vehicle.random_load(name) if is_random else vehicle.harmonic_load(name)
    under, stiffness = driven(prepared, [load], vehicle.speed), prepared.mount_stiffness(rates)
    lines = under.lines(resonances_at(prepared.basis, stiffness))
    spectra = input_spectra(load, lines, vehicle.speed)
    found = mount_forces(under, stiffness, lines, spectra, is_random)
    anew = solve_loaded(prepared, rates, load, vehicle.speed, lines)
    expected = anew.forces.force[:, : 6 * len(vehicle.mounts)].reshape(found.force.shape)
    largest = np.abs(expected).max(axis=(1, 2, 3), keepdims=True)
    assert (np.abs(found.force - expected) <= 1e-6 * largest).all()
    at = float(lines[90])
    line = prepare_line(prepared, {}, load, at, vehicle.speed).forces(stiffness)
    assert np.abs(line.force[0] - anew.forces.force[90]).max() <= 1e-8 * largest[90]
