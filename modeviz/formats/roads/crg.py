"""The heights of a road in an OpenCRG file: a grid along and across a reference line."""

import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.limits import check_size
from modeviz.formats.roads.crg_file import CrgFile, read_crg_file, road_data
from modeviz.units import UNITS
from modeviz.vehicle.arrays import Floats

MOST_HEIGHTS = 50_000_000

HIGHEST = 1e5
"""m: of no road, nor is any so wide."""

FINEST, COARSEST = 1e-6, 1e3
"""m, between heights along a road."""

AT = re.compile(r"long section at v\s*=\s*(\S+)", re.IGNORECASE)
NUMBERED = re.compile(r"long section\s+(\d+)", re.IGNORECASE)


@dataclass(frozen=True, eq=False)
class Surface:
    """Heights over a grid, which stay as their file has them until a track is asked for."""

    increment: float
    """m, along the road."""
    v: Floats
    """(n_sections,), rising, m: across, to the left of the reference line."""
    grid: np.ndarray
    """(n_rows, n_sections) above the reference line; not a number where unknown."""
    unit: Floats = field(default_factory=lambda: np.ones(1))
    """(n_sections,) or (1,), m of one in the grid."""
    rise: Floats = field(default_factory=lambda: np.zeros(1))
    """(n_rows,) or (1,), m: the height of the reference line."""
    banking: Floats = field(default_factory=lambda: np.zeros(1))
    """(n_rows,) or (1,), by how much it is higher by each m of v."""

    def __post_init__(self) -> None:
        if not FINEST <= self.increment <= COARSEST:
            raise VehicleError(
                f"has heights every {self.increment:g} m, expected every {FINEST:g} to {COARSEST:g} m"
            )
        if not (np.abs(self.v) <= HIGHEST).all():
            raise VehicleError(f"has long sections beyond {HIGHEST:g} m of its reference line")
        if len(self.v) > 1 and not (np.diff(self.v) > 0).all():
            raise VehicleError("two long sections are at the same v")

    @property
    def length(self) -> float:
        """Along the road, m."""
        return self.increment * (len(self.grid) - 1)

    def section(self, number: int) -> Floats:
        """Return the heights along a section, (n_rows,), m.

        Raises:
            VehicleError: they are those of no road.
        """
        unit = float(np.broadcast_to(self.unit, self.v.shape)[number])
        with np.errstate(over="ignore", invalid="ignore"):  # what is too large is refused
            heights = unit * self.grid[:, number].astype(float)
            heights += self.rise + self.banking * self.v[number]
        if not (np.abs(heights[~np.isnan(heights)]) < HIGHEST).all():
            raise VehicleError(
                f"has heights beyond {HIGHEST:g} m; is it damaged, or in another format than it says?"
            )
        return heights

    def track(self, v: float) -> Floats:
        """Return the heights along a line at v, (n_rows,), between its sections or at the nearest."""
        if len(self.v) == 1:
            return self.section(0)
        left = int(np.clip(np.searchsorted(self.v, v), 1, len(self.v) - 1)) - 1
        low, high = self.v[left : left + 2]
        part = float(np.clip((v - low) / (high - low), 0, 1))
        if part in (0.0, 1.0):
            return self.section(left + int(part))
        return (1 - part) * self.section(left) + part * self.section(left + 1)


def read_crg(path: Path) -> Surface:
    """Return the surface in an OpenCRG file, with its slope, banking and scales.

    Raises:
        VehicleError: no such file, or none with a road; the text says what is wrong.
    """
    file = read_crg_file(path)
    with located(path.name):
        if not file.data:
            raise VehicleError("has no road data, nor has a file that it names")
        increment = file.number("REFERENCE_LINE_INCREMENT") or 0.0
        if not increment > 0:
            raise VehicleError(f"REFERENCE_LINE_INCREMENT: found {increment:g}, expected more than 0")
        sections = _sections(file)
        if not sections:
            raise VehicleError(
                f"found the channels {listed(file.channels)}, expected some of 'long section ...'"
            )
        data = road_data(file, _n_rows(file, increment))
        check_size("heights", data.size, MOST_HEIGHTS)
        return _surface(file, increment, sections, data)


