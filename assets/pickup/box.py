"""The pickup box: floor, sides, tailgate and wheel houses."""

import numpy as np

from pickup.half_mesh import Structure
from pickup.lattice import Lattice
from pickup.sections import BRACKET, box_member, steel_sheet

X = (2.10, 2.62, 3.34, 4.16)
Y = (0.0, 0.47, 0.62, 0.86)
Z = (0.74, 0.98, 1.22)
FLARE = 0.04
"""How much wider the sides are above the floor."""
BRACKETS = ((2.30, 0.47, 0.70), (2.62, 0.47, 0.70), (3.34, 0.47, 0.70), (4.10, 0.47, 0.70))
"""Where the right side of the box stands on the frame."""

SWAGED = 60.0


def corners() -> np.ndarray:
    """The corners of the box's blocks, (4, 4, 3, 3) along x, y and z."""
    places = np.stack(np.meshgrid(X, Y, Z, indexing="ij"), axis=-1)
    places[:, 3, 1:, 1] += FLARE
    return places


def box() -> Structure:
    """The box's finite-element mesh."""
    half = Lattice(corners(), ([8, 12, 12], [6, 2, 3], [4, 4]))
    _panels(half)
    _members(half)
    for i, tip in enumerate(BRACKETS):
        half.add_bracket(half.corner(i, 1, 0), tip, BRACKET)
    return half.mirrored()


def _panels(half: Lattice) -> None:
    sheet = steel_sheet(0.0010, SWAGED)
    half.panel((0, 3), (0, 3), 0, steel_sheet(0.0012, SWAGED))  # floor
    half.panel(0, (0, 3), (0, 2), sheet)  # front panel
    half.panel(3, (0, 3), (0, 2), steel_sheet(0.0012, 1.5 * SWAGED, added_mass=4.0))  # tailgate
    half.panel((0, 3), 3, (0, 2), steel_sheet(0.0010, SWAGED, added_mass=3.0))  # sides
    half.panel((1, 2), 2, (0, 1), sheet)  # wheel house
    half.panel((1, 2), (2, 3), 1, sheet)
    half.panel(1, (2, 3), (0, 1), sheet)
    half.panel(2, (2, 3), (0, 1), sheet)


def _members(half: Lattice) -> None:
    upright = (1, 0, 0)
    for i in range(4):
        half.member((i, 0, 0), (i, 3, 0), box_member(0.08, 0.07, 0.0014))  # under the floor
    half.member((0, 3, 2), (3, 3, 2), box_member(0.05, 0.05, 0.0012))  # rails
    half.member((0, 0, 2), (0, 3, 2), box_member(0.04, 0.04, 0.0010))
    half.member((3, 0, 2), (3, 3, 2), box_member(0.04, 0.04, 0.0010))
    half.member((0, 3, 0), (3, 3, 0), box_member(0.05, 0.05, 0.0010))
    half.member((0, 1, 0), (3, 1, 0), box_member(0.08, 0.09, 0.0018))
    half.member((0, 3, 0), (0, 3, 2), box_member(0.06, 0.06, 0.0010), upright)  # posts
    half.member((3, 3, 0), (3, 3, 2), box_member(0.06, 0.06, 0.0012), upright)
