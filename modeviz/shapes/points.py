"""Places drawn as small octahedra."""

import numpy as np

from modeviz.vehicle.arrays import Array, Floats

CORNERS = np.concatenate([np.eye(3), -np.eye(3)])
FACES = np.array(
    [[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]], np.int32
)
"""Of `CORNERS`, seen from outside against the clock."""


def octahedra(places: Floats, radius: float) -> tuple[Floats, Array]:
    """Return vertices and faces of an octahedron around each place, six vertices for each in turn.

    Args:
        places: (n, 3), m.
        radius: m.
    """
    vertices = places[:, None] + radius * CORNERS
    faces = FACES + 6 * np.arange(len(places), dtype=np.int32)[:, None, None]
    return vertices.reshape(-1, 3), faces.reshape(-1, 3)
