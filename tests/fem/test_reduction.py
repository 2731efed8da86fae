"""Guyan reduction against a theory of beams, a dense solution, and the full model."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp
from oracles import Beam
from small_meshes import bar, plate, twisted_plate

from modeviz.errors import SolveError
from modeviz.fem.free import free_modes
from modeviz.fem.matrices import assemble, nodal_matrices
from modeviz.fem.mesh import PointMass
from modeviz.fem.reduction import craig_bampton_reduction, guyan_reduction, retained_up_to
from modeviz.vehicle.rigid import rigid_motions

FREE_BEAM = np.array([4.7300407, 7.8532046, 10.9956078])
"""βL of its bending modes."""


@pytest.fixture(scope="module")
def body():
    return assemble(twisted_plate())


def hertz(modes):
    return np.sqrt(modes.omega_n_squared) / (2 * np.pi)


def hertz_of(mass, stiffness):
    """Elastic natural frequencies of a free body, by a dense solution."""
    return np.sqrt(scipy.linalg.eigh(stiffness, mass, eigvals_only=True)[6:]) / (2 * np.pi)


def test_beam_in_a_tenth_of_its_freedoms_bends_as_theory_says():
    beam = Beam(n_elements=100)
    body = nodal_matrices(beam.nodes, sp.csc_array(beam.mass), sp.csc_array(beam.stiffness))
    reduction = guyan_reduction(body, [6 * node + i for node in range(0, 101, 10) for i in range(6)])
    found = hertz(free_modes(reduction.matrices, 20))[6:]
    bending = [b**2 * np.sqrt(EI / 20.0) / 2.0**2 / (2 * np.pi) for b in FREE_BEAM for EI in (6e4, 9e4)]
    # What follows in statics between retained nodes is an element, a tenth of the length: of its
    # frequencies the error is (βL/10)⁴ / 1440.
    errors = np.array([found[np.argmin(abs(found - f))] / f - 1 for f in bending])
    expected = np.repeat((FREE_BEAM / 10) ** 4 / 1440, 2)
    np.testing.assert_allclose(errors, expected, rtol=0.1)


def test_reduction_is_a_dense_static_condensation(body):
    retained = retained_up_to(body, 200.0)
    reduction = guyan_reduction(body, retained)
    rest = np.setdiff1d(np.arange(body.n_dofs), retained)
    order = np.ix_(np.r_[retained, rest], np.r_[retained, rest])
    K, M = body.stiffness.toarray()[order], body.mass.toarray()[order]
    n = len(retained)
    T = np.vstack([np.eye(n), -np.linalg.solve(K[n:, n:], K[n:, :n])])
    modes = free_modes(reduction.matrices, n - 1)
    np.testing.assert_allclose(hertz(modes)[6:], hertz_of(T.T @ M @ T, T.T @ K @ T)[:-1], rtol=1e-7)
    flexibility = scipy.linalg.eigh(M[n:, n:], K[n:, n:], eigvals_only=True)[-1]
    assert reduction.omitted_hz == pytest.approx(flexibility**-0.5 / (2 * np.pi), rel=1e-9)


@pytest.fixture(scope="module")
def reductions(body):
    """With all else above 100, 200 and 400 Hz: the reduction, its modes and the full model's."""
    found = []
    for hz in (100.0, 200.0, 400.0):
        reduction = guyan_reduction(body, retained_up_to(body, hz))
        modes = free_modes(reduction.matrices, len(reduction.retained) - 1)
        found.append((reduction, modes, hertz(free_modes(body, len(reduction.retained) - 1))))
    return found


def test_reduced_frequencies_converge_from_above(reductions):
    errors = np.array([(hertz(modes) - full)[6:9] / full[6:9] for _, modes, full in reductions])
    assert (errors > 0).all()
    assert (np.diff(errors, axis=0) < 0).all()
    assert (errors[2] < errors[0] / 4).all()
    assert errors[2][0] < 2e-3


def test_full_frequencies_are_within_what_the_reduction_says(reductions):
    for reduction, modes, full in reductions:
        found = hertz(modes)[6:]
        assert (reduction.at_least_hz(found) <= full[6:]).all()
        assert (full[6:] <= found * (1 + 1e-9)).all()


