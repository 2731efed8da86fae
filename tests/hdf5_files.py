"""HDF5 files of results written table by table after MSC Nastran's data type definitions."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from io import BytesIO
from pathlib import Path
from typing import TypeVar

import h5py
import numpy as np
from free_network import CORNERS, HEXA, LABELS, free_network

T = TypeVar("T", Path, BytesIO)

MODES, COMPLEX_MODES, BUCKLING = 2, 9, 8

POINTS = [f"{point}{i}" for point in "ABC" for i in (1, 2, 3)]
DIRECTIONS = ["X", "Y", "Z", "RX", "RY", "RZ"]

TABLES = {
    "GRID": [
        ("ID", "i8"), ("CP", "i8"), ("X", "f8", (3,)), ("CD", "i8"), ("PS", "i8"), ("SEID", "i8"),
    ],
    "SPOINT": [("ID", "i8")],
    "CORD1": [("CID", "i8"), ("G1", "i8"), ("G2", "i8"), ("G3", "i8")],
    "CORD2": [("CID", "i8"), ("RID", "i8"), *((name, "f8") for name in POINTS)],
    "CBAR": [("EID", "i8"), ("PID", "i8"), ("GA", "i8"), ("GB", "i8"), ("FLAG", "i8")],
    "CONROD": [("EID", "i8"), ("G1", "i8"), ("G2", "i8"), ("MID", "i8"), ("A", "f8")],
    "CHEXA": [("EID", "i8"), ("PID", "i8"), ("G", "i8", (20,))],
    "CTRIA6": [("EID", "i8"), ("PID", "i8"), ("G", "i8", (6,)), ("THETA", "f8")],
    "DOUBLE": [("NAME", "S8"), ("VALUE", "f8")],
    "EIGENVALUE": [
        ("MODE", "i8"), ("ORDER", "i8"), ("EIGEN", "f8"), ("OMEGA", "f8"), ("FREQ", "f8"),
        ("MASS", "f8"), ("STIFF", "f8"), ("RESFLG", "i8"), ("FLDFLG", "i8"),
    ],
    "EIGENVECTOR": [("ID", "i8"), *((name, "f8") for name in DIRECTIONS)],
    "EIGENVECTOR_CPLX": [
        ("ID", "i8"), *((f"{name}{part}", "f8") for part in "RI" for name in DIRECTIONS),
    ],
}  # fmt: skip
DOMAINS = [
    ("ID", "i8"), ("SUBCASE", "i8"), ("STEP", "i8"), ("ANALYSIS", "i8"), ("TIME_FREQ_EIGR", "f8"),
    ("EIGI", "f8"), ("MODE", "i8"), ("DESIGN_CYCLE", "i8"), ("RANDOM", "i8"), ("SE", "i8"),
]  # fmt: skip
INDEX = [("DOMAIN_ID", "i8"), ("POSITION", "i8"), ("LENGTH", "i8")]


@dataclass
class Hdf5:
    """What is to be in a file."""

    tables: dict[str, np.ndarray] = field(default_factory=dict)
    """By path."""
    domains: list[tuple] = field(default_factory=list)
    motions: dict[str, list[np.ndarray]] = field(default_factory=dict)
    """By the name of the table, a lot of rows for each mode."""
    index: dict[str, list[tuple]] = field(default_factory=dict)

    def input(self, path: str, rows: Sequence[tuple], like: str = "") -> "Hdf5":
        """A table of cards; its last column is the domain."""
        columns = [*TABLES[like or path.split("/")[-1]], ("DOMAIN_ID", "i8")]
        self.tables[f"NASTRAN/INPUT/{path}"] = np.array([(*row, 1) for row in rows], columns)
        return self

    def grids(self, rows: Sequence[tuple]) -> "Hdf5":
        """Of id, CP, three coordinates and CD."""
        return self.input("NODE/GRID", [(i, cp, place, cd, 0, 0) for i, cp, place, cd in rows])

    def frame(self, kind: str, number: int, points, reference: int = 0) -> "Hdf5":
        rows = [(number, reference, *np.ravel(points).tolist())]
        return self.input(f"COORDINATE_SYSTEM/CORD2{kind}", rows, "CORD2")

    def mode(self, ids, motions, number: int, eigenvalue: complex, analysis=MODES, subcase=1) -> "Hdf5":
        """A mode in a domain of its own."""
        name = "EIGENVECTOR_CPLX" if np.iscomplexobj(motions) else "EIGENVECTOR"
        domain = len(self.domains) + 1
        real, imaginary = np.real(eigenvalue), np.imag(eigenvalue)
        self.domains.append((domain, subcase, 0, analysis, real, imaginary, number, 0, 0, 0))
        parts = [np.real(motions), np.imag(motions)] if np.iscomplexobj(motions) else [motions]
        rows = np.column_stack(parts).tolist()
        columns = [*TABLES[name], ("DOMAIN_ID", "i8")]
        lots = self.motions.setdefault(name, [])
        lot = [(int(i), *row, domain) for i, row in zip(ids, rows, strict=True)]
        begin = sum(map(len, lots))
        self.index.setdefault(name, []).append((domain, begin, len(lot)))
        lots.append(np.array(lot, columns))
        return self

    def eigenvalues(self, rows: Sequence[tuple]) -> "Hdf5":
        """Of mode, eigenvalue, generalised mass and, if not zero, RESFLG."""
        columns = [*TABLES["EIGENVALUE"], ("DOMAIN_ID", "i8")]
        self.tables["NASTRAN/RESULT/SUMMARY/EIGENVALUE"] = np.array(
            [
                (
                    *(mode, mode, w2, abs(w2) ** 0.5, abs(w2) ** 0.5 / 6.2832, mass, mass * w2),
                    *((*flag, 0)[0], 0, mode),
                )
                for mode, w2, mass, *flag in rows
            ],
            columns,
        )
        return self

    def every(self) -> Mapping[str, np.ndarray]:
        """All tables by their paths."""
        every = dict(self.tables)
        if self.domains:
            every["NASTRAN/RESULT/DOMAINS"] = np.array(self.domains, DOMAINS)
        for name, lots in self.motions.items():
            every[f"NASTRAN/RESULT/NODAL/{name}"] = np.concatenate(lots)
            every[f"INDEX/NASTRAN/RESULT/NODAL/{name}"] = np.array(self.index[name], INDEX)
        return every

    def content(self) -> bytes:
        """The bytes of the file."""
        out = BytesIO()
        self.write(out)
        return out.getvalue()

    def write(self, path: T) -> T:
        with h5py.File(path, "w") as file:
            file.attrs["SCHEMA"] = np.array([20200])
            file.create_group("NASTRAN")
            for name, rows in self.every().items():
                file.create_dataset(name, data=rows, chunks=True, maxshape=(None,), compression="gzip")
        return path


def network_hdf5() -> Hdf5:
    """The free network, with modal masses of one."""
    network = free_network()
    hdf5 = Hdf5().grids([(i, 0, place, 0) for i, place in zip(LABELS, CORNERS, strict=True)])
    hdf5.input("ELEMENT/CHEXA", [(1, 1, [*HEXA, *[0] * 12])])
    for mode, w2 in enumerate(network.omega_n_squared):
        motions = np.zeros((8, 6))
        motions[:, :3] = network.shapes[:, :, mode]
        hdf5.mode(LABELS, motions, mode + 1, w2)
    return hdf5.eigenvalues([(i + 1, w2, 1.0) for i, w2 in enumerate(network.omega_n_squared)])
