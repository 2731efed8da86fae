import numpy as np
import pytest

from modeviz.shapes.motion import (
    DRAWN_FRACTION,
    FURTHEST,
    SMALL_FRACTION,
    default_amplitude,
    displacement,
    mean_square,
    peak_displacement,
    vertex_shapes,
)
from modeviz.vehicle.bodies import FlexibleBody, RigidBody

RNG = np.random.default_rng(4)
SINGLE = 4e-6  # a few roundings of single-precision numbers up to about 5


def rigid_motions(points, center):
    """(n, 6, 6): the six motions of points that move rigidly about `center`, by the cross product."""
    motions = np.zeros((len(points), 6, 6))
    for axis in range(3):
        unit = np.eye(3)[axis]
        motions[:, axis, axis] = 1
        motions[:, :3, 3 + axis] = np.cross(unit, points - center)
        motions[:, 3 + axis, 3 + axis] = 1
    return motions


def flexible(nodes, shapes):
    omega_n_squared = np.r_[np.zeros(6), np.arange(1, shapes.shape[2] - 5) * 100.0]
    return FlexibleBody("cab", "cabin", "cab", omega_n_squared, 0, 0.02, (), nodes, shapes)


@pytest.fixture
def body():
    nodes = RNG.uniform(-2, 2, (30, 3))
    elastic = RNG.normal(size=(30, 6, 2))
    return flexible(nodes, np.concatenate([rigid_motions(nodes, np.zeros(3)), elastic], axis=2))


def test_vertex_at_a_node_moves_exactly_as_the_node(body):
    shapes = vertex_shapes(body, body.nodes[[7, 3]])
    assert np.array_equal(np.moveaxis(shapes, 0, -1), body.shapes[[7, 3], :3])


def test_every_vertex_follows_a_rigid_motion_of_its_flexible_body(body):
    vertices = RNG.uniform(-3, 3, (50, 3))
    exact = rigid_motions(vertices, np.zeros(3))[:, :3]
    shapes = np.moveaxis(vertex_shapes(body, vertices), 0, -1)
    assert shapes[:, :, :6] == pytest.approx(exact, abs=SINGLE)


def test_vertex_beside_one_far_heavier_weighted_node_is_carried_by_it(body):
    offset = np.array([1e-4, -2e-4, 1e-4])
    u, theta = body.shapes[5, :3, 7], body.shapes[5, 3:, 7]
    carried = u + np.cross(theta, offset)
    others = (np.linalg.norm(offset) / 0.1) ** 2 * 4 * 20  # three further nodes, at least 0.1 m away
    shapes = vertex_shapes(body, body.nodes[[5]] + offset)
    assert shapes[7, 0] == pytest.approx(carried, abs=others)


def test_vertex_between_two_nodes_bends_as_their_rotations_say():
    nodes = np.array([[0.0, 0, 0], [1.0, 0, 0]])
    elastic = np.zeros((2, 6, 1))
    elastic[:, 4, 0] = 0.1, -0.1  # about y, opposite: u_z = -θ_y r_x from both sides
    body = flexible(nodes, np.concatenate([rigid_motions(nodes, np.zeros(3)), elastic], axis=2))
    shapes = vertex_shapes(body, np.array([[0.5, 0, 0]]))
    assert shapes[6, 0] == pytest.approx([0, 0, -0.05], abs=1e-7)


def test_vertex_of_a_rigid_body_turns_about_its_center_of_gravity():
    center = np.array([1.0, 2.0, 3.0])
    body = RigidBody("engine", "powertrain", "engine", 1.0, center, np.eye(3))
    vertices = RNG.uniform(-1, 1, (20, 3))
    exact = rigid_motions(vertices, center)[:, :3]
    assert np.moveaxis(vertex_shapes(body, vertices), 0, -1) == pytest.approx(exact, abs=SINGLE)


