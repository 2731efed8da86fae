"""Left and right: y is positive on the right, and everything is laid out there first."""

from collections.abc import Sequence
from typing import Literal

import numpy as np

from modeviz.vehicle.arrays import Floats

Place = Sequence[float] | Floats
"""x, y, z."""
Side = Literal["left", "right"]
SIDES: tuple[Side, Side] = ("left", "right")


def on_side(position: Place, side: Side) -> Floats:
    """A place of the right side, or its mirror image on the left."""
    x, y, z = position
    return np.array([x, -y if side == "left" else y, z])
