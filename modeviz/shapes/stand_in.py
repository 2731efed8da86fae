"""What a rigid body looks like that has no mesh: a block of its mass and moments of inertia."""

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, Material, Mesh, MeshPart, RigidBody

COLOR = (150, 156, 164)

N_CELLS = 6
"""Along each edge of a face, so that colours tell how its middle moves."""

THINNEST = 0.02
"""Of its longest edge: a rod or a plate is drawn no thinner."""


def drawn_mesh(body: Body) -> Mesh:
    """Return the mesh by which a body is drawn: its own, or of a rigid one without any a block.

    That lies along the vehicle's axes, whatever the products of inertia are: the principal axes of an
    engine or a cab, whose moments hardly differ, would turn it as nobody has seen one. An absorber's is
    drawn above its place, where its spring is seen.
    """
    if body.mesh or not isinstance(body, RigidBody):
        return body.mesh
    vertices, faces = _block()
    edges = block_edges(body.mass, np.diag(body.inertia))
    lift = edges * [0, 0, body.role == "absorber"]
    places = body.center_of_gravity + lift + vertices * edges
    return (MeshPart("block", places, faces, Material(COLOR)),)


def block_edges(mass: float, moments: Floats) -> Floats:
    """Return the edges of a homogeneous block, (3,), m.

    I₁ = m (b² + c²)/12 and so on, so that a² = 6 (I₂ + I₃ - I₁)/m.

    Args:
        mass: kg.
        moments: of inertia about axes along its edges, (3,), kg m².
    """
    squares = 6 * (moments.sum() - 2 * moments) / mass
    edges = np.sqrt(np.maximum(squares, 0.0))
    return np.maximum(edges, THINNEST * edges.max())


def _block() -> tuple[Floats, np.ndarray]:
    """The vertices and faces of a cube from -1/2 to 1/2, outward sides in front."""
    steps = np.linspace(-0.5, 0.5, N_CELLS + 1)
    u, v = (grid.ravel() for grid in np.meshgrid(steps, steps, indexing="ij"))
    corner = np.arange((N_CELLS + 1) * N_CELLS).reshape(N_CELLS, N_CELLS + 1)[:, :-1].ravel()
    square = np.stack([corner, corner + N_CELLS + 1, corner + N_CELLS + 2, corner + 1], axis=1)
    face = square[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
    vertices, faces = [], []
    for axis in range(3):
        for side in (-0.5, 0.5):
            places = np.zeros((len(u), 3))
            places[:, axis], places[:, (axis + 1) % 3], places[:, (axis + 2) % 3] = side, u, v
            faces.append((face if side > 0 else face[:, ::-1]) + len(vertices) * len(u))
            vertices.append(places)
    return np.concatenate(vertices), np.concatenate(faces)
