"""The sections of an OpenCRG file, and the numbers of its road data."""

import math
import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.disk import inside, read_bytes
from modeviz.vehicle.arrays import Floats

LARGEST = 500_000_000
"""Bytes of a file."""

DEEPEST = 5
"""Of files that name others."""

RECORD = 80
"""Bytes that numbers are filled into."""

FORMATS = {"LRFI": (True, 10), "LDFI": (True, 20), "KRBI": (False, 4), "KDBI": (False, 8)}
"""Whether numbers are text, and how many bytes each has."""

PARAMETERS = ("ROAD_CRG", "ROAD_CRG_MODS")
REFERENCES = "ROAD_CRG_FILE"
CHANNELS = "KD_DEFINITION"


@dataclass(frozen=True)
class CrgFile:
    """What a file says, with the files that it names."""

    parameters: Mapping[str, str] = field(default_factory=dict)
    """Of the road and its modifiers, by names in capitals."""
    data_format: str = "KRBI"
    channels: tuple[str, ...] = ()
    """Each with its unit, as in "long section 1,m"."""
    data: bytes = b""

    def number(self, name: str) -> float | None:
        """Return a parameter; None if it is not there.

        Raises:
            VehicleError: it is no number.
        """
        text = self.parameters.get(name)
        if text is None:
            return None
        try:
            value = float(text.replace("D", "E").replace("d", "e"))
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise VehicleError(f"{name}: found {quoted(text)}, expected a finite number")
        return value


def read_crg_file(path: Path) -> CrgFile:
    """Return the content of a file; one that names others has what they say besides.

    Raises:
        VehicleError: no such file, or it is damaged.
    """
    return _read(path, path.parent, 0)


def _read(path: Path, home: Path, depth: int) -> CrgFile:
    if depth > DEEPEST:
        raise VehicleError(f"{path.name}: names files that name others, more than {DEEPEST} deep")
    content = read_bytes(path, LARGEST)
    with located(path.name):
        header, data = _split(content)
        sections = _sections(header)
        parameters: dict[str, str] = {}
        for name in PARAMETERS:
            parameters |= _parameters(sections.get(name, []))
        own = _channels(sections.get(CHANNELS, []), parameters, data)
        for name in _references(sections.get(REFERENCES, [])):
            with located(REFERENCES):
                other = _read(inside(home, name, "the folder of the road"), home, depth + 1)
            own = CrgFile(
                {**own.parameters, **other.parameters},
                *((own.data_format, own.channels, own.data) if own.data else
                  (other.data_format, other.channels, other.data)),
            )  # fmt: skip
    return own


def _split(content: bytes) -> tuple[str, bytes]:
    """The text before the road data, and these; the line between begins with "$$$$"."""
    mark = re.search(rb"(?m)^\$\$\$\$[^\r\n]*(\r\n|\n|\r|$)", content)
    header, data = (content[: mark.start()], content[mark.end() :]) if mark else (content, b"")
    if b"$ROAD_CRG" not in header.upper():
        raise VehicleError("found no section $ROAD_CRG, so it is no OpenCRG file")
    return header.decode("latin-1"), data


def _sections(header: str) -> dict[str, list[str]]:
    """The lines of each section by its name in capitals, without comments."""
    sections: dict[str, list[str]] = {}
    lines: list[str] = []
    for line in header.splitlines():
        if line[:1] == "*":
            continue
        line = line.split("!", 1)[0]
        if line[:1] == "$":
            lines = []
            if name := re.match(r"\$(\w+)", line):
                lines = sections.setdefault(name[1].upper(), [])
        elif line.strip():
            lines.append(line)
    return sections


def _parameters(lines: list[str]) -> dict[str, str]:
    pairs = [line.partition("=") for line in lines if "=" in line]
    return {name.strip().upper(): text.strip() for name, _, text in pairs}


def _references(lines: list[str]) -> Iterator[str]:
    """The names of files; one that goes on in the next line ends without ".crg" before."""
    name = ""
    for line in lines:
        name += line.strip()
        if name.lower().endswith(".crg"):
            yield name
            name = ""
    if name:
        raise VehicleError(f"{REFERENCES}: found {quoted(name)}, expected the name of a file, .crg")


def _channels(lines: list[str], parameters: Mapping[str, str], data: bytes) -> CrgFile:
    data_format, channels = "KRBI", []
    for line in lines:
        kind, _, text = line.strip().partition(":")
        if kind == "#":
            data_format = text.strip().upper()
        elif kind.upper() == "D":
            channels.append(" ".join(text.split()))
    if data_format not in FORMATS:
        raise VehicleError(
            f"found road data in the format {quoted(data_format)}, expected {', '.join(FORMATS)}"
        )
    return CrgFile(parameters, data_format, tuple(channels), data)


def road_data(file: CrgFile, n_rows: int | None) -> np.ndarray:
    """Return the numbers of a file, (n_rows, n_channels), not a number where one is missing.

    Args:
        file: with channels and data.
        n_rows: as many as there have to be; None: as there are.

    Raises:
        VehicleError: there are fewer, or the data are cut or changed.
    """
    is_text, width = FORMATS[file.data_format]
    decode = _of_text if is_text else _of_bytes
    values = decode(file.data, len(file.channels), width, n_rows)
    if n_rows is None:
        last = max(len(values) - RECORD, 0)  # so much padding there can be
        n_rows = last + int(np.flatnonzero(np.isfinite(values[last:]).any(axis=1)).max(initial=-1)) + 1
    if len(values) < n_rows:
        raise VehicleError(f"found {len(values):,} lines of road data, expected {n_rows:,}; is it cut?")
    return values[:n_rows]


def _of_bytes(data: bytes, n_channels: int, width: int, n_rows: int | None) -> np.ndarray:
    """Big-endian numbers, filled up to a whole record with those that are none."""
    least = (n_rows or 0) * n_channels * width
    whole = -(-least // RECORD) * RECORD
    if len(data) % RECORD and len(data) != least:
        wanted = f"{whole:,}" if n_rows else f"a multiple of {RECORD}"
        raise VehicleError(
            f"found {len(data):,} bytes of road data, expected {wanted}; it is cut, or its line ends "
            "were changed as those of a text"
        )
    values = np.frombuffer(data, f">f{width}", len(data) // width)
    rows = len(values) // n_channels
    return values[: rows * n_channels].reshape(rows, n_channels)


def _of_text(data: bytes, n_channels: int, width: int, n_rows: int | None) -> Floats:
    """Numbers in columns, each row of them in lines of its own."""
    lines = [line for line in data.decode("latin-1").splitlines() if line.strip()]
    n_lines = -(-n_channels * width // RECORD)
    if len(lines) % n_lines:
        raise VehicleError(
            f"found {len(lines):,} lines of road data, expected {n_lines} for each row; is it cut?"
        )
    rows = ["".join(line.ljust(RECORD)[:RECORD] for line in lines[i : i + n_lines])
            for i in range(0, len(lines), n_lines)]  # fmt: skip
    columns = range(0, n_channels * width, width)
    return np.array([[_number(row[at : at + width]) for at in columns] for row in rows]).reshape(
        -1, n_channels
    )


def _number(text: str) -> float:
    """The number in a field; not a number for the mark of a missing one."""
    if "*" in text:
        return math.nan
    try:
        return float(text.replace("D", "E").replace("d", "e"))
    except ValueError:
        raise VehicleError(
            f"found {quoted(text.strip())} in the road data, expected a number"
        ) from None