def _n_rows(file: CrgFile, increment: float) -> int | None:
    """How many cuts across the road there are, by its start and end; None: it has no end."""
    end = file.number("REFERENCE_LINE_END_U")
    if end is None:
        return None
    length = end - (file.number("REFERENCE_LINE_START_U") or 0.0)
    n_rows = round(max(0.0, min(length / increment, 1e12))) + 1
    check_size("heights", n_rows * len(file.channels), MOST_HEIGHTS)
    if n_rows < 2:
        raise VehicleError(f"REFERENCE_LINE_END_U: found {end:g}, expected more than where it starts")
    return n_rows


def _sections(file: CrgFile) -> list[tuple[int, float, float]]:
    """Column, v and unit in m of each long section."""
    found = []
    numbers = [int(n[1]) for c in file.channels if (n := NUMBERED.match(c)) and not AT.match(c)]
    for column, channel in enumerate(file.channels):
        name, _, unit = channel.rpartition(",")
        if at := AT.match(name):
            found.append((column, _v(at[1]), _unit(channel, unit)))
        elif number := NUMBERED.match(name):
            v = _v_of_number(int(number[1]), max(numbers), file)
            found.append((column, v, _unit(channel, unit)))
    return sorted(found, key=lambda section: section[1])


def _v(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = np.nan
    if not np.isfinite(value):
        raise VehicleError(f"found a long section at v = {quoted(text)}, expected a number")
    return value


def _unit(channel: str, unit: str) -> float:
    if unit.strip() not in UNITS["length"]:
        raise VehicleError(f"found the channel {quoted(channel)}, expected heights in m")
    return UNITS["length"][unit.strip()]


def _v_of_number(number: int, count: int, file: CrgFile) -> float:
    """Where a section is that is numbered from the right, 1 to `count`."""
    right, left = file.number("LONG_SECTION_V_RIGHT"), file.number("LONG_SECTION_V_LEFT")
    step = file.number("LONG_SECTION_V_INCREMENT")
    if step is None and right is not None and left is not None:
        step = (left - right) / max(count - 1, 1)
    if step is None or not (step > 0 or count == 1):
        raise VehicleError(
            "LONG_SECTION_V_INCREMENT: missing, expected the distance of the sections that are numbered"
        )
    start = -step * (count - 1) / 2 if right is None else right
    return start + step * (number - 1)


def _surface(
    file: CrgFile, increment: float, sections: list[tuple[int, float, float]], data: np.ndarray
) -> Surface:
    """The surface with what the reference line adds to the grid, and its modifiers."""

    def scale(name: str) -> float:
        return file.number(f"SCALE_{name}") or 1.0  # zero means none, as the specification has it

    columns, v, unit = (np.array(values) for values in zip(*sections, strict=True))
    first, last = columns[[0, -1]]
    is_whole = np.array_equal(columns, np.arange(first, last + 1))
    with np.errstate(over="ignore", invalid="ignore"):  # what is too large is refused
        slope, banking = (_along(file, data, name) for name in ("slope", "banking"))
        return Surface(
            increment * scale("LENGTH"),
            v * scale("WIDTH"),
            data[:, first : last + 1] if is_whole else data[:, columns],
            unit * scale("Z_GRID"),
            scale("SLOPE") * increment * np.concatenate([[0.0], np.cumsum(slope[1:])]),
            scale("BANKING") / scale("WIDTH") * banking,
        )


def _along(file: CrgFile, data: np.ndarray, name: str) -> Floats:
    """The slope or banking of the reference line, (n_rows,): a channel, or a constant."""
    names = [channel.rpartition(",")[0].lower() for channel in file.channels]
    if f"reference line {name}" not in names:
        constant = file.number(f"REFERENCE_LINE_START_{name[0].upper()}") or 0.0
        return np.full(len(data), constant)
    values = data[:, names.index(f"reference line {name}")].astype(float)
    values[:1] = np.nan_to_num(values[:1])  # the first is not used
    if not np.isfinite(values).all():
        raise VehicleError(f"channel 'reference line {name}': has values that are no numbers")
    return values
