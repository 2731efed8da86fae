"""Property files of bushings: Adams's .bus and Altair's .gbs, in TeimOrbit's blocks of text.

Adams has no public description of the file itself. Its manual ("Curve Manager, Bushing") says that a
file lists six curves of force over deflection and six constant dampings; the names of the blocks are
those of files that come with Adams Car: [UNITS], [DAMPING] with FX_DAMPING to TZ_DAMPING, [FX_CURVE] to
[TZ_CURVE]. Altair describes its own ("Bushing Property File", MotionSolve Reference Guide): [UNITS],
[DIRECTIONS] with an ACTIVITY table, and [CONSTANT_STIFFNESS_FX] and the like.
"""

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.disk import LARGEST_TEXT, read_text
from modeviz.formats.component import LARGEST
from modeviz.units import UNITS
from modeviz.vehicle.arrays import Floats

SUFFIXES = (".bus", ".gbs")

FORCES = ("FX", "FY", "FZ", "TX", "TY", "TZ")

LENGTHS = {"mm": 1e-3, "millimeter": 1e-3, "cm": 1e-2, "centimeter": 1e-2, "m": 1.0, "meter": 1.0,
           "km": 1e3, "kilometer": 1e3, "inch": UNITS["length"]["in"], "in": UNITS["length"]["in"],
           "foot": UNITS["length"]["ft"], "ft": UNITS["length"]["ft"]}  # fmt: skip
FORCE_UNITS = {"newton": 1.0, "n": 1.0, "knewton": 1e3, "kn": 1e3, "kilonewton": 1e3,
               "pound_force": UNITS["force"]["lbf"], "lbf": UNITS["force"]["lbf"],
               "kg_force": 9.80665}  # fmt: skip
ANGLES = {"deg": np.pi / 180, "degree": np.pi / 180, "degrees": np.pi / 180, "rad": 1.0, "radian": 1.0,
          "radians": 1.0}  # fmt: skip
TIMES = {"sec": 1.0, "second": 1.0, "s": 1.0, "msec": 1e-3, "millisecond": 1e-3, "ms": 1e-3,
         "min": 60.0, "minute": 60.0}  # fmt: skip
KNOWN_UNITS = {"LENGTH": LENGTHS, "FORCE": FORCE_UNITS, "ANGLE": ANGLES, "TIME": TIMES}

STRAIGHT = 0.01
"""Relative: a curve whose slopes differ by less is a linear one."""


@dataclass(frozen=True, eq=False)
class BushingProperty:
    """The rates of a bushing of linear tables."""

    stiffness: Floats
    """(6,), N/m and N m/rad."""
    damping: Floats
    """(6,), N s/m and N m s/rad."""


@dataclass
class _Block:
    """A block of such a file."""

    values: dict[str, str] = field(default_factory=dict)
    lines: list[tuple[int, str]] = field(default_factory=list)
    """Those that are no assignments."""


def read_property(path: Path) -> BushingProperty:
    """Return the rates of a property file.

    Raises:
        VehicleError: no such file, or what it says is not linear, or not described anywhere.
    """
    text = read_text(path, LARGEST_TEXT, otherwise="latin-1")
    with located(path.name):
        blocks = _blocks(text)
        units = _units(blocks)
        if path.suffix.lower() == ".gbs":
            return _of_altair(blocks, units)
        if path.suffix.lower() == ".bus":
            return _of_adams(blocks, units)
        raise VehicleError(f"found {quoted(path.suffix)}, expected one of {', '.join(SUFFIXES)}")


def _blocks(text: str) -> dict[str, _Block]:
    """The blocks of a file by their names; "$" and "!" begin comments."""
    blocks: dict[str, _Block] = {}
    block = _Block()
    for number, line in enumerate(text.splitlines(), 1):
        line = re.split(r"[$!]", line, maxsplit=1)[0].strip()
        if not line:
            continue
        if header := re.fullmatch(r"\[(\w+)\]", line):
            if header[1].upper() in blocks:
                raise VehicleError(f"line {number}: the block {line} is there twice")
            block = blocks.setdefault(header[1].upper(), _Block())
        elif assigned := re.fullmatch(r"(\w+)\s*=\s*(.*)", line):
            block.values[assigned[1].upper()] = assigned[2].strip().strip("'\"")
        else:
            block.lines.append((number, line))
    if "UNITS" not in blocks:
        raise VehicleError(f"found the blocks {listed(blocks)}, without [UNITS]; no property file")
    return blocks


def _units(blocks: Mapping[str, _Block]) -> dict[str, float]:
    found = {}
    for name, known in KNOWN_UNITS.items():
        text = blocks["UNITS"].values.get(name, "")
        if text.lower() not in known:
            raise VehicleError(
                f"[UNITS] {name}: found {quoted(text)}, expected one of {', '.join(known)}"
            )
        found[name] = known[text.lower()]
    return found


def _scales(units: Mapping[str, float]) -> Floats:
    """One of a file's stiffnesses in SI, (6,): force by length, and force times length by angle."""
    force, length, angle = units["FORCE"], units["LENGTH"], units["ANGLE"]
    return np.array([force / length] * 3 + [force * length / angle] * 3)


