"""The cards of a Nastran input file, with those of the files it includes.

After MSC Nastran's Quick Reference Guide, "The Bulk Data Section": small, large and free fields,
continuations in the order of the file, comments, replication, and INCLUDE.
"""

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.disk import read_bytes
from modeviz.formats.nastran.replication import replica

LARGEST_DECK = 500_000_000
"""Bytes of one file."""

LINE = re.compile(r"[^\r\n\v\f]+")

BEGINS_INPUT = re.compile(r"\s*[$A-Za-z]")

NAME = re.compile(r"\s*([^,\s*]{0,8})")
"""Of a card, at the beginning of its line."""

DEEPEST, MOST_FILES = 20, 1000
"""Of files that include others."""

INCLUDE = re.compile(r"\s*INCLUDE\b\s*(.*)", re.IGNORECASE)
BEGIN = re.compile(r"\s*BEGIN(\s+BULK)?\b", re.IGNORECASE)
LARGEST_WHOLE = 10**16
"""No whole number that fills a large field."""

BEGIN_OTHER = re.compile(r"\s*BEGIN\s+(BULK\s+)?\w+\s*=", re.IGNORECASE)
"""Before the bulk data of a superelement, or of another part."""

END = re.compile(r"\s*ENDDATA\b", re.IGNORECASE)
TOLD = "TOLD"
"""The name of a card that says in a sentence what is passed over."""

REPEATED = re.compile(r"\s*=\s*\(?\s*(\d{1,9})\s*\)?\s*,?\s*$")
"""A line that says how often the one before it is repeated."""

MOST_REPLICAS = 1_000_000

