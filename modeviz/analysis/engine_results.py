"""The response of a vehicle to a running engine: order by order, at each of its speeds.

Orders shake at frequencies of their own, so that their powers add up: the RMS over time at a speed is
√(Σ a²/2) over the peaks of all orders whose frequencies are in the vehicle's band.
"""

from dataclasses import dataclass

import numpy as np

from modeviz.analysis.driven import driven
from modeviz.analysis.preparation import Prepared
from modeviz.ride.psd import harmonic_acceleration
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.engine import Engine


@dataclass(frozen=True, eq=False)
class EngineResults:
    """Accelerations of the response points while an engine runs at one speed after the other."""

    engine: Engine
    speed_hz: Floats
    """(n_speeds,), revolutions of the crank per second."""
    acceleration_g: Floats
    """(n_speeds, n_orders, n_points, 3): peak x, y, z of each order, g; nan beyond the band."""

    @property
    def rms(self) -> Floats:
        """(n_speeds, n_points, 3): over time, of all orders in the band, g."""
        return np.sqrt(np.nansum(self.acceleration_g**2, axis=1) / 2)

    @property
    def idle(self) -> int:
        """Which of the speeds is idle."""
        return int(np.argmin(np.abs(self.speed_hz - self.engine.idle_hz)))


def solve_engine(
    prepared: Prepared, rates: Rates, engine: Engine, speed_hz: Floats | None = None
) -> EngineResults:
    """Return what an engine does to a vehicle with other mount rates.

    Args:
        prepared: see `prepare`; exact at any frequency of its band.
        rates: of the groups that differ from the vehicle's own.
        engine: one of the vehicle's.
        speed_hz: (n_speeds,), rising, revolutions of the crank per second; None: those that its orders
            are given at, and idle.

    Raises:
        VehicleError: a group that the vehicle does not have.
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    speeds = np.union1d(engine.speed_hz, engine.idle_hz) if speed_hz is None else speed_hz
    n_points = len(prepared.vehicle.response_points)
    found = np.full((len(speeds), len(engine.orders), n_points, 3), np.nan)
    stiffness = prepared.mount_stiffness(rates)
    low, high = prepared.frequency_hz[[0, -1]]
    for number, order in enumerate(engine.orders):
        f = order.order * speeds
        inside = (f >= low) & (f <= high)
        if inside.any():
            under = driven(prepared, [order], prepared.vehicle.speed)
            H = under.response(stiffness, f[inside])
            g = harmonic_acceleration(f[inside], H)[:, :, 0]
            found[inside, number] = g.reshape(-1, n_points, 3)
    return EngineResults(engine, speeds, found)
