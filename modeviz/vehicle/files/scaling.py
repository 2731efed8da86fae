"""The units that a vehicle file declares: its numbers into SI and back."""

from collections.abc import Callable, Mapping
from typing import Any

from modeviz.errors import VehicleError, located, unknown
from modeviz.units import UNITS, factor

WRITTEN_UNITS = {
    "length": "m",
    "mass": "kg",
    "inertia": "kg m²",
    "stiffness": "N/mm",
    "rotational_stiffness": "N m/rad",
    "damping": "N s/m",
    "force": "N",
    "unbalance": "g m",
    "speed": "km/h",
}
"""The units of the files we write."""

_QUANTITIES = {
    "speed": "speed",
    "mass": "mass",
    "inertia": "inertia",
    "center_of_gravity": "length",
    "at": "length",
    "wheel_center": "length",
    "trail": "length",
    "stiffness": "stiffness",
    "rates": "stiffness",
    "softest": "stiffness",
    "stiffest": "stiffness",
    "rotational_stiffness": "rotational_stiffness",
    "damping": "damping",
}
"""The quantity that a key's numbers are; the numbers of other keys have no unit."""

_AMPLITUDES = {"unbalance": "unbalance", "radial force": "force", "lateral force": "force"}
"""The quantity of a wheel load's amplitude, by the kind of load."""


def to_si(data: Any, units: Mapping[str, str]) -> Any:
    """The content of a vehicle file with every number in SI.

    Args:
        data: what the file says.
        units: its `units` table, quantity to unit.

    Raises:
        VehicleError: no such quantity or unit, or a quantity without a unit.
    """
    factors = {quantity: _factor(quantity, unit) for quantity, unit in units.items()}

    def convert(value: float, quantity: str) -> float:
        if quantity not in factors:
            known = ", ".join(UNITS[_spoken(quantity)])
            raise VehicleError(f"units.{quantity}: missing, expected one of {known}")
        return value * factors[quantity]

    return _converted(data, convert)


def from_si(data: Any) -> Any:
    """The content of a vehicle file, given in SI, in `WRITTEN_UNITS`."""
    return _converted(data, lambda value, quantity: written(value, _factor(quantity)))


def _factor(quantity: str, unit: str | None = None) -> float:
    """What one unit is in SI; the unit we write, if none is given."""
    if quantity not in WRITTEN_UNITS:
        raise VehicleError("units: " + unknown("quantity", quantity, WRITTEN_UNITS))
    with located(f"units.{quantity}"):
        return factor(unit or WRITTEN_UNITS[quantity], _spoken(quantity))


def _spoken(quantity: str) -> str:
    return quantity.replace("_", " ")


def written(value: float, unit: float) -> float:
    """The shortest number of units that reads back to the SI `value`, or else the nearest."""
    number = value / unit
    short = float(f"{number:.15g}")
    return short if short * unit == value else number


def _converted(data: Any, convert: Callable[[float, str], float], quantity: str | None = None) -> Any:
    """The data with `convert(value, quantity)` in place of each number that is a quantity."""
    if isinstance(data, dict):
        return {
            key: _converted(value, convert, _quantity(key, data, quantity))
            for key, value in data.items()
        }
    if isinstance(data, list | tuple):
        return [_converted(value, convert, quantity) for value in data]
    if quantity is None or isinstance(data, bool) or not isinstance(data, int | float):
        return data
    return convert(data, quantity)


def _quantity(key: str, table: Mapping[str, Any], whole: str | None) -> str | None:
    """The quantity of the numbers at `key` of `table`, which may be of one `whole`."""
    if key == "loss_factor" and not isinstance(table[key], dict):  # else a group of that name
        return None
    if whole:
        return whole
    return _AMPLITUDES.get(str(table.get("kind"))) if key == "amplitude" else _QUANTITIES.get(key)
