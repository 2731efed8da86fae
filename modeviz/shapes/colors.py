"""From displacements to the colours of vertices."""

import numpy as np
from numpy.typing import NDArray

from modeviz.shapes.motion import peak_displacement
from modeviz.vehicle.arrays import Floats

DISPLACEMENT_STOPS = ("#3a5480", "#3e8aa0", "#96bea0", "#ecce78", "#e28446", "#b02c34")
"""sRGB from no displacement to the largest, equally spaced."""


def color_map(values: Floats) -> NDArray[np.uint8]:
    """The sRGB colours of values from 0 to 1, (n, 3); values outside take the end colours."""
    stops = np.array([list(bytes.fromhex(stop[1:])) for stop in DISPLACEMENT_STOPS], float)
    places = np.linspace(0, 1, len(stops))
    channels = [np.interp(values, places, channel) for channel in stops.T]
    return np.stack(channels, axis=-1).round().astype(np.uint8)


def displacement_colors(shape: NDArray, largest: float) -> NDArray[np.uint8]:
    """The sRGB colours of vertices by how far they move, (n_vertices, 3).

    Args:
        shape: (n_vertices, 3), real or complex.
        largest: the displacement that takes the last colour.
    """
    return color_map(peak_displacement(shape) / largest if largest > 0 else np.zeros(len(shape)))
