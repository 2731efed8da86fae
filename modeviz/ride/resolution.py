"""The distance of lines at which a response between them can be told from those at them."""

import math
from collections.abc import Sequence

import numpy as np

from modeviz.ride.excitation import known_part
from modeviz.ride.roads import lag
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import RandomLoad, Road
from modeviz.vehicle.vehicle import Vehicle

LINES_A_TURN = 8
"""The last axle meets the road τ later than the first, so that what both do turns by 2πfτ."""


def resolving_lines(
    vehicle: Vehicle, loads: Sequence[tuple[RandomLoad, float]], lines: Floats
) -> Floats:
    """The lines that a load's table holds, and more between where a road is met slowly.

    Args:
        vehicle: whose tyres meet roads.
        loads: each with the speed on a road, m/s.
        lines: (n_lines,), Hz, evenly spaced.

    Returns:
        (m (n_held - 1) + 1,), evenly spaced, with the least m that resolves what lies between axles.

    Raises:
        ModevizError: a table holds none of the lines.
    """
    parts = [known_part(load, lines, speed) for load, speed in loads]
    held = lines[min(p.start for p in parts) : max(p.stop for p in parts)]
    speeds = [speed for load, speed in loads if isinstance(load, Road)]
    lags = [lag(tyre, vehicle.tyres, speed) for speed in speeds for tyre in vehicle.tyres]
    longest = max(lags, default=0.0)
    m = max(1, math.ceil(LINES_A_TURN * longest * (held[1] - held[0])))
    closer = np.linspace(held[0], held[-1], m * (len(held) - 1) + 1)
    closer[::m] = held
    return closer
