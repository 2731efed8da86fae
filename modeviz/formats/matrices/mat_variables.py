"""Variables of MATLAB's files of versions 4, 5 and 7, checked before they are used.

After MathWorks, "MAT-File Format": after a header elements of a type and a number of bytes, packed ones
among them, each matrix with its flags, dimensions, name and numbers. SciPy's reader is not used: some
damaged files make it read beyond its memory.
"""

import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import islice

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, quoted
from modeviz.files.limits import check_size
from modeviz.formats.named_matrices import MOST_DOFS
from modeviz.vehicle.arrays import Array

NUMBERS = {1: "i1", 2: "u1", 3: "i2", 4: "u2", 5: "i4", 6: "u4", 7: "f4", 9: "f8", 12: "i8", 13: "u8"}
"""By the type of an element."""

MATRIX, PACKED = 14, 15

SPARSE, FIRST_NUMERIC, LAST_NUMERIC = 5, 6, 15
"""Classes of arrays: sparse ones, and doubles to whole numbers."""

COMPLEX = 0x800

NUMBERS_4 = ("f8", "f4", "i4", "i2", "u2", "u1")
"""By the tens of a type of version 4."""

MOST_VARIABLES = 100_000
"""In a file, whether they are matrices or not."""

HEADER = 128
"""Bytes of text, version and byte order before the elements."""

LEAST_BYTES, MOST_TIMES_PACKED = 500_000_000, 100
"""Unpacked, so many are read of any element, and more of one that is no smaller than this part."""

LEAST_IN_ALL, MOST_TIMES_IN_ALL = 1_000_000_000, 10
"""The same of all elements, and of the file."""


