"""The free network as Nastran writes it."""

import numpy as np
from free_network import CORNERS, HEXA, LABELS, free_network
from op2_files import MODES, Op2


def network_op2(op2: Op2, hertz=None, masses=None, unstable=None) -> bytes:
    """An OP2 file of all modes, with what it calls hertz, modal masses, and a mode with ω² < 0."""
    network = free_network()
    grids = [(i, 0, place, 0) for i, place in zip(LABELS, CORNERS, strict=True)]
    w2 = network.omega_n_squared.copy()
    if unstable is not None:
        w2[unstable] *= -1
    masses = np.ones(24) if masses is None else masses
    records, rows = [], []
    for mode in range(24):
        motions = np.zeros((8, 6))
        motions[:, :3] = network.shapes[:, :, mode] * np.sqrt(masses[mode])
        said = network.frequency_hz[mode] if hertz is None else hertz[mode]
        records += [op2.header(MODES, mode + 1, w2[mode], hertz=said), op2.shape(LABELS, motions)]
        rows.append((mode + 1, w2[mode], said, masses[mode]))
    hexa = op2.words(7308, 73, 253, 1, 1, *HEXA, *[0] * 12)
    return op2.file(
        op2.table("GEOM1", op2.grids(grids)),
        op2.table("GEOM2", hexa),
        op2.table("LAMA", *op2.eigenvalues(*rows)),
        op2.table("OUGV1", *records),
    )
