"""Small finite-element meshes with known answers."""

import numpy as np

from modeviz.fem.mesh import BeamSection, FiniteElementMesh, ShellSection

STEEL = {"youngs_modulus": 2.1e11, "poisson_ratio": 0.3, "density": 7850.0}

BAR = BeamSection(
    area=4e-4,
    bending_inertia_up=2e-8,
    bending_inertia_across=1e-8,
    torsion_constant=2.4e-8,
    **STEEL,
)


def grid(place, n_u, n_v, closed=False):
    """Nodes and quads of a surface u, v -> (x, y, z) over the unit square.

    Closed surfaces end in u where they began.
    """
    u, v = np.meshgrid(np.linspace(0, 1, n_u + 1), np.linspace(0, 1, n_v + 1), indexing="ij")
    index = np.arange(u.size).reshape(u.shape)
    if closed:
        u, v, index[-1] = u[:-1], v[:-1], index[0]
    nodes = np.stack(np.broadcast_arrays(*place(u, v)), axis=-1).reshape(-1, 3).astype(float)
    corners = index[:-1, :-1], index[1:, :-1], index[1:, 1:], index[:-1, 1:]
    return nodes, np.stack(corners, axis=-1).reshape(-1, 4)


def shell(place, n_u, n_v, section, closed=False):
    nodes, quads = grid(place, n_u, n_v, closed)
    return FiniteElementMesh(nodes, quads, (section,) * len(quads))


def plate(n, thickness=0.005):
    """A square steel plate of 1 m in n x n elements."""
    return shell(lambda u, v: (u, v, 0), n, n, ShellSection(thickness, **STEEL))


def twisted_plate(n=6):
    """A plate whose far edge is turned by half a radian: every element is warped."""
    return shell(
        lambda u, v: (u, (v - 0.5) * np.cos(u / 2), (v - 0.5) * np.sin(u / 2)),
        n,
        n,
        ShellSection(0.001, **STEEL, bending_factor=50.0),
    )


def bar(n=20, length=1.0, section=BAR, along=(1.0, 0.0, 0.0), up=(0.0, 0.0, 1.0)):
    """A straight beam of n elements from the origin."""
    nodes = np.outer(np.linspace(0, length, n + 1), along)
    beams = np.stack([np.arange(n), np.arange(n) + 1], axis=1)
    return FiniteElementMesh(
        nodes, beams=beams, beam_sections=(section,) * n, beam_up=np.tile(up, (n, 1))
    )
