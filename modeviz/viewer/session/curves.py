"""The responses of a vehicle that can be drawn."""

import numpy as np

from modeviz.dynamics.mount_rates import turning_axes
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.state import ChartCurve, ForceCurve, ResponseCurve


def known_curves(vehicle: Vehicle) -> list[ChartCurve]:
    """Return all responses there are: accelerations of points, then forces of mounts.

    Along the vehicle's axes too where a mount's own are others.
    """
    curves: list[ChartCurve] = [
        ResponseCurve(i, d) for i in range(len(vehicle.response_points)) for d in DIRECTIONS
    ]
    turns = turning_axes(vehicle)
    for mount, about in zip(vehicle.mounts, turns, strict=True):
        own = [*MOTIONS[:3], *(m for m, does in zip(MOTIONS[3:], about, strict=True) if does)]
        curves += [ForceCurve(mount.name, motion) for motion in own]
        if not np.array_equal(mount.axes, np.eye(3)):
            every = MOTIONS if about.any() else MOTIONS[:3]
            curves += [ForceCurve(mount.name, motion, in_vehicle_axes=True) for motion in every]
    return curves
