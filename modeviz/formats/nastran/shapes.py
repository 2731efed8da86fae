"""Modes as any of Nastran's result files has them, in whichever order it writes them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, located
from modeviz.formats.component import check_range, rows_of
from modeviz.formats.limits import check_shapes
from modeviz.vehicle.arrays import Array, Floats

OTHER_GRIDS = "moves other grids than the first mode"


@dataclass(frozen=True, eq=False)
class Shape:
    """A mode, or what one table has of it: superelements have a table each."""

    subcase: int
    mode: int
    eigenvalue: complex
    """ω² of a normal mode, s of a complex one."""
    ids: Array
    """(n,), of the grids."""
    motions: Callable[[], Array]
    """Reads them, (n, 6), real or complex."""
    n_scalar: int = 0
    """How many scalar points there are beside the grids, which no one can see move."""

    def __post_init__(self) -> None:
        if not np.isfinite(self.eigenvalue):
            raise VehicleError(f"mode {self.mode} has an eigenvalue that is no finite number")
        rising = np.sort(self.ids)
        if len(again := rising[1:][rising[1:] == rising[:-1]]):
            raise VehicleError(f"mode {self.mode} moves grid {again[0]} twice")


@dataclass(frozen=True, eq=False)
class Shapes:
    """The modes of a file, of its first subcase that has any."""

    ids: Array
    """(n_nodes,), of the grids that all modes move, rising."""
    array: Array
    """(n_nodes, 6, n_modes), in the precision of the file, real or complex."""
    numbers: Array
    """(n_modes,), of the modes."""
    eigenvalues: Array
    """(n_modes,), complex: ω² of normal modes, s of complex ones."""
    is_basic: bool
    """Whether motions are in the basic system, and not in those of the grids' CD."""
    notes: tuple[str, ...]
    """What was left out."""

    @property
    def is_complex(self) -> bool:
        """Whether they are those of a damped structure."""
        return np.iscomplexobj(self.array)

    def frequencies(self) -> tuple[Floats, Floats]:
        """Return hertz, below zero where ω² is, and damping ratios, not numbers for normal modes.

        They are those of eigenvalues: what tables say of hertz is in rad/s in some files.
        """
        size = np.abs(self.eigenvalues)
        unknown = np.full(len(size), np.nan)
        if self.is_complex:
            ratio = np.divide(-np.real(self.eigenvalues), size, out=unknown, where=size > 0)
            return size / (2 * np.pi), ratio
        return np.sign(np.real(self.eigenvalues)) * np.sqrt(size) / (2 * np.pi), unknown

    def modal_masses(self, rows: Array) -> Floats:
        """Return the generalised mass of each mode, (n_modes,); not a number where none is said.

        Args:
            rows: (n, 4), of tables of eigenvalues: number of a mode, eigenvalue, generalised mass,
                RESFLG. A row is of the mode of the same number and eigenvalue.
        """
        known: dict[int, list[tuple[float, float]]] = {}
        for number, eigenvalue, mass in rows[:, :3].tolist():
            known.setdefault(int(number), []).append((eigenvalue, mass))
        masses = np.full(len(self.numbers), np.nan)
        for i, (number, own) in enumerate(zip(self.numbers.tolist(), self.eigenvalues, strict=True)):
            for eigenvalue, mass in known.get(number, []):
                is_same = is_same_eigenvalue(eigenvalue, own)
                if is_same and not self.is_complex and np.isfinite(mass) and mass > 0:
                    masses[i] = mass
        return masses


def is_same_eigenvalue(one: float, other: complex) -> bool:
    """Return whether two eigenvalues are alike in all digits of single precision, but some."""
    return abs(one - other) <= 1e-5 * max(abs(other), 1e-3)


def assembled(found: Sequence[Shape], is_basic: bool) -> Shapes:
    """Return the modes of the first subcase, each put together of all tables that have some of it.

    Other subcases are those of other superelements where they have the same eigenvalues at other grids.

    Args:
        found: in the order of the file.
        is_basic: whether their motions are in the basic system.

    Raises:
        VehicleError: they move different grids, or are too many or no finite numbers.
    """
    parts: dict[int, list[Shape]] = {}
    for shape in found:
        same = parts.get(shape.mode)
        if same is None and shape.subcase == found[0].subcase:
            parts[shape.mode] = [shape]
        elif same and same[0].eigenvalue == shape.eigenvalue and _is_more(shape, same[0]):
            same.append(shape)
    modes = list(parts.values())
    ids = np.unique(np.concatenate([part.ids for part in modes[0]]))
    check_shapes(len(ids), len(modes))
    array = np.empty(0)
    for column, mode in enumerate(modes):
        with located(f"mode {mode[0].mode}"):
            motions = _motions(ids, mode)
            if column == 0:
                array = np.empty((*motions.shape, len(modes)), motions.dtype)
            _check_one_kind(motions, array)
        array[:, :, column] = motions
    subcase = found[0].subcase
    n_again = sum(shape.subcase == subcase for shape in found) - sum(
        part.subcase == subcase for mode in modes for part in mode
    )
    n_other = len(found) - sum(len(mode) for mode in modes) - n_again
    return Shapes(
        ids,
        array,
        np.array([mode[0].mode for mode in modes]),
        np.array([complex(mode[0].eigenvalue) for mode in modes]),
        is_basic,
        tuple(_left_out(sum(part.n_scalar for part in modes[0]), n_other, subcase, n_again)),
    )


def _is_more(shape: Shape, first: Shape) -> bool:
    """Whether a shape is a part of the same mode: of the same subcase, or with grids of its own."""
    return shape.subcase == first.subcase or not np.isin(shape.ids, first.ids).all()


def _check_one_kind(motions: Array, others: Array) -> None:
    """Raises VehicleError for real motions among complex ones, or the reverse."""
    if np.iscomplexobj(motions) != np.iscomplexobj(others):
        raise VehicleError(
            "found real and complex modes, expected those of one run; is the file of several?"
        )


def _motions(ids: Array, parts: Sequence[Shape]) -> Array:
    """The motions of a mode along ids, (n, 6), of which each table has some; the first that has one."""
    first = parts[0].motions()
    motions = np.empty((len(ids), 6), first.dtype.newbyteorder("="))
    is_there = np.zeros(len(ids), bool)
    for part in reversed(parts):
        rows = _rows(ids, part)
        own = first if part is parts[0] else part.motions()
        _check_one_kind(own, motions)
        motions[rows] = own
        is_there[rows] = True
    if not is_there.all():
        raise VehicleError(OTHER_GRIDS)
    check_range("its motions", motions)
    return motions


def _rows(ids: Array, part: Shape) -> Array | slice:
    """Where the grids of a part stand among rising ids."""
    if np.array_equal(ids, part.ids):
        return slice(None)
    try:
        return rows_of(ids, part.ids)
    except VehicleError:
        raise VehicleError(OTHER_GRIDS) from None


def _left_out(n_scalar: int, n_other: int, subcase: int, n_again: int) -> Iterator[str]:
    """Sentences on what shapes have not of a file."""
    if n_scalar:
        yield f"{n_scalar} scalar points have no place and are left out"
    if n_other:
        yield f"{n_other} modes of other subcases than {subcase} are left out"
    if n_again:
        yield (
            f"{n_again} modes have the number of one before them, as those of further rotor speeds, "
            "and are left out"
        )
