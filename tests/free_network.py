"""A free structure with known modes: point masses at the corners of a box, springs between all."""

from dataclasses import dataclass

import numpy as np
from scipy.linalg import eigh

CORNERS = np.array([[x, y, z] for z in (0, 400.0) for y in (0, 700.0) for x in (0, 1000.0)])
"""mm."""
MASSES = np.array([1.0, 2.0, 1.5, 3.0, 2.5, 1.2, 0.8, 2.2]) / 1000
"""t."""
LABELS = np.array([11, 12, 13, 14, 21, 22, 23, 24])
HEXA = (11, 12, 14, 13, 21, 22, 24, 23)
"""Its corners, the lower face round about first."""


@dataclass(frozen=True, eq=False)
class Network:
    """The structure's matrices and modes, in mm and t; three directions of each mass."""

    mass: np.ndarray
    stiffness: np.ndarray
    omega_n_squared: np.ndarray
    shapes: np.ndarray
    """(8, 3, 24), mass-normalised."""

    @property
    def frequency_hz(self) -> np.ndarray:
        return np.sqrt(np.abs(self.omega_n_squared)) / (2 * np.pi)


def free_network() -> Network:
    n = len(CORNERS)
    K = np.zeros((3 * n, 3 * n))
    for a in range(n):
        for b in range(a + 1, n):
            along = CORNERS[b] - CORNERS[a]
            along /= np.linalg.norm(along)
            k = (20 + 3 * a + 5 * b) * np.outer(along, along)  # N/mm
            i, j = slice(3 * a, 3 * a + 3), slice(3 * b, 3 * b + 3)
            K[i, i] += k
            K[j, j] += k
            K[i, j] -= k
            K[j, i] -= k
    M = np.diag(np.repeat(MASSES, 3))
    omega_n_squared, shapes = eigh(K, M)
    omega_n_squared[:6] = 1e-4 * np.arange(1, 7)  # as solvers leave them, some mHz, in order
    return Network(M, K, omega_n_squared, shapes.reshape(n, 3, -1))


def held_frequencies(network: Network, springs: dict[int, float]) -> np.ndarray:
    """Hz of the structure with springs to the ground in all three directions, N/mm by label."""
    K = network.stiffness.copy()
    for label, stiffness in springs.items():
        row = 3 * int(np.flatnonzero(label == LABELS)[0])
        K[range(row, row + 3), range(row, row + 3)] += stiffness
    return np.sqrt(eigh(K, network.mass, eigvals_only=True)) / (2 * np.pi)
