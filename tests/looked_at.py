"""Components to look at: a square plate that somebody measured or computed."""

import numpy as np

from modeviz.formats.component import Component, Modes, UnitSystem

CORNERS = np.array([[0, 0, 0], [2000, 0, 0], [2000, 1000, 0], [0, 1000, 0.0]])
"""mm."""
MM_T_S = UnitSystem("mm-t-s", 1e-3, 1e3)


def plate(shapes, frequency_hz=(0.0, 20.0), modal_mass=None, units=None) -> Component:
    """The plate in modes whose translations of its corners are given, (4, 3, n_modes)."""
    shapes = np.asarray(shapes)
    motions = np.zeros((4, 6, shapes.shape[2]), shapes.dtype)
    motions[:, :3] = shapes
    unknown = np.full(shapes.shape[2], np.nan)
    mass = unknown if modal_mass is None else np.array(modal_mass)
    modes = Modes(np.array(frequency_hz[: len(mass)]), mass, unknown, motions)
    quads = np.array([[0, 1, 2, 3]])
    ids = np.array([1, 2, 3, 4])
    return Component(ids, CORNERS, {"quad": quads}, modes, units, source="plate.unv")


def heaving_and_twisting(kind=float):
    """Up in the first mode; in the second two corners up and two down, in quadrature if complex."""
    shapes = np.zeros((4, 3, 2), kind)
    shapes[:, 2, 0] = 1
    shapes[:, 2, 1] = [1, -1, 1, -1]
    if kind is complex:
        shapes[:, 2, 1] *= [1, 1j, 1, 1j]
    return shapes
