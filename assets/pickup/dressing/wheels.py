"""A wheel of the right side: tyre, rim, spokes and hub cap."""

import numpy as np

from pickup.connections import WHEEL_RADIUS
from pickup.materials import Piece
from pickup.sides import Place
from pickup.solids import Surface, block, revolved, rotation

N_SPOKES = 6
N_SEGMENTS = 36

TYRE = (
    (0.205, -0.090),
    (0.240, -0.118),
    (0.305, -0.118),
    (0.345, -0.092),
    (WHEEL_RADIUS, -0.012),
    (0.346, -0.008),
    (0.346, 0.008),
    (WHEEL_RADIUS, 0.012),
    (0.345, 0.092),
    (0.305, 0.118),
    (0.240, 0.118),
    (0.205, 0.090),
)
"""(radius, height), m, with a groove in the tread."""
RIM = (
    (0.210, -0.100),
    (0.182, 0.040),
    (0.200, 0.090),
    (0.212, 0.106),
    (0.218, 0.098),
)


def wheel(center: Place) -> list[Piece]:
    """A wheel about its centre, its face towards the right."""
    c = np.asarray(center, float)
    dish = [(0.182, 0.018), (0.10, 0.034), (0.0, 0.040)]
    cap = [(0.062, 0.03), (0.060, 0.086), (0.050, 0.096), (0.0, 0.100)]
    return [
        Piece("rubber", revolved(TYRE, "y", c, N_SEGMENTS)),
        Piece("chrome", revolved(RIM, "y", c, N_SEGMENTS)),
        Piece("dark", revolved(dish, "y", c, 24)),
        *(Piece("chrome", _spoke(k).moved(c)) for k in range(N_SPOKES)),
        Piece("chrome", revolved(cap, "y", c, 20)),
    ]


def _spoke(number: int) -> Surface:
    shape = block((0.125, 0.066, 0), (0.145, 0.030, 0.085), rear=0.62)
    return shape.turned(rotation("y", number * 360 / N_SPOKES))