def test_displacement_is_the_superposition_of_the_shapes(body):
    shapes = vertex_shapes(body, RNG.uniform(-1, 1, (9, 3)))
    real, imaginary = RNG.normal(size=(2, body.n_modes))
    both = displacement(shapes, real + 1j * imaginary)
    exact = np.einsum("mvc,m->vc", shapes.astype(float), real + 1j * imaginary)
    assert both == pytest.approx(exact, abs=10 * SINGLE)
    assert displacement(shapes, real) == pytest.approx(both.real, abs=SINGLE)
    assert not np.iscomplexobj(displacement(shapes, real))


def test_peak_displacement_is_the_largest_of_the_cycle():
    shape = RNG.normal(size=(40, 3)) + 1j * RNG.normal(size=(40, 3))
    phases = np.linspace(0, np.pi, 2001)
    cycle = np.linalg.norm((shape[:, :, None] * np.exp(1j * phases)).real, axis=1).max(axis=1)
    sampling = (phases[1] / 2) ** 2  # the maximum is flat: relative loss below δ²/2 times 2
    assert peak_displacement(shape) == pytest.approx(cycle, rel=sampling)


def test_mean_square_is_twice_that_of_the_cycle():
    shape = RNG.normal(size=(40, 3)) + 1j * RNG.normal(size=(40, 3))
    phases = np.arange(8) * np.pi / 4  # a square of a cosine has no more than two periods in a turn
    cycle = np.linalg.norm((shape[:, :, None] * np.exp(1j * phases)).real, axis=1)
    assert mean_square(shape) == pytest.approx(2 * (cycle**2).mean(axis=1), rel=1e-14)
    assert mean_square(shape.real) == pytest.approx(np.linalg.norm(shape.real, axis=1) ** 2)


def test_what_moves_alike_is_drawn_at_a_fortieth_of_the_length():
    shapes = [np.array([[0.0, 0.3, 0.4], [0.5, 0, 0]]), np.array([[0.1, 0, 0]])]
    areas = [np.ones(2), np.ones(1)]
    assert default_amplitude(shapes, areas, 5.2) * 0.5 == pytest.approx(5.2 / 40)


def test_amplitude_goes_by_what_is_large_while_something_small_moves_further():
    panel, rod = np.full((99, 3), [0.0, 0, 0.6]), np.array([[1.0, 0, 0]])
    areas = [np.ones(99), np.array([1.0])]
    assert default_amplitude([panel, rod], areas, 5.2) * 0.6 == pytest.approx(5.2 / 40)
    everything_is_large = [np.ones(99), np.array([3.0])]
    assert default_amplitude([panel, rod], everything_is_large, 5.2) == pytest.approx(5.2 / 40)


def test_where_only_something_small_moves_it_is_drawn_twice_as_far():
    shapes, areas = [np.zeros((99, 3)), np.array([[1j, 0, 0]])], [np.ones(99), np.array([1.0])]
    assert default_amplitude(shapes, areas, 5.2) == pytest.approx(2 * 5.2 / 40)
    assert default_amplitude([np.ones((1, 3))], [np.zeros(1)], 5.2) > 0


@pytest.mark.parametrize("n_vertices", [1, 2, 30, 5000])
@pytest.mark.parametrize("power", [0.2, 1.0, 4.0])
@pytest.mark.parametrize("decimals", [1, 9])
def test_amplitude_goes_by_what_sorting_all_vertices_would_find(n_vertices, power, decimals):
    moved = np.round(RNG.exponential(1.0, n_vertices) ** power + 0.1, decimals)
    area = RNG.exponential(1.0, n_vertices)
    order = np.argsort(-moved)
    exceeded = area[order].cumsum() > SMALL_FRACTION * area.sum()
    large = max(moved[order][exceeded.argmax()], moved.max() / FURTHEST)
    shape = np.column_stack([moved, np.zeros((n_vertices, 2))])
    amplitude = default_amplitude([shape], [area], 4.0)
    assert amplitude * large == pytest.approx(DRAWN_FRACTION * 4.0, rel=1e-9)


def test_shapes_that_do_not_move_are_drawn_undeformed():
    assert default_amplitude([np.zeros((4, 3))], [np.ones(4)], 5.0) == 0
    assert default_amplitude([], [], 5.0) == 0
