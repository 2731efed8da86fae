from itertools import combinations

import numpy as np
import pytest
import scipy.linalg
import scipy.sparse as sp
from small_meshes import bar, twisted_plate

from modeviz.errors import SolveError
from modeviz.fem.attachments import OnFootprint, OnNearestNodes, OnNode, unit_loads
from modeviz.fem.component import body_from_matrices, flexible_body
from modeviz.fem.free import free_modes, static_response
from modeviz.fem.matrices import assemble, nodal_matrices
from modeviz.fem.reduction import guyan_reduction, retained_up_to
from modeviz.fem.residuals import residual_response
from modeviz.vehicle.rigid import rigid_motions

MESH = twisted_plate()
ATTACHMENTS = (
    OnNode("corner", MESH.nodes[0] + [0, 0, 0.05], 0),
    OnNode("spring", MESH.nodes[48], 48, directions=("z",)),
    OnFootprint("seat", MESH.nodes[24] + [0, 0, 0.3], (16, 18, 30, 32)),
    OnNearestNodes("ear", MESH.nodes[10] + [0.02, 0.03, 0.1], directions=()),
)


@pytest.fixture(scope="module")
def body():
    return flexible_body("panel", "cabin", "Panel", MESH, ATTACHMENTS, 20, 0.03)


def test_body_has_the_modes_asked_for_and_a_residual_vector_a_direction(body):
    assert body.n_modes - body.n_residuals == 20
    assert body.n_residuals == 3 + 1 + 3


def test_body_has_six_rigid_modes(body):
    assert (body.natural_frequency_hz[:6] == 0).all()
    assert (body.natural_frequency_hz[6:] > 1).all()


def test_attachments_of_a_rigid_mode_move_as_one(body):
    attached = np.vstack([a.shapes[:, :6] for a in body.attachments])
    rigid = rigid_motions(np.array([a.position for a in body.attachments])).reshape(-1, 6)
    fit = np.linalg.lstsq(rigid, attached)[0]
    np.testing.assert_allclose(rigid @ fit, attached, atol=1e-10)


def test_nodes_and_attachments_carry_the_same_shapes(body):
    spring = body.attachment("spring")
    np.testing.assert_allclose(body.shapes[48], spring.shapes, atol=1e-6 * abs(spring.shapes).max())
    assert body.shapes.dtype == np.float32


def test_static_deflection_at_attachments_is_exact(body):
    matrices = assemble(MESH)
    F = unit_loads(ATTACHMENTS, MESH.nodes)
    exact = F.T @ static_response(matrices, F)
    loaded = [("xyz".index(d), a.name) for a in ATTACHMENTS for d in a.directions]
    phi = np.array([body.attachment(name).shapes[axis, 6:] for axis, name in loaded])
    found = (phi / body.omega_n_squared[6:]) @ phi.T
    np.testing.assert_allclose(found, exact, atol=1e-9 * abs(exact).max())
    n = 20 - 6
    modes_only = (phi[:, :n] / body.omega_n_squared[6:20]) @ phi[:, :n].T
    assert (np.diag(exact - modes_only) > 0.001 * np.diag(exact)).all()


@pytest.mark.parametrize("name", ["corner", "seat"])
def test_residual_compliance_of_the_body_is_that_of_the_finite_elements(body, name):
    matrices = assemble(MESH)
    point = next(a for a in ATTACHMENTS if a.name == name)
    F = unit_loads([point], MESH.nodes)
    exact = F.T @ residual_response(matrices, free_modes(matrices, 20), F)
    found = body.residual_compliance(name)
    np.testing.assert_allclose(found, exact, atol=1e-8 * abs(exact).max())
    assert np.linalg.eigvalsh(found)[0] > 0


def test_factors_scale_the_frequencies_and_the_shapes(body):
    stiff = flexible_body(
        "panel", "cabin", "Panel", MESH, ATTACHMENTS, 20, 0.03, stiffness_factor=2.0, mass_factor=0.5
    )
    np.testing.assert_allclose(stiff.omega_n_squared, 4.0 * body.omega_n_squared, rtol=1e-6)
    np.testing.assert_allclose(
        np.linalg.norm(stiff.shapes), np.linalg.norm(body.shapes) * np.sqrt(2), rtol=1e-4
    )


