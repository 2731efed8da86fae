from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp
from small_meshes import bar, plate, twisted_plate

from modeviz.errors import SolveError
from modeviz.fem.free import (
    center_of_gravity,
    free_modes,
    free_modes_up_to,
    rigid_modes,
    static_response,
)
from modeviz.fem.matrices import assemble, nodal_matrices
from modeviz.fem.mesh import FiniteElementMesh
from modeviz.vehicle.rigid import rigid_motions


def test_free_body_has_six_zero_modes(modes):
    assert (modes.omega_n_squared[:6] == 0).all()
    assert (modes.omega_n_squared[6:] > (2 * np.pi) ** 2).all()


def test_modes_are_orthonormal_in_mass_and_orthogonal_in_stiffness(body, modes):
    phi = modes.shapes
    np.testing.assert_allclose(phi.T @ (body.mass @ phi), np.eye(16), atol=1e-10)
    k = phi.T @ (body.stiffness @ phi)
    np.testing.assert_allclose(k, np.diag(modes.omega_n_squared), atol=1e-8 * k.max())


def test_modes_agree_with_a_dense_solution(body, modes):
    # Stiffness per mass, ω⁻² as the eigenvalue, because some rotations have no inertia.
    K = (body.stiffness + 100.0 * body.mass).toarray()
    inverse = scipy.linalg.eigh(body.mass.toarray(), K, eigvals_only=True)
    dense = 1 / inverse[::-1][:16] - 100.0
    np.testing.assert_allclose(modes.omega_n_squared[6:], dense[6:], rtol=1e-8)


def test_rigid_modes_are_rigid_motions_about_the_center_of_gravity(body):
    R = rigid_modes(body)
    about_center = rigid_motions(body.nodes - center_of_gravity(body)).reshape(-1, 6)
    weight = (about_center.T @ (body.mass @ about_center))[0, 0]
    combination = np.linalg.lstsq(about_center, R)[0]
    np.testing.assert_allclose(about_center @ combination, R, atol=1e-12)
    np.testing.assert_allclose(combination[:3, :3] * np.sqrt(weight), np.eye(3), atol=1e-6)
    np.testing.assert_allclose(combination, combination.T, atol=1e-12)


@pytest.mark.bitwise
def test_same_mesh_gives_the_same_modes(modes):
    again = free_modes(assemble(twisted_plate()), 16)
    np.testing.assert_array_equal(again.shapes, modes.shapes)


def test_largest_entry_of_an_elastic_shape_is_positive(modes):
    phi = modes.shapes[:, 6:]
    assert (phi.max(axis=0) >= 0.99 * -phi.min(axis=0)).all()


@pytest.mark.parametrize("n_modes", [5, 18])
def test_number_of_modes_must_suit_the_body(n_modes):
    with pytest.raises(SolveError, match=f"found {n_modes}, expected 6 .* to 17"):
        free_modes(assemble(bar(n=2)), n_modes)


def test_rigid_modes_alone_can_be_asked_for():
    assert free_modes(assemble(plate(2)), 6).shapes.shape == (54, 6)


def test_body_in_two_pieces_is_refused():
    one, n = bar(n=4), 5
    two = FiniteElementMesh(
        np.vstack([one.nodes, one.nodes + np.array([0.0, 1.0, 0.0])]),
        beams=np.vstack([one.beams, one.beams + n]),
        beam_sections=2 * one.beam_sections,
        beam_up=np.vstack([one.beam_up, one.beam_up]),
    )
    with pytest.raises(SolveError, match="loose"):
        free_modes(assemble(two), 10)


def test_static_response_balances_the_loads_by_inertia(body, loads):
    u = static_response(body, loads)
    R = rigid_motions(body.nodes).reshape(-1, 6)
    acceleration = np.linalg.solve(R.T @ (body.mass @ R), R.T @ loads)
    inertia = body.mass @ (R @ acceleration)
    force = body.stiffness @ u
    np.testing.assert_allclose(force, loads - inertia, atol=1e-8)
    np.testing.assert_allclose(R.T @ (body.mass @ u) / abs(u).max(), 0, atol=1e-10)


