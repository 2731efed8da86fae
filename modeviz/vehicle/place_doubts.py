"""Doubts about where mounts are, as those have whose places are in other units than their bodies'."""

from collections.abc import Iterator

import numpy as np

from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.vehicle import Vehicle

FAR = 10.0
"""How many times as far as its body is large a mount may be from the centre of gravity."""

NEAR = 0.01
"""So near, in parts of its size, not all mounts of a body are."""

UNITS = "are its places in other units or from another origin?"


def place_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on rigid bodies whose mounts, springs and dampers are far off or all in one place."""
    for body in vehicle.bodies:
        if not isinstance(body, RigidBody):
            continue
        size = float(np.sqrt(6 * np.trace(body.inertia) / body.mass))
        places = {
            connection.name: float(np.linalg.norm(connection.center - body.center_of_gravity))
            for connection in vehicle.all_connections
            if body.name in connection.bodies
        }
        if not places:
            continue
        far = max(places, key=lambda name: places[name])
        where = f"of {body.name!r}, which is {size:.3g} m across by its inertia: {UNITS}"
        if places[far] > FAR * size:
            yield f"connection {far!r} is {places[far]:.3g} m from the centre of gravity {where}"
        elif len(places) > 2 and places[far] < NEAR * size:
            near = f"all {len(places)} connections are within {1000 * places[far]:.3g} mm"
            yield f"{near} of the centre of gravity {where}"
