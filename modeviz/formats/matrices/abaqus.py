"""Matrices that Abaqus writes: of substructures, and of whole models, both in `.mtx`.

After the Abaqus Keywords guide: `*SUBSTRUCTURE MATRIX OUTPUT` writes a linear user element with its
matrices, the lower triangle row by row (the whole if UNSYM), each row beginning a line; CalculiX
writes the same. `*MATRIX OUTPUT` writes an entry a line: row node, its direction, column node, its
direction and value (FORMAT=MATRIX INPUT and LABELS), or row, column and value (FORMAT=COORDINATE).
The package abaqus-mtx-parser reads the first of these alone, without checks: these lines are our own.
"""

import re
from collections.abc import Iterator, Sequence
from itertools import chain, groupby, islice
from pathlib import Path

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.disk import opened
from modeviz.files.limits import check_size
from modeviz.formats.limits import LARGEST_FILE
from modeviz.formats.matrices.lines import lines_of
from modeviz.formats.named_matrices import MOST_ENTRIES, NamedMatrix, from_entries
from modeviz.vehicle.arrays import Array, Floats

HELD = 1e36
"""What Abaqus writes on the diagonal of a direction that is held."""

MOST_NODES = 100_000
"""Of a substructure, whose matrices are full."""

MOST_KEYWORDS = 1000

AT_ONCE = 10_000
"""Lines whose numbers are read together."""

ENTRY = "node, direction, node, direction and value, or row, column and value"


def read_abaqus(path: Path) -> list[NamedMatrix]:
    """Return the matrices of a file of Abaqus or CalculiX.

    Raises:
        VehicleError: the file is damaged or none of these, or has a direction that is held.
    """
    with opened(path, LARGEST_FILE) as file, located(path):
        lines = (line.strip() for line in lines_of(file))
        first = next((line for line in lines if line and not line.startswith("**")), "")
        lines = chain([first], lines)
        if first.startswith("*"):
            return list(_substructure(lines))
        return [_of_model(path.stem, lines)]


def _substructure(lines: Iterator[str]) -> Iterator[NamedMatrix]:
    labels: Array | None = None
    for keyword, options, body in _blocks(lines):
        if keyword == "USER ELEMENT":
            if labels is not None:
                raise VehicleError("found several elements, expected the matrices of one substructure")
            labels = _labels(options, body)
        elif keyword == "MATRIX":
            if labels is None:
                raise VehicleError("*MATRIX: stands before *USER ELEMENT, which names its nodes")
            with located(f"*MATRIX, TYPE={options.get('TYPE', '')}"):
                matrix = _filled(_numbers(_data(body), len(labels) ** 2), len(labels))
            yield NamedMatrix(options.get("TYPE", "matrix"), matrix, labels)


def _blocks(lines: Iterator[str]) -> Iterator[tuple[str, dict[str, str], Iterator[str]]]:
    """Keywords with their options and the lines that follow them, of which the first is one."""
    n_keywords = 0

    def block(line: str) -> int:
        nonlocal n_keywords
        n_keywords += line.startswith("*") and not line.startswith("**")
        check_size("keywords", n_keywords, MOST_KEYWORDS)
        return n_keywords

    for _, body in groupby(lines, block):
        name, *options = (part.strip().upper() for part in next(body)[1:].split(","))
        pairs = (option.partition("=") for option in options)
        yield name, {key.strip(): value.strip() for key, _, value in pairs}, body


def _data(lines: Iterator[str]) -> Iterator[str]:
    """The lines that are neither empty nor comments."""
    return (line for line in lines if line and not line.startswith("**"))


def _labels(options: dict[str, str], lines: Iterator[str]) -> Array:
    """The node and the direction of each row, (n_dofs, 2)."""
    nodes: list[int] = []
    changes: list[list[int]] = []
    for line in lines:
        if not line.startswith("**"):
            changes += [_wholes(line)] if line else []
            check_size("lines with directions of a substructure", len(changes), MOST_NODES)
        elif re.fullmatch(r"[\s\d,]+", line[2:]):
            nodes += _wholes(line[2:])
            check_size("nodes of a substructure", len(nodes), MOST_NODES)
    n_nodes = options.get("NODES", "")
    if not nodes or str(len(nodes)) != n_nodes:
        raise VehicleError(
            f"*USER ELEMENT: found NODES={n_nodes} and {len(nodes)} numbers under ** ELEMENT NODES"
        )
    directions = _directions(changes, len(nodes))
    counts = [len(those) for those in directions]
    return np.column_stack([np.repeat(nodes, counts), [d for those in directions for d in those]])


