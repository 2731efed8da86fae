"""The compliance estimated of modes left out, held against all modes of plates, bars and blocks."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
import scipy.sparse as sp
from small_meshes import STEEL, shell

from benchmarks.from_matrices import block
from benchmarks.large_component import Box
from modeviz.fem.attachments import OnFootprint, OnNode
from modeviz.fem.component import body_from_matrices
from modeviz.fem.matrices import assemble, nodal_matrices
from modeviz.fem.mesh import ShellSection
from modeviz.formats.node_sets import set_motion
from modeviz.vehicle.bodies import Attachment
from modeviz.vehicle.held_nodes import held_nodes
from modeviz.vehicle.residual_estimate import estimate_residuals
from modeviz.vehicle.residuals import modal_compliance, with_residual_compliance

ARM = np.array([0.1, 0.05, 0.3])


@cache
def sheet():
    """A plate held at a node, by an arm of 32 cm, and by the mean of nine nodes around a place."""
    section = ShellSection(0.002, **STEEL)
    matrices = assemble(shell(lambda u, v: (1.1 * u, 0.8 * v, 0.0), 22, 16, section))
    nodes = matrices.nodes
    near = np.argsort(np.linalg.norm(nodes - nodes[130], axis=1))[:9]
    points = [
        OnNode("node", nodes[75], 75),
        OnNode("arm", nodes[210] + ARM, 210),
        OnFootprint("mean", nodes[near].mean(axis=0), tuple(near.tolist())),
    ]
    return body_from_matrices("sheet", "other", "sheet", matrices, points, 130, 0.01)


@cache
def solid():
    """A block of cubes held at two nodes."""
    box = Box((16, 11, 6), 0)
    mass, stiffness = block(box.corners() - 1, box.n_nodes)
    nodes = box.places() / 1000
    dofs = (6 * np.arange(len(nodes))[:, None] + np.arange(3)).ravel()
    matrices = nodal_matrices(nodes, sp.csc_array(1e3 * mass), sp.csc_array(1e3 * stiffness), dofs)
    points = [OnNode(f"{i}", nodes[i], i) for i in (140, 777)]
    return body_from_matrices("block", "other", "block", matrices, points, 120, 0.01)


def off(body, n_elastic):
    """log₂ of what is estimated over what is true, (n_attachments, 3)."""
    fewer = body.truncated(6 + n_elastic)
    true = modal_compliance(body) - modal_compliance(fewer)
    return np.log2(estimate_residuals(fewer).compliance / true)


def test_nodes_that_carry_an_attachment_are_told_from_its_motion():
    node, arm, mean = (held_nodes(sheet(), a) for a in sheet().attachments)
    assert (node.nodes.tolist(), node.is_mean) == ([75], False)
    assert (arm.nodes.tolist(), arm.is_mean) == ([210], False)
    assert mean.is_mean
    assert len(mean.nodes) == 9


@pytest.mark.parametrize("n_elastic", [16, 40, 60, 80])
def test_across_a_sheet_the_estimate_is_right_within_a_factor_of_two_at_nodes(n_elastic):
    assert abs(off(sheet(), n_elastic)[0, 2]) < 1


@pytest.mark.parametrize("n_elastic", [16, 25, 40, 60, 80])
def test_arms_and_means_are_not_taken_for_nodes(n_elastic):
    """An arm turns with the sheet, and a mean feels no waves shorter than it: within 4, where Σ φ²/ω²
    is 3 to 11 times too little and up to 12 times too much."""
    assert np.abs(off(sheet(), n_elastic)[1, :2]).max() < 2
    assert abs(off(sheet(), n_elastic)[2, 2]) < 2


@pytest.mark.parametrize("n_elastic", [25, 40, 60, 80])
def test_a_force_at_a_node_dents_a_block_as_its_mesh_lets_it(n_elastic):
    """Within a factor of three in each direction, where Σ φ²/ω² is ten times too little."""
    body = solid()
    assert np.abs(off(body, n_elastic)).max() < np.log2(3)
    fewer = body.truncated(6 + n_elastic)
    phi = np.array([a.shapes[:3, 6:] for a in fewer.attachments])
    simple = np.sum(phi**2, axis=2) / fewer.omega_n_squared[-1]
    true = modal_compliance(body) - modal_compliance(fewer)
    assert (true / simple).min() > 4


def test_the_ends_of_an_estimate_hold_what_is_true():
    for body in (sheet(), solid()):
        for n_elastic in (25, 40, 60):
            fewer = body.truncated(6 + n_elastic)
            true = modal_compliance(body) - modal_compliance(fewer)
            estimate = estimate_residuals(fewer)
            assert (estimate.most >= estimate.compliance).all()
            assert (estimate.least <= estimate.compliance).all()
            assert (estimate.most > true / 3).all()


def test_in_its_plane_nothing_is_known_of_a_flat_sheet():
    """None of its first modes moves it there, so it may give way as much as across."""
    estimate = estimate_residuals(sheet().truncated(46))
    assert (estimate.compliance[0, :2] < 1e-6 * estimate.compliance[0, 2]).all()
    assert (estimate.most[0, :2] >= estimate.most[0, 2]).all()


def test_where_residual_vectors_act_nothing_is_left():
    body = sheet().truncated(46)
    given = with_residual_compliance(body, {"node": np.array([0.0, 0.0, 1e-5])})
    estimate = estimate_residuals(given)
    assert estimate.compliance[0, 2] == estimate.most[0, 2] == 0
    assert (estimate.compliance[1] > 0).all()


def test_a_body_without_elastic_modes_or_attachments_has_no_estimate():
    assert not estimate_residuals(sheet().truncated(6)).compliance.any()
    assert estimate_residuals(replace(sheet(), attachments=())).compliance.shape == (0, 3)


def test_a_place_of_a_plate_that_no_node_carries_still_has_an_estimate():
    body = replace(sheet().truncated(30), nodes=np.zeros((0, 3)), shapes=np.zeros((0, 6, 30)))
    assert np.isfinite(estimate_residuals(body).compliance).all()


def test_a_corner_of_a_block_is_doubted_more_than_its_faces():
    """Two nodes in faces, and a corner: there fewer cubes hold it, and a force dents it further."""
    body = solid()
    corner = replace(body.attachments[0], name="corner", position=body.nodes[0])
    moved = replace(corner, shapes=body.shapes[0].astype(float))
    estimate = estimate_residuals(replace(body, attachments=(*body.attachments, moved)).truncated(46))
    spread = (estimate.compliance / estimate.least).max(axis=1)
    assert spread[2] > 1.2 * spread[:2].max()


@pytest.mark.parametrize("body", [sheet, solid])
def test_nodes_that_are_there_twice_change_no_estimate(body):
    """As those of attachments are in a body's universal file, which has them before its mesh."""
    once = body().truncated(46)
    held = [held_nodes(once, a).nodes[0] for a in once.attachments]
    again = np.r_[held, np.arange(len(once.nodes))]
    twice = replace(once, nodes=once.nodes[again], shapes=once.shapes[again])
    found, expected = estimate_residuals(twice), estimate_residuals(once)
    for name in ("compliance", "least", "most"):
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), rtol=1e-9)


