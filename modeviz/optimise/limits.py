"""What a search may choose in a mount group, and the limits to that, in logarithms x = ln(k/k₀)."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError
from modeviz.optimise.contradiction import SAME, check_ratios
from modeviz.units import si_unit
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import RATE_NAMES, RATE_QUANTITIES, STIFFNESS_FIELDS, MountRates
from modeviz.vehicle.problem import DesignGroup

VERTICAL, *SHEAR = STIFFNESS_FIELDS
"""The ratios of the others to the vertical rate are limited."""


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
        return _spoken(self.group, self.lead)

    @property
    def lead(self) -> str:
        """Its first field."""
        return self.fields[0]


@dataclass(frozen=True)
class Limit:
    """One side of a bound or of a ratio limit: sign · (x_rate - x_of) <= value.

    A rate that is kept has no number, and its x is zero.
    """

    spoken: str
    """What a person calls it: "C2 fore-aft: lower ratio limit"."""
    rate: int | None
    """The number of the rate that is limited."""
    of: int | None
    """The number of the vertical rate that it is a ratio to; None for a bound, too."""
    sign: int
    """1 for an upper limit, -1 for a lower one."""
    value: float
    """sign · ln(limit of k or of the ratio, over that at the start)."""

    @property
    def terms(self) -> tuple[tuple[int, int], ...]:
        """Each number in it with its sign."""
        both = ((self.rate, self.sign), (self.of, -self.sign))
        return tuple((number, sign) for number, sign in both if number is not None)


def group_variables(
    group: DesignGroup, mounts: MountGroup, locked: frozenset[tuple[str, str]]
) -> list[DesignVariable]:
    """The numbers that may be chosen in a group, vertical first; see `design_space`."""
    free = [
        field
        for field in mounts.fields
        if RATE_NAMES[field] in group.directions and (group.group, field) not in locked
    ]
    together = [STIFFNESS_FIELDS] if group.fixed_ratios and set(STIFFNESS_FIELDS) <= set(free) else []
    alone = [field for field in free if not (group.fixed_ratios and field in STIFFNESS_FIELDS)]
    return [DesignVariable(group.group, fields) for fields in (*together, *((f,) for f in alone))]


def group_limits(
    group: DesignGroup,
    mounts: MountGroup,
    base: MountRates,
    variables: Sequence[DesignVariable],
    first: int,
) -> list[Limit]:
    """The bounds and ratio limits of a group.

    Args:
        group: what of it may change.
        mounts: the group itself, with the limits that are not given.
        base: its rates where x is zero.
        variables: what may be chosen in it.
        first: the number of the first of those; the others follow.

    Raises:
        VehicleError: a rate of zero, or bounds that no rates meet with fixed or limited ratios.
    """
    numbered = dict(enumerate(variables, first))
    bounds = group.bounds_in(mounts.bounds)
    limits = _bounds(bounds, base, numbered)
    ratios = group.ratio_limits or mounts.ratio_limits
    if ratios and not group.fixed_ratios:
        check_ratios(group.group, ratios, bounds, base, {v.lead for v in variables})
        limits += _ratio_limits(group.group, ratios, base, numbered)
    return limits


def reach(n_variables: int, limits: Sequence[Limit]) -> tuple[Floats, Floats]:
    """The least and the most that each number can be where all limits are met, which is possible."""
    lower, upper = np.full(n_variables, -np.inf), np.full(n_variables, np.inf)
    for limit in limits:
        if len(limit.terms) == 1:
            _tighten(lower, upper, *limit.terms[0], limit.value)
    lowest, highest = lower.copy(), upper.copy()
    for limit in limits:
        if limit.rate is not None and limit.of is not None:
            far = lowest[limit.rate] if limit.sign > 0 else -highest[limit.rate]
            _tighten(lower, upper, limit.of, -limit.sign, limit.value - far)
    return lower, np.maximum(lower, upper)


def _tighten(lower: Floats, upper: Floats, number: int, sign: int, value: float) -> None:
    """Puts sign · x <= value of one number into its ends."""
    if sign > 0:
        upper[number] = min(upper[number], value)
    else:
        lower[number] = max(lower[number], -value)


def _bounds(
    bounds: tuple[MountRates, MountRates], base: MountRates, numbered: Mapping[int, DesignVariable]
) -> list[Limit]:
    """The bounds of each number."""
    limits = []
    for number, variable in numbered.items():
        low, high = _reach_within(variable, base, bounds)
        limits += _sides(variable.spoken, "bound", number, None, low, high)
    return limits


def _ratio_limits(
    group: str, ratios: tuple[float, float], base: MountRates, numbered: Mapping[int, DesignVariable]
) -> list[Limit]:
    """The limits of each ratio of which a search can change one rate or both."""
    numbers = {variable.lead: number for number, variable in numbered.items()}
    limits = []
    for field in SHEAR:
        rate, of = numbers.get(field), numbers.get(VERTICAL)
        k, vertical = getattr(base, field), base.vertical
        # A rate of zero can only be one that is kept, and no factor changes a ratio with it.
        if (rate is not None or of is not None) and k and vertical:
            low, high = (_log(limit * vertical / k) for limit in ratios)
            limits += _sides(_spoken(group, field), "ratio limit", rate, of, low, high)
    return limits


def _reach_within(
    variable: DesignVariable, base: MountRates, bounds: tuple[MountRates, MountRates]
) -> tuple[float, float]:
    """The least and the most of a number within the bounds of its rates."""
    softest, stiffest = bounds
    start = np.array([_rate(variable.group, base, field) for field in variable.fields])
    least = [_rate(variable.group, softest, field, "softest") for field in variable.fields]
    most = [getattr(stiffest, field) for field in variable.fields]
    low, high = _log(np.max(least / start)), _log(np.min(most / start))
    if low > high + SAME:
        raise VehicleError(
            f"{variable.spoken}: no rate keeps the bounds of every direction at fixed ratios; "
            "widen the bounds or free the ratios"
        )
    return low, max(low, high)


def _sides(
    spoken: str, what: str, rate: int | None, of: int | None, low: float, high: float
) -> list[Limit]:
    """Both sides of a range, as far as it has any."""
    both = (
        Limit(f"{spoken}: lower {what}", rate, of, -1, -low),
        Limit(f"{spoken}: upper {what}", rate, of, 1, high),
    )
    return [limit for limit in both if np.isfinite(limit.value)]


def _rate(group: str, rates: MountRates, field: str, what: str = "rate") -> float:
    """A rate that is not zero."""
    rate = getattr(rates, field)
    if rate <= 0:
        raise VehicleError(
            f"{_spoken(group, field)}: {what}: found 0 {si_unit(RATE_QUANTITIES[field])}, expected "
            "more than zero, for a search goes by factors"
        )
    return rate


def _log(ratio: float) -> float:
    """The natural logarithm, which has no limit at zero."""
    return float(np.log(ratio)) if ratio > 0 else -np.inf


def _spoken(group: str, field: str) -> str:
    return f"{group} {RATE_NAMES[field]}"
