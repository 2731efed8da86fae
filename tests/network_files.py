"""The free network as other programs write it."""

import numpy as np
from free_network import CORNERS, HEXA, LABELS, free_network
from op2_files import MODES, Op2
from universal_files import elements_2412, nodes_2411, shape_2414


def network_op2(op2: Op2, hertz=None, masses=None, unstable=None, residual_flags=(0,)) -> bytes:
    """An OP2 file of all modes, with what it calls hertz, modal masses, and a mode with ω² < 0.

    Of each of `residual_flags` it has a table of eigenvalues; one from before residual vectors are
    added, 1, lacks the last four.
    """
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
        *(
            op2.table("LAMA", *op2.eigenvalues(*rows[: 20 if flag == 1 else 24], residual_flag=flag))
            for flag in residual_flags
        ),
        op2.table("OUGV1", *records),
    )


def network_unv(modal_masses=None, units="", write=shape_2414, n_modes=24, first=0) -> str:
    """A universal file of the free network, in mm and t."""
    network = free_network()
    masses = np.ones(24) if modal_masses is None else modal_masses
    text = units + nodes_2411(LABELS, CORNERS) + elements_2412((115, HEXA))
    for mode in range(first, n_modes):
        shape = network.shapes[:, :, mode] * np.sqrt(masses[mode])
        frequency = network.frequency_hz[mode]
        text += write(LABELS, shape, frequency, masses[mode], mode=mode + 1)
    return text
