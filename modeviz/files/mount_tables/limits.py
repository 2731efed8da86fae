"""What a line of a mount table says of its group beside rates: travel, and ratios of rates."""

from dataclasses import dataclass, field

import numpy as np

from modeviz.errors import VehicleError
from modeviz.files.headed_table import TableLine
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.local_axes import AXES

TRAVEL = ("least_travel", "most_travel")
"""What columns begin with of how far the first end may go from the second, then along which axis."""

OTHERS = (*(f"r{axis}" for axis in AXES), *(f"c_{axis}" for axis in AXES))
"""What columns of bounds end with that are not along an axis' springs: about axes, and of dampers."""

STATIC_RATIO, RATIOS = "static_ratio", ("least_ratio", "most_ratio")


@dataclass(frozen=True, eq=False)
class GroupLimits:
    """What the line of a mount says of its group, in SI and along the mount's axes."""

    travel: Floats = field(default_factory=lambda: np.full((2, 3), np.nan))
    """(2, 3), m: the least and the most along x, y, z; not numbers where nothing limits it."""
    static_ratio: float = np.nan
    """Rates by those under a load that stays; not a number where it is not said, as the ratios."""
    ratios: tuple[float, float] = (np.nan, np.nan)
    """The least and the most that other rates may be of the vertical one."""
    others: Floats = field(default_factory=lambda: np.full((2, len(OTHERS)), np.nan))
    """(2, 6): the softest and the stiffest of `OTHERS`; not numbers of what is not tuned."""

    @property
    def are_said(self) -> bool:
        """Whether anything is."""
        said = *self.travel.flat, self.static_ratio, *self.ratios, *self.others.flat
        return not np.isnan(said).all()


def check_travel(line: TableLine, columns: tuple[str, str], ends: tuple[float, float]) -> None:
    """Raises VehicleError unless a travel has both ends, the least below zero and the most above.

    Args:
        line: that says it.
        columns: of its ends.
        ends: in m; not a number where the cell is empty.
    """
    words = "zero or below", "zero or above"
    for column, end, sign, expected in zip(columns, ends, (-1, 1), words, strict=True):
        if np.isnan(end) and not np.isnan(ends).all():
            raise VehicleError(f"{line.where(column)}: empty, expected a length, {expected}")
        if end * sign < 0:
            raise VehicleError(f"{line.where(column)}: found {line.text(column)}, expected {expected}")
    if ends == (0.0, 0.0):
        raise VehicleError(f"{line.where(columns[1])}: found no travel at all, expected some")


def read_others(line: TableLine) -> Floats:
    """Return the bounds of `OTHERS`, (2, 6), not numbers where a line has none.

    Raises:
        VehicleError: only one of both is said, or the softest is not below the stiffest.
    """
    found = np.full((2, len(OTHERS)), np.nan)
    for i, what in enumerate(OTHERS):
        columns = f"softest_{what}", f"stiffest_{what}"
        low, high = (line.number(column, 0) for column in columns)
        for column, value, other in zip(columns, (low, high), (high, low), strict=True):
            if value is None and other is not None:
                raise VehicleError(f"{line.where(column)}: empty, expected the other bound too")
        if low is not None and high is not None:
            if low >= high:
                words = f"found {line.text(columns[1])}, expected more than the softest"
                raise VehicleError(f"{line.where(columns[1])}: {words}")
            found[:, i] = low, high
    return found


def read_ratios(line: TableLine) -> tuple[float, float]:
    """Return the least and the most that rates may be of the vertical one, not numbers if not said.

    Raises:
        VehicleError: only one is said, or the least is not below the most.
    """
    low, high = (line.number(name, 0) for name in RATIOS)
    if low is None and high is None:
        return np.nan, np.nan
    for name, value in zip(RATIOS, (low, high), strict=True):
        if value is None:
            raise VehicleError(f"{line.where(name)}: empty, expected the other ratio too")
    assert low is not None
    assert high is not None
    if low >= high:
        found = line.text(RATIOS[1])
        raise VehicleError(
            f"{line.where(RATIOS[1])}: found {found}, expected more than the least, {low:g}"
        )
    return low, high


def read_static_ratio(line: TableLine) -> float:
    """Return the static ratio, not a number if it is not said; raises VehicleError for zero."""
    value = line.number(STATIC_RATIO, 0)
    if value == 0:
        raise VehicleError(f"{line.where(STATIC_RATIO)}: found 0, expected more than zero")
    return np.nan if value is None else value
