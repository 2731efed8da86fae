"""Road spectra as a table, one line for each frequency."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectra import FREQUENCY, read_spectrum_table, write_spectrum_table
from modeviz.files.tables import Row
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import Road

COLUMNS = (FREQUENCY, "left", "right", "cross_real", "cross_imag")
"""Both tracks' spectra and S_lr = E[L R*]."""

COHERENCE_EXCESS = 1e-3
"""How far above one the squared coherence of two tracks is for rounding: with numbers of five digits it
can be 2e-4."""


def read_road(
    path: Path,
    name: str,
    label: str,
    speed: float,
    conventions: Conventions,
    note: Callable[[str], None],
) -> Road:
    """The road whose spectra are in the file.

    Args:
        path: of the file.
        name: see `Road`, like what follows.
        label: of the road.
        speed: at which it was met.
        conventions: in whose length² per Hz the spectra are, unless their header says a unit.
        note: told what was left out or is likely wrong.

    Raises:
        VehicleError: no such file, or no road; the text names line and column.
    """
    table = read_spectrum_table(path, COLUMNS, ("left", "right"), "length", conventions, note)
    with located(path):
        left, right, real, imaginary = table.values.T
        S_lr = _coherent(table.rows, left, right, real + 1j * imaginary)
        spectrum = np.array([[left, S_lr], [S_lr.conj(), right]]).transpose(2, 0, 1)
        return Road(name, label, speed, table.frequency_hz, spectrum)


def write_road(path: Path, road: Road) -> None:
    """Writes the spectra in m²/Hz; every number reads back to the same bits."""
    S = road.spectrum
    S_lr = S[:, 0, 1]
    values = (road.frequency_hz, S[:, 0, 0].real, S[:, 1, 1].real, S_lr.real, S_lr.imag)
    write_spectrum_table(path, COLUMNS, values)


def _coherent(rows: tuple[Row, ...], left: Floats, right: Floats, cross: np.ndarray) -> np.ndarray:
    """The cross spectrum, with a coherence that is above one by rounding made one."""
    most, found = left * right, np.abs(cross) ** 2
    wrong = np.flatnonzero(found > most * (1 + COHERENCE_EXCESS))
    if wrong.size:
        i = wrong[0]
        raise VehicleError(
            f"line {rows[i].line}, columns {COLUMNS[3]} and {COLUMNS[4]}: found a coherence above one, "
            f"{found[i]:.5g} m⁴/Hz² as their square beside {most[i]:.5g} as left times right"
        )
    above = found > most
    ratio = np.sqrt(np.divide(most, found, out=np.ones_like(most), where=above))
    return cross * ratio
