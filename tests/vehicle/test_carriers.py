"""What nodes carry along moves rigidly with them, and without steps or folds between their regions."""

import numpy as np
import pytest

from modeviz.vehicle.carriers import carried_by_nodes
from modeviz.vehicle.rigid import rigid_motions

RNG = np.random.default_rng(7)
SINGLE = 4e-6
"""A few roundings of single-precision numbers up to about 5."""


def moved(nodes, motions, places):
    """(n_places, 3, n_coordinates)."""
    return np.moveaxis(carried_by_nodes(nodes, motions, places), 0, -1).astype(float)


def plate(n=9, size=1.0):
    """Nodes of a flat square, (n², 3)."""
    x, y = np.meshgrid(np.linspace(0, size, n), np.linspace(0, size, n))
    return np.stack([x.ravel(), y.ravel(), 0.2 + 0 * x.ravel()], axis=1)


def along_a_line(n, motions_of):
    """The motion of n places on a line across many regions of scattered nodes, (n, 3)."""
    nodes = np.random.default_rng(3).uniform(0, 1, (300, 3))
    line = np.linspace([0.05, 0.1, 0.2], [0.95, 0.83, 0.71], n)
    return moved(nodes, motions_of(nodes), line)[:, :, 0]


def noise(nodes):
    """Nodes that know nothing of each other."""
    return np.random.default_rng(4).normal(size=(len(nodes), 6, 1))


def wave(nodes):
    """Bending about the plane z = 0.5 with a length of 1.5: u_z = w, u_x = -(z - 0.5) w', θ_y = -w'."""
    k, (x, _, z) = 2 * np.pi / 1.5, nodes.T
    motions = np.zeros((len(nodes), 6, 1))
    motions[:, 2, 0] = np.sin(k * x)
    motions[:, 0, 0] = -(z - 0.5) * k * np.cos(k * x)
    motions[:, 4, 0] = -k * np.cos(k * x)
    return motions


def test_neighbouring_places_move_alike_across_every_seam_between_regions_of_nodes():
    coarse, fine = (np.abs(np.diff(along_a_line(n, noise), axis=0)).max() for n in (2_001, 20_001))
    assert fine < 0.15 * coarse  # a step would be the same in both


def test_slopes_of_a_smooth_mode_hardly_differ_at_a_seam():
    n = 8_001
    slopes = np.diff(along_a_line(n, wave), axis=0) * n
    assert np.abs(np.diff(slopes, axis=0)).max() < 0.1 * np.abs(slopes).max()  # of a step: thousands


def test_places_at_the_same_distance_from_all_nodes_take_their_mean():
    angles = np.arange(24) * np.pi / 12
    ring = np.stack([np.cos(angles), np.sin(angles), 0 * angles], axis=1)
    motions = np.zeros((24, 6, 1))
    motions[:, 2] = 1.5
    assert moved(ring, motions, np.zeros((1, 3)))[0, :, 0] == pytest.approx([0, 0, 1.5], abs=SINGLE)


@pytest.mark.parametrize("n_nodes", [1, 2, 3, 8, 9, 10])
def test_few_nodes_carry_a_rigid_motion_exactly(n_nodes):
    nodes = RNG.normal(size=(n_nodes, 3))
    places = RNG.normal(size=(20, 3))
    exact = rigid_motions(places)[:, :3]
    assert moved(nodes, rigid_motions(nodes), places) == pytest.approx(exact, abs=SINGLE)


@pytest.mark.parametrize("nodes", [plate(), RNG.uniform(-1, 1, (40, 3))], ids=["flat", "scattered"])
def test_nodes_without_rotations_turn_what_they_carry_as_they_move(nodes):
    motions = rigid_motions(nodes)
    motions[:, 3:] = 0  # as of solid elements and tests in three directions
    places = RNG.uniform(0, 1, (50, 3)) + np.array(
        [0, 0, 0.3]
    )  # off the plate, where only rotations tell
    exact = rigid_motions(places)[:, :3]
    assert moved(nodes, motions, places) == pytest.approx(exact, abs=SINGLE)


def test_nodes_on_a_line_do_not_turn_about_it():
    line = np.linspace([0, 0, 0], [1, 0, 0], 7)
    motions = np.zeros((7, 6, 1))
    motions[:, 2, 0] = line[:, 0] ** 2
    found = moved(line, motions, np.array([[0.5, 0.0, 0.1]]))[0, :, 0]
    assert found == pytest.approx([-2 * 0.5 * 0.1, 0, 0.25], abs=0.01)


def test_a_bent_plate_of_nodes_without_rotations_is_drawn_without_treads():
    nodes = plate(11)
    motions = np.zeros((121, 6, 1))
    motions[:, 2, 0] = nodes[:, 0] ** 2 / 2  # slope x, curvature 1
    x = np.linspace(0.2, 0.8, 601)
    places = np.stack([x, 0.5 + 0 * x, 0.2 + 0 * x], axis=1)
    slope = np.gradient(moved(nodes, motions, places)[:, 2, 0], x)
    spacing = 0.1
    assert np.abs(slope - x).max() < spacing  # treads would have slopes from none to twice the mean
    at_nodes = np.isclose(x / spacing, np.rint(x / spacing))
    assert slope[at_nodes] == pytest.approx(x[at_nodes], abs=0.02)


def test_vertices_in_one_place_stay_together_whatever_faces_they_are_of():
    nodes, motions = RNG.uniform(-1, 1, (50, 3)), RNG.normal(size=(50, 6, 4))
    places = RNG.uniform(-1, 1, (30, 3))
    twice = moved(nodes, motions, np.concatenate([places, RNG.permuted(places, axis=0), places]))
    assert twice[:30] == pytest.approx(twice[-30:], abs=SINGLE)


def test_nodes_in_one_place_carry_what_is_there_by_their_mean():
    nodes = np.concatenate([np.zeros((2, 3)), RNG.normal(size=(20, 3)) + 3])
    motions = RNG.normal(size=(22, 6, 1))
    found = moved(nodes, motions, np.zeros((1, 3)))[0, :, 0]
    assert found == pytest.approx(motions[:2, :3, 0].mean(axis=0), abs=SINGLE)