def _wholes(line: str) -> list[int]:
    try:
        return [int(cell) for cell in line.split(",") if cell.strip()]
    except ValueError:
        raise VehicleError(f"*USER ELEMENT: found {quoted(line)}, expected whole numbers") from None


def _directions(lines: Sequence[Sequence[int]], n_nodes: int) -> list[Sequence[int]]:
    """Those of every node: the first line's, until a line that begins with a place changes them."""
    if not lines:
        raise VehicleError("*USER ELEMENT: found no line with the directions of its nodes")
    changes = {1: lines[0]} | {line[0]: line[1:] for line in lines[1:] if line}
    every: list[Sequence[int]] = []
    for place in range(1, n_nodes + 1):
        every.append(changes.get(place, every[-1] if every else ()))
    wrong = [d for those in every for d in those if not 1 <= d <= 6]
    if wrong or not all(1 <= place <= n_nodes for place in changes):
        raise VehicleError(
            "*USER ELEMENT: found directions other than 1 to 6, or of nodes that are not there"
        )
    return every


def _numbers(lines: Iterator[str], most: int) -> Floats:
    """All numbers of lines, or a few more than most."""
    parts = [np.zeros(0)]
    n_found = 0
    while n_found <= most and (some := list(islice(lines, AT_ONCE))):
        try:
            parts.append(np.array(" ".join(some).replace(",", " ").replace("D", "E").split(), float))
        except ValueError as error:
            raise VehicleError(f"found no numbers ({error})") from None
        n_found += len(parts[-1])
    return np.concatenate(parts)


def _filled(numbers: Floats, n: int) -> sp.csc_array:
    """The matrix of its lower triangle, row by row, or of all its numbers."""
    if len(numbers) == n * n:
        return sp.csc_array(numbers.reshape(n, n))
    if len(numbers) != n * (n + 1) // 2:
        raise VehicleError(
            f"found {len(numbers)} numbers, expected {n * (n + 1) // 2} of the lower triangle of {n} "
            f"rows, or {n * n} of all"
        )
    lower = np.zeros((n, n))
    lower[np.tril_indices(n)] = numbers
    return sp.csc_array(lower + np.tril(lower, -1).T)


def _of_model(name: str, lines: Iterator[str]) -> NamedMatrix:
    """The matrix of a whole model, an entry a line."""
    data = _data(lines)
    first = next(data, "")
    separator = "," if "," in first else None
    if len(first.split(separator)) not in (3, 5):
        raise VehicleError(
            f"is neither Matrix Market's nor Abaqus's: found {quoted(first)}, expected {ENTRY}"
        )
    try:
        table = np.loadtxt(
            chain([first], data), delimiter=separator, ndmin=2, comments=None, max_rows=MOST_ENTRIES
        )
    except ValueError as error:
        raise VehicleError(f"is neither Matrix Market's nor Abaqus's ({error})") from None
    check_size("entries in a matrix", len(table) + 1, MOST_ENTRIES)
    places, values = table[:, :-1], table[:, -1]
    if not (places == np.round(places)).all() or np.abs(places).max() >= 2**53:
        raise VehicleError("found places in the matrix that are no whole numbers")
    places = places.astype(np.int64)
    if places.shape[1] == 2:
        n = int(places.max())
        return NamedMatrix(name, from_entries(places[:, 0] - 1, places[:, 1] - 1, values, (n, n)))
    return _labelled(name, places, values)


def _labelled(name: str, places: Array, values: Floats) -> NamedMatrix:
    """The matrix of entries by nodes and directions, (n_entries, 4)."""
    if (places[:, [0, 2]] < 1).any():
        raise VehicleError(
            f"found node {places[:, [0, 2]].min()}, an internal one of Abaqus, as of a contact or a "
            "connector, which is at no place; expected the nodes of the model"
        )
    if not ((places[:, [1, 3]] >= 1) & (places[:, [1, 3]] <= 6)).all():
        raise VehicleError("found directions other than 1 to 6")
    if len(held := np.flatnonzero(np.abs(values) >= HELD)):
        node, direction = places[held[0], :2]
        raise VehicleError(
            f"node {node}, direction {direction}: is held, which Abaqus writes as {HELD:g}; generate "
            "the matrices in a step without boundary conditions"
        )
    keys = places[:, [0, 2]] * 10 + places[:, [1, 3]]
    every, rows = np.unique(keys, return_inverse=True)
    rows = rows.reshape(keys.shape)
    shape = (len(every), len(every))
    matrix = from_entries(rows[:, 0], rows[:, 1], values, shape)
    return NamedMatrix(name, matrix, np.column_stack([every // 10, every % 10]))
