"""Bounds along or about x, y and z as files have them: all of the least, then all of the most."""

from modeviz.files.schema.quantities import Vector
from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.place_bounds import PlaceBounds


def ends_of(bounds: PlaceBounds) -> tuple[Vector, Vector] | None:
    """Return the least and the most of all axes, zero of one that has none; None of no bounds."""
    if not bounds:
        return None
    x, y, z = (bounds.get(axis, (0.0, 0.0)) for axis in AXES)
    return (x[0], y[0], z[0]), (x[1], y[1], z[1])


def bounds_of(ends: tuple[Vector, Vector] | None) -> PlaceBounds:
    """Return the bounds of the axes that have any."""
    pairs = zip(AXES, *(ends or ((), ())), strict=False)
    return {axis: (least, most) for axis, least, most in pairs if least or most}
