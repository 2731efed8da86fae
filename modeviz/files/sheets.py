"""Tables of text and of Excel as lines of cells.

Excel's .xlsx is read by openpyxl 3.1 (MIT, one small dependency, maintained, reads row by row and gives
the values that Excel stored for formulas); pandas would bring 100 MB for the same reader, calamine a
compiled one.
"""

import warnings
import zipfile
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from io import BytesIO
from itertools import islice
from pathlib import Path
from typing import Any

from modeviz.errors import VehicleError, located, reason
from modeviz.files.disk import LARGEST_TABLE, WESTERN, read_bytes, read_text
from modeviz.files.limits import check_size
from modeviz.files.tables import read_cells

TEXT_SUFFIXES = (".csv", ".tsv", ".txt")
EXCEL_SUFFIXES = (".xlsx", ".xlsm", ".xls", ".xlsb", ".ods")
"""Those of workbooks, of which the first two are read."""

LARGEST_UNPACKED = 100_000_000
"""Bytes of a workbook."""

MOST_MOUNTS = 2000
"""Lines of a table, as many as a vehicle's file has of a kind."""

MOST_ROWS = 10_000
"""Lines of a workbook, with those that are empty."""

MOST_CELLS = 200
"""Of a line of a workbook; what is further right is not looked at."""


@dataclass(frozen=True)
class Sheet:
    """The lines of a table that are not empty, with their numbers, the header's first."""

    lines: Sequence[tuple[int, list[str]]]
    decimal_comma: bool
    """Whether 1,5 is a number."""


def read_sheet(path: Path, name: str = "") -> Sheet:
    """Return the table in a file: of a workbook that of its first sheet that is not empty.

    Args:
        path: of the file.
        name: of the sheet that is meant where a workbook has one called so.

    Raises:
        VehicleError: it cannot be read.
    """
    if path.suffix.lower() in EXCEL_SUFFIXES:
        return Sheet(_of_workbook(path, name), decimal_comma=True)
    text = read_text(path, LARGEST_TABLE, otherwise=WESTERN)
    with located(path):
        found, decimal_comma = read_cells(text)
        lines = list(islice(found, MOST_MOUNTS + 2))
        check_size("lines", len(lines), MOST_MOUNTS + 1)
        return Sheet(lines, decimal_comma)


def _of_workbook(path: Path, name: str) -> list[tuple[int, list[str]]]:
    if path.suffix.lower() not in EXCEL_SUFFIXES[:2]:
        raise VehicleError(
            f"{path}: workbooks ending in {path.suffix} are not read; save it as .xlsx or .csv"
        )
    content = read_bytes(path, LARGEST_TABLE)
    with located(path):
        _check_unpacked(content)
        try:
            from openpyxl import load_workbook
        except ImportError:
            raise VehicleError(
                "to read Excel's files needs openpyxl; pip install 'modeviz[excel]', or save it as .csv"
            ) from None
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")  # of styles, and what else is nothing here
                books = [
                    load_workbook(BytesIO(content), read_only=True, data_only=values)
                    for values in (True, False)
                ]
            pairs = list(zip(*(book.worksheets for book in books), strict=True))
            meant = [pair for pair in pairs if pair[0].title.strip().lower() == name]
            for sheets in meant or pairs:
                if lines := list(_lines(*sheets)):
                    return lines
        except VehicleError:
            raise
        except Exception as error:  # a damaged workbook raises what its parts do
            raise VehicleError(f"damaged, no workbook that can be read ({reason(error)})") from None
        return []


def _lines(values: Any, formulas: Any) -> Iterator[tuple[int, list[str]]]:
    """The lines of a sheet that are not empty: values, or formulas of which no value is stored."""
    rows = []
    for sheet in (values, formulas):
        sheet.reset_dimensions()  # what a file says of them may be wrong
        rows.append(sheet.iter_rows(max_col=MOST_CELLS))
    n_lines = 0
    for number, row in enumerate(zip(*rows, strict=True), 1):
        check_size("lines", number, MOST_ROWS)
        cells = [
            _text(formula.value) if value.value is None else _shown(value)
            for value, formula in zip(*row, strict=True)
        ]
        while cells and not cells[-1]:
            cells.pop()
        if cells:
            n_lines += 1
            check_size("lines", n_lines, MOST_MOUNTS + 1)
            yield number, cells


def _shown(cell: Any) -> str:
    """A cell's text, with its percent sign if that is how a number is shown."""
    is_percent = isinstance(cell.value, int | float) and "%" in (cell.number_format or "")
    return f"{_text(100 * cell.value)}%" if is_percent else _text(cell.value)


def _text(value: Any) -> str:
    """A cell as it would stand in a file of text."""
    if value is None:
        return ""
    if isinstance(value, float) and value.is_integer() and abs(value) < 1e15:
        return str(int(value))
    return repr(value) if isinstance(value, float) else str(value).strip()


def _check_unpacked(content: bytes) -> None:
    """Raises VehicleError for what is no archive, or too large unpacked."""
    try:
        with zipfile.ZipFile(BytesIO(content)) as archive:
            check_size("bytes unpacked", sum(i.file_size for i in archive.infolist()), LARGEST_UNPACKED)
            names = set(archive.namelist())
    except (zipfile.BadZipFile, OSError, ValueError, NotImplementedError) as error:
        raise VehicleError(f"damaged, no workbook that can be read ({reason(error)})") from None
    if "[Content_Types].xml" not in names:
        raise VehicleError("an archive, but no workbook of Excel's")
