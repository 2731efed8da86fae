"""Matrices on cards, as in input files and in what Nastran punches: DMIG, with the grids they name."""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field

import numpy as np

from modeviz.errors import VehicleError, located, quoted
from modeviz.files.limits import check_size
from modeviz.formats.named_matrices import MOST_ENTRIES, NamedMatrix, from_entries
from modeviz.formats.nastran.bulk import Card
from modeviz.vehicle.arrays import Array

FORMS = (1, 6)
"""Square and symmetric; of rectangular matrices there is neither mass nor stiffness."""

REAL = (1, 2)


@dataclass
class _Entries:
    """Of one matrix: place and direction of the row and of the column of each."""

    form: int
    kind: int
    places: list[tuple[int, int, int, int]] = field(default_factory=list)
    values: list[float] = field(default_factory=list)


NAMES = frozenset({"DMIG", "EXTRN", "SPOINT"})
"""The cards that are read."""


@dataclass
class MatrixCards:
    """What cards say of matrices and of the order of their rows, one after the other."""

    found: dict[str, _Entries] = field(default_factory=dict)
    external: list[tuple[int, int]] = field(default_factory=list)
    """The degrees of freedom of an external superelement."""
    scalars: set[int] = field(default_factory=set)

    def add(self, card: Card) -> None:
        """Take in one of `NAMES`; raises VehicleError if it is wrong."""
        if card.name == "DMIG":
            _add(card, self.found)
        elif card.name == "EXTRN":
            self.external += _external(card)
        else:
            self.scalars.update(_listed(card))

    def matrices(self) -> list[NamedMatrix]:
        """Return the square real ones; raises VehicleError if one is wrong."""
        return list(_matrices(self.found))

    def orders(self, grids: Iterable[int]) -> list[Array]:
        """Return what rows of matrices may be, in their order: grids and directions, (n, 2).

        The degrees of freedom of an external superelement; and all grids with six directions each
        and all scalar points, by their numbers (the g-set).
        """
        whole = [(grid, d) for grid in set(grids) for d in range(1, 7)]
        orders = [self.external, sorted([*whole, *((scalar, 0) for scalar in self.scalars)])]
        return [np.array(order, np.int64) for order in orders if order]


def _add(card: Card, found: dict[str, _Entries]) -> None:
    """Adds a card, which begins a matrix or has entries of one of its columns."""
    name = card.text(0).upper()
    if card.text(1) == "0":
        if name in found:
            raise VehicleError(f"DMIG {quoted(name)}: begins twice")
        found[name] = _Entries(card.whole(2), card.whole(3))
        return
    if name not in found:
        raise VehicleError(f"DMIG {quoted(name)}: has entries before the card that says what it is")
    entries = found[name]
    column = card.whole(1), card.whole(2, 0)
    for first in range(4, len(card.fields), 4):
        if card.text(first):
            entries.places.append((card.whole(first), card.whole(first + 1, 0), *column))
            entries.values.append(card.real(first + 2))
    check_size("entries in a matrix", len(entries.values), MOST_ENTRIES)


def _matrices(found: dict[str, _Entries]) -> Iterator[NamedMatrix]:
    for name, entries in found.items():
        if entries.form in FORMS and entries.kind in REAL and entries.values:
            with located(f"DMIG {quoted(name)}"):
                yield _matrix(name, entries)


def _matrix(name: str, entries: _Entries) -> NamedMatrix:
    places = np.array(entries.places, np.int64)
    wrong = (places[:, [1, 3]] < 0) | (places[:, [1, 3]] > 6) | (places[:, [0, 2]] < 1)
    if wrong.any():
        grid, direction = (
            places[:, :2][wrong[:, 0]][0] if wrong[:, 0].any() else places[wrong[:, 1]][0, 2:]
        )
        raise VehicleError(
            f"found grid {grid}, direction {direction}, expected 1 to 6, or 0 of a scalar"
        )
    keys = places[:, [0, 2]] * 10 + places[:, [1, 3]]
    every, rows = np.unique(keys, return_inverse=True)
    rows = rows.reshape(keys.shape)
    if len(np.unique(rows[:, 0] * len(every) + rows[:, 1])) < len(rows):
        raise VehicleError("has an entry twice")
    n = len(every)
    matrix = from_entries(rows[:, 0], rows[:, 1], np.array(entries.values), (n, n))
    return NamedMatrix(name, matrix, np.column_stack([every // 10, every % 10]))


def _external(card: Card) -> Iterable[tuple[int, int]]:
    """Grids, each with the digits of its directions, 0 of a scalar."""
    for first in range(0, len(card.fields), 2):
        if card.text(first):
            digits = card.text(first + 1) or "0"
            if not set(digits) <= set("0123456"):
                raise VehicleError(f"EXTRN: found {quoted(digits)}, expected digits from 0 to 6")
            yield from ((card.whole(first), int(digit)) for digit in digits)


def _listed(card: Card) -> Iterable[int]:
    """The scalar points of a card: a list, or the first THRU the last."""
    if card.text(1).upper() == "THRU":
        first, last = card.whole(0), card.whole(2)
        check_size("scalar points on a card", last - first, 10_000_000)
        return range(first, last + 1)
    return [card.whole(i) for i, text in enumerate(card.fields) if text]
