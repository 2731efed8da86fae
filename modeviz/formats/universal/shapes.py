"""Mode shapes of a universal file: data sets 55 and 2414."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.universal.blocks import Block, ids, numbers, table, whole_numbers
from modeviz.vehicle.arrays import Array, Floats

NORMAL, COMPLEX = 2, (3, 7)
"""Kinds of analysis that have modes: normal ones, and complex ones in displacement or velocity."""

MOTIONS = {2: 3, 3: 6}
"""How many components the data of a node have that are motions, by their characteristic."""

DISPLACEMENT = (0, 8)
"""What data are that are displacements; 0 is said to be unknown."""

COMPLEX_DATA = (5, 6)
"""Of single and double precision."""

MOST_VALUES = 12
"""Of a node in a shape: six complex ones."""

RESIDUAL = "RESIDUAL VECTOR"
"""The line of text of what is used like a mode and is none, which no kind of analysis says."""

STATIC = {10: "Craig-Bampton constraint modes", 11: "equivalent attachment modes"}
"""Kinds of analysis of 2414 whose shapes go with modes, and have neither frequency nor modal mass."""


@dataclass(frozen=True, eq=False)
class Shape:
    """A mode as one data set has it."""

    frequency_hz: float
    modal_mass: float
    """Not a number if it is not said, as for damping."""
    damping_ratio: float
    labels: Array
    """(n,), of the nodes that it moves."""
    values: Array
    """(n, 3 or 6), in each node's own system."""
    is_residual: bool = False
    """Whether it is said to be a residual vector."""


@dataclass(frozen=True)
class _Header:
    """What both data sets say of their data."""

    analysis: int
    characteristic: int
    result: int
    data: int
    n_values: int


def read_shape_55(block: Block) -> Shape | None:
    """Return the mode of data set 55; None if it has something else."""
    lines, rest = block.split(6)
    header = _Header(*whole_numbers(lines[5], 6)[1:6])
    if not _is_mode(header):
        return None
    first, rest = _cut(rest, 1)
    n_whole, n_real = whole_numbers(first, 2)[:2]
    _check_header(0 <= n_whole <= 100 and 4 <= n_real <= 100, f"{n_whole} and {n_real} parameters")
    _, rest = _cut(rest, -(-(n_whole + 2) // 8) - 1)
    text, rest = _cut(rest, -(-n_real // 6))
    return _shape(header, numbers(text), rest, lines[:5])


def read_shape_2414(block: Block) -> Shape | None:
    """Return the mode of data set 2414; None if it has something else."""
    lines, rest = block.split(9)
    header = _Header(*whole_numbers(lines[8], 6)[1:6])
    at_nodes = whole_numbers(lines[2], 1)[0] == 1
    if not (at_nodes and _is_mode(header)):
        return None
    _, rest = _cut(rest, 2)
    real, rest = _cut(rest, 1)
    other, rest = _cut(rest, 1)
    text = other if header.analysis in COMPLEX else " ".join(_columns(real)[1:2] + _columns(real)[3:])
    return _shape(header, numbers(text), rest, lines[3:8])


def _columns(line: str) -> list[str]:
    """The numbers of a line of six, each in 13 columns or not."""
    return [f"{number:.17g}" for number in numbers(line)]


def _is_mode(header: _Header) -> bool:
    return header.analysis in (NORMAL, *COMPLEX) and header.characteristic in MOTIONS


def _shape(header: _Header, parameters: Floats, text: bytes, titles: Sequence[str]) -> Shape:
    """The mode of a header, its parameters, the lines of its nodes and its five of text."""
    is_complex = header.data in COMPLEX_DATA
    n_values = header.n_values
    _check_header(n_values == MOTIONS[header.characteristic], f"{n_values} values of each node")
    _check_header(len(parameters) >= 4, f"{len(parameters)} parameters of a mode")
    rows = table(text, 1 + n_values * (2 if is_complex else 1), "node")
    values = rows[:, 1::2] + 1j * rows[:, 2::2] if is_complex else rows[:, 1:]
    if not np.imag(values).any():  # some write normal modes as complex numbers
        values = values.real
    frequency, mass, damping = _parameters(header, parameters)
    if not (np.isfinite(frequency) and frequency >= 0):
        raise VehicleError(f"found a mode of {frequency:g} Hz")
    is_residual = any(line.strip().upper() == RESIDUAL for line in titles)
    return Shape(frequency, mass, damping, ids(rows[:, 0], "node"), values, is_residual)


def _parameters(header: _Header, parameters: Floats) -> tuple[float, float, float]:
    """Frequency, modal mass and damping ratio."""
    if header.analysis in COMPLEX:
        eigenvalue = complex(parameters[0], parameters[1])
        size = abs(eigenvalue)
        return size / (2 * np.pi), np.nan, -eigenvalue.real / size if size else np.nan
    frequency, mass, viscous, hysteretic = parameters[:4].tolist()
    is_known = mass > 0 and header.result in DISPLACEMENT
    damping = viscous or hysteretic / 2  # at resonance
    return frequency, mass if is_known else np.nan, damping if damping > 0 else np.nan


def _cut(text: bytes, n_lines: int) -> tuple[str, bytes]:
    """So many lines from the front, and what follows."""
    *first, rest = text.split(b"\n", n_lines)
    _check_header(len(first) == n_lines, "no more lines")
    return b"\n".join(first).decode("latin-1"), rest


def _check_header(holds: bool, found: str) -> None:
    if not holds:
        raise VehicleError(f"found {found}, as no data set of a mode has")


def unread_name(block: Block) -> str:
    """Return what a data set is that is not read: its number, and of 2414 what goes with modes."""
    if block.kind != "2414":
        return block.kind
    lines, _ = block.split(9)
    analysis = int(whole_numbers(lines[8], 6)[1])
    return f"{block.kind} ({STATIC[analysis]})" if analysis in STATIC else block.kind


def read_mode(block: Block) -> Shape | None:
    """Return the mode of a data set of either kind.

    Raises:
        VehicleError: it is damaged; the text says where.
    """
    with located(block.where):
        return read_shape_55(block) if block.kind == "55" else read_shape_2414(block)
