"""The cab: floor, toe panel, doors, pillars, roof and fixed glass."""

import numpy as np

from pickup.half_mesh import Structure
from pickup.lattice import Lattice
from pickup.sections import BRACKET, box_member, glass, steel_sheet

HEIGHTS = (0.60, 0.78, 1.16, 1.72)
"""Floor, rocker top, belt, roof."""
FRONT = (0.66, 0.52, 0.50, 1.00)
"""x of the front at those heights."""
REAR = (2.00, 2.00, 2.02, 1.93)
HALF_WIDTH = (0.80, 0.92, 0.93, 0.70)
ALONG = (0.0, 0.216, 0.90, 1.0)
"""Hinge pillar front, door front, door rear, back of the cab; fractions of its length."""
ACROSS = (0.0, 0.25, 0.72, 1.0)

SWAGED = 60.0
SEAT_FOOTPRINT = ((1.35, 0.25), (1.35, 0.60), (1.70, 0.25), (1.70, 0.60))
"""x, y of the feet of the right-hand seat."""
SEAT_MASS = 16.0
"""kg a side; also the instrument panel's."""
FRONT_BRACKET = (0.97, 0.62, 0.57)
REAR_BRACKET = (1.93, 0.62, 0.57)


def corners() -> np.ndarray:
    """The corners of the cab's blocks, (4, 4, 4, 3) along x, y and z."""
    places = np.zeros((4, 4, 4, 3))
    for k, (front, rear, half_width) in enumerate(zip(FRONT, REAR, HALF_WIDTH, strict=True)):
        places[:, :, k, 0] = front + np.array(ALONG)[:, None] * (rear - front)
        places[:, :, k, 1] = np.array(ACROSS) * half_width
        places[:, :, k, 2] = HEIGHTS[k]
    return places


def cab() -> Structure:
    """The cab's finite-element mesh, with seats and instrument panel, without occupants."""
    half = Lattice(corners(), ([5, 15, 3], [4, 7, 4], [3, 6, 9]))
    _panels(half)
    _members(half)
    for x, y in SEAT_FOOTPRINT:
        half.add_mass(half.nearest((x, y, HEIGHTS[0])), SEAT_MASS / 4)
    for y in (0.2, 0.5, 0.8):
        half.add_mass(half.nearest((0.51, y, 1.10)), SEAT_MASS / 3)
    half.hang_mounts_on(
        half.add_bracket(half.corner(1, 2, 0), FRONT_BRACKET, BRACKET),
        half.add_bracket(half.corner(2, 2, 0), REAR_BRACKET, BRACKET),
    )
    return half.mirrored()


def _panels(half: Lattice) -> None:
    half.panel((0, 3), (0, 3), 0, steel_sheet(0.0010, SWAGED, added_mass=4.0))  # floor and carpet
    half.panel(0, (0, 3), (0, 2), steel_sheet(0.0010, SWAGED, added_mass=3.0))  # toe and dash
    half.panel(0, (0, 3), (2, 3), glass(0.006))
    half.panel((0, 3), (0, 3), 3, steel_sheet(0.0009, SWAGED, added_mass=1.5))  # roof
    half.panel(3, (0, 3), (0, 2), steel_sheet(0.0009, SWAGED, added_mass=1.5))  # back panel
    half.panel(3, (0, 2), (2, 3), glass(0.004))
    half.panel(3, (2, 3), (2, 3), steel_sheet(0.0009, SWAGED))
    half.panel((0, 3), 3, (0, 1), steel_sheet(0.0012, SWAGED))  # rocker
    half.panel((0, 1), 3, (1, 3), steel_sheet(0.0012, SWAGED))  # hinge pillar
    half.panel((2, 3), 3, (1, 3), steel_sheet(0.0010, SWAGED))  # quarter
    # The door is a deep box on hinges and seals: stiff by itself, soft in what it gives the opening.
    half.panel((1, 2), 3, (1, 2), steel_sheet(0.0012, 25 * SWAGED, added_mass=18.0, softening=0.15))


def _members(half: Lattice) -> None:
    upright = (1, 0, 0)
    half.member((0, 3, 0), (3, 3, 0), box_member(0.10, 0.14, 0.0012))  # rocker
    half.member((0, 3, 1), (3, 3, 1), box_member(0.05, 0.05, 0.0010))
    half.member((0, 0, 2), (0, 3, 2), box_member(0.14, 0.12, 0.0014))  # cowl
    half.member((0, 0, 3), (0, 3, 3), box_member(0.06, 0.04, 0.0010))  # headers
    half.member((3, 0, 3), (3, 3, 3), box_member(0.06, 0.04, 0.0010))
    half.member((0, 3, 3), (3, 3, 3), box_member(0.05, 0.06, 0.0010))  # roof rail
    half.member((0, 3, 2), (0, 3, 3), box_member(0.05, 0.06, 0.0012), upright)  # A pillar
    half.member((0, 3, 0), (0, 3, 2), box_member(0.12, 0.09, 0.0018), upright)  # hinge pillar
    half.member((1, 3, 1), (1, 3, 2), box_member(0.08, 0.08, 0.0012), upright)
    half.member((2, 3, 1), (2, 3, 3), box_member(0.08, 0.08, 0.0012), upright)  # B pillar
    half.member((3, 3, 0), (3, 3, 3), box_member(0.06, 0.06, 0.0010), upright)  # rear corner
    half.member((3, 0, 0), (3, 3, 0), box_member(0.08, 0.08, 0.0010))
    half.member((3, 0, 2), (3, 3, 2), box_member(0.06, 0.06, 0.0010))
    half.member((0, 2, 0), (3, 2, 0), box_member(0.10, 0.10, 0.0018))  # under the floor
    half.member((0, 1, 0), (3, 1, 0), box_member(0.06, 0.06, 0.0010))
    half.member((0, 0, 0), (0, 3, 0), box_member(0.08, 0.08, 0.0012))
    half.member((1, 0, 0), (1, 3, 0), box_member(0.12, 0.09, 0.0018))
    half.member((2, 0, 0), (2, 3, 0), box_member(0.14, 0.09, 0.0018))
    half.member((0, 0, 1), (0, 3, 1), box_member(0.05, 0.05, 0.0010))
    half.member((3, 0, 1), (3, 3, 1), box_member(0.05, 0.05, 0.0010))
