"""Ansys's results and full matrices, from the arrays that the library's process leaves."""

import subprocess
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from modeviz.errors import VehicleError, cut, located
from modeviz.files.disk import opened
from modeviz.files.limits import VARIABLE, most_allowed
from modeviz.files.own_process import own_process
from modeviz.formats.ansys import extract
from modeviz.formats.component import CORNERS, LARGEST, Component, ElementKind, Modes
from modeviz.formats.limits import LARGEST_FILE, check_shapes
from modeviz.formats.named_matrices import LARGEST_ENTRY, NamedMatrix, from_entries
from modeviz.vehicle.arrays import Array, Floats

RESULTS, FULL = ".rst", ".full"

MODAL = 2
"""The kind of an analysis for natural modes."""

DIRECTIONS = ("UX", "UY", "UZ", "ROTX", "ROTY", "ROTZ")

KINDS: Mapping[int, ElementKind] = {
    3: "line", 21: "line", 5: "triangle", 22: "triangle", 9: "quad", 23: "quad", 10: "tetra",
    24: "tetra", 14: "pyramid", 27: "pyramid", 13: "wedge", 26: "wedge", 12: "hexa", 25: "hexa",
}  # fmt: skip
"""By the number that VTK has for a cell; its corners come first."""

ROUNDED = 1e-5
"""By which a largest motion of one may differ, in single precision."""

BEGINNINGS = (b"\x64\0\0\0", b"\0\0\0\x64")
"""Of Ansys's binary files, little and big-endian: the length of their header, 100 words."""

MOST_MEMORY = 4_000_000_000
"""Bytes, for reading a file, where the system can hold a process to them."""

LEAST_SECONDS, BYTES_A_SECOND = 60, 2_000_000
"""For reading a file."""

COMPRESSED = (
    "the file is compressed in a way that ansys-mapdl-reader does not know, as newer versions do; "
    "write it again after /FCOMP,RST,0"
)


def read_ansys(paths: Sequence[Path]) -> Component:
    """Return the component of a results file of a modal analysis.

    Raises:
        VehicleError: it is damaged, of another analysis, or in a compression that is not known, or the
            library is not installed.
    """
    if len(paths) != 1:
        raise VehicleError(f"found {len(paths)} results files, expected one")
    with located(paths[0]):
        return _component(_arrays(paths[0]))


def read_full(path: Path) -> list[NamedMatrix]:
    """Return stiffness and mass of a full file, with the nodes of its rows.

    Raises:
        VehicleError: it is damaged or cannot be read rightly, or has directions that are held.
    """
    with located(path):
        arrays = _arrays(path)
        if len(held := arrays["held"]):
            raise VehicleError(
                f"{len(held)} directions are held, such as that of node {held[0, 0]}; solve it without "
                "supports"
            )
        labels = np.column_stack([arrays["dofs"][:, 0], arrays["dofs"][:, 1] + 1]).astype(np.int64)
        if not ((labels[:, 1] >= 1) & (labels[:, 1] <= 6)).all():
            raise VehicleError("has directions other than motions and rotations, such as temperatures")
        return [_matrix(arrays, name, labels) for name in ("K", "M")]


def _matrix(arrays: Mapping[str, Array], name: str, labels: Array) -> NamedMatrix:
    rows, columns, values = (arrays[f"{name}_{part}"] for part in ("row", "col", "data"))
    n = len(labels)
    if not np.abs(values).max(initial=0.0) < LARGEST_ENTRY:
        raise VehicleError(
            f"matrix {name}: found numbers beyond {LARGEST_ENTRY:g}: ansys-mapdl-reader does not know "
            "how this version of Ansys writes them"
        )
    if not len(values):
        raise VehicleError(f"matrix {name}: has no entries; solve for modes, which needs both")
    matrix = from_entries(rows.astype(np.int64), columns.astype(np.int64), values.astype(float), (n, n))
    if name == "K" and (matrix.diagonal() == 0).any():
        node = labels[matrix.diagonal() == 0][0, 0]
        raise VehicleError(
            f"matrix K: has nothing on its diagonal at node {node}: ansys-mapdl-reader does not know "
            "how this version of Ansys writes it"
        )
    return NamedMatrix(name, matrix, labels)


def _component(arrays: Mapping[str, Array]) -> Component:
    if int(arrays["analysis"]) != MODAL or bool(arrays["is_cyclic"]):
        raise VehicleError("has results of another analysis than a modal one, or of a cyclic sector")
    if bool(arrays["is_complex"]):
        raise VehicleError("its modes are complex, which are not read; solve without damping")
    if not bool(arrays["is_whole"]):
        raise VehicleError(
            "has the motions of some of its nodes only, as a part of a distributed solution: give the "
            "file that these are combined to, with the results of all nodes (OUTRES)"
        )
    shapes = _shapes(arrays)
    mass, note = _modal_mass(arrays)
    frequency = arrays["frequencies"].astype(float)
    order = np.argsort(frequency, kind="stable")
    unknown = np.full(len(frequency), np.nan)
    return Component(
        arrays["numbers"].astype(np.int64),
        arrays["nodes"].astype(float),
        _elements(arrays["cells"], arrays["kinds"]),
        Modes(frequency[order], np.full(len(frequency), mass), unknown, shapes[:, :, order]),
        notes=(note,),
        axes=_axes(arrays["angles"]),
    )