def test_static_response_of_a_free_beam_agrees_with_theory():
    # A force P at mid-span is carried by the inertia P / L of the beam: each half is a cantilever of
    # l = L / 2 under the uniform load q = P / L, whose end sags q l⁴ / (8 EI).
    length, P = 20.0, 1.0
    mesh = bar(40, length)
    f = np.zeros((6 * 41, 1))
    f[6 * 20 + 2] = P
    u = static_response(assemble(mesh), f)[2::6, 0]
    EI = 2.1e11 * 2e-8
    np.testing.assert_allclose(u[20] - u[0], P / length * (length / 2) ** 4 / (8 * EI), rtol=1e-4)


@pytest.mark.parametrize("up_to", [10.0, 60.0, 120.0])
def test_modes_up_to_a_frequency_are_those_and_one_more(body, up_to):
    expected = free_modes(body, 60).omega_n_squared
    n_below = int((np.sqrt(expected) / (2 * np.pi) <= up_to).sum())
    found = free_modes_up_to(body, up_to, 100).omega_n_squared
    np.testing.assert_allclose(found[6:], expected[6 : n_below + 1], rtol=1e-8)
    assert len(found) == n_below + 1


def test_no_more_modes_up_to_a_frequency_are_computed_than_allowed(body):
    with pytest.raises(SolveError, match="more than 12 modes are below 500 Hz"):
        free_modes_up_to(body, 500.0, 12)


def test_of_a_small_body_all_modes_can_be_had():
    """By the dense solution, where some rotations have no inertia and so no mode."""
    body = assemble(bar(n=3))
    lowest = free_modes(body, 8).omega_n_squared
    every = free_modes_up_to(body, 1e9, 100).omega_n_squared
    np.testing.assert_allclose(every[6:8], lowest[6:8], rtol=1e-8)
    assert len(every) == 24 - 1


@pytest.mark.parametrize("n_modes", [12, 60])
def test_a_node_without_mass_that_a_rod_alone_holds_is_refused(body, n_modes):
    """It moves across the rod as it likes; by the sparse solution and by the dense one."""
    along = np.array([2.0, 1.0, 3.0]) / np.sqrt(14)
    rod = np.kron([[1, -1], [-1, 1]], 1e6 * np.outer(along, along))
    n = body.n_dofs
    ends = np.r_[0:3, n : n + 3]
    stiffness = sp.block_diag([body.stiffness, sp.csc_array((3, 3))]).tolil()
    stiffness[np.ix_(ends, ends)] += rod
    mass = sp.csc_array(sp.block_diag([body.mass, sp.csc_array((3, 3))]))
    nodes = np.vstack([body.nodes, body.nodes[0] + along])
    hung = nodal_matrices(nodes, mass, sp.csc_array(stiffness), np.arange(n + 3))
    with pytest.raises(SolveError, match=r"without mass|has no mass"):
        free_modes(hung, n_modes)


@pytest.mark.parametrize("n_modes", [12, 60])
def test_a_body_whose_stiffness_is_negative_is_refused(body, n_modes):
    negative = replace(body, stiffness=sp.csc_array(body.stiffness - 1e3 * body.mass))
    with pytest.raises(SolveError, match="negative"):
        free_modes(negative, n_modes)


def test_a_body_that_is_held_is_refused(body):
    held = replace(body, stiffness=sp.csc_array(body.stiffness + 1e3 * body.mass))
    with pytest.raises(SolveError, match=r"is held: moving as a whole it would vibrate at 5\.033 Hz"):
        free_modes(held, 12)


def test_a_body_too_large_for_memory_is_refused(body, monkeypatch):
    def exhausted(*arguments, **options):
        raise MemoryError

    monkeypatch.setattr("scipy.sparse.linalg.splu", exhausted)
    with pytest.raises(SolveError, match="294 degrees of freedom take more memory"):
        free_modes(body, 12)


def test_a_body_of_more_numbers_than_superlu_counts_is_refused_as_such(body, monkeypatch):
    def exhausted(*arguments, **options):
        raise MemoryError

    monkeypatch.setattr("scipy.sparse.linalg.splu", exhausted)
    monkeypatch.setattr("modeviz.fem.free.LARGEST_COUNT", 30 * body.stiffness.nnz)
    with pytest.raises(SolveError, match="294 degrees of freedom take more numbers than SuperLU can"):
        free_modes(body, 12)
