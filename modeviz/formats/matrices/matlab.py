"""Matrices in MATLAB's `.mat` files: of versions 4 to 7, and of 7.3, which is HDF5, by h5py."""

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, listed, located, reason
from modeviz.files.disk import opened, read_bytes
from modeviz.files.limits import check_size
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.matrices.mat_variables import variables
from modeviz.formats.named_matrices import MOST_DOFS, MOST_ENTRIES, NamedMatrix

NUMBERS = frozenset(
    {
        "sparse",
        "double",
        "single",
        *(f"{sign}int{bits}" for sign in ("", "u") for bits in (8, 16, 32, 64)),
    }
)
"""Kinds of variables that may be matrices."""

MOST_TIMES_THE_FILE = 1100
"""How many times the bytes of the file a full matrix may have: what deflate can reach."""

HDF5 = b"MATLAB 7.3"

FULL, SPARSE = "MATLAB_class", "MATLAB_sparse"
"""Attributes that MATLAB gives its variables."""


def read_matlab(path: Path) -> list[NamedMatrix]:
    """Return the square matrices among the variables of a file.

    Raises:
        VehicleError: the file is damaged or has none, or h5py is needed and not installed.
    """
    with opened(path, LARGEST_FILE) as file:
        is_hdf5 = file.read(len(HDF5)) == HDF5
    with located(path):
        try:
            found = list(_of_hdf5(path) if is_hdf5 else _of_version_5(path))
        except VehicleError:
            raise
        except Exception as error:  # damaged files make h5py raise almost anything
            raise VehicleError(f"no whole .mat file ({reason(error)})") from None
        if not found:
            raise VehicleError(
                "has no square matrix among its variables, expected those called K and M"
            )
        return found


def _of_version_5(path: Path) -> Iterator[NamedMatrix]:
    for name, array in variables(read_bytes(path, LARGEST_FILE)):
        if _is_square(array.shape or ()):
            yield NamedMatrix(name, sp.csc_array(array))


def _is_square(shape: tuple[int, ...]) -> bool:
    if len(shape) != 2 or shape[0] != shape[1] or shape[0] < 2:
        return False
    check_size("degrees of freedom in a matrix", shape[0], MOST_DOFS)
    return True


def _check_full(n_bytes: int, path: Path) -> None:
    """Raises VehicleError for full matrices that the file cannot hold, or that are too large."""
    check_size("entries in a matrix", n_bytes // 8, MOST_ENTRIES)
    if n_bytes > MOST_TIMES_THE_FILE * path.stat().st_size:
        raise VehicleError(f"says that its matrices have {n_bytes:,} bytes, which it has no room for")


def _of_hdf5(path: Path) -> Iterator[NamedMatrix]:
    try:
        import h5py
    except ImportError:
        raise VehicleError(
            "to read files of version 7.3 h5py is needed: pip install 'modeviz[hdf5]', or save them "
            "with -v7"
        ) from None
    with h5py.File(path, "r", locking=False) as file:
        for name in map(str, file):
            if not isinstance(file.get(name, getlink=True), h5py.HardLink):
                continue
            variable = file[name]
            if isinstance(variable, h5py.Group) and SPARSE in variable.attrs:
                yield NamedMatrix(name, _sparse(variable, path))
            elif isinstance(variable, h5py.Dataset) and _is_full(variable):
                _check_full(8 * variable.shape[0] ** 2, path)
                yield NamedMatrix(name, sp.csc_array(_whole(variable, path).T))


def _is_full(variable: Any) -> bool:
    kind = variable.attrs.get(FULL, b"")
    kind = kind.decode("ascii", "replace") if isinstance(kind, bytes) else str(kind)
    return kind in NUMBERS and _is_square(variable.shape)


def _sparse(group: Any, path: Path) -> sp.csc_array:
    """The columns of a sparse variable; one of zeros alone has no data."""
    n_rows = int(group.attrs[SPARSE])
    starts = _whole(group["jc"], path).astype(np.int64)
    check_size("degrees of freedom in a matrix", max(n_rows, len(starts) - 1), MOST_DOFS)
    shape = (n_rows, len(starts) - 1)
    if "data" not in group:
        return sp.csc_array(shape)
    values, rows = _whole(group["data"], path), _whole(group["ir"], path).astype(np.int64)
    matrix = sp.csc_array((values, rows, starts), shape=shape)
    matrix.check_format(full_check=True)
    return matrix


def _whole(dataset: Any, path: Path) -> np.ndarray:
    """The numbers of a data set that is in the file itself and no larger than it can be."""
    if dataset.external or dataset.is_virtual:
        raise VehicleError(f"{listed([dataset.name])}: is in another file, which is not read")
    if dataset.dtype.kind not in "iuf":
        raise VehicleError(f"{listed([dataset.name])}: has no real numbers")
    _check_full(dataset.size * dataset.dtype.itemsize, path)
    return dataset[()]