def _of_adams(blocks: Mapping[str, _Block], units: Mapping[str, float]) -> BushingProperty:
    if "DAMPING" not in blocks or not any(f"{name}_CURVE" in blocks for name in FORCES):
        raise VehicleError(
            f"found the blocks {listed(blocks)}, expected [DAMPING] and [FX_CURVE] to [TZ_CURVE]: "
            "other bushings of Adams, which have no public description, are not read"
        )
    slopes = [_slope(f"{name}_CURVE", blocks) for name in FORCES]
    damping = [_value(blocks, "DAMPING", f"{name}_DAMPING") for name in FORCES]
    return _property(np.array(slopes), np.array(damping), units)


def _of_altair(blocks: Mapping[str, _Block], units: Mapping[str, float]) -> BushingProperty:
    active = _activity(blocks)
    slopes, damping = np.zeros(6), np.zeros(6)
    for i, name in enumerate(FORCES):
        for formulation in (f for f, on in active.items() if on[i]):
            block = f"{formulation}_{name}"
            if formulation == "CONSTANT_STIFFNESS":
                slopes[i] = _value(blocks, block, "K")
            elif formulation == "SPLINE_STIFFNESS":
                slopes[i] = _slope(block, blocks)
            elif formulation == "CONSTANT_DAMPING":
                damping[i] = _value(blocks, block, "C")
            else:
                raise VehicleError(
                    f"[DIRECTIONS]: {formulation} is active for {name}, which is not linear; expected "
                    "CONSTANT_STIFFNESS, SPLINE_STIFFNESS along a line, or CONSTANT_DAMPING"
                )
    return _property(slopes, damping, units)


def _property(slopes: Floats, damping: Floats, units: Mapping[str, float]) -> BushingProperty:
    for values, what in ((slopes, "stiffness"), (damping, "damping")):
        if (values < 0).any():
            name = FORCES[int(np.argmin(values))]
            raise VehicleError(f"{name}: found a {what} of {values.min():g}, expected zero or more")
    scales = _scales(units)
    return BushingProperty(slopes * scales, damping * scales * units["TIME"])


def _activity(blocks: Mapping[str, _Block]) -> dict[str, list[bool]]:
    """In which of `FORCES` formulations are active, of lines such as 'CUBIC_STIFFNESS' 0 1 0 0 0 0."""
    if "DIRECTIONS" not in blocks:
        raise VehicleError(f"found the blocks {listed(blocks)}, without [DIRECTIONS]")
    active = {}
    for number, line in blocks["DIRECTIONS"].lines:
        if line[0] in "{(":
            continue
        name, *switches = line.replace("'", " ").replace('"', " ").split() or [""]
        if len(switches) != 6 or not set(switches) <= {"0", "1"}:
            raise VehicleError(
                f"line {number}: found {quoted(line)}, expected a formulation and six of 0 and 1"
            )
        active[name.upper()] = [switch == "1" for switch in switches]
    return active


def _value(blocks: Mapping[str, _Block], block: str, key: str) -> float:
    if block not in blocks or key not in blocks[block].values:
        raise VehicleError(f"[{block}] {key}: missing")
    return _number(f"[{block}] {key}", blocks[block].values[key])


def _number(where: str, text: str) -> float:
    try:
        value = float(text.upper().replace("D", "E"))
    except ValueError:
        value = np.nan
    if not abs(value) < LARGEST:
        raise VehicleError(f"{where}: found {quoted(text)}, expected a number")
    return value


def _slope(name: str, blocks: Mapping[str, _Block]) -> float:
    """The slope of a curve that is a straight line.

    Raises:
        VehicleError: it is none; the text says its slopes.
    """
    if name not in blocks:
        raise VehicleError(f"[{name}]: missing")
    points = np.array(list(_points(name, blocks[name])))
    if len(points) < 2 or (np.diff(points[:, 0]) <= 0).any():
        raise VehicleError(f"[{name}]: expected two or more points of rising deflections")
    with np.errstate(over="ignore"):
        slopes = np.diff(points[:, 1]) / np.diff(points[:, 0])
    least, most = float(slopes.min()), float(slopes.max())
    if not np.isfinite([least, most]).all() or most - least > STRAIGHT * max(abs(most), abs(least)):
        at_rest = slopes[np.clip(np.searchsorted(points[:, 0], 0.0) - 1, 0, len(slopes) - 1)]
        raise VehicleError(
            f"[{name}]: is no straight line, its slope is {least:g} to {most:g} and {at_rest:g} at "
            "rest, in the file's units; expected a linear table: give the rate at the load it has as a "
            "number"
        )
    return float((points[-1, 1] - points[0, 1]) / (points[-1, 0] - points[0, 0]))


def _points(name: str, block: _Block) -> Iterator[list[float]]:
    for number, line in block.lines:
        if line[0] in "{(":  # the names of the columns, or of the table
            continue
        parts = line.replace(",", " ").split()
        if len(parts) != 2:
            raise VehicleError(
                f"line {number}: found {quoted(line)}, expected a deflection and a force of [{name}]"
            )
        yield [_number(f"line {number}", part) for part in parts]
