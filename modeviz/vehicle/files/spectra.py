"""The spectrum of one quantity as comma-separated text, one line for each frequency."""

from pathlib import Path

import numpy as np

from modeviz.errors import located
from modeviz.vehicle.files.disk import write_text
from modeviz.vehicle.files.roads import read_columns
from modeviz.vehicle.loads import Spectrum

COLUMNS = ("frequency_hz", "psd")
"""The PSD in the square of the quantity's unit per Hz."""


def read_spectrum(path: Path, unit: float) -> Spectrum:
    """The spectrum in a file, SI.

    Args:
        path: of the file.
        unit: what one unit of the quantity is in SI.

    Raises:
        VehicleError: no such file, a cut one, or no spectrum.
    """
    frequency_hz, psd = read_columns(path, COLUMNS)
    with located(path):
        return Spectrum(frequency_hz, psd * unit**2)


def write_spectrum(path: Path, spectrum: Spectrum) -> None:
    """Writes a spectrum, SI; every number reads back to the same bits."""
    rows = np.column_stack([spectrum.frequency_hz, spectrum.power]).tolist()
    lines = [",".join(COLUMNS), *(",".join(map(repr, row)) for row in rows)]
    write_text(path, "\n".join(lines) + "\n")
