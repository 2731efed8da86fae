"""Road spectra as comma-separated text, one line for each frequency, m²/Hz."""

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.files.disk import read_text, write_text
from modeviz.vehicle.loads import Road

COLUMNS = ("frequency_hz", "left", "right", "cross_real", "cross_imag")
"""Both tracks' spectra and S_lr = E[L R*]."""


def read_road(path: Path, name: str, label: str, speed: float) -> Road:
    """The road whose spectra are in the file.

    Raises:
        VehicleError: no such file, a cut one, or no road.
    """
    frequency_hz, left, right, cross_real, cross_imag = read_columns(path, COLUMNS)
    S_lr = cross_real + 1j * cross_imag
    spectrum = np.array([[left, S_lr], [S_lr.conj(), right]]).transpose(2, 0, 1)
    with located(path):
        return Road(name, label, speed, frequency_hz, spectrum)


def write_road(path: Path, road: Road) -> None:
    """Writes the spectra; every number reads back to the same bits."""
    S = road.spectrum
    S_lr = S[:, 0, 1]
    columns = (road.frequency_hz, S[:, 0, 0].real, S[:, 1, 1].real, S_lr.real, S_lr.imag)
    rows = np.column_stack(columns).tolist()
    lines = [",".join(COLUMNS), *(",".join(map(repr, row)) for row in rows)]
    write_text(path, "\n".join(lines) + "\n")


def read_columns(path: Path, columns: Sequence[str]) -> Floats:
    """The columns of a file of numbers, (n_columns, n_rows).

    Raises:
        VehicleError: no such file, a cut one, or other columns.
    """
    text = read_text(path)
    if not text.endswith("\n"):
        raise VehicleError(f"{path}: the last line does not end; the file may be cut")
    header, *lines = text.splitlines()
    if header.split(",") != list(columns):
        raise VehicleError(f"{path}: line 1: found {header!r}, expected {','.join(columns)}")
    rows = [_row(line, len(columns), f"{path}: line {n}") for n, line in enumerate(lines, 2)]
    return np.array(rows).reshape(-1, len(columns)).T


def _row(line: str, n_columns: int, where: str) -> list[float]:
    try:
        numbers = [float(cell) for cell in line.split(",")]
    except ValueError:
        numbers = []
    if len(numbers) != n_columns:
        raise VehicleError(f"{where}: found {line!r}, expected {n_columns} numbers")
    return numbers
