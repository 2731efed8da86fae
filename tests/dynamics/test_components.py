from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import truck_modes
from mounted_cabin import mounted_cabin
from oracles import Beam

from modeviz.analysis.modal_results import solve_modal
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.components import component_modes, component_shares
from modeviz.dynamics.energy import kinetic_energy
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.vehicle.bodies import AddedMass
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

RIGID = ("fore-aft", "lateral", "bounce", "roll", "pitch", "yaw")
BEAM = Beam(8)


def beam_on_springs(*added: AddedMass, n_modes=14, loads=((2, 2), (6, 1))):
    """A beam with two residual vectors, held at both ends and below a rigid one it carries."""
    body = BEAM.body("beam", n_modes=n_modes, loads=loads)
    other = replace(mounted_cabin().bodies[0], name="box", center_of_gravity=np.array([1.0, 0, 0.4]))
    feet = [
        Spring(f"foot {i}", "feet", ("beam", other), np.tile(BEAM.nodes[i], (2, 1)), np.full(3, 2e4))
        for i, other in ((0, "ground"), (8, "ground"), (2, "box"), (6, "box"))
    ]
    return assemble(Vehicle("beam", (other, body), tuple(feet), added_masses=added))


def test_a_free_beam_rings_at_the_published_frequencies():
    modes = component_modes(beam_on_springs(n_modes=20), "beam")
    beta = np.array([4.7300407449, 7.8532046241])  # cos βL cosh βL = 1
    bending = beta**2 / (2 * np.pi * 2.0**2) * np.sqrt(6e4 / 20.0)  # EI about y, 20 kg/m, 2 m
    for f in bending:
        assert np.abs(modes.frequency_hz / f - 1).min() < 1e-3
    assert (modes.frequency_hz[:6] == 0).all()
    assert (modes.frequency_hz[6:] > 0).all()


def test_residual_vectors_are_no_free_modes():
    with_residuals = component_modes(beam_on_springs(), "beam")
    assert len(with_residuals.names) == with_residuals.shapes.shape[1] == 14
    assert with_residuals.names == (*RIGID, *(f"mode {i}" for i in range(7, 15)))


@pytest.mark.parametrize("body", ["beam", "box"])
def test_all_but_the_component_rests_and_it_solves_its_own_free_problem(body):
    system = beam_on_springs(AddedMass("load", "beam", BEAM.nodes[3], 9.0))
    modes, own = component_modes(system, body), system.dofs[body]
    alone = assemble(Vehicle("alone", (system.vehicle.body(body),), ()))
    others = np.delete(np.arange(system.n_dofs), np.arange(own.start, own.stop))
    assert not modes.shapes[others].any()
    phi = modes.shapes[own]
    np.testing.assert_allclose(phi.T @ alone.mass @ phi, np.eye(phi.shape[1]), atol=1e-12)
    omega_squared = (2 * np.pi * modes.frequency_hz) ** 2
    np.testing.assert_allclose(
        alone.stiffness @ phi, alone.mass @ phi * omega_squared, atol=1e-9 * omega_squared.max()
    )


def test_a_body_with_products_of_inertia_still_moves_rigidly_and_nearly_as_named():
    vehicle = mounted_cabin()
    inertia = np.array([[150, 0, -40], [0, 250, 0], [-40, 0, 260.0]])
    cab = replace(vehicle.bodies[0], inertia=inertia)
    system = assemble(replace(vehicle, bodies=(cab, vehicle.bodies[1])))
    modes = component_modes(system, "cab")
    phi = modes.shapes[system.dofs["cab"]]
    np.testing.assert_allclose(phi[:3, :3], np.eye(3) / np.sqrt(cab.mass), atol=1e-12)
    turns = phi[3:, 3:]
    np.testing.assert_allclose(turns.T @ inertia @ turns, np.eye(3), atol=1e-12)
    assert (np.abs(turns).argmax(axis=0) == [0, 1, 2]).all()
    np.testing.assert_allclose(turns[:, 1], [0, 1 / np.sqrt(250), 0], atol=1e-12)


