"""The spectrum of one quantity as comma-separated text, one line for each frequency."""

from collections.abc import Callable
from pathlib import Path

import numpy as np

from modeviz.errors import located
from modeviz.files.disk import write_text
from modeviz.files.schema.conventions import Conventions
from modeviz.files.spectrum_tables import read_spectrum_table
from modeviz.units import QuantityName
from modeviz.vehicle.loads import Spectrum

COLUMNS = ("frequency_hz", "psd")
"""The PSD in the square of the quantity's unit per Hz."""


def read_spectrum(
    path: Path, quantity: QuantityName, conventions: Conventions, note: Callable[[str], None]
) -> Spectrum:
    """The spectrum in a file, SI.

    Args:
        path: of the file.
        quantity: of what.
        conventions: with the unit of that quantity, for a header that says none.
        note: told what was left out or is likely wrong.

    Raises:
        VehicleError: no such file, or no spectrum; the text names line and column.
    """
    table = read_spectrum_table(path, COLUMNS, ("psd",), quantity, conventions, note)
    with located(path):
        return Spectrum(table.frequency_hz, table.values[:, 0])


def write_spectrum(path: Path, spectrum: Spectrum) -> None:
    """Writes a spectrum, SI; every number reads back to the same bits."""
    rows = np.column_stack([spectrum.frequency_hz, spectrum.power]).tolist()
    lines = [",".join(COLUMNS), *(",".join(map(repr, row)) for row in rows)]
    write_text(path, "\n".join(lines) + "\n")
