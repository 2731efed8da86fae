"""Rigid joints: what they hold is eliminated, so no stiff spring has to stand for them.

    R x = a  ⇒  x = U a + T y,  TᵀMT = I,  TᵀMU = 0

R are the relative motions of the joints, a is zero but where the ground end of a joint moves, T is a
basis of the motions that are left (multipoint constraints by elimination; R. D. Cook and others,
"Concepts and Applications of Finite Element Analysis", 4th ed., section 13.2).
"""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from modeviz.vehicle.arrays import Floats

DEPENDENT = 1e-9
"""A joint that holds nothing that others do not is left out: bodies may be bolted more often than
needed. In mass-normalised coordinates, relative to what is held best."""


@dataclass(frozen=True, eq=False)
class RigidJoints:
    """The motions that the rigid joints of a system hold, and those they leave."""

    held: Floats
    """B, (n_held, n_dofs): independent rows that are zero in every motion."""
    freedom: Floats
    """T, (n_dofs, n_free): every motion is a sum of these columns, which are orthonormal in mass."""
    led: Floats
    """U, (n_dofs, n_rows): the motion that a unit of each of R x is; repeated rows share it."""

    @property
    def shares(self) -> Floats:
        """B U, (n_held, n_rows): what of each that is held a unit of each of R x is."""
        return self.held @ self.led


def rigid_joints(mass: Floats, rows: Floats) -> RigidJoints:
    """The joints that hold some relative motions.

    Args:
        mass: M, (n_dofs, n_dofs).
        rows: R, (n_rows, n_dofs), one for each relative motion; some may repeat others.
    """
    L = scipy.linalg.cholesky(mass, lower=True)
    of_unit_mass = scipy.linalg.solve_triangular(L, rows.T, lower=True).T
    size = np.linalg.norm(of_unit_mass, axis=1)
    moved = size > 0
    W, singular, V = np.linalg.svd(of_unit_mass[moved] / size[moved, None])
    n_held = int(np.count_nonzero(singular > DEPENDENT * singular.max(initial=0.0)))
    shares = np.zeros((n_held, len(rows)))
    shares[:, moved] = (W[:, :n_held] / singular[:n_held]).T / size[moved]
    return RigidJoints(
        held=V[:n_held] @ L.T,
        freedom=scipy.linalg.solve_triangular(L.T, V[n_held:].T),
        led=scipy.linalg.solve_triangular(L.T, V[:n_held].T @ shares),
    )
