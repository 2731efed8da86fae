"""Forces at one frequency by reanalysis are those of the vehicle solved anew."""

import numpy as np
import pytest
from mounted_machine import mounted_machine

from modeviz.analysis.forces import solve_loaded
from modeviz.analysis.line_forces import prepare_line
from modeviz.analysis.preparation import prepare_modes
from modeviz.mounting.levels import input_spectra
from modeviz.mounting.paths import solve_paths
from modeviz.vehicle.mount_rates import MountRates

MACHINE = mounted_machine()
PREPARED = prepare_modes(MACHINE, 60.0)
RATES = {"E": MountRates(5e5, 2e5, 1e5, loss_factor=0.25), "F": MountRates(2e5, 3e5, 6e5)}
LOADS = [*MACHINE.random_loads, *MACHINE.harmonic_loads]


@pytest.mark.parametrize("frequency_hz", [0.7, 9.5, 31.0])
@pytest.mark.parametrize("load", LOADS, ids=lambda load: load.name)
def test_paths_at_one_frequency_are_those_of_the_vehicle_solved_anew(load, frequency_hz):
    line = prepare_line(PREPARED, {"E": MountRates(1e5, 2e5, 3e5)}, load, frequency_hz, MACHINE.speed)
    forces = line.forces(PREPARED.mount_stiffness(RATES))
    at = np.array([frequency_hz])
    anew = solve_loaded(PREPARED, RATES, load, MACHINE.speed, at)
    spectra = input_spectra(load, at, MACHINE.speed)
    for point in MACHINE.response_points:
        row = PREPARED.system.motion(point.body, point.position)[2]
        own = row[PREPARED.system.dofs[point.body]]
        found = solve_paths(forces, point.body, own)
        expected = anew.paths(point, 2)
        assert found.paths == expected.paths
        largest = np.abs(expected.parts).max()
        assert (np.abs(found.parts - expected.parts) <= 1e-8 * largest).all()
        cancelled = (largest / np.abs(expected.response).max()) ** 2
        error = np.abs(found.shares(spectra) - expected.shares(spectra))
        assert (error <= 1e-7 * cancelled).all()


def test_the_rates_it_was_prepared_with_need_no_change():
    load = MACHINE.harmonic_load("firing")
    line = prepare_line(PREPARED, RATES, load, 12.0, MACHINE.speed)
    forces = line.forces(PREPARED.mount_stiffness(RATES))
    anew = solve_loaded(PREPARED, RATES, load, MACHINE.speed, np.array([12.0]))
    error = np.abs(forces.on_bodies - anew.forces.on_bodies)
    assert (error <= 1e-9 * np.abs(anew.forces.on_bodies).max()).all()
