"""Conversion between the units people write and plain SI."""

import math
import re
import unicodedata
from collections import Counter
from typing import Literal

from modeviz.errors import ModevizError, quoted, unknown

STANDARD_GRAVITY = 9.80665
"""m/s², the g of every acceleration in g."""

INCH = 0.0254
"""m, exact, as the pound is (International Yard and Pound Agreement, 1959)."""

POUND = 0.45359237
"""kg."""

QuantityName = Literal[
    "length",
    "mass",
    "inertia",
    "stiffness",
    "rotational_stiffness",
    "damping",
    "rotational_damping",
    "force",
    "torque",
    "acceleration",
    "unbalance",
    "speed",
    "roughness",
    "angle",
]
"""As the `units` tables of files have them."""

UNITS: dict[QuantityName, dict[str, float]] = {
    "length": {"m": 1.0, "mm": 1e-3, "cm": 1e-2, "in": INCH, "ft": 12 * INCH},
    "mass": {
        "kg": 1.0,
        "t": 1e3,
        "lb": POUND,
        "slug": POUND * STANDARD_GRAVITY / (12 * INCH),
        "lbf s²/in": POUND * STANDARD_GRAVITY / INCH,
        "lbf s^2/in": POUND * STANDARD_GRAVITY / INCH,
    },
    "inertia": {
        "kg m²": 1.0,
        "kg m^2": 1.0,
        "kg mm²": 1e-6,
        "kg mm^2": 1e-6,
        "t mm²": 1e-3,
        "t mm^2": 1e-3,
        "lb in²": POUND * INCH**2,
        "lb in^2": POUND * INCH**2,
        "lbf in s²": POUND * STANDARD_GRAVITY * INCH,
        "lbf in s^2": POUND * STANDARD_GRAVITY * INCH,
    },
    "stiffness": {
        "N/m": 1.0,
        "N/mm": 1e3,
        "N/cm": 1e2,
        "kN/mm": 1e6,
        "kN/m": 1e3,
        "lbf/in": POUND * STANDARD_GRAVITY / INCH,
    },
    "rotational_stiffness": {
        "N m/rad": 1.0,
        "N m/deg": 180 / math.pi,
        "N mm/rad": 1e-3,
        "kN m/rad": 1e3,
        "lbf in/rad": POUND * STANDARD_GRAVITY * INCH,
    },
    "damping": {
        "N s/m": 1.0,
        "N s/mm": 1e3,
        "kN s/m": 1e3,
        "lbf s/in": POUND * STANDARD_GRAVITY / INCH,
    },
    "rotational_damping": {"N m s/rad": 1.0, "N m s/deg": 180 / math.pi, "N mm s/rad": 1e-3},
    "force": {"N": 1.0, "kN": 1e3, "lbf": POUND * STANDARD_GRAVITY},
    "torque": {
        "N m": 1.0,
        "kN m": 1e3,
        "N mm": 1e-3,
        "lbf in": POUND * STANDARD_GRAVITY * INCH,
        "lbf ft": POUND * STANDARD_GRAVITY * 12 * INCH,
    },
    "acceleration": {"m/s²": 1.0, "m/s^2": 1.0, "mm/s²": 1e-3, "mm/s^2": 1e-3, "g": STANDARD_GRAVITY},
    "unbalance": {"kg m": 1.0, "g m": 1e-3, "g mm": 1e-6, "oz in": POUND / 16 * INCH},
    "speed": {"m/s": 1.0, "km/h": 1 / 3.6, "mph": 0.44704},
    "angle": {"deg": math.pi / 180, "rad": 1.0},
    "roughness": {"m³": 1.0, "m^3": 1.0, "cm³": 1e-6, "cm^3": 1e-6, "mm³": 1e-9, "mm^3": 1e-9},
}
"""For each quantity, what one of the unit is in SI."""

WRITTEN_UNITS: dict[QuantityName, str] = {
    "length": "m",
    "mass": "kg",
    "inertia": "kg m²",
    "stiffness": "N/mm",
    "rotational_stiffness": "N m/rad",
    "damping": "N s/m",
    "rotational_damping": "N m s/rad",
    "force": "N",
    "torque": "N m",
    "acceleration": "m/s²",
    "unbalance": "g m",
    "speed": "km/h",
    "roughness": "cm³",
    "angle": "deg",
}
"""The units of the files and tables we write, and in which people read rates."""

NUMBER_AND_UNIT = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(\D.*)?", re.ASCII)


def spoken(quantity: QuantityName) -> str:
    """Return what a person calls a quantity."""
    return quantity.replace("_", " ")


def si_unit(quantity: QuantityName) -> str:
    """Return the first unit that is one of a quantity in SI."""
    return next(unit for unit, value in UNITS[quantity].items() if value == 1.0)


