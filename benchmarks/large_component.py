"""A component of any size as another program writes it: a free box of solids in an OP2 file."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.vehicle.arrays import Array, Floats

STEP = 20.0
"""mm, between nodes."""

NODE_MASS = 1e-6
"""t, of each node."""

FIRST_HZ, STEP_HZ = 20.0, 3.0

N_RIGID = 6

GRID, HEXA = (4501, 45, 1), (7308, 73, 253)
"""Keys of the records in which grids and solids are."""

MOST_WORDS = 1_000_000
"""Between two keys, so that long records are in parts."""


@dataclass(frozen=True)
class Box:
    """A box of nodes."""

    nodes: tuple[int, int, int]
    """Along x, y and z."""
    n_modes: int
    """With the six rigid ones."""

    @property
    def n_nodes(self) -> int:
        """How many nodes it has."""
        return int(np.prod(self.nodes))

    def places(self) -> Floats:
        """Where its nodes are, (n_nodes, 3), mm."""
        along = [STEP * np.arange(n) for n in self.nodes]
        return np.stack(np.meshgrid(*along, indexing="ij"), axis=-1).reshape(-1, 3).astype(float)

    def corners(self) -> Array:
        """The nodes of its solids, (n_solids, 8), from one."""
        number = np.arange(1, self.n_nodes + 1).reshape(self.nodes)
        low, high = slice(None, -1), slice(1, None)
        face = [(low, low), (high, low), (high, high), (low, high)]
        return np.stack([number[x, y, z].ravel() for z in (low, high) for x, y in face], axis=1)

    def frequency_hz(self, mode: int) -> float:
        """Of a mode, from zero."""
        return 0.0 if mode < N_RIGID else FIRST_HZ + STEP_HZ * (mode - N_RIGID)

    def shapes(self) -> Iterator[Floats]:
        """Its modes, (n_nodes, 6) each, with a modal mass of one."""
        places = self.places()
        rigid = rigid_modes(places)
        yield from rigid
        flat = rigid[:, :, :3].reshape(N_RIGID, -1)
        for number in range(self.n_modes - N_RIGID):
            shape = np.zeros((self.n_nodes, 6))
            waves = np.cos(np.pi * (number // 3 + 1) * (places / places.max(axis=0)))
            shape[:, number % 3] = waves.prod(axis=1)
            shape[:, (number + 1) % 3] = number / self.n_modes * shape[:, number % 3]
            motion = shape[:, :3].reshape(-1)
            motion -= NODE_MASS * (flat @ motion) @ flat
            shape[:, :3] = motion.reshape(-1, 3) / np.sqrt(NODE_MASS * motion @ motion)
            yield shape


def rigid_modes(places: Floats) -> Floats:
    """The six rigid modes of equal masses, (6, n_nodes, 6), with a modal mass of one."""
    n = len(places)
    center = places.mean(axis=0)
    motions = np.zeros((N_RIGID, n, 6))
    for axis in range(3):
        unit = np.eye(3)[axis]
        motions[axis, :, axis] = 1.0
        motions[3 + axis, :, :3] = np.cross(unit, places - center)
        motions[3 + axis, :, 3 + axis] = 1.0
    size = np.sqrt(NODE_MASS * (motions[:, :, :3] ** 2).sum(axis=(1, 2)))
    return motions / size[:, None, None]


def write_op2(path: Path, box: Box) -> None:
    """Writes a box as MSC Nastran does: words of four bytes, the lowest first."""
    ids = np.arange(1, box.n_nodes + 1)
    with path.open("wb") as file:
        file.write(_key(3) + _fortran(_words(1, 1, 26)) + _key(7))
        file.write(_fortran(b"NASTRAN FORT TAPE ID CODE - ") + _key(2) + _fortran(b"XXXXXXXX"))
        file.write(_key(-1) + _key(0))
        grids = np.zeros((box.n_nodes, 8), "<i4")
        grids[:, 0] = ids
        grids[:, 2:5] = box.places().astype("<f4").view("<i4")
        file.writelines(_table("GEOM1", [_words(*GRID) + grids.tobytes()]))
        solids = np.zeros((len(box.corners()), 22), "<i4")
        solids[:, 0] = np.arange(1, len(solids) + 1)
        solids[:, 1] = 1
        solids[:, 2:10] = box.corners()
        file.writelines(_table("GEOM2", [_words(*HEXA) + solids.tobytes()]))
        file.writelines(_table("LAMA", [_words(21, 6, *[0] * 144), _eigenvalues(box)]))
        file.writelines(_table("OUGV1", _records(box, ids)))
        file.write(_key(0))


def _eigenvalues(box: Box) -> bytes:
    """Rows of number twice, eigenvalue, rad/s, hertz, generalised mass and stiffness."""
    rows = np.zeros((box.n_modes, 7), "<f4")
    hertz = np.array([box.frequency_hz(mode) for mode in range(box.n_modes)])
    omega_n = 2 * np.pi * hertz
    rows[:, 2:] = np.column_stack([omega_n**2, omega_n, hertz, np.ones_like(hertz), omega_n**2])
    rows.view("<i4")[:, :2] = np.arange(1, box.n_modes + 1)[:, None]
    return rows.tobytes()


def _records(box: Box, ids: Array) -> Iterator[bytes]:
    """A header and the motions of each mode, in turn."""
    rows = np.ones((box.n_nodes, 8), "<i4")
    rows[:, 0] = 10 * ids + 2
    for mode, shape in enumerate(box.shapes()):
        omega_n_squared = (2 * np.pi * box.frequency_hz(mode)) ** 2
        number = np.array([omega_n_squared], "<f4").view("<i4")[0]
        yield _words(22, 7, 0, 1, mode + 1, int(number), 0, 0, 1, 8, *[0] * 136)
        rows[:, 2:] = shape.astype("<f4").view("<i4")
        yield rows.tobytes()


def _table(name: str, records: list[bytes] | Iterator[bytes]) -> Iterator[bytes]:
    yield _key(2) + _fortran(name.ljust(8).encode()) + _key(-1)
    yield _key(7) + _fortran(_words(101, *[0] * 6)) + _key(-2)
    yield _key(1) + _fortran(_words(0)) + _key(2) + _fortran(name.ljust(8).encode()) + _key(-3)
    number = -3
    for record in records:
        number -= 1
        yield _key(1) + _fortran(_words(0))
        for begin in range(0, len(record), 4 * MOST_WORDS):
            part = record[begin : begin + 4 * MOST_WORDS]
            yield _key(len(part) // 4) + _fortran(part)
        yield _key(number)
    yield _key(1) + _fortran(_words(0)) + _key(0)


def _words(*numbers: int) -> bytes:
    return np.array(numbers, "<i4").tobytes()


def _fortran(content: bytes) -> bytes:
    return _words(len(content)) + content + _words(len(content))


def _key(number: int) -> bytes:
    return _fortran(_words(number))
