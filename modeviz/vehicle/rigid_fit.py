"""The rigid motions that are in a body's modes, fitted over all that is known of their shapes."""

from dataclasses import dataclass

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.rigid import rigid_motions

INDEPENDENT = 1e-6
"""Motions count as independent of others by more than this part of the largest."""


@dataclass(frozen=True, eq=False)
class RigidFit:
    """The rigid motions that the rigid modes of a body are closest to."""

    center: Floats
    """(3,), m: the middle of all places that are known."""
    motions: Floats
    """(6, n_rigid): x, y, z, rx, ry, rz of `center` in each rigid mode."""

    @property
    def coordinates(self) -> Floats:
        """The modal coordinates of unit motions of the origin, (n_rigid, 6).

        What none of the modes does, as a rod's turning about itself, has none.
        """
        to_modes = np.linalg.pinv(self.motions, rcond=INDEPENDENT)
        return to_modes @ rigid_motions(self.center)

    @property
    def mass(self) -> Floats:
        """The mass matrix of the body as a rigid one, (6, 6), for motions of the origin.

        In kg, kg m and kg m²; it takes the modes as mass-normalised.
        """
        T = self.coordinates
        return T.T @ T

    @property
    def center_of_gravity(self) -> Floats:
        """(3,), m."""
        m = self.mass
        twice = [m[1, 5] - m[2, 4], m[2, 3] - m[0, 5], m[0, 4] - m[1, 3]]
        return np.array(twice) / (2 * np.trace(m[:3, :3]) / 3)

    @property
    def mass_about_center_of_gravity(self) -> tuple[Floats, Floats]:
        """Masses along x, y, z and the tensor of inertia, (3, 3) each, kg and kg m²."""
        T = rigid_motions(-self.center_of_gravity)
        about = T.T @ self.mass @ T
        return about[:3, :3], about[3:, 3:]

    def moved(self, positions: Floats) -> Floats:
        """x, y, z, rx, ry, rz of places that move with the fit, (n_places, 6, n_rigid).

        Args:
            positions: (n_places, 3), m.
        """
        return rigid_motions(positions - self.center) @ self.motions


def fit_rigid(positions: Floats, shapes: Floats, nodes: Floats, node_shapes: Floats) -> RigidFit:
    """The rigid motions closest to rigid modes in the least-squares sense.

    Translations of the attachments are fitted; where these lie so that they do not tell all motions,
    rotations too and then the translations of the nodes.

    Args:
        positions: (n_attachments, 3), m.
        shapes: (n_attachments, 6, n_rigid), of the rigid modes; no rotations at all count as unknown.
        nodes: (n_nodes, 3), m.
        node_shapes: (n_nodes, 6, n_rigid).
    """
    n_rigid = shapes.shape[2]
    places = np.vstack([positions, nodes])
    if not len(places):
        return RigidFit(np.zeros(3), np.zeros((6, n_rigid)))
    center = places.mean(axis=0)
    length = float(np.linalg.norm(places - center, axis=1).max()) or 1.0
    weight = np.repeat([1.0, length], 3)[:, None]
    every = [
        (positions, shapes, slice(0, 3)),
        (positions, shapes, slice(3, 6 if shapes[:, 3:].any() else 3)),
        (nodes, node_shapes, slice(0, 3)),
    ]
    A, B = np.zeros((0, 6)), np.zeros((0, n_rigid))
    for where, motions, rows in every:
        G = (weight * rigid_motions(where - center) / weight.T)[:, rows].reshape(-1, 6)
        A = np.vstack([A, G])
        B = np.vstack([B, (weight * motions)[:, rows].reshape(-1, n_rigid)])
        if np.linalg.matrix_rank(A.T @ A, rtol=INDEPENDENT**2) >= n_rigid:
            break
    X = np.linalg.lstsq(A, B, rcond=INDEPENDENT)[0]
    return RigidFit(center, X / weight)