def test_errors_are_what_the_reduction_says(reductions):
    for reduction, modes, full in reductions:
        error = (hertz(modes) / np.where(full, full, 1.0) - 1)[6:]
        said = reduction.too_high(modes)[6:]
        small = hertz(modes)[6:] < 0.4 * reduction.omitted_hz
        assert small.any()
        np.testing.assert_allclose(said[small], error[small], rtol=0.1)


def test_what_is_left_out_is_above_the_frequency_asked_for(body):
    few, many = (retained_up_to(body, hz) for hz in (100.0, 400.0))
    assert guyan_reduction(body, few).omitted_hz > 100
    assert guyan_reduction(body, many).omitted_hz > 400
    assert len(few) < len(many) < 0.2 * body.n_dofs
    with_corner = retained_up_to(body, 100.0, always=range(6))
    assert {*range(6)} <= set(with_corner)
    assert len(set(with_corner)) == len(with_corner) <= len(few) + 6


def test_static_deflection_of_the_retained_is_exact(body):
    retained = retained_up_to(body, 200.0)
    reduction = guyan_reduction(body, retained)
    T = reduction.static_modes
    force = body.stiffness @ T
    omitted = np.setdiff1d(np.arange(body.n_dofs), retained)
    np.testing.assert_allclose(force[omitted], 0, atol=1e-9 * abs(force).max())
    reduced = reduction.matrices.stiffness.toarray()
    np.testing.assert_allclose(force[retained], reduced, atol=1e-9 * abs(force).max())
    np.testing.assert_array_equal(T[retained], np.eye(len(retained)))


def test_reduced_body_weighs_what_the_full_one_does(body):
    reduced = guyan_reduction(body, retained_up_to(body, 200.0)).matrices
    R, R_m = rigid_motions(body.nodes).reshape(-1, 6), reduced.rigid
    np.testing.assert_allclose(R_m.T @ (reduced.mass @ R_m), R.T @ (body.mass @ R), atol=1e-8)
    np.testing.assert_allclose(reduced.stiffness @ R_m, 0, atol=1e-8 * abs(reduced.stiffness).max())
    np.testing.assert_allclose(reduced.motion @ R_m, R, atol=1e-8)


def test_retaining_all_leaves_the_body_as_it_is():
    body = assemble(bar(n=2))
    reduction = guyan_reduction(body, range(18))
    np.testing.assert_allclose(reduction.matrices.stiffness.toarray(), body.stiffness.toarray())
    np.testing.assert_allclose(reduction.matrices.mass.toarray(), body.mass.toarray())
    assert reduction.omitted_hz == np.inf
    assert (reduction.too_high(free_modes(reduction.matrices, 8)) == 0).all()