MOST_NAMELESS = 1000
"""Lines without a card's name before the first with one: more are in no input file."""

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
            value = int(text)
        except ValueError:
            value = LARGEST_WHOLE
        if abs(value) >= LARGEST_WHOLE:
            raise VehicleError(f"{self._where}: found {quoted(text)}, expected a whole number")
        return value

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

    First come cards `TOLD`, one for each thing that is passed over, such as a file with changes to the
    solution sequence that isn't there.

    Raises:
        VehicleError: a file cannot be read, or one that is included is not there.
    """
    told, bulk = _bulk(path)
    for sentence in told:
        yield Card(TOLD, [sentence])
    last, pattern = None, []
    for lines in _entries(bulk):
        if lines[0].lstrip()[:1] == "=":
            if last is None:
                continue
            if (again := REPEATED.match(lines[0])) is None:
                pattern = _line_fields(lines[0])
            for _ in range(_n_repeated(again, last)):
                last = Card(last.name, replica(last.fields, pattern))
                yield last
            continue
        name = _name(lines[0])
        last, pattern = (Card(name, _fields(lines)) if name in names else None), []
        if last is not None:
            yield last


def _entries(lines: Iterator[str]) -> Iterator[list[str]]:
    """The lines of each card, the first and its continuations."""
    parts: list[str] = []
    for line in lines:
        if line[:1] in "+* \t," and not (line[:1] in " \t" and _begins_card(line)):
            parts.append(line)
            continue
        if parts:
            yield parts
        parts = [line]
    if parts:
        yield parts


def _after_a_name(lines: Iterator[str]) -> Iterator[str]:
    """The same lines; raises VehicleError if one name or comment at least is not among the first."""
    first = list(islice(lines, MOST_NAMELESS))
    if len(first) == MOST_NAMELESS and not any(map(BEGINS_INPUT.match, first)):
        raise VehicleError(
            f"found no card in the first {MOST_NAMELESS:,} lines, expected an input file of Nastran"
        )
    return chain(first, lines)


def _n_repeated(again: re.Match[str] | None, last: Card) -> int:
    """How many cards a line of replication stands for."""
    number = int(again[1]) if again else 1
    if number > MOST_REPLICAS:
        raise VehicleError(
            f"{last.name} {last.text(0)}: is repeated {number:,} times, expected at most "
            f"{MOST_REPLICAS:,}"
        )
    return number


def _begins_card(line: str) -> bool:
    """Whether a line that begins with a blank has a name or an equals sign in its first field."""
    return line[:8].strip()[:1].isalpha() or line.lstrip()[:1] == "="


def _name(line: str) -> str:
    found = NAME.match(line)
    return found[1].upper() if found else ""


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
        first, *fields = (part.strip() for part in line.split(","))
        name, *one_more = first.split(maxsplit=1)[:2] or [""]
        fields = one_more + fields
        n_fields = 4 if "*" in name else 8
        if not any(fields[n_fields + 1 :]):  # the tenth is the mark of a continuation
            fields = fields[:n_fields]
        n_fields = -(-len(fields) // n_fields) * n_fields
    else:
        line = line.expandtabs(8)
        is_large = "*" in line[:8]
        n_fields, width = (4, 16) if is_large else (8, 8)
        fields = [line[i : i + width].strip() for i in range(8, 8 + n_fields * width, width)]
    return fields + [""] * (n_fields - len(fields))


def _bulk(path: Path) -> tuple[list[str], Iterator[str]]:
    """What is passed over, in sentences, and the lines of the bulk data; all if there is nothing else.

    That ends at ENDDATA, or where the bulk data of a superelement begin.
    """
    lines = list(_lines(path, (), [0], path.parent))
    texts = ["" if isinstance(line, VehicleError) else line for line in lines]
    parts = [i for i, text in enumerate(texts) if BEGIN.match(text)]
    others = [i for i in parts if BEGIN_OTHER.match(texts[i])]
    begins = [i for i in parts if i not in others]
    begin = begins[0] + 1 if begins else 0
    end = next((i for i in others if i >= begin), None)
    told = [
        f"{line}; it is before the bulk data, and passed over"
        for line in lines[:begin]
        if isinstance(line, VehicleError)
    ]
    if others:
        told.append(f"{len(others)} superelements that the input file has are left out")
    return told, _until_end(lines[begin:end])


def _until_end(lines: Iterable[str | VehicleError]) -> Iterator[str]:
    """The lines before ENDDATA; raises what is missing among them."""
    for line in lines:
        if not isinstance(line, str):
            raise line
        if END.match(line):
            return
        yield line


def _lines(
    path: Path, within: tuple[Path, ...], count: list[int], home: Path
) -> Iterator[str | VehicleError]:
    """The lines of a file that are no comments, with those of files included in place.

    They are looked for beside it, and then at home; for one that is not there it is the error that says
    so.
    """
    text = read_bytes(path, LARGEST_DECK).decode("latin-1")
    if "\0" in text:
        raise VehicleError(f"{path}: found no text, expected Nastran input")
    lines = (found[0] for found in LINE.finditer(text))
    if not within:
        lines = _after_a_name(lines)
    for line in lines:
        line = line.split("$", 1)[0].rstrip()
        if not line:
            continue
        if found := INCLUDE.match(line):
            name = _included(found[1], lines)
            places = [folder / name for folder in (path.parent, home)]
            other = next((place for place in places if _is_there(place)), None)
            if other is None:
                yield VehicleError(f"INCLUDE {quoted(name)}: there is no such file")
                continue
            including = (*within, path.resolve())
            _check_includes(other.resolve(), including, count)
            with located(other):
                yield from _lines(other, including, count, home)
        else:
            yield line


def _check_includes(path: Path, including: tuple[Path, ...], count: list[int]) -> None:
    """Counts an included file; raises VehicleError if it includes itself, or if there are too many."""
    count[0] += 1
    if path in including:
        which = "itself" if path == including[-1] else "again one of these files"
        raise VehicleError(f"includes {which}, so it would never end")
    if len(including) >= DEEPEST:
        raise VehicleError(f"includes files that include others, {DEEPEST} deep, expected fewer")
    if count[0] >= MOST_FILES:
        raise VehicleError(f"includes {MOST_FILES} files or more, expected fewer")


def _is_there(path: Path) -> bool:
    """Whether there is something of that name, if it can be one."""
    try:
        return path.exists()
    except (OSError, ValueError):
        return False


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
