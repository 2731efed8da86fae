import numpy as np
import pytest
from small_meshes import bar, twisted_plate

from modeviz.errors import SolveError
from modeviz.fem.attachments import OnFootprint, OnNearestNodes, OnNode, unit_loads
from modeviz.fem.component import flexible_body, modal_properties
from modeviz.fem.free import free_modes, residual_compliance, static_response
from modeviz.fem.matrices import assemble
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
    exact = residual_compliance(matrices, free_modes(matrices, 20), unit_loads([point], MESH.nodes))
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


def test_modal_properties_do_not_need_normalised_shapes():
    matrices = assemble(MESH)
    modes = free_modes(matrices, 12)
    sizes = np.linspace(1, 7, 12)
    found = modal_properties(matrices, modes.shapes * sizes, damping_ratio=0.03)
    omega = np.sqrt(modes.omega_n_squared)
    np.testing.assert_allclose(found.mass, sizes**2, rtol=1e-9)
    np.testing.assert_allclose(found.stiffness[6:], (sizes * omega)[6:] ** 2, rtol=1e-8)
    np.testing.assert_allclose(found.damping[6:], (2 * 0.03 * omega * sizes**2)[6:], rtol=1e-8)
    np.testing.assert_allclose(found.stiffness[:6], 0, atol=1e-8 * found.stiffness[6])
