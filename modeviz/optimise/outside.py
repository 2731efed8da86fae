"""What a search keeps, and why rates that it is compared with lie outside of what it can find."""

import numpy as np

from modeviz.optimise.design_space import DesignSpace
from modeviz.optimise.limits import SHEAR, Limit
from modeviz.optimise.search import Search
from modeviz.vehicle.mount_rates import RATE_FIELDS, RATE_NAMES, MountRates, Rates, spoken_rate

SAME = 1e-6
"""Relative: rates are read and written in other units, and are not more alike than that."""

NO_RATE = 1e-200
"""N/m in place of none: logarithms and ratios of it are numbers."""

FAR = np.log(1e6)


def kept_ratios(space: DesignSpace) -> dict[str, dict[str, float]]:
    """Return the ratios to vertical of each group whose rates a search changes together.

    They are those of the rates that the search starts from: `{"E": {"lateral": 0.3, "fore_aft": 0.2}}`.
    """
    groups = [v.group for v in space.variables if len(v.fields) > 1]
    return {group: _ratios(space.base[group]) for group in groups}


def outside_space(space: DesignSpace, rates: Rates) -> tuple[str, ...]:
    """Return why no design of a space has some rates, "E lateral is 0.294 of vertical, kept at 0.314".

    Args:
        space: of designs.
        rates: of groups; others as in the vehicle's file.

    Returns:
        A text for each rate, ratio or limit; none if the rates lie within.
    """
    every = space.vehicle.all_rates(rates)
    return (*_moved(space, every), *_past(space, every))


def outside_search(search: Search, rates: Rates) -> tuple[str, ...]:
    """Return the same as `outside_space`, and modes and mounts that are where they may not be."""
    found = list(outside_space(search.space, rates))
    if search.windows is not None:
        at = zip(search.windows.windows, search.windows.exact_frequencies(rates).tolist(), strict=True)
        found += [f"{w.mode} is at {f:.2f} Hz, where it may not be" for w, f in at if not w.allows(f)]
    if search.deflections is not None:
        limits = search.deflections.limits
        gives = zip(limits, search.deflections.exact(rates).tolist(), strict=True)
        found += [
            f"{limit.mount} gives {1e3 * abs(d):.3g} mm ({limit.direction}, {limit.load_case}), may "
            f"give {1e3 * limit.most:.3g} mm"
            for limit, d in gives
            if not limit.allows(d)
        ]
    return tuple(found)


def _moved(space: DesignSpace, every: Rates) -> list[str]:
    """Return what differs of what a search keeps: ratios, rates and loss factors."""
    fixed = kept_ratios(space)
    free = {(v.group, field) for v in space.variables for field in v.fields}
    found = []
    for group, base in space.base.items():
        now, kept = every[group], fixed.get(group, {})
        ratios = _ratios(now) if kept else {}
        found += [
            f"{group} {RATE_NAMES[field]} is {ratios[field]:.4g} of vertical, kept at {ratio:.4g}"
            for field, ratio in kept.items()
            if _differ(ratios[field], ratio)
        ]
        found += [
            f"{group} {RATE_NAMES[field]} is {spoken_rate(now, field)}, kept at "
            f"{spoken_rate(base, field).partition(' ')[0]}"
            for field in RATE_FIELDS
            if (group, field) not in free and _differ(getattr(now, field), getattr(base, field))
        ]
        loss = [_loss(space, group, r) for r in (now, base)]
        if _differ(*loss):
            found.append(f"{group} loss factor is {loss[0]:.4g}, kept at {loss[1]:.4g}")
    return found


def _past(space: DesignSpace, every: Rates) -> list[str]:
    """The limits that rates do not keep, nor mounts where they were given."""
    logarithms = [_log(space, every, v.group, v.lead) for v in space.variables]
    excess = space.rows @ np.append(logarithms, space.places.to_x({})) - space.values
    each = zip(space.limits, excess.tolist(), strict=True)
    return [f"past {limit.spoken}{_amount(space, limit, by)}" for limit, by in each if by > SAME]


def _amount(space: DesignSpace, limit: Limit, by: float) -> str:
    """Return how far a rate or ratio is past its limit; nothing of one that is zero, or of a place."""
    return "" if space.is_of_place(limit) or by >= FAR else f" by {100 * np.expm1(by):.3g} %"


def _log(space: DesignSpace, every: Rates, group: str, field: str) -> float:
    """ln(k/k₀) of a rate; of one that is zero a number below any limit."""
    k = max(getattr(every[group], field), NO_RATE)
    return float(np.log(k / getattr(space.base[group], field)))


def _ratios(rates: MountRates) -> dict[str, float]:
    """Return the ratios of the other rates to the vertical one."""
    vertical = rates.vertical or NO_RATE
    return {field: getattr(rates, field) / vertical for field in SHEAR}


def _loss(space: DesignSpace, group: str, rates: MountRates) -> float:
    own = space.vehicle.mount_group(group).loss_factor
    return own if rates.loss_factor is None else rates.loss_factor


def _differ(one: float, other: float) -> bool:
    return abs(one - other) > SAME * max(abs(one), abs(other))
