"""Conversion between sRGB, which screens show, and linear light, which glTF keeps."""

import numpy as np
from numpy.typing import ArrayLike

from modeviz.vehicle.arrays import Floats


def srgb_to_linear(srgb: ArrayLike) -> Floats:
    """Linear light of sRGB values, both 0 to 1 (IEC 61966-2-1)."""
    c = np.asarray(srgb, float)
    return np.where(c <= 0.04045, c / 12.92, ((c + 0.055) / 1.055) ** 2.4)


def linear_to_srgb(linear: ArrayLike) -> Floats:
    """The sRGB values of linear light, both 0 to 1 (IEC 61966-2-1)."""
    c = np.asarray(linear, float)
    return np.where(c <= 0.0031308, c * 12.92, 1.055 * np.maximum(c, 0) ** (1 / 2.4) - 0.055)