def _modal_mass(arrays: Mapping[str, Array]) -> tuple[float, str]:
    """The modal mass of all modes, NaN if it is not known, and a sentence on it.

    MODOPT (Ansys, Mechanical APDL Command Reference) knows two normalisations: to the mass matrix, so
    that modal masses are one, and with Nrmkey to a largest motion of one. The file doesn't say which.
    """
    is_motion = np.char.startswith(arrays["directions"], "U")
    for shapes in (arrays["shapes"], arrays["shapes"][:, :, is_motion]):
        largest = np.abs(shapes).max(axis=(1, 2), initial=0.0)
        if (np.abs(largest - 1) < ROUNDED).any():
            return np.nan, (
                "its modes have a largest motion of one (Nrmkey of MODOPT), so that modal masses are "
                "not known: give the .full file too, or solve with modes normalised to mass"
            )
    return 1.0, (
        "the modal masses are taken for one: Ansys normalises modes to mass or to a largest motion of "
        "one, which they don't have"
    )


def _shapes(arrays: Mapping[str, Array]) -> Floats:
    """(n_nodes, 6, n_modes), checked for what a wrong decompression makes of them."""
    names = arrays["directions"].tolist()
    if not set(names) <= set(DIRECTIONS):
        raise VehicleError(f"has results of {', '.join(names)}, expected motions and rotations")
    found = arrays["shapes"]
    n_modes, n_nodes, _ = found.shape
    check_shapes(n_nodes, n_modes)
    still = ~found.any(axis=2)
    if not np.abs(found).max(initial=0.0) < LARGEST or (still.sum(axis=1) > n_nodes / 2).any():
        raise VehicleError(COMPRESSED)
    shapes = np.zeros((n_nodes, 6, n_modes))
    for column, name in enumerate(names):
        shapes[:, DIRECTIONS.index(name)] = found[:, :, column].T
    return shapes


def _elements(cells: Array, kinds: Array) -> dict[ElementKind, Array]:
    """Corners by kind; cells are written as their number of nodes and these."""
    found: dict[ElementKind, list[Array]] = {}
    place = 0
    for kind in kinds.tolist():
        n_nodes = int(cells[place])
        name = KINDS.get(kind)
        if name and n_nodes >= CORNERS[name]:
            found.setdefault(name, []).append(cells[place + 1 : place + 1 + CORNERS[name]])
        place += 1 + n_nodes
    return {name: np.array(corners) for name, corners in found.items()}


def _axes(angles: Array) -> Floats | None:
    """The axes of the nodes, each turned about z, about x, or about y.

    Raises:
        VehicleError: a node is turned about several: the library and the manual differ on their order.
    """
    if not angles.any():
        return None
    if ((angles != 0).sum(axis=1) > 1).any():
        raise VehicleError("has nodes that are turned about several axes, which is not read")
    axes = np.tile(np.eye(3), (len(angles), 1, 1))
    for column, (first, second) in enumerate(((0, 1), (1, 2), (2, 0))):
        turned = np.flatnonzero(angles[:, column])
        c, s = np.cos(np.radians(angles[turned, column])), np.sin(np.radians(angles[turned, column]))
        axes[turned, first, first] = axes[turned, second, second] = c
        axes[turned, second, first], axes[turned, first, second] = s, -s
    return axes


def _arrays(path: Path) -> dict[str, Array]:
    """What the library's process reads of a file."""
    with opened(path, LARGEST_FILE) as file:
        if file.read(4) not in BEGINNINGS:
            raise VehicleError("is empty or no binary file of Ansys, which begins with a header")
        seconds = LEAST_SECONDS + path.stat().st_size // BYTES_A_SECOND
    memory = most_allowed(MOST_MEMORY)
    with TemporaryDirectory() as folder:
        output = Path(folder) / "arrays.npz"
        code = Path(extract.__file__).read_text("utf-8")
        command = own_process(code, memory, str(path.resolve()), str(output))
        try:
            run = subprocess.run(command, capture_output=True, timeout=seconds, check=False)
        except subprocess.TimeoutExpired:
            raise VehicleError(f"is not read within {seconds} s: it is damaged") from None
        said = run.stderr.decode("utf-8", "replace").strip().rpartition("\n")[2]
        if said.startswith("missing:"):
            raise VehicleError(
                "to read Ansys's files ansys-mapdl-reader is needed: pip install 'modeviz[ansys]'"
            )
        if said == "memory":
            raise VehicleError(
                f"takes more than {memory:,} bytes of memory to be read: it is damaged, or "
                f"{VARIABLE}=2 in the environment would allow twice as many"
            )
        if run.returncode:
            what = f"ends with status {run.returncode}" if run.returncode < 0 else cut(said, 200)
            raise VehicleError(f"is a damaged file of Ansys, or one that is not known ({what})")
        with np.load(output, allow_pickle=False) as arrays:
            return dict(arrays)
