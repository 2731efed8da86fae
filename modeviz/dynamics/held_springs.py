"""Springs beside a rigid joint of the same two bodies, along which it lets nothing move."""

import numpy as np
from numpy.typing import NDArray

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND, MOTIONS
from modeviz.vehicle.vehicle import Vehicle

HELD = 1e-9
"""Of a row: what is left of it beside the rows of joints is rounding."""


def held_rows(vehicle: Vehicle, rows: Floats) -> NDArray[np.bool_]:
    """Return which relative motions of connections a rigid joint beside them holds, (n_rows,).

    Not those of the joint itself, nor any to the ground, whose end may be moved. Computed, such a row
    would be rounding, which has no accurate receptance.

    Args:
        vehicle: whose connections.
        rows: (n_rows, n_dofs), six of each connection, see `System.relative_motion`.
    """
    connections = vehicle.all_connections
    pairs = [frozenset(c.bodies) for c in connections for _ in MOTIONS]
    rigid = np.array([motion in c.rigid for c in connections for motion in MOTIONS], bool)
    found = np.zeros(len(rows), bool)
    for pair in {pairs[i] for i in np.flatnonzero(rigid)}:
        if GROUND in pair:
            continue
        own = np.array([p == pair for p in pairs])
        held = np.linalg.qr(rows[own & rigid].T)[0]
        others = rows[own & ~rigid]
        left = others - (others @ held) @ held.T
        found[own & ~rigid] = np.linalg.norm(left, axis=1) < HELD * np.linalg.norm(others, axis=1)
    return found
