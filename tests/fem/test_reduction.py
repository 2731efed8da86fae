from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from small_meshes import bar, plate, twisted_plate

from modeviz.errors import SolveError
from modeviz.fem.free import free_modes
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import PointMass
from modeviz.fem.reduction import guyan_reduction, lowest_ratio_masters
from modeviz.vehicle.rigid import rigid_motions


@pytest.fixture(scope="module")
def body():
    return assemble(twisted_plate())


def elastic_omega_squared(reduced):
    return scipy.linalg.eigh(reduced.stiffness, reduced.mass, eigvals_only=True)[6:]


def test_reduced_frequencies_converge_from_above(body):
    full = free_modes(body, 10).omega_n_squared[6:]
    errors = [
        elastic_omega_squared(guyan_reduction(body, lowest_ratio_masters(body, n)))[:4] / full - 1
        for n in (30, 60, 120)
    ]
    assert (np.array(errors) > 0).all()
    assert (np.diff(errors, axis=0) < 0).all()
    assert errors[-1][0] < 2e-3


def test_static_deflection_of_the_masters_is_exact(body):
    masters = lowest_ratio_masters(body, 30)
    reduced = guyan_reduction(body, masters)
    T, K = reduced.transformation, body.stiffness
    force = K @ T
    slaves = np.setdiff1d(np.arange(body.n_dofs), masters)
    np.testing.assert_allclose(force[slaves], 0, atol=1e-9 * abs(force).max())
    np.testing.assert_allclose(force[masters], reduced.stiffness, atol=1e-9 * abs(force).max())
    np.testing.assert_array_equal(T[masters], np.eye(30))


def test_reduced_body_weighs_what_the_full_one_does(body):
    reduced = guyan_reduction(body, lowest_ratio_masters(body, 30))
    R = rigid_motions(body.nodes).reshape(-1, 6)
    R_m = R[reduced.masters]
    np.testing.assert_allclose(R_m.T @ reduced.mass @ R_m, R.T @ (body.mass @ R), atol=1e-8)
    np.testing.assert_allclose(reduced.stiffness @ R_m, 0, atol=1e-8 * abs(reduced.stiffness).max())


def test_all_masters_leave_the_body_as_it_is():
    body = assemble(bar(n=2))
    reduced = guyan_reduction(body, np.arange(18))
    np.testing.assert_allclose(reduced.stiffness, body.stiffness.toarray())
    np.testing.assert_allclose(reduced.mass, body.mass.toarray())


def test_heavy_node_becomes_a_master():
    mesh = replace(bar(n=4), point_masses=(PointMass(3, 50.0),))
    assert {19, 20} <= set(lowest_ratio_masters(assemble(mesh), 6))


def test_masters_chosen_on_a_sheet_hold_it_in_its_plane():
    # Every motion across a flat sheet has a smaller ratio than any in its plane.
    body = assemble(plate(4))
    masters = lowest_ratio_masters(body, 12)
    assert len(set(masters)) == 12
    assert np.isin(masters % 6, [0, 1, 5]).sum() == 3
    guyan_reduction(body, masters)


@pytest.mark.parametrize("masters", [[], [0, 1, 2], [1, 2, 3, 4, 5, 7]])
def test_masters_that_do_not_hold_the_body_are_refused(masters):
    with pytest.raises(SolveError, match=f"the {len(masters)} found don't hold the body"):
        guyan_reduction(assemble(bar(n=2)), np.array(masters))


@pytest.mark.parametrize("masters", [[0, 0, 1], [-1, 2], [10**6]])
def test_wrong_masters_are_refused(body, masters):
    with pytest.raises(SolveError, match="expected different indices from 0 to 293"):
        guyan_reduction(body, np.array(masters))
