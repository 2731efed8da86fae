"""Bodies and modes as an unstructured grid of VTK in XML, which ParaView opens.

Written here, since meshio, the one light library for it, has had no release since 2024 and would be
there for some lines of XML alone; tests read files with an XML parser. After "VTK XML Formats" of VTK's
documentation.
"""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from xml.sax.saxutils import quoteattr

import numpy as np

from modeviz.export.axes import FileAxes
from modeviz.export.drawn import Drawn, moved
from modeviz.export.shapes import ShapeSet
from modeviz.shapes.motion import default_amplitude
from modeviz.vehicle.arrays import Array, Floats

VERTEX, LINE, TRIANGLE = 1, 3, 5
"""Types of cells."""

TYPES = {"f4": "Float32", "f8": "Float64", "i4": "Int32", "i8": "Int64", "u1": "UInt8"}
"""What VTK calls the kinds of numbers."""

UNITS = "places in m; modes mass-normalised, 1/sqrt(kg)"


N_STEPS = 24
"""Of a cycle of a motion."""


def vtu_file(name: str, bodies: Sequence[Drawn], modes: ShapeSet | None, axes: FileAxes) -> bytes:
    """Return a .vtu file: cells of bodies, and for each mode a vector at each point.

    Args:
        name: of what it is, to say so.
        bodies: what is drawn; the data of a cell say which it is of.
        modes: that move them; complex ones are two vectors each, real and imaginary part.
        axes: in which it is written.
    """
    data = "" if modes is None else "".join(_vectors(bodies, modes, axes))
    field = "" if modes is None else _field(modes)
    return _grid(name, bodies, axes, _array("Points", axes.vectors(_places(bodies))), data, field)


def motion_file(name: str, bodies: Sequence[Drawn], mode: ShapeSet, axes: FileAxes) -> bytes:
    """Return a .vtu file that moves: one cycle of a mode in `N_STEPS` time steps.

    It is drawn as large as on the screen; its vectors are the mode itself.

    Args:
        name: of what it is, to say so.
        bodies: what is drawn.
        mode: one, undamped.
        axes: in which it is written.
    """
    places = _places(bodies)
    by_body = [moved(body, mode, 0) for body in bodies]
    length = float(np.ptp(places, axis=0).max(initial=0.0))
    scale = default_amplitude(by_body, [np.ones(len(u)) for u in by_body], length)
    u = scale * np.concatenate(by_body)
    cycle = np.cos(2 * np.pi * np.arange(N_STEPS) / N_STEPS)
    steps = [
        _array("Points", axes.vectors(places + part * u).astype(np.float32), step=step)
        for step, part in enumerate(cycle)
    ]
    data = "".join(_vectors(bodies, mode, axes))
    times = f' TimeValues="{" ".join(map(str, range(N_STEPS)))}"'
    return _grid(name, bodies, axes, "".join(steps), data, times=times)


def _grid(
    name: str,
    bodies: Sequence[Drawn],
    axes: FileAxes,
    points: str,
    data: str,
    field: str = "",
    times: str = "",
) -> bytes:
    """The file of some bodies with the arrays of its points, of their data and of the whole."""
    cells, offsets, types, owners = _cells(bodies)
    names = ", ".join(f"{number} {body.body}" for number, body in enumerate(bodies))
    about = f"{name}, by modeviz; {UNITS}; axes: {axes.text}; bodies: {names}"
    joined = _array("connectivity", cells) + _array("offsets", offsets) + _array("types", types)
    return (
        '<?xml version="1.0" encoding="utf-8"?>\n'
        f"<!-- {_in_comment(about)} -->\n"
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" '
        f'header_type="UInt64">\n<UnstructuredGrid{times}>\n{field}'
        f'<Piece NumberOfPoints="{sum(len(b.places) for b in bodies)}" NumberOfCells="{len(types)}">\n'
        f"<PointData>\n{data}</PointData>\n"
        f"<CellData>\n{_array('body', owners)}</CellData>\n"
        f"<Points>\n{points}</Points>\n<Cells>\n{joined}</Cells>\n"
        "</Piece>\n</UnstructuredGrid>\n</VTKFile>\n"
    ).encode()


def _places(bodies: Sequence[Drawn]) -> Floats:
    return np.concatenate([body.places for body in bodies])


def _field(modes: ShapeSet) -> str:
    """What there is to know of modes besides how points move."""
    arrays = {
        "mode number": np.array(modes.numbers, np.int32),
        "frequency, Hz": modes.frequency_hz,
        "damping ratio": modes.damping_ratio,
    }
    lines = (_array(name, values, of_field=True) for name, values in arrays.items())
    return f"<FieldData>\n{''.join(lines)}</FieldData>\n"


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


def _array(name: str, values: Array, of_field: bool = False, step: int | None = None) -> str:
    """An array in base64 with its length before it; of one time step, or of all."""
    content = np.ascontiguousarray(values, values.dtype.newbyteorder("<")).tobytes()
    data = b64encode(np.uint64(len(content)).tobytes() + content).decode()
    shape = f' NumberOfTuples="{len(values)}"' if of_field else ""
    columns = values.shape[1] if values.ndim == 2 else 1
    shape += "" if step is None else f' TimeStep="{step}"'
    return (
        f'<DataArray type="{TYPES[values.dtype.str[1:]]}" Name={quoteattr(_plain(name))} '
        f'NumberOfComponents="{columns}"{shape} format="binary">{data}</DataArray>\n'
    )


def _in_comment(text: str) -> str:
    """A text that does not end a comment of XML."""
    return _plain(text).replace("--", "- -")


def _plain(text: str) -> str:
    """A text on one line, without the control characters that XML does not have."""
    return "".join(letter if letter.isprintable() else " " for letter in text)
