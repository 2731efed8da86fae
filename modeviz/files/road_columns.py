"""The columns that a road's table has, in which units: over hertz or over cycles by length."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectra import FREQUENCY
from modeviz.units import psd_factor, spatial_psd_factor

CROSS = ("cross_real", "cross_imag")
WRITTEN = (FREQUENCY, "left", "right", *CROSS)
"""Both tracks' spectra and S_lr = E[L R*]."""

COLUMNS = (*WRITTEN, "coherence", "track", "spatial_frequency")
"""All that a table may have."""

SPATIAL = ("spatial_frequency", "n", "wavenumber", "frequency")
"""What the frequencies along a road are called; of these the first is ours."""

KNOWN = (*COLUMNS, *SPATIAL[1:])

KNOWN = (*COLUMNS, *SPATIAL[1:])

PER_METRE: Mapping[str, float] = {"cycles/m": 1.0, "cycle/m": 1.0, "1/m": 1.0, "rad/m": 1 / (2 * np.pi)}
"""Cycles/m of each."""


@dataclass(frozen=True, eq=False)
class RoadColumns:
    """Which of its columns are a table's, and one of each in SI."""

    frequency: str
    factors: Mapping[str, float]
    """By column, frequency first: Hz and m²/Hz, or cycles/m and m²/(cycle/m)."""

    @property
    def is_spatial(self) -> bool:
        """Whether its frequencies are along the road, and not those of a vehicle on it."""
        return self.frequency != FREQUENCY

    @property
    def tracks(self) -> tuple[str, str]:
        """The columns of the left and the right track, which are one if it has one alone."""
        if "left" in self.factors and "right" in self.factors:
            return "left", "right"
        one = next(name for name in ("track", "left", "right") if name in self.factors)
        return one, one


def road_columns(units: Mapping[str, str], conventions: Conventions) -> RoadColumns:
    """The columns of a table.

    Args:
        units: what its headers say, by column.
        conventions: in whose units those are that say none.

    Raises:
        VehicleError: too few or too many columns, or a unit of something else.
    """
    frequency = _the_frequency(units)
    _check_tracks(units)
    factors = {frequency: 1.0}
    if frequency != FREQUENCY:
        with located(f"column {frequency}"):
            factors[frequency] = _per_metre(units[frequency])
    for name in units:
        if name != frequency:
            with located(f"column {name}"):
                factors[name] = _power(name, units, frequency, conventions)
    return RoadColumns(frequency, factors)


def _the_frequency(units: Mapping[str, str]) -> str:
    found = [name for name in units if name in (FREQUENCY, *SPATIAL)]
    if len(found) != 1:
        raise VehicleError(
            f"found {listed(units)}, expected one column of frequencies, {FREQUENCY} or {SPATIAL[0]} "
            "with its unit"
        )
    return found[0]


def _check_tracks(units: Mapping[str, str]) -> None:
    """Raises VehicleError unless there are one or two tracks, and of two what goes with them."""
    is_two = "left" in units and "right" in units
    beside = [name for name in (*CROSS, "coherence") if name in units]
    wrong = ""
    if beside and not is_two:
        wrong = ", without " + " and ".join(name for name in ("left", "right") if name not in units)
    elif not is_two and sum(name in units for name in ("left", "right", "track")) != 1:
        wrong = ", without left and right"
    elif is_two and "track" in units:
        wrong = ", with one track beside two"
    elif beside not in ([], list(CROSS), ["coherence"]):
        wrong = f", with {' and '.join(beside)}"
    if wrong:
        raise VehicleError(
            f"found {','.join(units)!r}{wrong}; expected left and right and, if known, cross_real and "
            "cross_imag or coherence; or track alone"
        )


def _per_metre(unit: str) -> float:
    """Cycles/m of a unit."""
    level = unit.strip().replace("⁻¹", "^-1").replace("m^-1", "/m")
    level = {"/m": "1/m"}.get(level, level)
    if level not in PER_METRE:
        raise VehicleError(f"found the unit {quoted(unit)}, expected one of {', '.join(PER_METRE)}")
    return PER_METRE[level]


def _power(name: str, units: Mapping[str, str], frequency: str, conventions: Conventions) -> float:
    """One of a column's power in m²/Hz, or in m²/(cycle/m); the coherence has no unit."""
    unit = units[name]
    if name == "coherence":
        return 1.0
    if frequency == FREQUENCY:
        return psd_factor(unit, "length") if unit else conventions.unit("length") ** 2
    is_angular = "rad" in units[frequency]
    if unit:
        return spatial_psd_factor(unit, is_angular)
    return conventions.unit("length") ** 3 * (2 * np.pi if is_angular else 1.0)
