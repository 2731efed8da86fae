"""Bodies and modes as an unstructured grid of VTK in XML, which ParaView opens.

Written here, since meshio, the one light library for it, has had no release since 2024 and would be
there for some lines of XML alone; tests read files with an XML parser. After "VTK XML Formats" of VTK's
documentation.
"""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from xml.sax.saxutils import escape, quoteattr

import numpy as np

from modeviz.export.axes import FileAxes
from modeviz.export.drawn import Drawn, moved
from modeviz.export.shapes import ShapeSet
from modeviz.vehicle.arrays import Array

VERTEX, LINE, TRIANGLE = 1, 3, 5
"""Types of cells."""

TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
"""What VTK calls the kinds of numbers."""

UNITS = "places in m; modes mass-normalised, 1/sqrt(kg)"


def vtu_file(name: str, bodies: Sequence[Drawn], modes: ShapeSet | None, axes: FileAxes) -> bytes:
    """Return a .vtu file: cells of bodies, and for each mode a vector at each point.

    Args:
        name: of what it is, to say so.
        bodies: what is drawn; the data of a cell say which it is of.
        modes: that move them; complex ones are two vectors each, real and imaginary part.
        axes: in which it is written.
    """
    return "".join(_lines(name, bodies, modes, axes)).encode()


def _lines(name: str, bodies: Sequence[Drawn], modes: ShapeSet | None, axes: FileAxes) -> Iterator[str]:
    places = np.concatenate([body.places for body in bodies])
    cells, offsets, types, owners = _cells(bodies)
    names = ", ".join(f"{number} {body.body}" for number, body in enumerate(bodies))
    about = f"{name}, by modeviz; {UNITS}; axes: {axes.text}; bodies: {names}"
    yield '<?xml version="1.0" encoding="utf-8"?>\n'
    yield f"<!-- {_in_comment(about)} -->\n"
    yield '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
    yield 'header_type="UInt64">\n<UnstructuredGrid>\n'
    if modes is not None:
        yield "<FieldData>\n"
        yield _array("mode number", np.array(modes.numbers, np.int32), of_field=True)
        yield _array("frequency, Hz", modes.frequency_hz, of_field=True)
        yield _array("damping ratio", modes.damping_ratio, of_field=True)
        yield "</FieldData>\n"
    yield f'<Piece NumberOfPoints="{len(places)}" NumberOfCells="{len(types)}">\n<PointData>\n'
    if modes is not None:
        yield from _vectors(bodies, modes, axes)
    yield f"</PointData>\n<CellData>\n{_array('body', owners)}</CellData>\n"
    yield f"<Points>\n{_array('Points', axes.vectors(places))}</Points>\n<Cells>\n"
    yield _array("connectivity", cells) + _array("offsets", offsets) + _array("types", types)
    yield "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"


def _vectors(bodies: Sequence[Drawn], modes: ShapeSet, axes: FileAxes) -> Iterator[str]:
    """How points move in each mode."""
    for mode, (number, name) in enumerate(zip(modes.numbers, modes.names, strict=True)):
        vectors = axes.vectors(np.concatenate([moved(body, modes, mode) for body in bodies]))
        title = f"mode {number:03d}, {modes.frequency_hz[mode]:.4g} Hz, {name}"
        if np.iscomplexobj(vectors):
            yield _array(f"{title}, real", np.real(vectors).astype(np.float32))
            yield _array(f"{title}, imaginary", np.imag(vectors).astype(np.float32))
        else:
            yield _array(title, vectors.astype(np.float32))


def _cells(bodies: Sequence[Drawn]) -> tuple[Array, Array, Array, Array]:
    """Corners of all cells, where each ends among them, its type, and its body."""
    starts = np.cumsum([0, *(len(body.places) for body in bodies)])
    corners, counts, types, owners = [], [], [], []
    for number, (body, start) in enumerate(zip(bodies, starts, strict=False)):
        for kind, cells in _cells_of(body).items():
            corners.append((cells + start).ravel())
            counts += [cells.shape[1]] * len(cells)
            types += [kind] * len(cells)
            owners += [number] * len(cells)
    return (
        np.concatenate(corners).astype(np.int64),
        np.cumsum(counts, dtype=np.int64),
        np.array(types, np.uint8),
        np.array(owners, np.int32),
    )


def _cells_of(body: Drawn) -> dict[int, Array]:
    """Triangles and lines; of a body that has neither, its points."""
    joined = {TRIANGLE: body.triangles, LINE: body.lines}
    if any(map(len, joined.values())):
        return joined
    return {VERTEX: np.arange(len(body.places))[:, None]}


def _array(name: str, values: Array, of_field: bool = False) -> str:
    """An array in base64 with its length before it."""
    content = np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()
    data = b64encode(np.uint64(len(content)).tobytes() + content).decode()
    shape = f' NumberOfTuples="{len(values)}"' if of_field else ""
    columns = values.shape[1] if values.ndim == 2 else 1
    return (
        f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name={quoteattr(name)} '
        f'NumberOfComponents="{columns}"{shape} format="binary">{data}</DataArray>\n'
    )


def _in_comment(text: str) -> str:
    """A text that does not end a comment of XML."""
    return escape(text).replace("--", "- -")
