"""Frequency responses and power spectra as comma-separated text, a column for each."""

import csv
from collections.abc import Iterator
from io import StringIO

import numpy as np

from modeviz.export.functions import UNITS, Function, Functions
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Floats


def function_table(functions: Functions) -> bytes:
    """Return functions in UTF-8, with units in the header; PSDs in g²/Hz, as they are printed."""
    columns = [("frequency [Hz]", functions.frequency_hz)]
    for function in functions.functions:
        columns += _columns(functions.title(function), function)
    text = StringIO()
    table = csv.writer(text, lineterminator="\n")
    table.writerow(name for name, _ in columns)
    table.writerows(np.column_stack([values for _, values in columns]).tolist())
    return text.getvalue().encode()


def _columns(title: str, function: Function) -> Iterator[tuple[str, Floats]]:
    if function.reference is None:
        yield f"{title} [g^2/Hz]", function.values / STANDARD_GRAVITY**2
        return
    unit = f"(m/s^2)/({UNITS[function.reference.quantity]})"
    yield f"{title}, real [{unit}]", np.real(function.values)
    yield f"{title}, imaginary [{unit}]", np.imag(function.values)