def test_the_rigid_modes_of_a_flexible_body_are_motions_about_its_own_centre_of_gravity():
    system = beam_on_springs(AddedMass("load", "beam", BEAM.nodes[8], 50.0))
    modes = component_modes(system, "beam")
    middle = BEAM.nodes[4]
    mass = 20.0 * 2.0
    for node in (0, 3, 8):
        motion = system.motion("beam", BEAM.nodes[node]) @ modes.shapes[:, :6]
        expected = rigid_motions(BEAM.nodes[node] - middle)
        np.testing.assert_allclose(motion[:, :3], expected[:, :3] / np.sqrt(mass), atol=1e-9)
        pitch = motion[:, 4] / motion[4, 4]
        np.testing.assert_allclose(pitch, expected[:, 4], atol=1e-9)


def test_shares_of_all_bodies_are_the_kinetic_energy_with_and_without_added_masses():
    loads = [AddedMass("a", "beam", BEAM.nodes[3], 9.0), AddedMass("b", "box", np.ones(3), 30.0)]
    for system in (beam_on_springs(), beam_on_springs(*loads)):
        shapes = solve_modes(system, 14).shapes
        energy = kinetic_energy(system, shapes)
        for i, shape in enumerate(shapes.T):
            for body in ("beam", "box"):
                shares = component_shares(system, shape, body)
                assert sum(s.share for s in shares) == pytest.approx(energy[body][i], abs=1e-12)
                assert [s.share for s in shares] == sorted((s.share for s in shares), reverse=True)
                assert min(s.share for s in shares) >= 0


def test_an_added_mass_has_the_energy_of_its_own_motion():
    load = AddedMass("load", "box", np.array([1.0, 0.5, 0.4]), 30.0)
    system = beam_on_springs(load)
    shape = np.zeros(system.n_dofs)
    shape[[2, 3]] = 1.0, 4.0  # the box goes up at 1 m/s and rolls at 4 rad/s: its load at 3 m/s
    box = system.vehicle.bodies[0]
    parts = {"bounce": 300.0, "roll": box.inertia[0, 0] * 16.0, "added masses": 30.0 * 9.0}
    shares = {s.name: s for s in component_shares(system, shape, "box")}
    assert list(shares)[:3] == sorted(parts, key=lambda n: -parts[n])
    for name, energy in parts.items():
        assert shares[name].share == pytest.approx(energy / sum(parts.values()), rel=1e-12)
    assert (shares["bounce"].mode, shares["added masses"].mode) == (2, None)


def test_a_component_mode_alone_is_all_of_its_own_motion():
    system = beam_on_springs()
    modes = component_modes(system, "beam")
    for i in (0, 4, 9):
        largest = component_shares(system, modes.shapes[:, i], "beam")[0]
        assert (largest.name, largest.mode) == (modes.names[i], i)
        assert largest.share == pytest.approx(1.0, abs=1e-12)


def test_a_residual_vector_is_counted_as_one():
    system = beam_on_springs()
    shape = np.zeros(system.n_dofs)
    shape[system.dofs["beam"]][[7, -1, -2]] = 1.0, 2.0, 2.0
    shares = {s.name: s.share for s in component_shares(system, shape, "beam")}
    assert shares["residual vectors"] == pytest.approx(8 / 9, rel=1e-12)
    assert shares["mode 8"] == pytest.approx(1 / 9, rel=1e-12)


def test_phase_does_not_change_shares():
    system = beam_on_springs()
    shape = solve_modes(system, 8).shapes[:, 7]
    real = component_shares(system, shape, "beam")
    turned = component_shares(system, shape * np.exp(0.7j), "beam")
    assert [s.share for s in turned] == pytest.approx([s.share for s in real], rel=1e-12)


def test_the_cab_yaws_in_the_cab_yaw_of_the_optimised_truck():
    truck = truck_modes()
    results = solve_modal(truck, truck.vehicle.rate_sets["optimised"])
    yaw = results.mode_index("cab yaw")
    shares = component_shares(truck.system, results.modes.shapes[:, yaw], "cab")
    assert shares[0].name == "yaw"
    for body in truck.system.dofs:
        total = sum(s.share for s in component_shares(truck.system, results.modes.shapes[:, yaw], body))
        assert total == pytest.approx(results.kinetic_energy[body][yaw], abs=1e-12)


def test_a_body_that_is_not_there_is_an_error():
    with pytest.raises(VehicleError, match=r"unknown body 'trailer'.*box, beam"):
        component_modes(beam_on_springs(), "trailer")
