"""Bounds of how far mounts may be moved along the vehicle's axes and turned about them."""

from collections.abc import Mapping

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.units import factor
from modeviz.vehicle.local_axes import AXES

PlaceBounds = Mapping[str, tuple[float, float]]
"""The least and the most, by axis."""

FARTHEST = np.pi / 2
"""Rad: a mount that is turned by more is another way round."""


def check_offsets(where: str, bounds: PlaceBounds) -> None:
    """Raises VehicleError unless these are bounds of offsets, m."""
    _check(f"{where}: offset", bounds, factor("mm", "length"), "mm")


def check_angles(where: str, bounds: PlaceBounds) -> None:
    """Raises VehicleError unless these are bounds of angles, rad."""
    _check(f"{where}: angle", bounds, factor("deg", "angle"), "deg")
    for axis, ends in bounds.items():
        if max(map(abs, ends)) > FARTHEST * (1 + 1e-9):
            raise VehicleError(
                f"{where}: angle: {axis}: found {_range(ends, factor('deg', 'angle'))} deg, expected "
                "no more than 90 deg to either side"
            )


def _check(where: str, bounds: PlaceBounds, unit: float, name: str) -> None:
    for axis, (low, high) in bounds.items():
        if axis not in AXES:
            raise VehicleError(f"{where}: {unknown('axis', axis, AXES)}")
        if not (np.isfinite([low, high]).all() and low < high):
            raise VehicleError(
                f"{where}: {axis}: found {_range((low, high), unit)} {name}, expected two numbers, the "
                "lower one first"
            )


def _range(ends: tuple[float, float], unit: float) -> str:
    return " to ".join(f"{end / unit:g}" for end in ends)