def massless_middle():
    """A bar of which only the outer nodes have mass."""
    body = assemble(bar(n=4))
    mass = sp.diags_array(np.where(np.isin(np.arange(30) // 6, [1, 2, 3]), 0.0, 1.0)).tocsc()
    return nodal_matrices(body.nodes, mass, body.stiffness)


def test_leaving_out_what_has_no_mass_costs_nothing():
    body = massless_middle()
    reduction = guyan_reduction(body, [*range(6), *range(24, 30)])
    assert reduction.omitted_hz == np.inf
    modes = free_modes(reduction.matrices, 11)
    assert (reduction.too_high(modes) == 0).all()
    np.testing.assert_array_equal(reduction.at_least_hz(hertz(modes)), hertz(modes))
    assert set(retained_up_to(body, 1e9)) <= set(reduction.retained)


def test_heavy_node_is_retained():
    mesh = replace(bar(n=40), point_masses=(PointMass(27, 50.0, inertia=(1.0, 1.0, 1.0)),))
    assert 27 in retained_up_to(assemble(mesh), 20.0) // 6


def test_what_is_retained_of_a_sheet_holds_it_in_its_plane():
    # Every motion across a flat sheet has a smaller ratio of stiffness to mass than any in its plane.
    body = assemble(plate(4))
    retained = retained_up_to(body, 50.0)
    assert len(set(retained)) == len(retained)
    assert np.isin(retained % 6, [0, 1, 5]).sum() == 3
    guyan_reduction(body, retained)


@pytest.mark.parametrize("retained", [[], [0, 1, 2], [1, 2, 3, 4, 5, 7]])
def test_retained_that_do_not_hold_the_body_are_refused(retained):
    with pytest.raises(SolveError, match=f"the {len(retained)} found don't hold the body"):
        guyan_reduction(assemble(bar(n=2)), retained)


@pytest.mark.parametrize("retained", [[0, 0, 1], [-1, 2], [10**6]])
def test_wrong_indices_are_refused(body, retained):
    with pytest.raises(SolveError, match="expected different indices from 0 to 293"):
        guyan_reduction(body, retained)


@pytest.mark.parametrize("turn", [0.0, 0.3], ids=["exactly", "but for rounding"])
def test_loose_part_that_is_left_out_is_refused(turn):
    along = (np.cos(turn), np.sin(turn), 0.0)
    two = [assemble(bar(n=2, along=along)) for _ in range(2)]
    nodes = np.vstack(
        [body.nodes + np.array([0.0, y, 0.0]) for body, y in zip(two, (0.0, 0.5), strict=True)]
    )
    M, K = (
        sp.csc_array(sp.block_diag([getattr(body, name) for body in two]))
        for name in ("mass", "stiffness")
    )
    loose = nodal_matrices(nodes, M, K)
    with pytest.raises(SolveError, match="a part of the body is loose"):
        guyan_reduction(loose, range(18))
    with pytest.raises(SolveError, match="a part of the body is loose"):
        retained_up_to(loose, 1.0)


BOUNDARY = np.arange(6)[None, :] + 6 * np.array([[0], [6], [48]])
"""Of three corners, so that it holds the body."""


def test_craig_bampton_with_all_modes_is_the_full_body(body):
    reduced = craig_bampton_reduction(body, BOUNDARY.ravel(), 1e9)
    full = free_modes(body, 30).omega_n_squared
    np.testing.assert_allclose(free_modes(reduced, 30).omega_n_squared[6:], full[6:], rtol=1e-6)


@pytest.mark.parametrize("up_to", [160.0, 320.0])
def test_craig_bampton_is_right_up_to_half_of_its_frequency(body, up_to):
    """By a few hundredths, and never too low, by Rayleigh; Guyan's on that boundary is further off."""
    reduced = craig_bampton_reduction(body, BOUNDARY.ravel(), up_to)
    full = hertz(free_modes(body, 60))[6:]
    n = int((full < up_to / 2).sum())
    found = hertz(free_modes(reduced, 6 + n))[6:]
    too_high = found / full[:n] - 1
    assert ((too_high > -1e-8) & (too_high < 3e-2)).all()
    guyan = hertz(free_modes(guyan_reduction(body, BOUNDARY.ravel()).matrices, 17))[6:][:n]
    assert (guyan[: len(found)] >= found[: len(guyan)] * (1 - 1e-9)).all()


def test_craig_bampton_deflects_its_boundary_as_the_full_body_does(body):
    reduced = craig_bampton_reduction(body, BOUNDARY.ravel(), 60.0)
    force = np.zeros((body.n_dofs, 1))
    force[[2, 6 * 6 + 2, 6 * 48 + 2], 0] = [1.0, -2.0, 1.5]
    rigid = rigid_motions(body.nodes).reshape(-1, 6)
    onto = rigid @ np.linalg.solve(rigid[BOUNDARY.ravel()].T @ rigid[BOUNDARY.ravel()], np.eye(6))
    balanced = force.copy()
    balanced[BOUNDARY.ravel()] -= onto[BOUNDARY.ravel()] @ (rigid.T @ force)
    strained = body.stiffness.toarray()
    expected = np.linalg.lstsq(strained, balanced, rcond=1e-10)[0][:, 0] @ balanced[:, 0]
    small = (reduced.motion.T @ balanced)[:, 0]
    found = np.linalg.lstsq(reduced.stiffness.toarray(), small, rcond=1e-10)[0] @ small
    assert found == pytest.approx(expected, rel=1e-6)
