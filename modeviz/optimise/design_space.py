"""What a search may choose: rates, as x = ln(k/k₀) so that bounds and ratio limits are linear; places.

Every design that leaves here meets its constraints: they are met group by group, the vertical rate
first and the others within what it leaves them. Places follow all rates, in widths of their bounds.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.sensitivity import RateVariable, rate_variables
from modeviz.errors import VehicleError
from modeviz.optimise.limits import DesignVariable, Limit, group_limits, group_variables, reach
from modeviz.optimise.place_variables import Places, places_of, seen_from
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import MountRates, Rates, spoken_rate
from modeviz.vehicle.placement import Placements, with_placements
from modeviz.vehicle.problem import DesignGroup
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class DesignSpace:
    """Bounded logarithms of rates, with limits to their ratios, and bounded places."""

    vehicle: Vehicle
    base: Rates
    """Of every group: where x is zero."""
    variables: tuple[DesignVariable, ...]
    """Rates; those of places come after them."""
    limits: tuple[Limit, ...]
    members: Floats
    """(n_rates, n_variables): ∂ ln k/∂x, 0 or 1, for each of `rate_variables`."""
    lower: Floats
    """(n_variables,): the least x with which all limits can be met."""
    upper: Floats
    places: Places = field(default_factory=Places)

    @property
    def n_variables(self) -> int:
        return len(self.lower)

    @property
    def n_rates(self) -> int:
        """How many of the numbers are of rates; the others are of places."""
        return len(self.variables)

    def rates(self, x: Floats) -> dict[str, MountRates]:
        """The rates of every group of a design."""
        factors: dict[str, dict[str, float]] = {group: {} for group in self.base}
        changed = np.exp(self.members @ x).tolist()
        for rate, by in zip(rate_variables(self.vehicle), changed, strict=True):
            factors[rate.group][rate.direction] = by
        return {group: rates.scaled(factors[group]) for group, rates in self.base.items()}

    def placements(self, x: Floats) -> Placements:
        """Where the mounts of a design are, of those that are not where they were given."""
        return self.places.placements(x[self.n_rates :])

    def built(self, x: Floats) -> Vehicle:
        """The vehicle of a design, to go on from; raises VehicleError where it cannot hold a mount."""
        placements = self.placements(x)
        placed = with_placements(self.vehicle.with_rates(self.rates(x)), placements)
        problems = tuple(seen_from(problem, placements) for problem in placed.problems)
        return replace(placed, problems=problems) if placements else placed

    def to_x(self, rates: Rates, placements: Placements | None = None) -> Floats:
        """The design nearest to some rates, group by group: what is outside of a limit is put on it.

        Args:
            rates: of the groups that differ from the vehicle's own.
            placements: None: those that the space begins with.
        """
        every = self.vehicle.all_rates(rates)
        found = np.zeros(self.n_variables)
        for i, v in enumerate(self.variables):
            found[i] = np.mean([_log_ratio(every, self.base, v.group, field) for field in v.fields])
        found[self.n_rates :] = self.places.to_x(self.places.base if placements is None else placements)
        return self.admitted(found)

    def admitted(self, x: Floats) -> Floats:
        """The design with every number put within what the ones before it leave."""
        x = np.clip(x, self.lower, self.upper)
        for i, (low, high) in self._ranges(x).items():
            x[i] = np.clip(x[i], low, high)
        return x

    def sampled(self, fractions: Floats) -> Floats:
        """The design at a fraction, 0 to 1, of what is left for each number; (n_variables,)."""
        x = self.lower + fractions * (self.upper - self.lower)
        for i, (low, high) in self._ranges(x).items():
            x[i] = low + fractions[i] * (high - low)
        return x

    def samples(self, count: int, seed: int) -> Floats:
        """Designs spread evenly, (count, n_variables): a Latin hypercube of fractions."""
        from scipy.stats import qmc  # a second, which only those who draw samples wait for

        fractions = qmc.LatinHypercube(self.n_variables, rng=seed).random(count)
        return np.array([self.sampled(row) for row in fractions]).reshape(count, self.n_variables)

    @property
    def rows(self) -> Floats:
        """(n_limits, n_variables): `rows` @ x <= `values`."""
        rows = np.zeros((len(self.limits), self.n_variables))
        for row, limit in zip(rows, self.limits, strict=True):
            for number, sign in limit.terms:
                row[number] = sign
        return rows

    @property
    def values(self) -> Floats:
        """(n_limits,)."""
        return np.array([limit.value for limit in self.limits])

    @property
    def ratios(self) -> NDArray[np.bool_]:
        """(n_limits,): which of them are between two numbers; the others bound one."""
        return np.array([len(limit.terms) == 2 for limit in self.limits], bool)

    def is_of_place(self, limit: Limit) -> bool:
        """Whether a limit bounds a place, in widths of its bounds, and not a rate or a ratio."""
        return limit.rate is not None and limit.rate >= self.n_rates

    def spoken(self, x: Floats) -> str:
        """A design in a sentence: "C2 fore-aft 141 N/mm, E rates × 1.2, E offset z +12 mm"."""
        rates = self.rates(x)
        texts = [
            f"{v.spoken} × {np.exp(step):.3g}"
            if len(v.fields) > 1
            else f"{v.spoken} {spoken_rate(rates[v.group], v.lead)}"
            for v, step in zip(self.variables, x[: self.n_rates], strict=True)
        ]
        return ", ".join([*texts, *self.places.spoken(x[self.n_rates :])])

    def _ranges(self, x: Floats) -> Mapping[int, tuple[float, float]]:
        """Return what a vertical rate leaves for the numbers whose ratio to it is limited."""
        found: dict[int, tuple[float, float]] = {}
        for limit in self.limits:
            if limit.rate is None or limit.of is None:
                continue
            low, high = found.get(limit.rate, (self.lower[limit.rate], self.upper[limit.rate]))
            end = x[limit.of] + limit.sign * limit.value
            found[limit.rate] = (low, min(high, end)) if limit.sign > 0 else (max(low, end), high)
        return found


def design_space(
    vehicle: Vehicle,
    groups: Sequence[DesignGroup],
    base: Rates | None = None,
    locked: frozenset[tuple[str, str]] = frozenset(),
    placements: Placements | None = None,
) -> DesignSpace:
    """The space of the designs that a problem allows.

    Args:
        vehicle: whose rates they are.
        groups: of mounts whose rates or places may change.
        base: the rates that others keep and that fixed ratios are of; None: the vehicle's own.
        locked: rates, (group, field of `MountRates`), that may not change.
        placements: where mounts are that no group may place otherwise, and where others begin; None:
            where they were given.

    Raises:
        VehicleError: an unknown group, nothing that may change, a rate of zero among what may, limits
            that contradict each other, or progressive mounts where any may be placed otherwise; the
            text names the rate.
    """
    every = vehicle.all_rates(base or {})
    variables: list[DesignVariable] = []
    limits: list[Limit] = []
    for group in groups:
        mounts = vehicle.mount_group(group.group)
        own = group_variables(group, mounts, locked)
        limits += group_limits(group, mounts, every[group.group], own, len(variables))
        variables += own
    places = places_of(vehicle, groups, placements)
    limits += places.limits(len(variables))
    n_places = len(places.variables)
    if not variables and not n_places:
        raise VehicleError("nothing may change: every rate of the problem is locked; unlock one")
    lower, upper = reach(len(variables) + n_places, limits)
    members = np.pad(_members(vehicle, variables), ((0, 0), (0, n_places)))
    return DesignSpace(vehicle, every, tuple(variables), tuple(limits), members, lower, upper, places)


def _members(vehicle: Vehicle, variables: Sequence[DesignVariable]) -> Floats:
    own = [{RateVariable(v.group, field) for field in v.fields} for v in variables]
    rates = rate_variables(vehicle)
    return np.array([[rate in its for its in own] for rate in rates], float).reshape(len(rates), -1)


def _log_ratio(rates: Rates, base: Rates, group: str, field: str) -> float:
    """ln(k/k₀) of a rate; of one that is zero a number below any limit."""
    k = max(_rate(rates, group, field), np.finfo(np.float64).tiny)
    return float(np.log(k / _rate(base, group, field)))


def _rate(rates: Rates, group: str, field: str) -> float:
    return getattr(rates[group], field)
