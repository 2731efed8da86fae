"""Where mounts are as people write it: "C1=20,0,-10 mm" is moved, "C1=0,5,0 deg" is turned."""

import re
from collections.abc import Iterable
from dataclasses import replace

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.units import UNITS, QuantityName, parse
from modeviz.vehicle.placement import Placement, Placements

FIELDS: dict[QuantityName, str] = {"length": "offset", "angle": "angles"}
"""The field of `Placement` that a quantity is of."""

FORM = re.compile(r"([^,]+),([^,]+),\s*([^,\s]+)\s*([^\d,\s][^,]*)")


def parse_placements(texts: Iterable[str]) -> Placements:
    """Return the placements of mount groups, each said by one text or two.

    Args:
        texts: "GROUP=X,Y,Z UNIT", along or about the vehicle's axes.

    Raises:
        VehicleError: one is not of that form, or has a unit of neither lengths nor angles; or two say
            the same of a group.
    """
    placements: dict[str, Placement] = {}
    said: set[tuple[str, str]] = set()
    for text in texts:
        group, _, value = text.partition("=")
        group = group.strip()
        with located(f"place {quoted(text)}"):
            field, values = _parse(value)
            if (group, field) in said:
                way = "moved" if field == "offset" else "turned"
                raise VehicleError(f"{quoted(group)} is {way} twice, expected once")
            said.add((group, field))
            placements[group] = replace(placements.get(group, Placement()), **{field: values})
    return placements


def _parse(value: str) -> tuple[str, tuple[float, ...]]:
    """The field of `Placement` and its values, m or rad."""
    found = FORM.fullmatch(value.strip())
    if found is None:
        raise VehicleError(
            "expected GROUP=X,Y,Z UNIT, as in C1=20,0,-10 mm (moved) or C1=0,5,0 deg (turned)"
        )
    *numbers, unit = map(str.strip, found.groups())
    quantity: QuantityName | None = next((q for q in FIELDS if unit in UNITS[q]), None)
    if quantity is None:
        known = listed(name for q in FIELDS for name in UNITS[q])
        raise VehicleError(f"found the unit {quoted(unit)}, expected one of {known}")
    return FIELDS[quantity], tuple(parse(f"{number} {unit}", quantity) for number in numbers)
