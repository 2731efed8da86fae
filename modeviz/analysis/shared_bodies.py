"""What two vehicles have in common that differ by some bodies, such as one with an absorber."""

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.vehicle.arrays import Array, Floats
from modeviz.vehicle.bodies import RigidBody


def carried_over(values: Array, own: System, other: System) -> Array:
    """Return shapes in the coordinates of another vehicle, (n_dofs of the other, ...).

    Bodies go by their names: what only the other has rests, and what it lacks is left out.

    Args:
        values: (n_dofs, ...), in the coordinates of `own`.
        own: of one vehicle.
        other: of the other.
    """
    if dict(own.dofs) == dict(other.dofs):
        return values
    carried = np.zeros((other.n_dofs, *values.shape[1:]), values.dtype)
    for body, there in other.dofs.items():
        here = own.dofs.get(body)
        if here is not None and _length(here) == _length(there):
            carried[there] = values[here]
    return carried


def carried_momentum(momentum: Floats, own: System, other: System) -> Floats:
    """Return M φ of shapes as `carried_over`, so that its products with the other's shapes are shares.

    Of a rigid body whose mass is another one, M is the geometric mean of both: as shapes are normalised
    by mass, the same motion is a share of one then.
    """
    carried = carried_over(momentum, own, other)
    masses = {body.name: body.mass for body in own.vehicle.bodies if isinstance(body, RigidBody)}
    for body in other.vehicle.bodies:
        before = masses.get(body.name)
        if isinstance(body, RigidBody) and before is not None and before != body.mass:
            if carried is momentum:
                carried = momentum.copy()
            carried[other.dofs[body.name]] *= np.sqrt(body.mass / before)
    return carried


def _length(coordinates: slice) -> int:
    return coordinates.stop - coordinates.start
