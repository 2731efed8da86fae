"""Two sets of rates of one vehicle, solved side by side."""

from dataclasses import dataclass

from modeviz.dynamics.tracking import Track
from modeviz.tuning.following import accept, follow_rates
from modeviz.tuning.preparation import Prepared
from modeviz.tuning.results import (
    Conditions,
    ModalResults,
    Results,
    WheelResults,
    drive,
    solve_modal,
    solve_on,
    solve_wheels,
)
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class RateSet:
    """Rates with a name."""

    name: str
    rates: Rates
    """Of the groups that differ from the vehicle's own."""


@dataclass(frozen=True, eq=False)
class Comparison:
    """What two sets of rates make of a vehicle."""

    names: tuple[str, str]
    """Of the set that is compared with, and of the other."""
    base: ModalResults
    """`Results` if the vehicle has a road and someone to feel it."""
    now: ModalResults
    track: Track
    """Where the modes of `base` went."""
    wheels: tuple[WheelResults, WheelResults] | None
    """The response to wheel loads, if there are any."""

    @property
    def vehicle(self) -> Vehicle:
        """With the rates it has in its file."""
        return self.base.prepared.vehicle

    @property
    def rides(self) -> tuple[Results, Results] | None:
        """Both on the road, if there is one."""
        if isinstance(self.base, Results) and isinstance(self.now, Results):
            return self.base, self.now
        return None


def compare(
    prepared: Prepared, base: RateSet, now: RateSet, conditions: Conditions | None
) -> Comparison:
    """Solves a vehicle with two sets of rates, all that it has loads for.

    Args:
        prepared: see `prepare`.
        base: what is compared with.
        now: the other.
        conditions: road and speed; None for a vehicle that has no roads or no response points.

    Raises:
        VehicleError: a group or a road that the vehicle does not have.
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    if conditions is None:
        first, second = (solve_modal(prepared, s.rates) for s in (base, now))
    else:
        road = drive(prepared, conditions)
        first, second = (solve_on(road, s.rates) for s in (base, now))
    vehicle = prepared.vehicle
    wheels = None
    if vehicle.wheel_loads and vehicle.response_points:
        wheels = solve_wheels(prepared, base.rates), solve_wheels(prepared, now.rates)
    track = follow_rates(accept(first), first, second)
    return Comparison((base.name, now.name), first, second, track, wheels)
