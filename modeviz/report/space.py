"""Words for what a search can find and what it cannot."""

from collections.abc import Mapping, Sequence

from modeviz.optimise.design_space import DesignSpace
from modeviz.optimise.outside import kept_ratios
from modeviz.vehicle.mount_rates import RATE_NAMES

FEW = 3
"""So many reasons are given; the rest is counted."""


def ratio_words(space: DesignSpace) -> str:
    """The ratios that a search keeps, "E lateral 0.314 and fore-aft 0.5 of vertical"; "" if none."""
    kept = {
        group: " and ".join(f"{RATE_NAMES[field]} {ratio:.4g}" for field, ratio in ratios.items())
        for group, ratios in kept_ratios(space).items()
    }
    return "; ".join(f"{group} {ratios} of vertical" for group, ratios in kept.items())


def outside_words(name: str, reasons: Sequence[str]) -> str:
    """The reasons why a set of rates could not be found; "" if it could."""
    if not reasons:
        return ""
    more = [f"{len(reasons) - FEW} more"] if len(reasons) > FEW else []
    return f"{name} lies outside of what is searched: {'; '.join([*reasons[:FEW], *more])}"


def space_lines(space: DesignSpace, outside: Mapping[str, Sequence[str]]) -> list[str]:
    """Lines of text on the ratios kept, and on each set that is compared and could not be found."""
    ratios = ratio_words(space)
    kept = [f"ratios kept as in the rates it starts from: {ratios}"] if ratios else []
    return [*kept, *(line for n, r in outside.items() if (line := outside_words(n, r)))]
