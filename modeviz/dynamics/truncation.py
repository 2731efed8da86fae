"""The paper's own truncation, kept to show what it costs."""

from dataclasses import replace

import numpy as np

from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import Bolt, Connection
from modeviz.vehicle.vehicle import Vehicle


def modes_only(vehicle: Vehicle) -> Vehicle:
    """The vehicle as the paper models it: normal modes alone, residual compliance at the bolts.

    No body keeps its residual vectors. What truncation takes from the first body of each bolt is put
    in series with the bolt, 1/k' = 1/k + R in each direction by itself, the paper's one-dimensional
    spring; the second body of `Bolt.bodies` is taken as stiff, as the paper does with the cab (Duncan,
    "Modal synthesis theory and modeling").
    """
    return replace(
        vehicle,
        bodies=tuple(
            body.truncated(body.n_modes - body.n_residuals) if isinstance(body, FlexibleBody) else body
            for body in vehicle.bodies
        ),
        connections=tuple(_with_residual_compliance(c, vehicle) for c in vehicle.connections),
    )


def _with_residual_compliance(connection: Connection, vehicle: Vehicle) -> Connection:
    body = vehicle.body(connection.bodies[0])
    if not (isinstance(connection, Bolt) and isinstance(body, FlexibleBody)):
        return connection
    at = body.nearest_attachment(connection.points[0])
    compliance = body.residual_compliance(at.name, connection.center)
    along_axes = connection.axes @ compliance @ connection.axes.T
    k = connection.stiffness
    return replace(connection, stiffness=k / (1 + k * np.diag(along_axes)))
