"""How far a design is within its limits."""

from modeviz.optimise.design_space import DesignSpace
from modeviz.vehicle.arrays import Floats


def excess(space: DesignSpace, x: Floats) -> float:
    """By how much ln k or that of a ratio is beyond its limit, at worst; below 0 if none is."""
    return float((space.rows @ x - space.values).max())
