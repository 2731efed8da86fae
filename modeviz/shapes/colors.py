"""Colours of vertices, made of how they move."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from modeviz.shapes.motion import mean_square
from modeviz.vehicle.arrays import Array, Floats

Color = tuple[int, int, int]
"""sRGB, 0 to 255."""

COLOR_STOPS = ("#3a5480", "#3e8aa0", "#96bea0", "#ecce78", "#e28446", "#b02c34")
"""sRGB from nothing to the most, equally spaced."""


@dataclass(frozen=True)
class Shade:
    """A way to colour a body: each vertex by `gain` times a measure of its displacement u."""

    gain: float
    power: Literal[0, 1, 2]
    """The measure: 0 is 1 everywhere, 1 the largest |u| of the cycle, 2 u·ū, twice its mean |u|²."""


def stop_colors() -> Floats:
    """The stops of the colour map, sRGB from 0 to 255, (n_stops, 3)."""
    return np.array([list(bytes.fromhex(stop[1:])) for stop in COLOR_STOPS], float)


def color_map(values: Floats) -> NDArray[np.uint8]:
    """The sRGB colours of values from 0 to 1, (n, 3); values outside take the end colours."""
    stops = stop_colors()
    places = np.linspace(0, 1, len(stops))
    channels = [np.interp(values, places, channel) for channel in stops.T]
    return np.stack(channels, axis=-1).round().astype(np.uint8)


def displacement_shade(largest: float) -> Shade:
    """Colours a body by how far its vertices move; `largest` takes the last colour."""
    return Shade(1 / largest if largest > 0 else 0.0, 1)


def motion_shades(
    shares: Mapping[str, float], shapes: Mapping[str, Array], largest: float
) -> dict[str, Shade]:
    """Colours bodies by their shares of an energy of motion, within each by its vertices' |u|².

    The vertex of a body that moves most has the colour of the body's share, one that moves half as far
    that of a quarter of it. So bodies are compared by their shares, and within a body the colour tells
    where it moves; it is no energy density, which would need the body's mass by vertex.

    Args:
        shares: by body, 0 to 1.
        shapes: (n_vertices, 3) by body, real or complex.
        largest: the share that takes the last colour.
    """
    shades = {}
    for name, shape in shapes.items():
        moves_most = float(mean_square(shape).max(initial=0.0))
        scale = largest * moves_most
        shades[name] = Shade(shares.get(name, 0.0) / scale if scale > 0 else 0.0, 2)
    return shades


def share_shade(share: float, largest: float) -> Shade:
    """Colours the whole of a body by its share; the share `largest` takes the last colour."""
    return Shade(share / largest if largest > 0 else 0.0, 0)
