"""The nodes that matrices move, as a table: number, place, and which of their directions count.

    node, x, y, z, dofs
    101, 0.0, 250.0, 30.5, 123456
    102, 10.0, 250.0, 30.5, 123

A line a node, in the order of the matrices' rows, which has each node's directions one after another:
1, 2, 3 for x, y, z, and 4, 5, 6 for rotations about them. Without the last column all nodes have three
or all have six, as many as the matrices' size tells. A scalar, which is at no place, has a 0 there. The
header may be missing: lines as they stand under Abaqus's *NODE do.
"""

import re
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.disk import WESTERN, read_text
from modeviz.formats.component import check_range
from modeviz.formats.limits import LARGEST_FILE
from modeviz.vehicle.arrays import Array, Floats

COLUMNS = ("node", "x", "y", "z")
ALSO = {
    "id": "node", "label": "node", "grid": "node", "nid": "node", "number": "node",
    "dof": "dofs", "mask": "dofs",
}  # fmt: skip

ALL_DIRECTIONS = (123, 123456)
"""What nodes have whose table does not say it."""


@dataclass(frozen=True, eq=False)
class NodeTable:
    """Nodes in the order of the rows of matrices."""

    ids: Array
    """(n_nodes,)."""
    places: Floats
    """(n_nodes, 3)."""
    masks: Array | None = None
    """(n_nodes,), the digits of their directions as one number; 0 of a scalar; None: unknown."""

    def labels(self, n_dofs: int) -> Array:
        """Return the node and the direction of each row of matrices of that size, (n_dofs, 2).

        Raises:
            VehicleError: the nodes have more or fewer directions.
        """
        masks = self._masks(n_dofs)
        digits = [[int(digit) for digit in str(mask)] for mask in masks.tolist()]
        labels = np.column_stack(
            [np.repeat(self.ids, [len(d) for d in digits]), [digit for d in digits for digit in d]]
        )
        if len(labels) != n_dofs:
            raise VehicleError(
                f"the matrices have {n_dofs} degrees of freedom, the {len(self.ids)} nodes "
                f"{len(labels)}"
            )
        return labels

    def _masks(self, n_dofs: int) -> Array:
        if self.masks is not None:
            return self.masks
        for mask in ALL_DIRECTIONS:
            if n_dofs == len(str(mask)) * len(self.ids):
                return np.full(len(self.ids), mask)
        raise VehicleError(
            f"the matrices have {n_dofs} degrees of freedom, which is neither three nor six for each "
            f"of the {len(self.ids)} nodes: say in a column dofs which each node has, such as 123456"
        )


def read_node_table(path: Path) -> NodeTable:
    """Return the nodes of a table.

    Raises:
        VehicleError: it is no such table, or a number in it is wrong.
    """
    text = read_text(path, LARGEST_FILE, otherwise=WESTERN)
    with located(path):
        first, _, rest = text.strip().partition("\n")
        separator = next((mark for mark in ";\t," if mark in first), None)
        names = _names(first, separator) if first else []
        if not (rest if names else first):
            raise VehicleError("found no nodes, expected a line for each")
        numbers = _numbers(rest if names else text, separator, bool(names))
        columns = _columns(names or [*COLUMNS, "dofs"][: numbers.shape[1]], numbers)
        ids = _whole("node", columns["node"])
        places = np.column_stack([columns[name] for name in "xyz"])
        masks = _whole("dofs", columns["dofs"]) if "dofs" in columns else None
        if masks is not None:
            _check_masks(ids, masks)
        check_range("the places of nodes", places)
        return NodeTable(ids, places, masks)


def _names(line: str, separator: str | None) -> list[str]:
    """The columns of a header, without their units; none of a line of numbers."""
    cells = [cell.strip().strip('"').lower() for cell in line.split(separator)]
    cells = [re.sub(r"\s*[\[(].*", "", cell) for cell in cells]
    try:
        float(cells[0])
    except ValueError:
        return [ALSO.get(cell, cell) for cell in cells]
    return []


def _numbers(text: str, separator: str | None, has_header: bool) -> Floats:
    if separator in (";", "\t"):
        text = text.replace(",", ".")
    lines = (line.rstrip().rstrip(",;") if separator else line for line in StringIO(text))
    try:
        return np.loadtxt(lines, delimiter=separator, ndmin=2, comments=("#", "*"))
    except ValueError as error:
        raise VehicleError(
            f"is no table of numbers below {'its header' if has_header else 'no header'} ({error})"
        ) from None


def _columns(names: list[str], numbers: Floats) -> dict[str, Floats]:
    if repeated := {name for name in names if names.count(name) > 1}:
        raise VehicleError(f"column {min(repeated)} is there twice")
    if len(names) != numbers.shape[1]:
        raise VehicleError(f"found {numbers.shape[1]} columns under {len(names)} names")
    columns = dict(zip(names, numbers.T.reshape(len(names), -1), strict=True))
    if missing := [name for name in COLUMNS if name not in columns]:
        raise VehicleError(
            f"found the columns {listed(quoted(name) for name in names)}, without {listed(missing)}; "
            "expected node, x, y, z and, if wanted, dofs"
        )
    return columns


def _whole(name: str, values: Floats) -> Array:
    wrong = ~((values >= 0) & (values == np.round(values)) & (values < 2**53))
    if wrong.any():
        raise VehicleError(f"column {name}: found {values[wrong][0]:g}, expected whole numbers")
    return values.astype(np.int64)


def _check_masks(ids: Array, masks: Array) -> None:
    for mask in np.unique(masks).tolist():
        if not re.fullmatch(r"0|(?!\d*(\d)\d*\1)[1-6]{1,6}", str(mask)):
            node = ids[masks == mask][0]
            raise VehicleError(
                f"node {node}: found the dofs {mask}, expected different digits from 1 to 6, or 0 for "
                "a scalar"
            )
