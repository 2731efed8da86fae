"""The rates that a search may choose, as x = ln(k/k₀): so bounds and ratio limits are linear.

Every design that leaves here meets its constraints: they are met group by group, the vertical rate
first and the others within what it leaves them.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import qmc

from modeviz.errors import VehicleError
from modeviz.tuning.sensitivity import RateVariable, rate_variables
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import DIRECTIONS, RATE_FIELDS, MountRates, Rates
from modeviz.vehicle.problem import DesignGroup
from modeviz.vehicle.vehicle import Vehicle

VERTICAL = RATE_FIELDS[0]


@dataclass(frozen=True)
class DesignVariable:
    """One number that a search chooses: a rate, or all rates of a group in fixed ratios."""

    group: str
    fields: tuple[str, ...]
    """Of `RATE_FIELDS`: what moves with it."""

    @property
    def spoken(self) -> str:
        """What a person calls it: "C2 fore-aft"."""
        if len(self.fields) > 1:
            return f"{self.group} rates"
        return f"{self.group} {self.direction}"

    @property
    def direction(self) -> str:
        """Of its first field."""
        return DIRECTIONS[RATE_FIELDS.index(self.lead)]

    @property
    def lead(self) -> str:
        """Its first field."""
        return self.fields[0]


@dataclass(frozen=True)
class Limit:
    """One side of a bound or of a ratio limit: sign · (x_variable - x_of) <= value."""

    variable: int
    """Its number."""
    of: int | None
    """The number of the vertical rate that it is a ratio to; None for a bound."""
    sign: int
    """1 for an upper limit, -1 for a lower one."""
    value: float
    """sign · ln(limit of k or of the ratio, over that at the start)."""

    @property
    def spoken(self) -> str:
        """What a person calls it: "lower ratio limit"."""
        return (
            f"{'upper' if self.sign > 0 else 'lower'} {'bound' if self.of is None else 'ratio limit'}"
        )


@dataclass(frozen=True, eq=False)
class DesignSpace:
    """Bounded logarithms of rates, with limits to their ratios."""

    vehicle: Vehicle
    base: Rates
    """Of every group: where x is zero."""
    variables: tuple[DesignVariable, ...]
    limits: tuple[Limit, ...]
    members: Floats
    """(n_rates, n_variables): ∂ ln k/∂x, 0 or 1, for each of `rate_variables`."""
    lower: Floats
    """(n_variables,): the least x with which all limits can be met."""
    upper: Floats

    @property
    def n_variables(self) -> int:
        return len(self.variables)

    def rates(self, x: Floats) -> dict[str, MountRates]:
        """The rates of every group of a design."""
        factors = np.exp(self.members @ x).reshape(-1, len(RATE_FIELDS))
        return {
            name: MountRates(*np.multiply(r.as_tuple(), f).tolist(), loss_factor=r.loss_factor)
            for (name, r), f in zip(self.base.items(), factors, strict=True)
        }

    def to_x(self, rates: Rates) -> Floats:
        """The design nearest to some rates, group by group: what is outside of a limit is put on it."""
        every = self.vehicle.all_rates(rates)
        found = np.zeros(self.n_variables)
        for i, v in enumerate(self.variables):
            found[i] = np.mean([_log_ratio(every, self.base, v.group, field) for field in v.fields])
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
        fractions = qmc.LatinHypercube(self.n_variables, rng=seed).random(count)
        return np.array([self.sampled(row) for row in fractions]).reshape(count, self.n_variables)

    def excess(self, x: Floats) -> float:
        """By how much ln k or that of a ratio is beyond its limit, at worst; below 0 if none is."""
        return float((self.rows @ x - self.values).max(initial=-np.inf))

    @property
    def rows(self) -> Floats:
        """(n_limits, n_variables): `rows` @ x <= `values`."""
        rows = np.zeros((len(self.limits), self.n_variables))
        for row, limit in zip(rows, self.limits, strict=True):
            row[limit.variable] = limit.sign
            if limit.of is not None:
                row[limit.of] = -limit.sign
        return rows

    @property
    def values(self) -> Floats:
        """(n_limits,)."""
        return np.array([limit.value for limit in self.limits])

    @property
    def ratios(self) -> NDArray[np.bool_]:
        """(n_limits,): which of them are of ratios."""
        return np.array([limit.of is not None for limit in self.limits], bool)

    def spoken(self, x: Floats) -> str:
        """The rates of a design in a sentence: "C2 fore-aft 141 N/mm, E rates × 1.2"."""
        rates = self.rates(x)
        texts = [
            f"{v.spoken} × {np.exp(step):.3g}"
            if len(v.fields) > 1
            else f"{v.spoken} {_rate(rates, v.group, v.lead) / 1e3:.4g} N/mm"
            for v, step in zip(self.variables, x, strict=True)
        ]
        return ", ".join(texts)

    def _ranges(self, x: Floats) -> Mapping[int, tuple[float, float]]:
        """What a vertical rate leaves for the numbers whose ratio to it is limited."""
        found: dict[int, tuple[float, float]] = {}
        for limit in self.limits:
            if limit.of is None:
                continue
            low, high = found.get(
                limit.variable, (self.lower[limit.variable], self.upper[limit.variable])
            )
            end = x[limit.of] + limit.sign * limit.value
            found[limit.variable] = (low, min(high, end)) if limit.sign > 0 else (max(low, end), high)
        return found


def design_space(
    vehicle: Vehicle,
    groups: Sequence[DesignGroup],
    base: Rates | None = None,
    locked: frozenset[tuple[str, str]] = frozenset(),
) -> DesignSpace:
    """The space of the designs that a problem allows.

    Args:
        vehicle: whose rates they are.
        groups: of mounts whose rates may change.
        base: the rates that others keep and that fixed ratios are of; None: the vehicle's own.
        locked: rates, (group, field of `MountRates`), that may not change.

    Raises:
        VehicleError: an unknown group, nothing that may change, a rate of zero among what may, or
            limits that contradict each other; the text names the rate.
    """
    every = vehicle.all_rates(base or {})
    variables: list[DesignVariable] = []
    limits: list[Limit] = []
    for group in groups:
        own = _variables(group, locked)
        limits += _limits(vehicle, group, every, own, len(variables))
        variables += own
    if not variables:
        raise VehicleError("nothing may change: every rate of the problem is locked; unlock one")
    lower, upper = _reach(variables, limits)
    return DesignSpace(
        vehicle, every, tuple(variables), tuple(limits), _members(vehicle, variables), lower, upper
    )


def _variables(group: DesignGroup, locked: frozenset[tuple[str, str]]) -> list[DesignVariable]:
    """The numbers that may be chosen in a group, vertical first."""
    free = [
        field
        for field, direction in zip(RATE_FIELDS, DIRECTIONS, strict=True)
        if direction in group.directions and (group.group, field) not in locked
    ]
    if group.fixed_ratios:
        return [DesignVariable(group.group, RATE_FIELDS)] if len(free) == len(RATE_FIELDS) else []
    return [DesignVariable(group.group, (field,)) for field in free]


def _limits(
    vehicle: Vehicle, group: DesignGroup, base: Rates, variables: Sequence[DesignVariable], first: int
) -> list[Limit]:
    """The bounds and ratio limits of a group, whose variables have the numbers from `first` on."""
    mounts = vehicle.mount_group(group.group)
    softest, stiffest = group.bounds or mounts.bounds
    ratios = None if group.fixed_ratios else group.ratio_limits or mounts.ratio_limits
    own = base[group.group]
    limits = []
    for i, variable in enumerate(variables, first):
        low, high = -np.inf, np.inf
        for field in variable.fields:
            rate = _positive(variable, getattr(own, field), "rate")
            low = max(low, np.log(_positive(variable, getattr(softest, field), "softest") / rate))
            high = min(high, np.log(getattr(stiffest, field) / rate))
        if low > high:
            raise VehicleError(
                f"{variable.spoken}: no rate keeps the bounds of every direction at fixed ratios; "
                "widen the bounds or free the ratios"
            )
        if ratios and variable.fields[0] != VERTICAL:
            start = getattr(own, variable.fields[0]) / _positive(
                variable, own.vertical, "vertical rate"
            )
            least = np.log(ratios[0] / start) if ratios[0] else -np.inf
            most = np.log(ratios[1] / start)
            if variables[0].fields[0] == VERTICAL:
                limits += [Limit(i, first, -1, -least), Limit(i, first, 1, most)]
            else:
                low, high = max(low, least), min(high, most)
        limits += [Limit(i, None, -1, -low), Limit(i, None, 1, high)]
    return [limit for limit in limits if np.isfinite(limit.value)]


def _reach(variables: Sequence[DesignVariable], limits: Sequence[Limit]) -> tuple[Floats, Floats]:
    """What each number can be once all limits are met."""
    lower, upper = np.full(len(variables), -np.inf), np.full(len(variables), np.inf)
    for limit in limits:
        if limit.of is None:
            end = upper if limit.sign > 0 else lower
            end[limit.variable] = limit.sign * limit.value
    bounds = lower.copy(), upper.copy()
    for limit in limits:
        if limit.of is not None and limit.sign > 0:
            lower[limit.of] = max(lower[limit.of], bounds[0][limit.variable] - limit.value)
        elif limit.of is not None:
            upper[limit.of] = min(upper[limit.of], bounds[1][limit.variable] + limit.value)
    for variable, low, high in zip(variables, lower, upper, strict=True):
        if low > high:
            raise VehicleError(
                f"{variable.spoken}: bounds and ratio limits of {variable.group} contradict each "
                "other: no rate meets them all; widen the bounds or the limits"
            )
    return lower, upper


def _members(vehicle: Vehicle, variables: Sequence[DesignVariable]) -> Floats:
    own = [{RateVariable(v.group, field) for field in v.fields} for v in variables]
    return np.array([[rate in its for its in own] for rate in rate_variables(vehicle)], float)


def _log_ratio(rates: Rates, base: Rates, group: str, field: str) -> float:
    """ln(k/k₀) of a rate; of one that is zero a number below any limit."""
    k = max(_rate(rates, group, field), np.finfo(np.float64).tiny)
    return float(np.log(k / _rate(base, group, field)))


def _rate(rates: Rates, group: str, field: str) -> float:
    return getattr(rates[group], field)


def _positive(variable: DesignVariable, rate: float, what: str) -> float:
    if rate <= 0:
        raise VehicleError(
            f"{variable.spoken}: {what}: found {rate:g} N/m, expected more than zero, for a search "
            "goes by factors"
        )
    return rate
