"""How much of another program's file is read, checked before it takes memory or time."""

from modeviz.files.limits import check_size

LARGEST_FILE = 2_000_000_000
"""Bytes."""

MOST_NUMBERS = 200_000_000
"""Of the shapes of a component: 1.6 GB; half a million nodes with 60 modes have 180 million."""


def check_shapes(n_nodes: int, n_modes: int) -> None:
    """Checks that the shapes of so many nodes and modes fit into memory; raises VehicleError."""
    check_size(
        f"numbers in the shapes of {n_nodes:,} nodes in {n_modes:,} modes",
        6 * n_nodes * n_modes,
        MOST_NUMBERS,
    )
