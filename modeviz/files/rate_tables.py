"""Tables of a mount's rates over frequency, as test rigs write them, one line for each frequency.

Of each direction, or of all alike, a table has `stiffness`, the magnitude |k| that a rig measures, or
`ratio`, the same in parts of any one rate, with `loss_angle` or `loss_factor` beside it if it is known;
or both parts of k: `storage` and `loss`. Lines of several amplitudes may stand in one table.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectra import FREQUENCY, open_table, write_spectrum_table
from modeviz.files.tables import Row
from modeviz.files.untold_units import note_untold_units
from modeviz.units import QuantityName, factor
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.dynamic_rates import RateTable
from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS

SIZES = ("stiffness", "ratio", "storage")
LOSSES = ("loss_angle", "loss_factor", "loss")
AMPLITUDE = "amplitude"

QUANTITIES = (*SIZES, *LOSSES)
COLUMNS = (*QUANTITIES, *(f"{d}_{q}" for d in STIFFNESS_FIELDS for q in QUANTITIES), AMPLITUDE)
"""All that a table may have beside its frequencies."""

WRITTEN = (FREQUENCY, *(f"{d}_{part} (N/m)" for d in STIFFNESS_FIELDS for part in ("storage", "loss")))

TOLD_IN: Mapping[str, QuantityName] = {
    AMPLITUDE: "length",
    **{
        prefix + name: "stiffness"
        for prefix in ("", *(f"{d}_" for d in STIFFNESS_FIELDS))
        for name in ("stiffness", "storage", "loss")
    },
}
"""What the columns are of that have a unit of [units]."""

PER_RADIAN: Mapping[str, float] = {"deg": pi / 180, "°": pi / 180, "degrees": pi / 180, "rad": 1.0}
"""Radians of one of each."""

RIGHT_ANGLE = pi / 2

AXES = (2, 1, 0)
"""Of `STIFFNESS_FIELDS` among x, y, z."""


@dataclass(frozen=True)
class _Columns:
    """What a table has of one direction."""

    size: str
    loss: str | None


def read_rate_table(
    path: Path,
    reference_hz: float,
    amplitude: float | None,
    conventions: Conventions,
    note: Callable[[str], None],
) -> RateTable:
    """The rates over frequency in a file.

    A direction of which it has no column has the same rate at all frequencies; one of which it has no
    loss has the loss factor that the first other direction has at the reference.

    Args:
        path: of the file.
        reference_hz: at which a mount has the rates of its group.
        amplitude: m, whose lines are taken of a table of several.
        conventions: with the units of stiffness and length, for headers that say none.
        note: told what is likely wrong.

    Raises:
        VehicleError: no such file, or no such table; the text names line and column.
    """
    table = open_table(path, note, (FREQUENCY,), COLUMNS, _check_header)
    with located(path):
        factors = {name: _factor(name, unit, conventions) for name, unit in table.units.items()}
        note_untold_units(path.name, table.units, TOLD_IN, conventions, note)
        rows, taken = _of_amplitude(table.rows, amplitude, factors)
        f = _rising(rows)
        columns = {d: _of_direction(d, table.units) for d in STIFFNESS_FIELDS}
        known = {d: _rates(rows, own, factors) for d, own in columns.items() if own}
        with_loss = [known[d] for d, own in columns.items() if own and own.loss]
        loss_factor = _loss_factor(np.interp(reference_hz, f, with_loss[0])) if with_loss else 0.0
        rates = np.full((len(f), 3), 1 + 1j * loss_factor)
        for axis, direction in zip(AXES, STIFFNESS_FIELDS, strict=True):
            own = columns[direction]
            if own:
                lossless = 1.0 if own.loss else 1 + 1j * loss_factor
                rates[:, axis] = known[direction] * lossless
        return RateTable(reference_hz=reference_hz, frequency_hz=f, rates=rates, amplitude=taken)


def write_rate_table(path: Path, table: RateTable) -> None:
    """Writes both parts of the rates, N/m; every number reads back to the same bits."""
    names = WRITTEN
    columns = [part(table.rates[:, axis]) for axis in AXES for part in (np.real, np.imag)]
    if table.amplitude is not None:
        names = (*WRITTEN, f"{AMPLITUDE} (m)")
        columns.append(np.full(len(table.frequency_hz), table.amplitude))
    write_spectrum_table(path, names, [table.frequency_hz, *columns])


def _loss_factor(rate: complex) -> float:
    return rate.imag / rate.real if rate.real else 0.0


def _check_header(units: Mapping[str, str]) -> None:
    """Raises VehicleError for columns that do not go together."""
    found = [d for d in STIFFNESS_FIELDS if _of_direction(d, units)]
    if not found:
        raise VehicleError(f"found {listed(units)}, expected stiffness, ratio or storage beside them")


def _of_direction(direction: str, units: Mapping[str, str]) -> _Columns | None:
    """The columns of a direction, or else those of all directions; None if there are none.

    Raises:
        VehicleError: two that say the same, or one that says nothing alone.
    """
    for prefix in (f"{direction}_", ""):
        sizes = [prefix + name for name in SIZES if prefix + name in units]
        losses = [prefix + name for name in LOSSES if prefix + name in units]
        if not sizes and not losses:
            continue
        if len(sizes) != 1 or len(losses) > 1:
            raise VehicleError(
                f"found {listed([*sizes, *losses])}, expected one of {listed(SIZES)} of a direction "
                f"and at most one of {listed(LOSSES)}"
            )
        loss = next(iter(losses), None)
        is_storage, is_loss = sizes[0] == prefix + "storage", loss == prefix + "loss"
        if is_loss and not is_storage:
            raise VehicleError(f"found {sizes[0]} beside {loss}, expected {prefix}storage beside it")
        return _Columns(sizes[0], loss)
    return None


def _factor(name: str, unit: str, conventions: Conventions) -> float:
    """One of a column in SI: N/m, rad or m; one of what has no unit."""
    kind = next((q for q in QUANTITIES if name in (q, *(f"{d}_{q}" for d in STIFFNESS_FIELDS))), name)
    with located(f"column {name}"):
        match kind:
            case "stiffness" | "storage" | "loss":
                return factor(unit, "stiffness") if unit else conventions.unit("stiffness")
            case "amplitude":
                return factor(unit, "length") if unit else conventions.unit("length")
            case "loss_angle":
                if unit.lower() not in PER_RADIAN:
                    words = f"found the unit {quoted(unit)}" if unit else "found no unit"
                    raise VehicleError(f'{words}, expected deg or rad in brackets: "{name} (deg)"')
                return PER_RADIAN[unit.lower()]
        if unit and kind != FREQUENCY:
            raise VehicleError(f"found the unit {quoted(unit)}, expected none")
        return 1.0


def _of_amplitude(
    rows: Sequence[Row], amplitude: float | None, factors: Mapping[str, float]
) -> tuple[Sequence[Row], float | None]:
    """The lines of one amplitude, and that, m; None if the table says none.

    Raises:
        VehicleError: none was chosen of several, or one that is not there.
    """
    if AMPLITUDE not in factors:
        if amplitude is not None:
            raise VehicleError(f"found no column {AMPLITUDE}: leave the key amplitude out")
        return rows, None
    by_row = [row.number(AMPLITUDE, at_least=0) * factors[AMPLITUDE] for row in rows]
    known = sorted(set(by_row))
    if amplitude is None and len(known) == 1:
        return rows, known[0]
    wanted = [value for value in known if amplitude is not None and np.isclose(value, amplitude)]
    if not wanted:
        found = "none" if amplitude is None else f"{1000 * amplitude:g} mm"
        every = ", ".join(f"{1000 * value:g}" for value in known)
        raise VehicleError(f"amplitude: found {found}, expected one of the table's, {every} mm")
    taken = [row for row, value in zip(rows, by_row, strict=True) if value == wanted[0]]
    return taken, wanted[0]


def _rising(rows: Sequence[Row]) -> Floats:
    """The frequencies; raises VehicleError unless there are some, which rise."""
    if not rows:
        raise VehicleError("found no lines below the header, expected one for each frequency")
    f = np.array([row.number(FREQUENCY, at_least=0) for row in rows])
    wrong = np.flatnonzero(np.diff(f) <= 0)
    if wrong.size:
        row, before = rows[wrong[0] + 1], f[wrong[0]]
        raise VehicleError(
            f"{row.where(FREQUENCY)}: found {row.cells[FREQUENCY]} after {before:g}, expected rising "
            "values; lines of several amplitudes need a column amplitude"
        )
    return f


def _rates(rows: Sequence[Row], columns: _Columns, factors: Mapping[str, float]) -> Complexes:
    """K (1 + jg) of one direction, (n,), N/m or in parts."""
    size = np.array([row.number(columns.size, at_least=0) for row in rows]) * factors[columns.size]
    if columns.loss is None:
        return size.astype(complex)
    loss = np.array([row.number(columns.loss, at_least=0) for row in rows]) * factors[columns.loss]
    if columns.loss.endswith("loss"):
        return size + 1j * loss
    if columns.loss.endswith("loss_angle"):
        _check_angles(rows, columns.loss, loss)
        tangent = np.tan(loss)
    else:
        tangent = loss
    unit = (1 + 1j * tangent) / np.hypot(1, tangent)
    return size * (1 + 1j * tangent if columns.size.endswith("storage") else unit)


def _check_angles(rows: Sequence[Row], column: str, angles: Floats) -> None:
    """Raises VehicleError for an angle of no loss in rubber."""
    wrong = np.flatnonzero(angles >= RIGHT_ANGLE)
    if wrong.size:
        row = rows[wrong[0]]
        raise VehicleError(
            f"{row.where(column)}: found {row.cells[column]}, expected less than a right angle"
        )
