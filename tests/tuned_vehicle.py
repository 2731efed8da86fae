"""An engine on a frame whose mounts turn and damp at tuned rates, and struts that only damp."""

from dataclasses import replace

import numpy as np
from dynamic_mounts import on_mounts

from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds

STRUTS = MountRates(0, 0, 0, damping_vertical=900.0, damping_lateral=300.0)
OTHER = {
    "E": MountRates(210e3, 220e3, 130e3, 0.2, rx=900.0, ry=150.0, rz=500.0, damping_vertical=80.0),
    "F": MountRates(500e3, 350e3, 250e3, damping_fore_aft=700.0),
    "S": MountRates(0, 0, 0, damping_vertical=2500.0, damping_lateral=100.0),
}
"""Rates other than the vehicle's own."""


def tuned_vehicle():
    """The vehicle; the frame's mounts have constant dampers across those that are tuned."""
    vehicle = on_mounts(None)
    engine, feet = vehicle.mount_groups
    rates = replace(
        engine.rates, rx=400.0, ry=300.0, rz=800.0, damping_vertical=200.0, damping_lateral=50.0
    )
    turning = replace(engine, rates=rates, bounds=usual_bounds(rates))
    most = replace(feet.bounds[1], damping_fore_aft=4000.0)
    damped = replace(
        feet,
        rates=replace(feet.rates, damping_fore_aft=500.0),
        bounds=(feet.bounds[0], most),
        damping=np.array([0.0, 120.0, 90.0]),
        rotational_stiffness=np.array([200.0, 0.0, 100.0]),
    )
    turn = np.array([[0.8, 0.0, 0.6], [0.0, 1.0, 0.0], [-0.6, 0.0, 0.8]])
    struts = tuple(
        Mount(f"S{i}", "S", ("frame", GROUND), np.tile([0.7, y, 0.4], (2, 1)), axes=turn)
        for i, y in enumerate((-0.5, 0.5))
    )
    group = MountGroup("S", "struts", STRUTS, 0.0, usual_bounds(STRUTS), struts)
    return replace(vehicle, mount_groups=(turning, damped, group))