@dataclass(frozen=True)
class Elements:
    """A stretch of a file."""

    content: bytes
    order: str
    """Of bytes, "<" or ">"."""

    def __iter__(self) -> Iterator[tuple[int, bytes]]:
        """Yield the type and the content of each element; those that are empty have type 0."""
        place = 0
        while place + 8 <= len(self.content):
            first, n_bytes = np.frombuffer(self.content, f"{self.order}u4", 2, place).tolist()
            is_small = first >> 16 > 0  # both are in four bytes, and no more than four follow
            if is_small:
                kind, n_bytes, begin, end = first & 0xFFFF, first >> 16, place + 4, place + 8
            else:
                kind, begin = first, place + 8
                end = begin + (n_bytes if kind == PACKED else -(-n_bytes // 8) * 8)
            if begin + n_bytes > len(self.content) or (is_small and n_bytes > 4):
                raise VehicleError("the file is cut or damaged: an element ends beyond it")
            yield kind, self.content[begin : begin + n_bytes]
            place = end


def variables(content: bytes) -> Iterator[tuple[str, sp.csc_array | Array]]:
    """Yield the numeric variables of a file, with their names.

    Raises:
        VehicleError: it is damaged or no such file.
    """
    order = {b"IM": "<", b"MI": ">"}.get(content[126:128])
    if order is None:
        yield from _of_version_4(content)
        return
    n_unpacked, most = 0, max(LEAST_IN_ALL, MOST_TIMES_IN_ALL * len(content))
    for number, (kind, element) in enumerate(Elements(content[HEADER:], order), 1):
        check_size("variables", number, MOST_VARIABLES)
        if kind == PACKED:
            kind, element = next(iter(Elements(_unpacked(element), order)), (0, b""))
            n_unpacked += len(element)
            check_size("bytes in packed variables", n_unpacked, most)
        if kind == MATRIX:
            yield from _matrix(Elements(element, order))


def _unpacked(element: bytes) -> bytes:
    most = max(LEAST_BYTES, MOST_TIMES_PACKED * len(element))
    unpacker = zlib.decompressobj()
    try:
        content = unpacker.decompress(element, most)
    except zlib.error as error:
        raise VehicleError(f"a packed variable is damaged ({error})") from None
    if unpacker.unconsumed_tail:
        raise VehicleError(f"a packed variable of {len(element):,} bytes has more than {most:,}")
    return content


def _matrix(elements: Elements) -> Iterator[tuple[str, sp.csc_array | Array]]:
    """The array of an element, if it is a numeric one in two dimensions."""
    parts = iter(elements)
    head = list(islice(parts, 3))
    if len(head) < 3:
        return
    flags, shape = (_numbers(part, elements.order) for part in head[:2])
    name = head[2][1].decode("latin-1")
    kind = int(flags[0]) & 0xFF if len(flags) else 0
    if len(shape) != 2 or not (kind == SPARSE or FIRST_NUMERIC <= kind <= LAST_NUMERIC):
        return
    if int(flags[0]) & COMPLEX:
        raise VehicleError(f"variable {quoted(name)}: has complex numbers, expected real ones")
    n_rows, n_columns = (int(n) for n in shape)
    if min(n_rows, n_columns) < 0:
        raise VehicleError(f"variable {quoted(name)}: found {n_rows} by {n_columns} numbers")
    check_size("degrees of freedom in a matrix", max(n_rows, n_columns), MOST_DOFS)
    data = [_numbers(part, elements.order) for part in islice(parts, 3)]
    if kind == SPARSE:
        yield name, _sparse(name, data, (n_rows, n_columns))
    elif data and len(data[0]) == n_rows * n_columns:
        yield name, data[0].reshape(n_columns, n_rows).T
    elif n_rows * n_columns:
        raise VehicleError(f"variable {quoted(name)}: has other numbers than {n_rows} by {n_columns}")


def _sparse(name: str, data: list[Array], shape: tuple[int, int]) -> sp.csc_array:
    """A matrix of its rows, the beginnings of its columns, and its numbers, which may be fewer."""
    if len(data) < 2 or len(data[1]) != shape[1] + 1:
        raise VehicleError(f"variable {quoted(name)}: lacks the beginnings of its columns")
    rows, starts = (part.astype(np.int64) for part in data[:2])
    n = int(starts[-1])
    numbers = data[2] if len(data) > 2 else np.zeros(0)
    if n < 0 or n > len(rows) or n > len(numbers):
        raise VehicleError(f"variable {quoted(name)}: has {len(numbers)} numbers, expected {n}")
    try:
        matrix = sp.csc_array((numbers[:n].astype(float), rows[:n], starts), shape=shape)
        matrix.check_format(full_check=True)
    except ValueError as error:
        raise VehicleError(f"variable {quoted(name)}: its parts make no matrix ({error})") from None
    return matrix


def _numbers(part: tuple[int, bytes], order: str) -> Array:
    """The numbers of an element; none of an element of text or of structure."""
    kind, content = part
    if kind not in NUMBERS:
        return np.zeros(0)
    number = np.dtype(f"{order}{NUMBERS[kind]}")
    found = np.frombuffer(content[: len(content) // number.itemsize * number.itemsize], number)
    return found.astype(number.newbyteorder("="))


def _of_version_4(content: bytes) -> Iterator[tuple[str, Array]]:
    """Full variables, each behind five numbers: type, rows, columns, whether complex, letters."""
    place, order = 0, "<" if content[:2] != b"\0\0" or content[:4] == bytes(4) else ">"
    n_variables = 0
    while place < len(content):
        n_variables += 1
        check_size("variables", n_variables, MOST_VARIABLES)
        if place + 20 > len(content):
            raise VehicleError("no whole .mat file: it ends within a variable")
        kind, n_rows, n_columns, is_complex, n_letters = np.frombuffer(
            content, f"{order}i4", 5, place
        ).tolist()
        thousands, tens = kind // 1000, kind // 10 % 10
        is_known = thousands in (0, 1) and tens < len(NUMBERS_4) and is_complex in (0, 1)
        if not is_known or n_letters < 1:  # the last letter of a name is a zero
            raise VehicleError("no .mat file, or a damaged one")
        number = np.dtype(f"{order}{NUMBERS_4[tens]}")
        begin = place + 20 + n_letters
        end = begin + n_rows * n_columns * number.itemsize * (1 + is_complex)
        if min(n_rows, n_columns) < 0 or end > len(content):
            raise VehicleError("no whole .mat file: a variable ends beyond it")
        name = content[place + 20 : begin].split(b"\0")[0].decode("latin-1")
        if kind % 10 == 0 and not is_complex:
            numbers = np.frombuffer(content, number, n_rows * n_columns, begin)
            yield name, numbers.astype(float).reshape(n_columns, n_rows).T
        place = end
