"""Which modes of a Nastran run are residual vectors (RESVEC), as far as its files say.

After MSC Nastran's DMAP Programmer's Guide, "LAMA": word 11 of its identification, RESFLG, is 1 in a
table of the modes before residual vectors are added, and 2 in one after that.
"""

import numpy as np

from modeviz.formats.nastran.bulk import Card
from modeviz.formats.nastran.model import ModesAsked
from modeviz.formats.nastran.shapes import Shapes, is_same_eigenvalue
from modeviz.vehicle.arrays import Array, Floats

BEFORE, AFTER = 1, 2
"""Of RESFLG."""

HZ_MARGIN = 1e-4
"""A mode above the end of the range that is asked for by more than this part is none of it."""

UNSAID = (
    "its modes have residual vectors among them, and the file does not say how many: give the input "
    "file too, whose EIGRL says how many modes there are; they are all taken for modes"
)


def modes_asked(card: Card) -> ModesAsked:
    """Return what an EIGRL or EIGR card asks for; raises VehicleError if it is wrong."""
    top, number = (2, 3) if card.name == "EIGRL" else (3, 5)
    return ModesAsked(card.whole(number, 0), card.real(top))


def residual_vectors(
    shapes: Shapes, rows: Floats, asked: tuple[ModesAsked, ...]
) -> tuple[int, tuple[str, ...]]:
    """Return how many of the highest modes are residual vectors, and a sentence if that is not said.

    They are the modes that a table from before they were added does not have; without such a table,
    those beyond what the input file asks for.

    Args:
        shapes: of the run.
        rows: (n, 4), of tables of eigenvalues: number, eigenvalue, generalised mass, RESFLG.
        asked: by each card of the input file; several leave it open.
    """
    if shapes.is_complex:
        return 0, ()
    before = rows[rows[:, 3] == BEFORE]
    if len(before):
        return _last(shapes, ~_has(before[:, 1], shapes.eigenvalues)), ()
    if len(set(asked)) == 1:
        return _beyond(shapes, asked[0]), ()
    return 0, (UNSAID,) if (rows[:, 3] == AFTER).any() else ()


def _has(known: Floats, eigenvalues: Array) -> Array:
    """Whether each eigenvalue is among those that are known."""
    return np.array([any(is_same_eigenvalue(value, own) for value in known) for own in eigenvalues])


def _beyond(shapes: Shapes, asked: ModesAsked) -> int:
    hertz = shapes.frequencies()[0]
    beyond = np.zeros(len(hertz), bool)
    if asked.n_modes:
        beyond[np.argsort(hertz, kind="stable")[asked.n_modes :]] = True
    if asked.top_hz > 0:
        beyond |= hertz > asked.top_hz * (1 + HZ_MARGIN)
    return _last(shapes, beyond)


def _last(shapes: Shapes, chosen: Array) -> int:
    """How many are chosen, if they are the highest, and not all; else none."""
    n_chosen = int(chosen.sum())
    order = np.argsort(np.real(shapes.eigenvalues), kind="stable")
    return n_chosen if n_chosen < len(chosen) and chosen[order[len(chosen) - n_chosen :]].all() else 0
