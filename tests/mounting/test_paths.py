"""Paths add up to responses that the whole vehicle's equations give."""

import numpy as np
import pytest
from mounted_machine import mounted_machine

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mode_damping import with_mode_damping
from modeviz.dynamics.response import direct_response
from modeviz.mounting.forces import solve_forces
from modeviz.mounting.levels import input_spectra
from modeviz.mounting.paths import LOADS, MODE_DAMPING, Paths, solve_paths
from modeviz.ride.excitation import generalised_forces

F = np.array([0.7, 3.0, 9.5, 14.0, 22.0, 37.0])
MACHINE = mounted_machine()
SYSTEM = with_mode_damping(assemble(MACHINE), 60.0)
LOADED = [*MACHINE.random_loads, *MACHINE.harmonic_loads]


def paths_to(load, point, axis=2):
    place = next(p for p in MACHINE.response_points if p.name == point)
    row = SYSTEM.motion(place.body, place.position)[axis]
    forces = solve_forces(SYSTEM, load, F, MACHINE.speed)
    return solve_paths(forces, place.body, row[SYSTEM.dofs[place.body]]), row


@pytest.mark.parametrize("point", ["sensor", "head"])
@pytest.mark.parametrize("load", LOADED, ids=lambda load: load.name)
def test_paths_add_up_to_the_response_of_the_whole_vehicle(load, point):
    paths, row = paths_to(load, point)
    actions = generalised_forces(SYSTEM, load, F, MACHINE.speed)
    whole = direct_response(SYSTEM, F, actions, row[None])
    largest = np.abs(paths.parts).max(axis=1, keepdims=True)
    assert (np.abs(paths.response - whole) <= 1e-9 * largest).all()


@pytest.mark.parametrize("load", LOADED, ids=lambda load: load.name)
def test_shares_add_up_to_one(load):
    paths, _ = paths_to(load, "sensor")
    spectra = input_spectra(load, F, MACHINE.speed)
    np.testing.assert_allclose(paths.shares(spectra).sum(axis=1), 1.0, atol=1e-9)
    np.testing.assert_allclose(paths.total_shares(spectra).sum(), 1.0, atol=1e-9)


def test_what_acts_on_the_body_itself_is_a_path_of_its_own():
    paths, _ = paths_to(MACHINE.harmonic_load("firing"), "head")
    assert [p.connection for p in paths.paths if not p.direction] == [MODE_DAMPING, LOADS]
    there, _ = paths_to(MACHINE.harmonic_load("floor"), "head")
    assert LOADS not in {p.connection for p in there.paths}


def test_paths_taken_together_by_neighbour_are_what_comes_in_from_each():
    paths, _ = paths_to(MACHINE.harmonic_load("floor"), "sensor")
    by_body = paths.together("body")
    assert [p.body for p in by_body.paths] == ["engine", "ground", "hub", "table", ""]
    np.testing.assert_allclose(by_body.response, paths.response, rtol=1e-12)
    engine = [p.body == "engine" for p in paths.paths]
    np.testing.assert_allclose(by_body.parts[:, 0], paths.parts[:, engine].sum(axis=1), rtol=1e-12)


def test_a_single_path_has_all_of_the_response():
    paths, _ = paths_to(MACHINE.harmonic_load("floor"), "sensor")
    one = Paths(F, paths.paths[:1], paths.response)
    spectra = input_spectra(MACHINE.harmonic_load("floor"), F, MACHINE.speed)
    np.testing.assert_allclose(one.shares(spectra), 1.0, rtol=1e-12)
    np.testing.assert_allclose(one.alone(spectra), 1.0, rtol=1e-12)
