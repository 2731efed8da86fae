"""Matrices in Matrix Market's exchange format, which SciPy, MATLAB and many solvers write."""

import warnings
from pathlib import Path

import numpy as np
import scipy.io
import scipy.sparse as sp

from modeviz.errors import VehicleError, cut, located, reason
from modeviz.files.limits import check_size
from modeviz.formats.named_matrices import MOST_DOFS, MOST_ENTRIES, NamedMatrix

BEGINNING = b"%%MatrixMarket"

SHORTEST = 2
"""Bytes that an entry takes at least: its number and a line end."""


def read_market(path: Path) -> list[NamedMatrix]:
    """Return the matrix of a file, called as the file is.

    Raises:
        VehicleError: the file is damaged, cut, or has other numbers than it says.
    """
    with located(path), warnings.catch_warnings():
        warnings.simplefilter("error")
        try:
            rows, columns, entries, form, *_ = scipy.io.mminfo(path)
            check_size("degrees of freedom in a matrix", max(rows, columns), MOST_DOFS)
            written = entries if form == "coordinate" else rows * (columns + 1) // 2
            check_size("entries in a matrix", written, MOST_ENTRIES)
            if written > path.stat().st_size // SHORTEST:
                raise VehicleError(f"says that it has {entries:,} entries, which it has no room for")
            matrix = scipy.io.mmread(path)
        except VehicleError:
            raise
        except Exception as error:  # what SciPy's reader raises is not said
            text = cut(reason(error), 200)
            raise VehicleError(f"no whole Matrix Market file ({text})") from None
    return [NamedMatrix(path.stem, sp.csc_array(np.asarray(matrix) if form == "array" else matrix))]
