"""Nastran's OUTPUT4 files: matrices by columns, in text or binary, full or as strings of non-zeros.

After MSC Nastran's DMAP Programmer's Guide, "OUTPUT4". Binary files have Fortran records: one with the
number of columns, of rows (negative where strings name their rows in words of their own, BIGMAT),
form, type and name of a matrix, then one for each column with its number, its first row (zero of
strings) and the number of words that follow. Text files have the same in lines of a format that their
first line says. The package pyyeti reads them all too, with pandas, numba and matplotlib beside it, and
without checks, so these are lines of our own; its files are read alike.
"""

import re
from pathlib import Path

from modeviz.errors import located
from modeviz.files.disk import read_bytes
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.named_matrices import NamedMatrix
from modeviz.formats.nastran.op4_binary import BinaryReader
from modeviz.formats.nastran.op4_text import TextReader


def read_op4(path: Path) -> list[NamedMatrix]:
    """Return the square real matrices of an OUTPUT4 file.

    Raises:
        VehicleError: the file is damaged or cut, or none of these.
    """
    content = read_bytes(path, LARGEST_FILE)
    with located(path):
        is_text = bool(re.match(rb"[ \d\-]{24}", content))
        return list((TextReader if is_text else BinaryReader)(content).matrices())
