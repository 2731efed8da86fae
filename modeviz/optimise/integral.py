"""Goals over the whole band: integrals of PSDs at lines that follow the modes."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.analysis.driven import load_lines
from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions
from modeviz.analysis.sensitivity import spring_shares
from modeviz.dynamics.assembly import System
from modeviz.dynamics.resonances import resonances_at
from modeviz.optimise.objective import LoadCase, Objective, objective_on
from modeviz.ride.excitation import known_part
from modeviz.ride.integration import integration_weights
from modeviz.ride.rating import squared_weights
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import RandomLoad
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class BandCase:
    """A road on which mean squares are to be small."""

    load: Conditions
    selected: Floats
    """(n_points, 3): factors of the mean squares, g², along x, y, z."""
    is_weighted: bool = False
    """Whether accelerations are weighted as ISO 2631-1 does."""
    weight: float = 1.0
    highest_hz: float = np.inf
    """Up to where the squares are summed up, if the band does not end before."""

    def on(self, vehicle: Vehicle, lines: Floats) -> LoadCase:
        """Return the case as a sum over lines, as far as the road is known."""
        load = vehicle.random_load(self.load.road)
        f = lines[known_part(load, lines, self.load.speed)]
        band = 0.0, min(self.highest_hz, vehicle.highest_frequency)
        weights = integration_weights(f, band)[:, None, None]
        pattern = weights * self.selected
        if self.is_weighted:
            pattern = pattern * squared_weights(f)[:, None]
        return LoadCase(self.load, tuple(f.tolist()), self.weight, pattern, is_averaged=True)


@dataclass(frozen=True, eq=False)
class Integral:
    """F = Σ w ∫ (factors) S df over roads, response points and directions.

    Every set of rates has lines of its own, so close where its modes are sharp that others would not
    change the sum. Small changes of rates leave them where they are, so that the derivatives are those
    of the sum.
    """

    prepared: Prepared
    """At the lines of the band, and between."""
    cases: tuple[BandCase, ...]

    @property
    def loads(self) -> list[tuple[RandomLoad, float]]:
        """What shakes in each case, and the speed on a road, m/s."""
        vehicle = self.prepared.vehicle
        return [(vehicle.random_load(case.load.road), case.load.speed) for case in self.cases]

    @cached_property
    def grid(self) -> Floats:
        """Lines that hold what the loads' spectra say, (n_lines,), Hz, beside which others lie."""
        return load_lines(self.prepared, self.loads)

    def on(self, lines: Floats) -> Objective:
        """Return the integral as a sum over given lines."""
        cases = [case.on(self.prepared.vehicle, lines) for case in self.cases]
        return objective_on(self.prepared.on(lines), cases)

    def near(self, stiffness: Complexes) -> Objective:
        """Return it as a sum over the lines that mount rates want, (n_springs,), complex, N/m."""
        resonances = resonances_at(self.prepared.basis, stiffness)
        return self.on(self.prepared.lines(resonances, self.grid))

    def value(self, rates: Rates) -> float:
        """F at rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return float(self.values(rates).sum())

    def values(self, rates: Rates) -> Floats:
        """Return what each case adds to F, (n_cases,); raises as `solve`."""
        return self.near(self.prepared.mount_stiffness(rates)).values(rates)

    def totals(self, stiffness: Complexes) -> Floats:
        """F of many sets of rates, (n_sets,), from (n_sets, n_springs), complex, N/m; as `solve`."""
        return np.array([self._total(each) for each in stiffness])

    def exact_value(self, rates: Rates) -> float:
        """F from the equations of motion of the full model; raises as `exact_response`."""
        return self.near(self.prepared.mount_stiffness(rates)).exact_value(rates)

    def exact_total(self, system: System, stiffness: Complexes) -> float:
        """F of a system with these mount rates; raises as `direct_response`."""
        return self.near(stiffness).exact_total(system, stiffness)

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """F and ∂F/∂k, (n_variables,) in the order of `rate_variables`; raises as `solve`."""
        stiffness = self.prepared.mount_stiffness(rates)
        return self.of_springs(stiffness, spring_shares(self.prepared, rates))

    def of_springs(self, stiffness: Complexes, shares: Complexes) -> tuple[float, Floats]:
        """F and its derivatives, see `Objective.of_springs`."""
        return self.near(stiffness).of_springs(stiffness, shares)

    def join(self, values: Floats) -> float:
        """F from what each case adds to it."""
        return float(values.sum())

    def scaled(self, factors: Floats) -> "Integral":
        """Return the integral with other weights: each case's times a factor, (n_cases,)."""
        pairs = zip(self.cases, factors.tolist(), strict=True)
        return replace(
            self, cases=tuple(replace(case, weight=factor * case.weight) for case, factor in pairs)
        )

    def of_vehicle(self, vehicle: Vehicle) -> "Integral":
        """Return the integral of the vehicle with mounts elsewhere or more of them; as `prepare`."""
        return replace(self, prepared=prepare(vehicle))

    def _total(self, stiffness: Complexes) -> float:
        return float(self.near(stiffness).totals(stiffness[None])[0])


def prepare_integral(vehicle: Vehicle, cases: Sequence[BandCase]) -> Integral:
    """The integral over some roads.

    Raises:
        VehicleError: a road that the vehicle does not have.
        SolveError: as `prepare`.
        ModevizError: a road of which nothing is known in the band at its speed.
    """
    for case in cases:
        load = vehicle.random_load(case.load.road)
        known_part(load, vehicle.frequency_hz, case.load.speed)
    return Integral(prepare(vehicle), tuple(cases))