def factor(unit: str, quantity: QuantityName) -> float:
    """One `unit` of `quantity` in SI.

    Raises:
        ModevizError: the unit is not one of that quantity's.
    """
    units = UNITS[quantity]
    if unit not in units:
        raise ModevizError(unknown(f"unit of {spoken(quantity)}", unit, units))
    return units[unit]


def psd_factor(unit: str, quantity: QuantityName) -> float:
    """One unit of the PSD of a quantity in SI: of mm²/Hz, or (m/s²)²/Hz, or m²/s⁴/Hz.

    Raises:
        ModevizError: the unit is not the square of one of that quantity's per Hz.
    """
    found = _psd_powers(unit)
    for known, value in UNITS[quantity].items():
        if found == _squared(_powers(known)):
            return value**2
    squares = [f"({u})²/Hz" if "/" in u else f"{u}²/Hz" for u in UNITS[quantity] if "^" not in u]
    raise ModevizError(f"found the unit {quoted(unit)}, expected one of {', '.join(squares)}")


def spatial_psd_factor(unit: str, is_angular: bool) -> float:
    """One unit of a spectrum over cycles by length in m²/(cycle/m): of m³, mm²/(cycle/m), m³/rad.

    Args:
        unit: of lengths to the third power, by cycle or by rad.
        is_angular: whether it is by rad, where it says neither.

    Raises:
        ModevizError: it is not such a unit.
    """
    unnested = re.sub(r"/\s*\(\s*(\w+)\s*/\s*(\w+)\s*\)", r" \2/\1", _level(unit))
    powers = _powers(unnested)
    counted = {part: powers.pop(part) for part in ("cycle", "cycles", "rad") if part in powers}
    lengths = UNITS["length"]
    if counted not in ({}, {"cycle": -1}, {"cycles": -1}, {"rad": -1}) or (
        not set(powers) <= set(lengths) or sum(powers.values()) != 3
    ):
        raise ModevizError(
            f"found the unit {quoted(unit)}, expected such as m³, mm²/(cycle/m) or m²/(rad/m)"
        )
    per_radian = is_angular if not counted else "rad" in counted
    length = math.prod(lengths[part] ** power for part, power in powers.items())
    return length * (2 * math.pi if per_radian else 1.0)


def _psd_powers(unit: str) -> Counter[str]:
    """The power of each part of a unit that should be a square per Hz; none of another's."""
    level = _level(unit)
    square = re.fullmatch(r"\((.+)\)2\s*/\s*Hz", level)
    if square:
        return _squared(_powers(square[1]))
    powers = _powers(level)
    powers["Hz"] += 1
    return Counter({part: power for part, power in powers.items() if power})


def _squared(powers: Counter[str]) -> Counter[str]:
    return Counter({part: 2 * power for part, power in powers.items()})


def _powers(unit: str) -> Counter[str]:
    """The power of each part of a unit: of m/s² one for m and -2 for s."""
    powers: Counter[str] = Counter()
    above, *below = _level(unit).split("/")
    for sign, parts in ((1, above), *((-1, parts) for parts in below)):
        for part, power in re.findall(r"([^\W\d]+)(-?\d+)?", parts):
            powers[part] += sign * int(power or 1)
    return powers


def _level(unit: str) -> str:
    """A unit with powers as plain numbers behind what they are of, and Hz spelled so."""
    level = unicodedata.normalize("NFKD", unit).replace("−", "-").replace("^", "")
    return re.sub("hz", "Hz", level, flags=re.IGNORECASE)


def parse(text: str, quantity: QuantityName) -> float:
    """The SI value of a text such as "131 N/mm".

    Raises:
        ModevizError: no number, no unit, a unit of something else, or not finite.
    """
    parts = NUMBER_AND_UNIT.fullmatch(text.strip())
    if parts is None:
        raise ModevizError(f"found {quoted(text)}, expected a number and a unit of {spoken(quantity)}")
    number, unit = parts.groups()
    if not unit:
        units = ", ".join(UNITS[quantity])
        raise ModevizError(f"found {quoted(text)} without a unit, expected one of {units}")
    return _finite(float(number) * factor(unit, quantity), text)


def parse_number(text: str) -> float:
    """The value of a text such as "0.2".

    Raises:
        ModevizError: no number, something behind it, or not finite.
    """
    parts = NUMBER_AND_UNIT.fullmatch(text.strip())
    if parts is None or parts[2]:
        raise ModevizError(f"found {quoted(text)}, expected a number without a unit")
    return _finite(float(parts[1]), text)


def _finite(value: float, text: str) -> float:
    if not math.isfinite(value):
        raise ModevizError(f"found {quoted(text)}, expected a finite number")
    return value
