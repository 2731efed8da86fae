"""Accelerations that are to become small, as they are chosen on the page."""

from dataclasses import dataclass

from modeviz.errors import VehicleError
from modeviz.vehicle.mount_rates import DIRECTIONS, RIDE_DIRECTIONS
from modeviz.vehicle.problem import Performance
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.planning.frequencies import parse_frequencies, spoken_frequencies


@dataclass(frozen=True)
class LoadPlan:
    """Performance variables before anybody has looked whether they can be."""

    roads: frozenset[str]
    wheel_loads: frozenset[str]
    frequencies: str
    """Hz, as `parse_frequencies` reads them."""
    points: frozenset[str]
    directions: frozenset[str]
    target: float
    weight: float

    def performance(self, vehicle: Vehicle) -> Performance:
        """Return the performance that a search is asked for; all points are none that are named.

        Raises:
            VehicleError: frequencies that cannot be read, no load, no point, or no direction.
        """
        if not self.points:
            raise VehicleError("performance: no response point is chosen: choose one or more")
        points = tuple(p.name for p in vehicle.response_points)
        return Performance(
            parse_frequencies(self.frequencies),
            _in_order(self.roads, vehicle),
            tuple(load.name for load in vehicle.harmonic_loads if load.name in self.wheel_loads),
            () if self.points >= set(points) else tuple(p for p in points if p in self.points),
            tuple(d for d in reversed(DIRECTIONS) if d in self.directions),
            self.target,
            self.weight,
        )


def _in_order(roads: frozenset[str], vehicle: Vehicle) -> tuple[str, ...]:
    """Return names of random loads as the vehicle offers them, others of ISO 8608 after these."""
    offered = [load.name for load in vehicle.offered_loads]
    return (*(name for name in offered if name in roads), *sorted(roads - set(offered)))


def spare_load(vehicle: Vehicle) -> LoadPlan:
    """Return the load to add where there is none: the first road as in the paper, felt everywhere."""
    usual = vehicle.usual_load
    return LoadPlan(
        frozenset([usual.name] if usual else []),
        frozenset(),
        "6 to 14 by 1/3",
        frozenset(point.name for point in vehicle.response_points),
        frozenset(RIDE_DIRECTIONS),
        target=0.0,
        weight=1.0,
    )


def load_plan(vehicle: Vehicle, performance: Performance) -> LoadPlan:
    """Performance variables as they are, for the page to change."""
    every = (point.name for point in vehicle.response_points)
    return LoadPlan(
        frozenset(performance.roads),
        frozenset(performance.wheel_loads),
        spoken_frequencies(performance.frequency_hz),
        frozenset(performance.points or every),
        frozenset(performance.directions),
        performance.target,
        performance.weight,
    )
