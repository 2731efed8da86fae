"""A vehicle of two free networks in the same place, "upper" and "lower", that mounts can join."""

from pathlib import Path

import numpy as np
from free_network import CORNERS, LABELS, free_network
from network_files import network_unv
from scipy.linalg import block_diag, eigh

from modeviz.cli import main

ATTACHED = (11, 14, 22, 23)
"""The nodes at which each is held, which are the names of the attachments too."""


def two_networks(folder: Path, scratch: Path) -> Path:
    """The folder, with both bodies in it and nothing that joins them."""
    attach = [word for node in ATTACHED for word in ("--attach", str(node))]
    for name in ("upper", "lower"):
        path = scratch / f"{name}.unv"
        path.write_text(network_unv())
        assert main(["import", str(path), "--output", str(folder), "--units", "mm-t-s", *attach]) == 0
    return folder


def place(node: int) -> np.ndarray:
    """mm."""
    return CORNERS[np.flatnonzero(node == LABELS)[0]]


def joined_frequencies(joints: list[tuple[int, np.ndarray]], grounded=()) -> np.ndarray:
    """Hz of both with springs between them, by the whole matrices.

    Args:
        joints: nodes, and the stiffness (3, 3) between upper and lower there, N/mm.
        grounded: likewise, of springs from upper to the ground.
    """
    network = free_network()
    K = block_diag(network.stiffness, network.stiffness)
    for node, stiffness in joints:
        row = 3 * int(np.flatnonzero(node == LABELS)[0])
        upper, lower = slice(row, row + 3), slice(row + 24, row + 27)
        K[upper, upper] += stiffness
        K[lower, lower] += stiffness
        K[upper, lower] -= stiffness
        K[lower, upper] -= stiffness
    for node, stiffness in grounded:
        row = 3 * int(np.flatnonzero(node == LABELS)[0])
        K[row : row + 3, row : row + 3] += stiffness
    M = block_diag(network.mass, network.mass)
    return np.sqrt(np.abs(eigh(K, M, eigvals_only=True))) / (2 * np.pi)
