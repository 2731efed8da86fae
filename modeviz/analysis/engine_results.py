"""The response of a vehicle to a running engine: order by order, at each of its speeds.

Orders shake at frequencies of their own, so that their powers add up: the RMS over time at a speed is
√(Σ a²/2) over the peaks of all orders whose frequencies are in the vehicle's band.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.driven import Driven, driven
from modeviz.analysis.mount_forces import along_vehicle, forces_of_mounts
from modeviz.analysis.preparation import Prepared
from modeviz.mounting.forces import N_MOTIONS
from modeviz.ride.psd import harmonic_acceleration
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.engine import Engine
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

MOST_SPEEDS = 400
"""Of a run-up."""


@dataclass(frozen=True, eq=False)
class RunningEngine:
    """An engine in a prepared vehicle at some speeds: all that does not depend on mount rates."""

    prepared: Prepared
    engine: Engine
    speed_hz: Floats
    """(n_speeds,), rising, revolutions of the crank per second."""
    in_band: NDArray[np.bool_]
    """(n_speeds, n_orders): whether an order's frequency is in the vehicle's band."""
    orders: tuple[Driven, ...]
    """The vehicle under each of them, at the frequencies that are in the band."""

    def solve(self, rates: Rates) -> "EngineResults":
        """What it does with other mount rates; arguments and errors as `solve_engine`."""
        return EngineResults(self, self.prepared.mount_stiffness(rates))


@dataclass(frozen=True, eq=False)
class EngineResults:
    """Accelerations and forces of mounts while an engine runs at one speed after the other.

    Each is solved when it is asked for, which raises SolveError where with these rates an undamped
    resonance lies on a frequency.
    """

    running: RunningEngine
    stiffness: Complexes
    """(n_springs,), complex rates at the reference, N/m."""

    @property
    def engine(self) -> Engine:
        return self.running.engine

    @property
    def vehicle(self) -> Vehicle:
        return self.running.prepared.vehicle

    @property
    def speed_hz(self) -> Floats:
        """(n_speeds,), revolutions of the crank per second."""
        return self.running.speed_hz

    @property
    def in_band(self) -> NDArray[np.bool_]:
        """(n_speeds, n_orders): whether an order's frequency is in the vehicle's band."""
        return self.running.in_band

    @cached_property
    def acceleration_g(self) -> Floats:
        """(n_speeds, n_orders, n_points, 3): peak x, y, z of each order, g; nan beyond the band."""
        n_points = len(self.vehicle.response_points)
        found = np.full((*self.in_band.shape, n_points, 3), np.nan)
        for number, under in enumerate(self.running.orders):
            inside, f = self._inside(number)
            if f.size:
                g = harmonic_acceleration(f, under.response(self.stiffness, f))
                found[inside, number] = g.reshape(len(f), n_points, 3)
        return found

    @cached_property
    def force(self) -> Complexes:
        """(n_speeds, n_orders, n_mounts, 6): of each order on the body that carries the mount.

        Along and about its own axes, N and N m; nan beyond the band.
        """
        found = np.full((*self.in_band.shape, len(self.vehicle.mounts), N_MOTIONS), np.nan, complex)
        for number, under in enumerate(self.running.orders):
            inside, f = self._inside(number)
            if f.size:
                found[inside, number] = forces_of_mounts(under, self.stiffness, f)[..., 0]
        return found

    @cached_property
    def force_in_vehicle_axes(self) -> Complexes:
        """The same along and about the vehicle's axes."""
        return along_vehicle(self.vehicle, self.force)

    @cached_property
    def rms(self) -> Floats:
        """(n_speeds, n_points, 3): over time, of all orders in the band, g."""
        return orders_rms(self.acceleration_g)

    @cached_property
    def force_rms(self) -> Floats:
        """(n_speeds, n_mounts, 6): over time, of all orders in the band, along and about local axes."""
        return orders_rms(np.abs(self.force))

    @property
    def idle(self) -> int:
        """Which of the speeds is idle, or closest to it."""
        return int(np.argmin(np.abs(self.speed_hz - self.engine.idle_hz)))

    def _inside(self, number: int) -> tuple[NDArray[np.bool_], Floats]:
        """Speeds at which an order is in the band, (n_speeds,), and its frequencies there."""
        inside = self.in_band[:, number]
        return inside, self.engine.orders[number].order * self.speed_hz[inside]


def orders_rms(peaks: Floats) -> Floats:
    """The RMS over time of all orders, (n_speeds, ...), of peaks of each, (n_speeds, n_orders, ...)."""
    return np.sqrt(np.nansum(peaks**2, axis=1) / 2)


def running_engine(prepared: Prepared, engine: Engine, speed_hz: Floats | None = None) -> RunningEngine:
    """An engine of a prepared vehicle at some speeds, for any mount rates.

    Args:
        prepared: see `prepare`; exact at any frequency of its band.
        engine: one of the vehicle's.
        speed_hz: (n_speeds,), rising, revolutions of the crank per second; None: `run_up`.
    """
    speeds = run_up(prepared, engine) if speed_hz is None else speed_hz
    low, high = prepared.frequency_hz[[0, -1]]
    f = np.outer(speeds, [order.order for order in engine.orders])
    in_band = (f >= low) & (f <= high)
    orders = [
        driven(prepared, [order], prepared.vehicle.speed, f[inside, number])
        for number, (order, inside) in enumerate(zip(engine.orders, in_band.T, strict=True))
    ]
    return RunningEngine(prepared, engine, speeds, in_band, tuple(orders))


def solve_engine(
    prepared: Prepared, rates: Rates, engine: Engine, speed_hz: Floats | None = None
) -> EngineResults:
    """Return what an engine does to a vehicle with other mount rates.

    Args:
        prepared: see `prepare`; exact at any frequency of its band.
        rates: of the groups that differ from the vehicle's own.
        engine: one of the vehicle's.
        speed_hz: (n_speeds,), rising, revolutions of the crank per second; None: `run_up`.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    return running_engine(prepared, engine, speed_hz).solve(rates)


def run_up(prepared: Prepared, engine: Engine) -> Floats:
    """The speeds at which an engine is looked at, (n_speeds,), rising, revolutions per second.

    Those that its orders are given at and idle, and between them so many that its quickest order goes
    over the band by steps of the vehicle's, but for `MOST_SPEEDS`: as far as there is an order in the
    band.
    """
    low, last = run_up_ends(prepared.vehicle, engine)
    quickest = max(order.order for order in engine.orders)
    step = max(prepared.vehicle.frequency_step / quickest, (last - low) / MOST_SPEEDS)
    between = np.linspace(low, last, max(2, int(np.ceil((last - low) / step)) + 1))
    every = np.unique(np.concatenate([engine.speed_hz, between, [engine.idle_hz]]))
    return every[(every <= last) | (every == engine.idle_hz)]


def run_up_ends(vehicle: Vehicle, engine: Engine) -> tuple[float, float]:
    """The slowest speed of an engine, and the fastest at which it has an order in the band, Hz.

    Revolutions per second; both are the slowest where none is.
    """
    low, high = engine.speed_hz[[0, -1]].tolist()
    slowest = min(order.order for order in engine.orders)
    return low, min(high, max(vehicle.highest_frequency / slowest, low))
