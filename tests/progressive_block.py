"""A block on a progressive mount that holds it alone, to be solved by hand."""

from dataclasses import replace

import numpy as np
from small_systems import block

from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.loads import Force, ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.progressive import ForceCurve
from modeviz.vehicle.vehicle import Vehicle

MASS = 100.0
CURVE = ForceCurve(np.array([0.0, 0.005, 0.010]), np.array([0.0, 500.0, 2000.0]))
"""100 N/mm up to 5 mm, then 300 N/mm."""


def progressive_group(curves=None, **properties) -> MountGroup:
    """One mount at the origin; unloaded it vibrates with 130 N/mm vertically."""
    rates = MountRates(1.3e5, 1e6, 1e6)
    mount = Mount("m", "m", ("block", GROUND), np.zeros((2, 3)))
    values = {
        "rotational_stiffness": np.full(3, 1e5),
        "curves": {"vertical": CURVE} if curves is None else curves,
    } | properties
    return MountGroup("m", "m", rates, 0.1, usual_bounds(rates), (mount,), **values)


def progressive_block(**properties) -> Vehicle:
    """The block with a force on it and a point; `properties` are those of the group."""
    return Vehicle(
        "block",
        (replace(block("block", MASS), inertia=np.diag([10.0, 20.0, 25.0])),),
        (),
        (progressive_group(**properties),),
        response_points=(ResponsePoint("top", "block", np.array([0.0, 0.1, 0.2])),),
        forces=(Force("push", "block", np.array([0.1, 0.0, 0.0]), np.array([0.0, 0.6, 0.8]), 10.0),),
    )
