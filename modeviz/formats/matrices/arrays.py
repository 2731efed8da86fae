"""Matrices in NumPy's `.npz`: one that SciPy saved, or several by name."""

import zipfile
from collections.abc import Mapping
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, listed, located, reason
from modeviz.files.disk import opened
from modeviz.files.limits import check_size
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.named_matrices import MOST_DOFS, MOST_ENTRIES, NamedMatrix
from modeviz.vehicle.arrays import Array

MOST_BYTES = 12 * MOST_ENTRIES
"""Of all arrays of a file, unpacked."""

LEAST_BYTES, MOST_TIMES_PACKED = 500_000_000, 100
"""Unpacked, so many are read of any file, and more of one that is no smaller than this part of it."""

SCIPY = {"format", "shape", "data"}
"""What `scipy.sparse.save_npz` writes of every matrix."""

COMPRESSED = {"csc": sp.csc_array, "csr": sp.csr_array}


def read_npz(path: Path) -> list[NamedMatrix]:
    """Return the matrices of a file that `scipy.sparse.save_npz` or `numpy.savez` wrote.

    Raises:
        VehicleError: the file is damaged or pickled, or has none.
    """
    arrays = _read_arrays(path)
    with located(path):
        if arrays.keys() >= SCIPY:
            return [NamedMatrix(path.stem, _sparse(arrays))]
        squares = {name: array for name, array in arrays.items() if _is_square(array)}
        found = [NamedMatrix(name, sp.csc_array(array)) for name, array in squares.items()]
        if not found:
            raise VehicleError(
                f"found the arrays {listed(arrays)}, expected those of scipy.sparse.save_npz, or "
                "square ones that are called K and M"
            )
        return found


def _is_square(array: Array) -> bool:
    return array.ndim == 2 and array.shape[0] == array.shape[1] > 1 and array.dtype.kind in "iuf"


def _sparse(arrays: Mapping[str, Array]) -> sp.csc_array:
    """A matrix as SciPy writes it, by its parts."""
    kind = bytes(np.asarray(arrays["format"]).astype("S").item()).decode("ascii", "replace")
    shape = _shape(arrays["shape"])
    try:
        if kind in COMPRESSED:
            parts = tuple(arrays[name] for name in ("data", "indices", "indptr"))
            made = COMPRESSED[kind](parts, shape=shape)
            made.check_format(full_check=True)
        elif kind == "coo":
            coords = arrays["coords"] if "coords" in arrays else (arrays["row"], arrays["col"])
            made = sp.coo_array((arrays["data"], tuple(coords)), shape=shape)
        elif kind == "dia":
            made = sp.dia_array((arrays["data"], arrays["offsets"]), shape=shape)
        elif kind == "bsr":
            parts = tuple(arrays[name] for name in ("data", "indices", "indptr"))
            made = sp.bsr_array(parts, shape=shape)
            made.check_format(full_check=True)
        else:
            raise VehicleError(
                f"found a matrix in the format {kind!r}, expected csc, csr, coo, bsr or dia"
            )
        return sp.csc_array(made)
    except (KeyError, ValueError, IndexError, TypeError) as error:
        raise VehicleError(f"its parts make no matrix in the format {kind} ({reason(error)})") from None


def _shape(array: Array) -> tuple[int, int]:
    shape = array.ravel().tolist()
    if len(shape) != 2 or not all(isinstance(n, int) and n > 0 for n in shape):
        raise VehicleError(f"found a matrix of the shape {shape}, expected two whole numbers")
    check_size("degrees of freedom in a matrix", max(shape), MOST_DOFS)
    return shape[0], shape[1]


def _read_arrays(path: Path) -> dict[str, Array]:
    with opened(path, LARGEST_FILE) as file:
        try:
            with zipfile.ZipFile(file) as archive:
                members = [m for m in archive.infolist() if m.filename.endswith(".npy")]
                _check_unpacked(sum(m.file_size for m in members), path.stat().st_size)
                return {m.filename.removesuffix(".npy"): _read_array(archive, m) for m in members}
        except VehicleError as error:
            raise VehicleError(f"{path}: {error}") from None
        except Exception as error:  # damaged archives make zipfile and NumPy raise almost anything
            raise VehicleError(f"{path}: not a whole .npz file ({reason(error)})") from None


def _check_unpacked(n_bytes: int, n_packed: int) -> None:
    """Raises VehicleError for arrays that are too large, or larger than any packed so small."""
    check_size("bytes of arrays", n_bytes, MOST_BYTES)
    if n_bytes > max(LEAST_BYTES, MOST_TIMES_PACKED * n_packed):
        raise VehicleError(f"unpacks to {n_bytes:,} bytes, more than arrays in {n_packed:,} bytes do")


def _read_array(archive: zipfile.ZipFile, member: zipfile.ZipInfo) -> Array:
    with archive.open(member) as file:
        array = np.lib.format.read_array(file, allow_pickle=False)
    return array.astype(array.dtype.newbyteorder("="), copy=False)
