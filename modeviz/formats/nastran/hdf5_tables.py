"""Tables of an HDF5 file, of which nothing is taken that isn't in the file itself."""

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from modeviz.errors import VehicleError
from modeviz.files.disk import opened
from modeviz.formats.limits import LARGEST_FILE
from modeviz.vehicle.arrays import Array, Floats

MOST_TIMES_THE_FILE = 200
"""How many times the bytes of the file a table may have, since they are compressed."""

DAMAGE = (OSError, RuntimeError, KeyError, ValueError, TypeError, OverflowError)
"""What h5py raises of a damaged file."""

LEAST = 1_000_000
"""Bytes that a table may have in any file."""


@dataclass(frozen=True, eq=False)
class Tables:
    """The tables of a file that is open."""

    file: Any
    n_bytes: int
    """Of the file."""

    def has(self, name: str) -> bool:
        """Return whether there is a table of that name."""
        with _damage(name):
            return self._found(name) is not None

    def columns(self, name: str) -> set[str]:
        """Return the names of a table's columns."""
        return set(self._table(name).dtype.names or ())

    def whole(
        self, name: str, columns: Sequence[str], part: slice = slice(None), width: int = 0
    ) -> Array:
        """Return whole numbers of a table that is there, (n, width).

        Args:
            name: of the table.
            columns: that are read, one beside the other.
            part: of its rows.
            width: how many numbers of each row are wanted; 0: one for each column.

        Raises:
            VehicleError: it lacks some of them, is larger than could be, or damaged.
        """
        return self._read(name, columns, part, width or len(columns), "iu").astype(np.int64, copy=False)

    def real(
        self, name: str, columns: Sequence[str], part: slice = slice(None), width: int = 0
    ) -> Floats:
        """Return real numbers in the same way, (n, width)."""
        return self._read(name, columns, part, width or len(columns), "iuf").astype(float, copy=False)

    def texts(self, name: str, column: str) -> list[str]:
        """Return a column of text of a table that is there."""
        rows = self._read(name, (column,), slice(None), 1, "S")
        return [text.decode("latin-1").strip() for text in rows[:, 0].tolist()]

    def _read(self, name: str, columns: Sequence[str], part: slice, width: int, kinds: str) -> Array:
        """Columns of some rows, (n, width), whose numpy kinds are among those."""
        table = self._table(name)
        if missing := [column for column in columns if column not in self.columns(name)]:
            raise VehicleError(f"{name}: has no column {', '.join(missing)}")
        own = table.dtype.fields
        if odd := [column for column in columns if own[column][0].base.kind not in kinds]:
            raise VehicleError(f"{name}: its column {odd[0]} is of another kind than expected")
        if part.stop is not None and not 0 <= part.start <= part.stop <= len(table):
            raise VehicleError(
                f"{name}: has {len(table):,} rows, and INDEX says that it has those from "
                f"{part.start:,} to {part.stop:,}"
            )
        with _damage(name):
            rows = table.fields(list(columns))[part]
        side_by_side = np.column_stack([rows[column].reshape(len(rows), -1) for column in columns])
        if side_by_side.shape[1] < width:
            raise VehicleError(f"{name}: found {side_by_side.shape[1]} numbers, expected {width}")
        return side_by_side[:, :width]

    def _table(self, name: str) -> Any:
        """A table that is there.

        Raises:
            VehicleError: it isn't, or can't be read.
        """
        with _damage(name):
            table = self._found(name)
            if table is None:
                raise VehicleError(f"has no table {name}")
            if table.external or table.is_virtual:
                raise VehicleError(f"{name}: is in another file, which is not read")
            if len(table.shape) != 1 or table.dtype.names is None:
                raise VehicleError(f"{name}: is no table, expected rows of named columns")
            most = max(LEAST, MOST_TIMES_THE_FILE * self.n_bytes)
            if table.shape[0] * table.dtype.itemsize > most:
                raise VehicleError(
                    f"{name}: says that it has {table.shape[0]:,} rows, {table.dtype.itemsize} bytes "
                    f"each, more than a file of {self.n_bytes:,} bytes could hold"
                )
            return table

    def _found(self, name: str) -> Any:
        """What is at the end of hard links, since others lead out of the file; None if nothing is."""
        import h5py

        here = self.file
        for part in name.split("/"):
            if not isinstance(here, h5py.Group) or part not in here:
                return None
            if not isinstance(here.get(part, getlink=True), h5py.HardLink):
                raise VehicleError(f"{name}: is a link to elsewhere, which is not followed")
            here = here[part]
        return here if isinstance(here, h5py.Dataset) else None


@contextmanager
def opened_tables(path: Path) -> Iterator[Tables]:
    """Yield the tables of a file.

    Raises:
        VehicleError: it is no HDF5 file of Nastran's, or h5py is not installed.
    """
    try:
        import h5py
    except ImportError:
        raise VehicleError(
            f"{path}: to read HDF5 files h5py is needed: pip install 'modeviz[hdf5]'"
        ) from None
    with opened(path, LARGEST_FILE):
        n_bytes = path.stat().st_size
        try:
            file = h5py.File(path, "r", locking=False)
            is_nastran = "NASTRAN" in file
        except DAMAGE as error:
            raise VehicleError(f"{path}: is no HDF5 file, or is cut or damaged ({error})") from None
        with file:
            if not is_nastran:
                raise VehicleError(
                    f"{path}: has no group NASTRAN, so it is no file of results of MSC Nastran"
                )
            yield Tables(file, n_bytes)


@contextmanager
def _damage(name: str) -> Iterator[None]:
    """Says of what h5py stumbles over that the file is damaged."""
    try:
        yield
    except DAMAGE as error:
        reason = str(error).splitlines()[0] if str(error) else type(error).__name__
        raise VehicleError(f"{name}: is damaged ({reason})") from None
