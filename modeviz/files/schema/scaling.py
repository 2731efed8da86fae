"""The units that a vehicle file declares: its numbers into SI and back."""

from collections.abc import Callable, Mapping
from typing import Any

from modeviz.errors import Fault, FaultsError, VehicleError, at_key, unknown
from modeviz.files.schema.hints import each_annotated
from modeviz.files.schema.quantities import Quantity
from modeviz.units import UNITS, WRITTEN_UNITS, QuantityName, factor

BEYOND_ANY_VEHICLE = 1e15
"""In SI: of any quantity."""

_BOUNDS: Mapping[QuantityName, tuple[float, float]] = {
    "length": (0.0, 1e6),
    "mass": (1e-9, 1e9),
    "inertia": (1e-15, BEYOND_ANY_VEHICLE),
    "speed": (1e-6, 1e6),
    "roughness": (1e-15, 1e3),
}
"""The least that is not zero and the most of a quantity, in SI: beyond it nothing can be computed."""


def to_si(data: Any, kind: type, units: Mapping[str, str]) -> Any:
    """The content of a file with every number in SI.

    Args:
        data: what the file says.
        kind: the record that it is.
        units: its `units` table, quantity to unit.

    Raises:
        VehicleError: no such quantity or unit, a quantity without a unit, or a number that no vehicle
            has.
    """
    with at_key("units"):
        factors = factors_of(units)

    def convert(value: float, quantity: QuantityName, where: str) -> float:
        if quantity not in factors:
            raise FaultsError(Fault(f"units.{quantity}", _missing(quantity)))
        unit = factors[quantity]
        least, most = _BOUNDS.get(quantity, (0.0, BEYOND_ANY_VEHICLE))
        if value and not least <= abs(value) * unit <= most:
            words = f"{least / unit:.3g} to {most / unit:.3g}" if least else f"up to {most / unit:.3g}"
            raise FaultsError(Fault(where, f"found {value:g} {units[quantity]}, expected {words}"))
        return value * unit

    return _converted(data, kind, convert)


def unit_in_si(quantity: str, units: Mapping[str, str]) -> float:
    """One unit of a quantity in SI.

    Args:
        quantity: a key of `units` tables.
        units: such a table, quantity to unit.

    Raises:
        VehicleError: none is said, or no such quantity or unit.
    """
    if quantity in UNITS and quantity not in units:
        raise VehicleError(f"units.{quantity}: {_missing(quantity)}")
    return factors_of(units)[quantity]


def from_si(data: Any, kind: type, units: Mapping[Any, str] = WRITTEN_UNITS) -> Any:
    """The content of a file of that kind, given in SI, in those units, quantity to unit."""

    def convert(value: float, quantity: QuantityName, _where: str) -> float:
        return written(value, factor(units[quantity], quantity))

    return _converted(data, kind, convert)


def written(value: float, unit: float) -> float:
    """The shortest number of units that reads back to the SI `value`, or else the nearest."""
    number = value / unit
    short = float(f"{number:.15g}")
    return short if short * unit == value else number


def factors_of(units: Mapping[str, str]) -> dict[str, float]:
    """One unit of each quantity of a `units` table in SI.

    Raises:
        FaultsError: there is no such quantity or unit.
    """
    factors: dict[str, float] = {}
    for quantity, unit in units.items():
        with at_key(quantity):
            if quantity not in UNITS:
                raise VehicleError(unknown("quantity", quantity, UNITS))
            factors[quantity] = factor(unit, quantity)
    return factors


def _missing(quantity: QuantityName) -> str:
    return f"missing, expected one of {', '.join(UNITS[quantity])}"


def _converted(data: Any, kind: type, convert: Callable[[float, QuantityName, str], float]) -> Any:
    """The data with `convert(value, quantity, where)` in place of each number that has a unit."""

    def change(value: Any, quantity: Quantity, table: Mapping[str, Any], where: str) -> Any:
        if isinstance(value, list | tuple):
            return [change(inner, quantity, table, where) for inner in value]
        is_number = isinstance(value, int | float) and not isinstance(value, bool)
        return convert(value, quantity.named(table), where) if is_number else value

    return each_annotated(data, kind, Quantity, change)
