"""The front-end sheet metal: hood, fenders, inner panels and radiator support."""

import numpy as np

from pickup.half_mesh import Structure
from pickup.lattice import Lattice
from pickup.sections import box_member, steel_sheet

X = ((-0.84, -0.42, 0.0, 0.40, 0.60), (-0.86, -0.42, 0.0, 0.40, 0.51), (-0.82, -0.42, 0.0, 0.36, 0.49))
"""Along, at the three levels: sill, fender line, hood."""
Y = ((0.0, 0.36, 0.64, 0.90), (0.0, 0.36, 0.64, 0.95), (0.0, 0.36, 0.66, 0.93))
Z = ((0.50, 0.52, 0.54, 0.54, 0.54), (0.78, 0.82, 0.86, 0.82, 0.78), (1.06, 1.09, 1.12, 1.145, 1.155))
NOSE_TAPER = 0.97
CROWN = (0.02, 0.0, 0.0, -0.03)
"""How much the hood is higher in the middle and lower at the fender."""

SWAGED = 50.0


def corners() -> np.ndarray:
    """The corners of the front end's blocks, (5, 4, 3, 3) along x, y and z."""
    places = np.zeros((5, 4, 3, 3))
    for k in range(3):
        places[:, :, k, 0] = np.array(X[k])[:, None]
        places[:, :, k, 1] = Y[k]
        places[:, :, k, 2] = np.array(Z[k])[:, None]
    places[0, :, :, 1] *= NOSE_TAPER
    places[:, :, 2, 2] += CROWN
    return places


def front_end() -> Structure:
    """The front end's finite-element mesh, with radiator, grille and what hangs on the inner panels."""
    half = Lattice(corners(), ([6, 7, 6, 2], [6, 5, 5], [4, 5]))
    _panels(half)
    _members(half)
    for y, z in ((0.12, 0.60), (0.30, 0.60), (0.12, 0.95), (0.30, 0.95)):
        half.add_mass(half.nearest((-0.85, y, z)), 4.0, offset=(0.05, 0.0, 0.0))  # radiator
    for y in (0.50, 0.75):
        half.add_mass(half.nearest((-0.85, y, 0.85)), 4.0, offset=(-0.03, 0.0, 0.0))  # grille, lamps
    half.add_mass(half.nearest((-0.3, 0.64, 0.83)), 8.0, offset=(0.0, -0.08, 0.05))
    half.hang_mounts_on(half.corner(0, 1, 0))  # the foot of the radiator support's post
    return half.mirrored()


def _panels(half: Lattice) -> None:
    fender = steel_sheet(0.0009, SWAGED)
    half.panel((0, 4), (0, 2), 2, steel_sheet(0.0009, 1.5 * SWAGED, added_mass=5.0))  # hood, both skins
    half.panel((0, 4), (2, 3), 2, fender)
    half.panel((0, 4), 3, (1, 2), fender)
    half.panel((0, 1), 3, (0, 1), fender)
    half.panel((3, 4), 3, (0, 1), fender)
    half.panel((0, 4), 2, (1, 2), steel_sheet(0.0010, SWAGED))  # inner fender
    half.panel((1, 3), (2, 3), 1, steel_sheet(0.0010, SWAGED))  # wheel house
    half.panel(0, (0, 3), (0, 2), steel_sheet(0.0008, SWAGED))  # radiator support
    half.panel(4, (2, 3), (0, 2), fender)


def _members(half: Lattice) -> None:
    upright = (1, 0, 0)
    half.member((0, 0, 0), (0, 3, 0), box_member(0.07, 0.07, 0.0016))  # radiator support
    half.member((0, 0, 2), (0, 3, 2), box_member(0.05, 0.05, 0.0012))
    half.member((0, 0, 1), (0, 3, 1), box_member(0.04, 0.04, 0.0010))
    half.member((0, 1, 0), (0, 1, 2), box_member(0.06, 0.06, 0.0014), upright)
    half.member((0, 2, 0), (0, 2, 2), box_member(0.05, 0.05, 0.0012), upright)
    half.member((0, 2, 2), (4, 2, 2), box_member(0.05, 0.06, 0.0012))  # fender rails
    half.member((0, 2, 1), (4, 2, 1), box_member(0.05, 0.07, 0.0014))
    half.member((0, 3, 2), (4, 3, 2), box_member(0.04, 0.04, 0.0009))
    half.member((4, 0, 2), (4, 2, 2), box_member(0.05, 0.05, 0.0010))  # hood's rear edge
    half.member((4, 2, 1), (4, 2, 2), box_member(0.05, 0.05, 0.0010), upright)
    half.member((4, 3, 0), (4, 3, 2), box_member(0.05, 0.05, 0.0010), upright)
