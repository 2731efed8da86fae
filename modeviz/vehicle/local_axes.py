"""The local axes of a mount, of two vectors or of angles about x, y and z in some order."""

import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Self

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.vehicle.arrays import Floats

AXES = ("x", "y", "z")

OBLIQUE = np.radians(1.0)
"""By how much two of them may be off a right angle, for rounding."""

LOCKED = 1e-9
"""Cosine of a turn about y at which turns about x and z are told apart no more."""

_FIXED = {"fixed", "extrinsic", "space"}
_TURNED = {"turned", "intrinsic", "moving", "body", "local"}


def axes_of_vectors(vectors: Mapping[str, Floats]) -> Floats:
    """Return axes as rows, (3, 3), of two of them by name; the first is kept if they are oblique.

    Args:
        vectors: (3,) each, of any length, by x, y or z.

    Raises:
        VehicleError: not two, one of no length, or not at right angles.
    """
    if len(vectors) != 2:
        raise VehicleError(f"found {len(vectors)} of the local axes, expected two of them")
    (first, u), (second, v) = sorted(vectors.items())
    for axis, vector in ((first, u), (second, v)):
        if not np.linalg.norm(vector) > 1e-9 * max(1.0, float(np.abs(vector).max())):
            raise VehicleError(f"the local {axis} axis is {vector.tolist()}, which has no direction")
    u, v = u / np.linalg.norm(u), v / np.linalg.norm(v)
    if abs(off := np.arcsin(np.clip(u @ v, -1, 1))) > OBLIQUE:
        raise VehicleError(
            f"the local {first} and {second} axes are {90 - np.degrees(off):.4g}° apart, expected 90°"
        )
    v = v - (u @ v) * u
    axes = np.zeros((3, 3))
    i, j = AXES.index(first), AXES.index(second)
    axes[i], axes[j] = u, v / np.linalg.norm(v)
    k = 3 - i - j
    axes[k] = np.cross(axes[(k + 1) % 3], axes[(k + 2) % 3])
    return axes


@dataclass(frozen=True)
class TurnOrder:
    """In which order angles about x, y and z turn a frame, and about which axes."""

    letters: str = "xyz"
    """The axes in the order of the turns."""
    is_fixed: bool = True
    """Whether about axes that stay, or about those that were turned before."""

    @classmethod
    def of(cls, text: str) -> Self:
        """Return the order that a text says, such as "xyz fixed" or "z, y, x turned".

        Raises:
            VehicleError: it says none.
        """
        words = re.findall(r"[a-z]+", text.lower())
        letters = "".join(word for word in words if word not in _FIXED | _TURNED)
        is_fixed, is_turned = not _FIXED.isdisjoint(words), not _TURNED.isdisjoint(words)
        if sorted(letters) != [*AXES]:
            raise VehicleError(
                f'found {quoted(text)}, expected x, y and z in some order, as in "xyz fixed"'
            )
        if is_fixed == is_turned:
            raise VehicleError(
                f'found {quoted(text)}, expected "{letters} fixed", about axes that stay, or '
                f'"{letters} turned", about those that were turned before'
            )
        return cls(letters, is_fixed)

    def __str__(self) -> str:
        return f"{self.letters} {'fixed' if self.is_fixed else 'turned'}"


def axes_of_angles(angles: Floats, order: TurnOrder) -> Floats:
    """Return axes as rows, (3, 3), that stood along x, y, z and were turned.

    Turns about fixed axes are multiplied from the left, R = R_c R_b R_a, those about turned ones from
    the right, R = R_a R_b R_c (J. J. Craig, Introduction to Robotics, ch. 2).

    Args:
        angles: (3,), rad: about x, y, z, whatever the order.
        order: of the turns.
    """
    R = np.eye(3)
    for letter in order.letters:
        axis = AXES.index(letter)
        turn = _turn(axis, angles[axis])
        R = turn @ R if order.is_fixed else R @ turn
    return R.T


def angles_of_axes(axes: Floats) -> Floats:
    """Return the angles about x, then y, then z, (3,), rad, by which axes stand turned: y by up to 90°.

    Of R = R_z R_y R_x, as of `axes_of_angles` in that order; where y is 90° and only x and z together
    are known, z is zero.

    Args:
        axes: (3, 3), as rows.
    """
    R = axes.T
    level = np.hypot(R[0, 0], R[1, 0])
    y = np.arctan2(-R[2, 0], level)
    if level < LOCKED:
        return np.array([np.arctan2(-R[1, 2], R[1, 1]), y, 0.0])
    return np.array([np.arctan2(R[2, 1], R[2, 2]), y, np.arctan2(R[1, 0], R[0, 0])])


def _turn(axis: int, angle: float) -> Floats:
    """The turn (3, 3) about one of x, y, z."""
    R = np.eye(3)
    i, j = (axis + 1) % 3, (axis + 2) % 3
    R[[i, j], [i, j]] = np.cos(angle)
    R[j, i], R[i, j] = np.sin(angle), -np.sin(angle)
    return R
