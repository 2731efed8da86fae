"""Matrices by name, and which of them are the mass and the stiffness."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from modeviz.errors import VehicleError, listed, quoted
from modeviz.files.limits import check_size
from modeviz.vehicle.arrays import Array, Floats

LARGEST_ENTRY = 1e30
"""Penalty stiffnesses reach 1e20; what is beyond this is no number that a program wrote."""

MOST_ENTRIES = 500_000_000
"""Of a sparse matrix, 6 GB."""

MOST_DOFS = 10_000_000

ASYMMETRIC = 1e-6
"""Part of the largest entries about it by which an entry may differ from its mirror image."""

_MATRIX_OF = {"stiffness": "k", "mass": "m"}
_SETS = r"(?!4)(?:2?(?:aa|cc|ff|gg|jj|ll|nn|oo|pp|qq|tt|xx)x?|mat|matrix|global|e|red|reduced)?\d*"
_WORDS = {"stiffness": re.compile(rf"k{_SETS}|.*stif.*"), "mass": re.compile(rf"m{_SETS}|.*mass.*")}


@dataclass(frozen=True, eq=False)
class NamedMatrix:
    """A matrix of a file."""

    name: str
    """What its file calls it, or else the file's own name."""
    matrix: sp.csc_array
    """(n_dofs, n_dofs)."""
    labels: Array | None = None
    """(n_dofs, 2), of each row the node and 1 to 6 for x to rz, 0 of a scalar; None: unknown."""

    @property
    def shape(self) -> tuple[int, int]:
        """Of the matrix."""
        assert self.matrix.shape
        return self.matrix.shape


def from_entries(rows: Array, columns: Array, values: Floats, shape: tuple[int, int]) -> sp.csc_array:
    """Return the sparse matrix of some entries; those of one place add up.

    Raises:
        VehicleError: a place is outside of it, or it is too large.
    """
    check_size("degrees of freedom in a matrix", max(shape), MOST_DOFS)
    check_size("entries in a matrix", len(values), MOST_ENTRIES)
    for what, places, count in (("row", rows, shape[0]), ("column", columns, shape[1])):
        if len(places) and not 0 <= places.min() <= places.max() < count:
            wrong = places[(places < 0) | (places >= count)][0] + 1
            raise VehicleError(f"found an entry in {what} {wrong}, expected 1 to {count}")
    return sp.csc_array(sp.coo_array((values, (rows, columns)), shape=shape))


def symmetric(found: NamedMatrix) -> sp.csc_array:
    """Return a matrix made exactly symmetric; one that has each entry on one side alone is mirrored.

    Raises:
        VehicleError: it is not square, not of finite numbers, or not symmetric.
    """
    A, shape = found.matrix, found.shape
    if shape[0] != shape[1]:
        raise VehicleError(
            f"matrix {found.name}: found {shape[0]} rows and {shape[1]} columns, expected as many"
        )
    check_size("entries in a matrix", A.nnz, MOST_ENTRIES)
    try:
        A.check_format(full_check=True)
    except ValueError as error:
        raise VehicleError(f"matrix {found.name}: its parts make no matrix ({error})") from None
    if np.iscomplexobj(A.data):
        raise VehicleError(f"matrix {found.name}: has complex numbers, expected real ones")
    A = sp.csc_array(A, dtype=float)
    if not np.abs(A.data).max(initial=0.0) < LARGEST_ENTRY:
        raise VehicleError(
            f"matrix {found.name}: has values that are not finite numbers, or beyond {LARGEST_ENTRY:g}"
        )
    beside = sp.csc_array(A - sp.diags_array(A.diagonal()))
    beside.eliminate_zeros()
    if beside.nnz and not beside.multiply(beside.T).nnz:
        return sp.csc_array(A + beside.T)
    _check_symmetric(found, A)
    return sp.csc_array((A + A.T) / 2)


def _check_symmetric(found: NamedMatrix, A: sp.csc_array) -> None:
    skew = abs(A - A.T).tocoo()
    rows, columns = skew.coords
    largest = abs(A).max(axis=0).toarray() + abs(A).max(axis=1).toarray()
    wrong = np.flatnonzero(skew.data > ASYMMETRIC * np.minimum(largest[rows], largest[columns]))
    if len(wrong):
        worst = wrong[skew.data[wrong].argmax()]
        row, column = rows[worst], columns[worst]
        raise VehicleError(
            f"matrix {found.name}: is not symmetric: found {A[row, column]:.6g} in row {row + 1}, "
            f"column {column + 1}, and {A[column, row]:.6g} in its mirror image"
        )


def mass_and_stiffness(
    found: Sequence[NamedMatrix],
) -> tuple[NamedMatrix, NamedMatrix, tuple[str, ...]]:
    """Return the mass, the stiffness, and the names of the other matrices.

    Names are K, M, KGG, MAAX and their like, alone or as a word of a longer one such as "cab_K", or
    have "stif" or "mass" in them.

    Raises:
        VehicleError: one of them is missing, or there are several of it.
    """
    chosen = {}
    for role, letter in _MATRIX_OF.items():
        those = [matrix for matrix in found if _is(role, matrix.name)]
        if len(those) != 1:
            raise VehicleError(
                f"found {len(those) or 'no'} {role} {'matrices' if len(those) > 1 else 'matrix'} among "
                f"{listed(quoted(matrix.name) for matrix in found)}, expected one with a name such as "
                f"{letter.upper()} or {role}; rename the file or the variable"
            )
        chosen[role] = those[0]
    others = tuple(matrix.name for matrix in found if matrix not in chosen.values())
    return chosen["mass"], chosen["stiffness"], others


def _is(role: str, name: str) -> bool:
    words = re.split(r"[^a-z0-9]+", name.lower())
    return any(_WORDS[role].fullmatch(word) for word in words)
