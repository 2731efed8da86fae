"""The cards of a Nastran input file, with those of the files it includes.

After MSC Nastran's Quick Reference Guide, "The Bulk Data Section": small, large and free fields,
continuations in the order of the file, comments, and INCLUDE.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.disk import read_bytes

LARGEST_DECK = 500_000_000
"""Bytes of one file."""

DEEPEST, MOST_FILES = 20, 1000
"""Of files that include others."""

INCLUDE = re.compile(r"\s*INCLUDE\b\s*(.*)", re.IGNORECASE)
BEGIN = re.compile(r"\s*BEGIN(\s+BULK)?\b", re.IGNORECASE)
END = re.compile(r"\s*ENDDATA\b", re.IGNORECASE)
FORTRAN = re.compile(r"(?<=[\d.])(?=[-+])")
"""Where a number such as 2.9+7 lacks its E."""


@dataclass(frozen=True)
class Card:
    """A card of the bulk data."""

    name: str
    fields: list[str]
    """Eight for each of its lines, without the name; empty where nothing stands."""

    def whole(self, number: int, otherwise: int | None = None) -> int:
        """Return a field as a whole number; counted from zero.

        Raises:
            VehicleError: it is none, or empty if there is no `otherwise`.
        """
        text = self.text(number)
        if not text and otherwise is not None:
            return otherwise
        try:
            return int(text)
        except ValueError:
            raise VehicleError(
                f"{self._where}: found {quoted(text)}, expected a whole number"
            ) from None

    def real(self, number: int) -> float:
        """Return a field as a real number, 0 if it is empty; raises VehicleError if it is none."""
        text = self.text(number)
        try:
            return float(text) if text else 0.0
        except ValueError:
            pass
        try:
            return float(FORTRAN.sub("E", text.upper().replace("D", "E")))
        except ValueError:
            raise VehicleError(f"{self._where}: found {quoted(text)}, expected a number") from None

    def text(self, number: int) -> str:
        """Return a field; nothing if the card is shorter."""
        return self.fields[number] if number < len(self.fields) else ""

    @property
    def _where(self) -> str:
        return f"{self.name} {self.text(0)}".strip()


def cards(path: Path, names: frozenset[str]) -> Iterator[Card]:
    """Yield the cards of those names, in the order of the file.

    Raises:
        VehicleError: a file cannot be read, or one that is included is not there.
    """
    lines = _bulk_lines(path)
    name, parts = "", []
    for line in lines:
        if line[:1] in "+* \t," and not (line[:1] in " \t" and _begins_card(line)):
            if name:
                parts.append(line)
            continue
        if name:
            yield Card(name, _fields(parts))
        found = _name(line)
        name, parts = (found, [line]) if found in names else ("", [])
    if name:
        yield Card(name, _fields(parts))


def _begins_card(line: str) -> bool:
    """Whether a line that begins with a blank has a name in its first field all the same."""
    return line[:8].strip()[:1].isalpha()


def _name(line: str) -> str:
    return re.split(r"[,\s*]", line.lstrip()[:9], maxsplit=1)[0][:8].upper()


def _fields(lines: list[str]) -> list[str]:
    fields: list[str] = []
    for line in lines:
        fields += _line_fields(line)
    return fields


def _line_fields(line: str) -> list[str]:
    """The fields of a line between its first and its last, eight, or four of a large one.

    A free line may go on beyond its tenth field, as if it were several.
    """
    if "," in line:
        name, *fields = (part.strip() for part in line.split(","))
        n_fields = 4 if "*" in name else 8
        if len(fields) == n_fields + 1:  # with the mark of a continuation
            fields.pop()
        n_fields = -(-len(fields) // n_fields) * n_fields
    else:
        line = line.expandtabs(8)
        is_large = "*" in line[:8]
        n_fields, width = (4, 16) if is_large else (8, 8)
        fields = [line[i : i + width].strip() for i in range(8, 8 + n_fields * width, width)]
    return fields + [""] * (n_fields - len(fields))


def _bulk_lines(path: Path) -> Iterator[str]:
    """The lines of the bulk data, without comments; of a file that is nothing else, all of them."""
    lines = list(_lines(path, (), [0]))
    begin = next((i + 1 for i, line in enumerate(lines) if BEGIN.match(line)), 0)
    for line in lines[begin:]:
        if END.match(line):
            return
        yield line


def _lines(path: Path, within: tuple[Path, ...], count: list[int]) -> Iterator[str]:
    """The lines of a file that are no comments, with those of files included in place."""
    count[0] += 1
    if path.resolve() in within or len(within) >= DEEPEST or count[0] > MOST_FILES:
        raise VehicleError(f"{path}: is included by what it includes, or by too many")
    text = read_bytes(path, LARGEST_DECK).decode("latin-1")
    if "\0" in text:
        raise VehicleError(f"{path}: found no text, expected Nastran input")
    lines = iter(text.splitlines())
    for line in lines:
        line = line.split("$", 1)[0].rstrip()
        if not line:
            continue
        if found := INCLUDE.match(line):
            name = _included(found[1], lines)
            with located(f"{path}: INCLUDE {quoted(name)}"):
                yield from _lines(path.parent / name, (*within, path.resolve()), count)
        else:
            yield line


def _included(text: str, lines: Iterator[str]) -> str:
    """The name of a file, which may go on over several lines within its quotes."""
    quote = text[:1]
    if quote not in ("'", '"'):
        return text.strip().replace("\\", "/")
    while quote not in text[1:]:
        more = next(lines, None)
        if more is None or len(text) > 4096:
            raise VehicleError(f"INCLUDE {quoted(text[1:])}: its quote does not end")
        text += more.strip()
    return text[1 : text.index(quote, 1)].strip().replace("\\", "/")