def test_body_without_attachments_has_no_residual_vectors():
    assert flexible_body("panel", "cabin", "Panel", MESH, (), 10, 0.0).n_residuals == 0


def test_too_many_modes_are_refused():
    with pytest.raises(SolveError, match="found 40, expected 6"):
        flexible_body("bar", "frame", "Bar", bar(n=2), (), 40, 0.0)


@pytest.fixture(scope="module")
def reduction():
    matrices = assemble(MESH)
    held = [6 * n + i for n in (0, 48, 16, 18, 30, 32) for i in range(6)]
    return guyan_reduction(matrices, retained_up_to(matrices, 400.0, held))


@pytest.fixture(scope="module")
def condensed(reduction):
    return body_from_matrices(
        "panel", "cabin", "Panel", reduction.matrices, ATTACHMENTS, 20, damping_ratio=0.03
    )


def test_condensed_body_deflects_under_balanced_forces_as_the_whole(body, condensed):
    """Where nodes are retained; whatever balances other forces is the inertia of all that moves."""
    loaded = [("xyz".index(d), a.name) for a in ATTACHMENTS for d in a.directions]
    balanced = scipy.linalg.null_space(
        np.array([body.attachment(name).shapes[axis, :6] for axis, name in loaded]).T
    )
    assert balanced.size
    exact, found = (
        balanced.T @ (phi / b.omega_n_squared[6:]) @ phi.T @ balanced
        for b in (body, condensed)
        for phi in [np.array([b.attachment(name).shapes[axis, 6:] for axis, name in loaded])]
    )
    np.testing.assert_allclose(found, exact, rtol=1e-7)


def test_condensed_body_has_the_modes_of_the_whole_as_far_as_the_reduction_says(
    body, condensed, reduction
):
    np.testing.assert_array_equal(condensed.omega_n_squared[:6], 0)
    f = condensed.natural_frequency_hz[6:12]
    error = f / body.natural_frequency_hz[6:12] - 1
    said = reduction.too_high(free_modes(reduction.matrices, 12))[6:]
    assert (error > 0.99 * said).all()
    assert (error < 1.01 * said / (1 - (f / reduction.omitted_hz) ** 2)).all()
    assert error[0] < 0.002
    assert condensed.mass == pytest.approx(body.mass, rel=1e-6)
    for a, b in zip(condensed.shapes[..., 6:8].T, body.shapes[..., 6:8].T, strict=True):
        a, b = a[:3].ravel().astype(float), b[:3].ravel().astype(float)
        assert (a @ b) ** 2 / (a @ a) / (b @ b) > 0.999


def test_body_of_translations_alone_is_made_of_its_matrices():
    """As of a model of solid elements: a truss, whose nodes do not turn."""
    corners = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], float)
    K = np.zeros((15, 15))
    for i, j in combinations(range(5), 2):
        along = (corners[j] - corners[i]) / np.linalg.norm(corners[j] - corners[i])
        pull = np.zeros(15)
        pull[3 * i : 3 * i + 3], pull[3 * j : 3 * j + 3] = -along, along
        K += 1e6 * np.outer(pull, pull)
    dofs = np.array([6 * node + i for node in range(5) for i in range(3)])
    matrices = nodal_matrices(corners, 2.0 * sp.eye_array(15).tocsc(), sp.csc_array(K), dofs)
    truss = body_from_matrices(
        "truss", "frame", "Truss", matrices, (OnNode("tip", corners[4], 4),), 10, 0.01
    )
    expected = np.sqrt(np.linalg.eigvalsh(K / 2.0)[6:10])
    np.testing.assert_allclose(truss.natural_frequency_hz[6:10] * 2 * np.pi, expected, rtol=1e-9)
    assert truss.mass == pytest.approx(10.0)
