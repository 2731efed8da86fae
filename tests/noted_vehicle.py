"""A vehicle folder of which there is something to say: a solver's rigid modes, not quite at zero."""

from pathlib import Path

import numpy as np
from folders import one_of_everything

from modeviz.files import write_vehicle

RIGID_HZ = np.array([0.0, 1e-4, -2e-5, 3e-5, 1e-4, 5e-5])
"""Of the cab; the negative one stands for ω² below zero."""


def noted_vehicle(folder: Path) -> Path:
    """Writes it."""
    write_vehicle(one_of_everything(), folder)
    path = folder / "bodies/cab.npz"
    with np.load(path) as archive:
        arrays = dict(archive)
    arrays["omega_n_squared"][:6] = np.sign(RIGID_HZ) * (2 * np.pi * RIGID_HZ) ** 2
    np.savez(path, **arrays)
    return folder
