import sys

import numpy as np
import pytest
from small_meshes import bar, plate, twisted_plate

import modeviz.fem
from modeviz.errors import ModevizError
from modeviz.fem.free import lowest_modes
from modeviz.fem.matrices import assemble, without_rotation_strain
from modeviz.fem.mesh import FiniteElementMesh, PointMass
from modeviz.vehicle.rigid import rigid_motions


def rigid_mass(matrices):
    R = rigid_motions(matrices.nodes).reshape(-1, 6)
    return R.T @ (matrices.mass @ R)


@pytest.mark.parametrize("mesh", [plate(4), twisted_plate(), bar()], ids=["plate", "twisted", "bar"])
def test_rigid_motion_of_a_mesh_takes_no_force(mesh):
    matrices = assemble(mesh)
    R = rigid_motions(mesh.nodes - mesh.nodes.mean(axis=0)).reshape(-1, 6)
    force = abs(matrices.stiffness @ R)
    assert force.max() <= 1e-12 * abs(matrices.stiffness).max()


@pytest.mark.parametrize("mesh", [plate(4), twisted_plate(), bar()], ids=["plate", "twisted", "bar"])
def test_matrices_are_symmetric(mesh):
    matrices = assemble(mesh)
    assert abs(matrices.mass - matrices.mass.T).max() == 0
    assert abs(matrices.stiffness - matrices.stiffness.T).max() == 0


def test_rigid_modes_of_a_warped_mesh_are_at_zero_frequency():
    matrices = assemble(twisted_plate())
    omega_n_squared, _ = lowest_modes(matrices.mass, matrices.stiffness, 7)
    assert np.sqrt(np.abs(omega_n_squared[:6])).max() / (2 * np.pi) < 0.001
    assert omega_n_squared[6] > (2 * np.pi) ** 2


def test_freeing_an_element_of_rotation_strain_leaves_a_flat_one_alone():
    rng = np.random.default_rng(1)
    corners = rng.standard_normal((5, 4, 3))
    R = rigid_motions(corners).reshape(5, 24, 6)
    elastic = np.linalg.svd(R)[0][:, :, 6:]
    K = elastic @ elastic.swapaxes(1, 2)
    np.testing.assert_allclose(without_rotation_strain(corners, K), K, atol=1e-13)


def test_freeing_an_element_of_rotation_strain_does_not_depend_on_units():
    rng = np.random.default_rng(2)
    corners, K = rng.standard_normal((1, 4, 3)), rng.standard_normal((1, 24, 24))
    K = K @ K.swapaxes(1, 2)
    to_mm = np.tile(np.r_[np.full(3, 1e3), np.ones(3)], 4)
    in_mm = without_rotation_strain(1e3 * corners, K / np.outer(to_mm, to_mm))
    in_m = without_rotation_strain(corners, K)
    np.testing.assert_allclose(in_mm * np.outer(to_mm, to_mm), in_m, atol=1e-11)


def test_plate_weighs_what_its_volume_does():
    M = rigid_mass(assemble(plate(4)))
    weight = 7850 * 0.005
    np.testing.assert_allclose(np.diag(M)[:3], weight, rtol=1e-12)
    np.testing.assert_allclose(M[:3, 5], [-weight / 2, weight / 2, 0], atol=1e-10)
    np.testing.assert_allclose(M[5, 5], weight * 2 / 3, rtol=1e-12)


def test_point_mass_adds_its_mass_at_its_offset():
    mesh = bar(n=2)
    lump = PointMass(1, 3.0, offset=(0.1, -0.2, 0.3), inertia=(0.5, 0.6, 0.7))
    loaded = FiniteElementMesh(
        mesh.nodes,
        beams=mesh.beams,
        beam_sections=mesh.beam_sections,
        beam_up=mesh.beam_up,
        point_masses=(lump,),
    )
    added = rigid_mass(assemble(loaded)) - rigid_mass(assemble(mesh))
    c = mesh.nodes[1] + lump.offset
    steiner = 3.0 * (c @ c * np.eye(3) - np.outer(c, c)) + np.diag(lump.inertia)
    momentum = 3.0 * np.cross(np.eye(3), c)  # of unit rotations about the origin
    np.testing.assert_allclose(added[:3, :3], 3.0 * np.eye(3), atol=1e-12)
    np.testing.assert_allclose(added[3:, 3:], steiner, atol=1e-12)
    np.testing.assert_allclose(added[:3, 3:], momentum.T, atol=1e-12)


def test_scaling_multiplies_each_matrix():
    matrices = assemble(bar(n=2))
    scaled = matrices.scaled(stiffness_factor=2.0, mass_factor=3.0)
    assert abs(scaled.stiffness - 2.0 * matrices.stiffness).max() == 0
    assert abs(scaled.mass - 3.0 * matrices.mass).max() == 0


def test_missing_pyfe3d_is_named_with_what_installs_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pyfe3d", None)
    monkeypatch.delitem(sys.modules, "modeviz.fem.elements", raising=False)
    monkeypatch.delattr(modeviz.fem, "elements", raising=False)
    with pytest.raises(ModevizError, match=r"pip install 'modeviz\[fem\]'"):
        assemble(bar())
