"""What makes matrices none of a free structure in one piece, before they are solved."""

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from modeviz.errors import VehicleError, listed
from modeviz.fem.matrices import Matrices
from modeviz.vehicle.arrays import Array

UNEVEN = 0.01
"""Part by which the mass may differ along x, y and z."""


def check_structure(matrices: Matrices, node_ids: Array) -> None:
    """Checks that matrices are of one structure whose nodes are at the places given.

    Whether it is free is seen when it is solved, by its first modes.

    Args:
        matrices: in any units.
        node_ids: (n_nodes,).

    Raises:
        VehicleError: they are not.
    """
    _check_pieces(matrices, node_ids)
    R = matrices.rigid
    mass = np.diag(R.T @ (matrices.mass @ R))[:3]
    if not (mass > 0).all():
        direction = "xyz"[int(mass.argmin())]
        raise VehicleError(f"the mass along {direction} is {mass.min():.6g}, expected more than 0")
    if np.ptp(mass) > UNEVEN * mass.max():
        raise VehicleError(
            f"the mass along x, y and z is {listed(f'{m:.6g}' for m in mass)}, expected the same: the "
            "nodes stand in another order than the matrices' rows, or some of their directions are "
            "held or missing"
        )


def _check_pieces(matrices: Matrices, node_ids: Array) -> None:
    """Raises VehicleError for nodes and scalars that neither stiffness nor mass joins to the others."""
    n_nodes = len(node_ids)
    owner = matrices.owners
    owner = np.where(owner < 0, n_nodes + np.arange(matrices.n_dofs), owner)
    joined = sp.coo_array(abs(matrices.stiffness) + abs(matrices.mass))
    rows, columns = joined.coords
    size = n_nodes + matrices.n_dofs
    graph = sp.coo_array((np.ones(len(rows), bool), (owner[rows], owner[columns])), shape=(size, size))
    number = connected_components(graph.tocsr(), directed=False)[1]
    used = np.unique(owner)
    pieces, counts = np.unique(number[used], return_counts=True)
    if len(pieces) == 1:
        return
    smallest = used[number[used] == pieces[counts.argmin()]]
    names = [str(node_ids[i]) for i in smallest[smallest < n_nodes][:5]] or ["scalars"]
    raise VehicleError(
        f"found {len(pieces)} parts that nothing joins, expected one piece; the smallest has "
        f"{counts.min()} of {counts.sum()} nodes, such as {listed(names)}"
    )
