"""Tables of the orders of an engine over its speed, one line for each order at each speed.

Beside `speed` and `order` stand peak values of what the engine does to its body: `torque` about its
crank, `force_x` to `force_z` and `moment_x` to `moment_z` along and about the file's axes, each with a
`_phase` to the crank's angle if it is known.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from math import pi
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectra import open_table, write_spectrum_table
from modeviz.files.tables import Row
from modeviz.files.untold_units import note_untold_units
from modeviz.units import QuantityName, factor
from modeviz.vehicle.arrays import Complexes, Floats

ALONG = ("force_x", "force_y", "force_z", "moment_x", "moment_y", "moment_z")
TORQUE = "torque"
VALUES = (*ALONG, TORQUE)
QUANTITIES: Mapping[str, QuantityName] = {
    name: "force" if name.startswith("force") else "torque" for name in VALUES
}
COLUMNS = (*VALUES, *(f"{name}_phase" for name in VALUES))
SPEED, ORDER = "speed", "order"

WRITTEN = (
    f"{SPEED} (rpm)",
    ORDER,
    *(f"{name} ({'N' if name.startswith('f') else 'N m'})" for name in ALONG),
    *(f"{name}_phase (rad)" for name in ALONG),
)

PER_SECOND: Mapping[str, float] = {
    "rpm": 1 / 60,
    "1/min": 1 / 60,
    "r/min": 1 / 60,
    "hz": 1.0,
    "rad/s": 1 / (2 * pi),
}
"""Revolutions per second of one of each."""

MOST_NAMED = 5
"""Speeds in a sentence."""

RADIANS: Mapping[str, float] = {"deg": pi / 180, "°": pi / 180, "rad": 1.0}

Orders = dict[float, tuple[Floats, Complexes]]
"""Of each order, revolutions per second, (n_speeds,), rising, and force and moment, (n_speeds, 6)."""


def read_orders(
    path: Path, crank: Floats | None, conventions: Conventions, note: Callable[[str], None]
) -> Orders:
    """The orders in a file.

    Args:
        path: of the file.
        crank: (3,), the unit vector about which a torque acts; None: not known.
        conventions: with the units of force and torque, for headers that say none, and the file's axes.
        note: told what is likely wrong.

    Raises:
        VehicleError: no such file, or no such table; the text names line and column.
    """
    table = open_table(path, note, (SPEED, ORDER), COLUMNS, lambda units: _check_header(units, crank))
    with located(path):
        factors = {name: _factor(name, unit, conventions) for name, unit in table.units.items()}
        if not table.rows:
            raise VehicleError("found no lines below the header, expected one for each order and speed")
        found: dict[float, list[tuple[Row, float, Complexes]]] = {}
        for row in table.rows:
            speed, order = (row.number(name, at_least=0) for name in (SPEED, ORDER))
            if not order:
                raise VehicleError(
                    f"{row.where(ORDER)}: found 0, expected more: the mean shakes nothing"
                )
            load = _load(row, factors, crank, conventions)
            found.setdefault(order, []).append((row, speed * factors[SPEED], load))
        orders = {order: _rising(lines) for order, lines in sorted(found.items())}
        note_untold_units(path.name, table.units, QUANTITIES, conventions, note)
        for missing in _missing(orders):
            note(f"{path.name}: {missing}")
        return orders


def write_orders(path: Path, orders: Orders) -> None:
    """Writes a table that `read_orders` reads, in our axes."""
    blocks = []
    for order, (speed_hz, loads) in orders.items():
        head = np.column_stack([60 * speed_hz, np.full(len(speed_hz), order)])
        blocks.append(np.hstack([head, np.abs(loads), np.angle(loads)]))
    write_spectrum_table(path, WRITTEN, list(np.vstack(blocks).T))


def _check_header(units: Mapping[str, str], crank: Floats | None) -> None:
    """Raises VehicleError for columns that do not go together."""
    if not any(name in units for name in VALUES):
        raise VehicleError(
            f"found {listed(units)}, expected one or more of {listed(VALUES)} beside them"
        )
    for name in units:
        if name.endswith("_phase") and name.removesuffix("_phase") not in units:
            raise VehicleError(f"found {name} without {name.removesuffix('_phase')}")
    if TORQUE in units and crank is None:
        raise VehicleError(
            "found torque, of a body without a crank: give the engine or its body a crank_axis"
        )


def _factor(name: str, unit: str, conventions: Conventions) -> float:
    """One of a column in SI."""
    with located(f"column {name}"):
        if name in QUANTITIES:
            quantity = QUANTITIES[name]
            return factor(unit, quantity) if unit else conventions.unit(quantity)
        if name == ORDER:
            return 1.0
        known = PER_SECOND if name == SPEED else RADIANS
        if unit.lower() not in known:
            words = f"found the unit {quoted(unit)}" if unit else "found no unit"
            raise VehicleError(f"{words}, expected {' or '.join(known)} in brackets")
        return known[unit.lower()]


def _missing(orders: Orders) -> Iterator[str]:
    """A sentence on each order that is not given at all speeds of the table."""
    every = np.unique(np.concatenate([speed_hz for speed_hz, _ in orders.values()]))
    for order, (speed_hz, _) in orders.items():
        rpm = [f"{60 * speed:g}" for speed in np.setdiff1d(every, speed_hz)]
        if rpm:
            more = f" and {len(rpm) - MOST_NAMED} more" if len(rpm) > MOST_NAMED else ""
            at = f"{', '.join(rpm[:MOST_NAMED])}{more}"
            yield (
                f"order {order:g} is missing at {at} rpm, where others are given: it goes straight "
                "between its own speeds, and is nothing beyond them"
            )


def _load(
    row: Row, factors: Mapping[str, float], crank: Floats | None, conventions: Conventions
) -> Complexes:
    """Force and moment of a line, (6,), in our axes."""
    peaks = {name: _phasor(row, name, factors) for name in VALUES}
    values: Complexes = np.array([peaks[name] for name in ALONG], complex)
    load = values.reshape(2, 3) @ conventions.axes.T
    if crank is not None:
        load[1] += peaks[TORQUE] * crank
    return np.asarray(load.ravel(), complex)


def _phasor(row: Row, name: str, factors: Mapping[str, float]) -> complex:
    if name not in factors:
        return 0j
    phase = f"{name}_phase"
    angle = row.number(phase) * factors[phase] if phase in factors else 0.0
    return complex(row.number(name) * factors[name] * np.exp(1j * angle))


def _rising(lines: Sequence[tuple[Row, float, Complexes]]) -> tuple[Floats, Complexes]:
    """Speeds and loads of an order; raises VehicleError unless speeds rise, from above zero."""
    before = 0.0
    for row, speed, _ in lines:
        if speed <= before:
            raise VehicleError(
                f"{row.where(SPEED)}: found {row.cells[SPEED]} at order {row.cells[ORDER]}, expected "
                "speeds of each order to rise, from above zero"
            )
        before = speed
    return np.array([speed for _, speed, _ in lines]), np.array([load for _, _, load in lines])