def with_nodes_of_attachments(body):
    """A body that has a node, without mass, wherever an attachment is, as universal files have it."""
    shapes = np.array([a.shapes for a in body.attachments])
    return replace(
        body,
        nodes=np.concatenate([[a.position for a in body.attachments], body.nodes]),
        shapes=np.concatenate([shapes, body.shapes.astype(float)]),
    )


def test_a_reference_node_is_not_what_carries_its_attachment():
    node, arm, mean = (held_nodes(with_nodes_of_attachments(sheet()), a) for a in sheet().attachments)
    assert node.nodes.tolist() == [0, 75 + 3]
    assert (arm.nodes.tolist(), arm.without_mass.tolist()) == ([210 + 3], [1])
    assert (mean.is_mean, len(mean.nodes), mean.without_mass.tolist()) == (True, 9, [2])


def test_a_reference_node_above_its_grids_follows_how_they_turn():
    """As RBE3 carries one."""
    body = sheet()
    near = np.argsort(np.linalg.norm(body.nodes - body.nodes[200], axis=1))[:9]
    place = body.nodes[200] + np.array([0, 0, 0.05])
    motion = set_motion(place, body.nodes[near], np.ones(9), False)
    shapes = motion @ body.shapes[near].reshape(54, -1).astype(float)
    above = with_nodes_of_attachments(replace(body, attachments=(Attachment("above", place, shapes),)))
    held = held_nodes(above, above.attachments[0])
    assert (held.is_mean, held.without_mass.tolist()) == (True, [0])
    assert sorted(held.nodes - 1) == sorted(near)


def test_reference_nodes_change_no_estimate():
    """One that counts as mass makes a node of a mean, and doubles the mass at the foot of an arm."""
    once = sheet().truncated(46)
    found, expected = (estimate_residuals(b) for b in (with_nodes_of_attachments(once), once))
    for name in ("compliance", "least", "most"):
        np.testing.assert_allclose(getattr(found, name), getattr(expected, name), rtol=1e-6)
