"""Static deflections of mounts as constraints c >= 0 of a search, with their derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mount_rates import static_ratios
from modeviz.errors import VehicleError
from modeviz.mounting.springs import AXIS
from modeviz.mounting.static_system import PreparedStatics, prepare_statics
from modeviz.mounting.statics import Statics, solve_statics
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import DeflectionLimit
from modeviz.vehicle.vehicle import Vehicle

MARGIN = 1e-6
"""How far within its limit a search aims, a part of it."""


@dataclass(frozen=True, eq=False)
class Deflections:
    """The deflections that a problem limits, of a vehicle."""

    prepared: PreparedStatics
    limits: tuple[DeflectionLimit, ...]

    @property
    def spoken(self) -> list[str]:
        """What a person calls each of `margins`: "M1 vertical: at most 2 mm in standing"."""
        return [
            f"{limit.mount} {limit.direction}: at most {1e3 * limit.most:g} mm in {limit.load_case}"
            for limit in self.limits
        ]

    def margins(self, rates: Rates) -> tuple[Floats, Floats]:
        """Return what is left to every limit, and its derivatives.

        Returns:
            (n_limits,), a part of the limit, below zero beyond it; and (n_limits, n_rates), per N/m, in
            the order of `rate_variables`.
        """
        settling, has_rate = self.prepared.settling(rates), self.prepared.springs.has_stiffness
        by_rate = has_rate / static_ratios(self.prepared.vehicle)[:, None]
        values, gradients = [], []
        for limit, (spring, stretched) in zip(self.limits, self.stretched(rates), strict=True):
            d = float(stretched[spring])
            slopes = settling.by_stiffness(stretched)[spring] @ by_rate
            values.append(1 - abs(d) / limit.most - MARGIN)
            gradients.append(-np.sign(d) * slopes / limit.most)
        return np.array(values), np.array(gradients)

    def of_vehicle(self, vehicle: Vehicle) -> "Deflections":
        """Return the same limits of the vehicle with mounts elsewhere or more of them."""
        return Deflections(prepare_statics(assemble(vehicle)), self.limits)

    def gravity(self, load_case: str) -> Floats:
        """Return what pulls on masses in a load case, (3,), m/s²."""
        held = next(held for held in self.prepared.cases if held.case.name == load_case)
        return STANDARD_GRAVITY * np.asarray(held.case.load_g, np.float64)

    def check_held(self) -> None:
        """Raises VehicleError where a weight that is put elsewhere would move what nothing holds."""
        for limit in self.limits:
            held = next(held for held in self.prepared.cases if held.case.name == limit.load_case)
            if held.notes:
                raise VehicleError(
                    f"deflection of {limit.mount!r}: {held.notes[0]}; expected a load case in which "
                    "all is held where an absorber is moved"
                )

    def exact(self, rates: Rates) -> Floats:
        """Return the deflections of a vehicle that is made with these rates, (n_limits,), m."""
        vehicle = self.prepared.vehicle.with_rates(rates)
        return deflections_of(solve_statics(prepare_statics(assemble(vehicle)), {}), self.limits)

    def stretched(self, rates: Rates) -> list[tuple[int, Floats]]:
        """The spring of each limit, and the stretch of all mount springs in its load case."""
        statics, R = solve_statics(self.prepared, rates), self.prepared.system.mount_motions
        pairs = zip(self._springs, self.limits, strict=True)
        return [(spring, R @ statics.case(limit.load_case).motion) for spring, limit in pairs]

    @property
    def _springs(self) -> list[int]:
        """The number of the mount spring of each limit."""
        mounts = [mount.name for mount in self.prepared.vehicle.mounts]
        return [3 * mounts.index(limit.mount) + AXIS[limit.direction] for limit in self.limits]


def prepare_deflections(vehicle: Vehicle, limits: Sequence[DeflectionLimit]) -> Deflections:
    """Return limits made ready for a vehicle at any mount rates.

    Raises:
        VehicleError: a load case that the vehicle does not have.
        SolveError: a load case has no answer.
    """
    deflections = Deflections(prepare_statics(assemble(vehicle)), tuple(limits))
    deflections_of(solve_statics(deflections.prepared, {}), limits)
    return deflections


def deflections_of(statics: Statics, limits: Sequence[DeflectionLimit]) -> Floats:
    """Return the deflections that are limited, (n_limits,), m; raises as `Statics.case`."""
    found = [
        statics.case(limit.load_case).connections[limit.mount].deflection[AXIS[limit.direction]]
        for limit in limits
    ]
    return np.array(found, float)
