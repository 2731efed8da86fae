"""Models made without modeviz's own modelling code, to compare it with."""

import numpy as np
import scipy.linalg

from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.vehicle import Vehicle


class Beam:
    """A straight Euler-Bernoulli beam along x with 6 degrees of freedom a node, consistent mass."""

    def __init__(self, n_elements=10, length=2.0, start=(0.0, 0.0, 0.0), mass_per_length=20.0):
        self.n_nodes = n_elements + 1
        self.nodes = np.array(start) + np.outer(np.linspace(0, length, self.n_nodes), [1.0, 0, 0])
        h, m = length / n_elements, mass_per_length
        k, mass = _element(h, ea=4e7, gj=4e4, ei_y=6e4, ei_z=9e4, m=m, polar=0.02)
        self.stiffness = np.zeros((6 * self.n_nodes, 6 * self.n_nodes))
        self.mass = np.zeros_like(self.stiffness)
        for i in range(n_elements):
            s = slice(6 * i, 6 * i + 12)
            self.stiffness[s, s] += k
            self.mass[s, s] += mass

    def body(self, name, role="frame", n_modes=None, loads=(), damping_ratio=0.0):
        """The beam as a modal body with an attachment at every node.

        `n_modes` normal modes are kept (all if None), and a residual vector for each (node, direction)
        of `loads`.
        """
        omega_squared, phi = scipy.linalg.eigh(self.stiffness, self.mass)
        omega_squared[:6] = 0.0
        kept = n_modes or len(omega_squared)
        basis, squares, n_residuals = phi[:, :kept], omega_squared[:kept], 0
        if loads:
            left_out, their_squares = phi[:, kept:], omega_squared[kept:]
            rows = left_out[[6 * node + direction for node, direction in loads]]
            static = left_out @ (rows / their_squares).T
            s, y = scipy.linalg.eigh(static.T @ self.stiffness @ static, static.T @ self.mass @ static)
            basis, squares, n_residuals = np.hstack([basis, static @ y]), np.r_[squares, s], len(s)
        shapes = basis.reshape(self.n_nodes, 6, -1)
        attachments = tuple(
            Attachment(f"node {i}", self.nodes[i], shapes[i]) for i in range(self.n_nodes)
        )
        return FlexibleBody(
            name, role, name, squares, n_residuals, damping_ratio, attachments, self.nodes, shapes
        )


def _element(h, ea, gj, ei_y, ei_z, m, polar):
    """Stiffness and consistent mass of one element, x, y, z, rx, ry, rz at each end."""
    k, mass = np.zeros((12, 12)), np.zeros((12, 12))
    for a, b, stiffness, inertia in ((0, 6, ea / h, m * h), (3, 9, gj / h, polar * h)):
        k[np.ix_([a, b], [a, b])] += stiffness * np.array([[1, -1], [-1, 1]])
        mass[np.ix_([a, b], [a, b])] += inertia / 6 * np.array([[2, 1], [1, 2]])
    bending = np.array(
        [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
         [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
    )  # fmt: skip
    inertia = np.array(
        [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
         [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
    )  # fmt: skip
    for dofs, sign, ei in (([1, 5, 7, 11], 1, ei_z), ([2, 4, 8, 10], -1, ei_y)):
        turn = np.diag([1, sign, 1, sign])
        k[np.ix_(dofs, dofs)] += ei / h**3 * turn @ bending @ turn
        mass[np.ix_(dofs, dofs)] += m * h / 420 * turn @ inertia @ turn
    return k, mass


def direct_system(beams, vehicle: Vehicle):
    """Mass and stiffness of beams (by name) joined at nodes, in physical coordinates.

    Only for vehicles of such beams whose connections hold on to nodes; arms are the cross products of
    textbooks, u + θ × r.
    """
    offsets = dict(zip(beams, np.cumsum([0] + [b.mass.shape[0] for b in beams.values()]), strict=False))
    mass = scipy.linalg.block_diag(*(b.mass for b in beams.values()))
    stiffness = scipy.linalg.block_diag(*(b.stiffness for b in beams.values()))
    for connection in vehicle.all_connections:
        rows = np.zeros((6, len(mass)))
        for sign, name, point in zip((1, -1), connection.bodies, connection.points, strict=True):
            if name == "ground":
                continue
            node = int(np.argmin(np.linalg.norm(beams[name].nodes - point, axis=1)))
            first = offsets[name] + 6 * node
            arm = connection.center - point
            turned = np.cross(np.eye(3), arm).T
            rows[:, first : first + 6] = sign * np.block([[np.eye(3), turned], [0 * turned, np.eye(3)]])
        rows = scipy.linalg.block_diag(connection.axes, connection.axes) @ rows
        k = np.r_[connection.stiffness, connection.rotational_stiffness]
        stiffness += rows.T @ np.diag(k) @ rows
    return mass, stiffness
