"""Tensors of inertia that a body can have."""

import numpy as np

from modeviz.vehicle.arrays import Floats

ROUNDING = 1e-3
"""Moments are often given to three digits, and a flat body is at the limit."""


def impossible(inertia: Floats, tolerance: float = ROUNDING) -> str:
    """A sentence on why no body has that inertia; nothing if one may.

    Of the three principal moments no one is larger than the two others together, because
    I_1 + I_2 - I_3 = 2 ∫ x_3² dm.

    Args:
        inertia: (3, 3), symmetric, about the centre of gravity.
        tolerance: what it may be off, a part of the largest moment.
    """
    small, middle, large = np.linalg.eigvalsh(inertia)
    if large <= (small + middle) * (1 + tolerance):
        return ""
    return (
        f"of the principal moments {small:.4g}, {middle:.4g} and {large:.4g} the largest is more than "
        f"both others together, {small + middle:.4g}"
    )
