"""A .vtu file as "VTK XML Formats" describes it, read by an XML parser."""

import base64
import xml.etree.ElementTree as ElementTree

import numpy as np

TYPES = {"Float32": "<f4", "Float64": "<f8", "Int32": "<i4", "Int64": "<i8", "UInt8": "u1"}


def read_vtu(content: bytes) -> dict[str, dict[str, np.ndarray]]:
    """The arrays of one piece by their names, by the element that they are in."""
    root = ElementTree.fromstring(content)
    assert root.tag == "VTKFile"
    assert root.attrib["type"] == "UnstructuredGrid"
    assert (root.attrib["byte_order"], root.attrib["header_type"]) == ("LittleEndian", "UInt64")
    (piece,) = root.iter("Piece")
    n_points, n_cells = int(piece.attrib["NumberOfPoints"]), int(piece.attrib["NumberOfCells"])
    groups = {group.tag: _arrays(group) for group in (*root[0], *piece) if group.tag != "Piece"}
    assert all(len(array) == n_points for array in groups["PointData"].values())
    assert groups["Points"]["Points"].shape == (n_points, 3)
    assert len(groups["Cells"]["types"]) == len(groups["Cells"]["offsets"]) == n_cells
    assert all(len(array) == n_cells for array in groups["CellData"].values())
    assert groups["Cells"]["offsets"][-1] == len(groups["Cells"]["connectivity"])
    assert groups["Cells"]["connectivity"].max() < n_points
    return groups


def time_steps(content: bytes) -> np.ndarray:
    """Where points are at each of a file's time steps, (n_steps, n_points, 3)."""
    (grid,) = ElementTree.fromstring(content)
    (points,) = grid.iter("Points")
    steps = {int(element.attrib["TimeStep"]): _array(element) for element in points}
    assert list(steps) == list(range(len(grid.attrib["TimeValues"].split())))
    return np.array([*steps.values()])


def cells(groups: dict[str, dict[str, np.ndarray]], kind: int) -> np.ndarray:
    """The corners of cells of a type."""
    its = groups["Cells"]
    ends = np.split(its["connectivity"], its["offsets"][:-1])
    return np.array([corners for corners, t in zip(ends, its["types"], strict=True) if t == kind])


def _arrays(group: ElementTree.Element) -> dict[str, np.ndarray]:
    return {element.attrib["Name"]: _array(element) for element in group.iter("DataArray")}


def _array(element: ElementTree.Element) -> np.ndarray:
    assert element.attrib["format"] == "binary"
    content = base64.b64decode(element.text or "", validate=True)
    length = int.from_bytes(content[:8], "little")
    assert length == len(content) - 8
    values = np.frombuffer(content[8:], TYPES[element.attrib["type"]])
    columns = int(element.attrib["NumberOfComponents"])
    return values.reshape(-1, columns) if columns > 1 else values
