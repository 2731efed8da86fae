"""The axes that a vehicle file has, and how what stands in it turns into ours.

Ours are x rearward, y to the right, z up (ISO 4130). Both are right-handed and along the vehicle, so
that a turn only exchanges and reverses axes; the origin stays where it is.
"""

import re
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from modeviz.errors import VehicleError, at_key, unknown
from modeviz.files.schema.hints import each_annotated
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.local_axes import TurnOrder, axes_of_vectors

_WAYS = {
    "rearward": (0, 1),
    "forward": (0, -1),
    "right": (1, 1),
    "left": (1, -1),
    "up": (2, 1),
    "down": (2, -1),
}
"""Which of our axes a word means, and whether it is along it or against it."""

_WORDS = {"rear": "rearward", "back": "rearward", "for": "forward", "front": "forward"}
"""Words for them, without "ward" and "wards"."""


@dataclass(frozen=True, eq=False)
class Turns:
    """The annotation of a field that is something else in other axes."""

    turn: Callable[[Any, Floats], Any]
    """The value in other axes."""


def axes_of(text: str) -> Floats:
    """The turn T (3, 3) from the axes that a text says into ours: v = T v_file.

    Args:
        text: such as "x forward, y left, z up".

    Raises:
        VehicleError: no such text, two axes along the same line, or left-handed ones.
    """
    found = re.findall(r"([xyz])\s+(?:to the )?([a-z]+)", text.lower())
    if sorted(axis for axis, _ in found) != ["x", "y", "z"]:
        raise VehicleError(f"found {text!r}, expected such as 'x forward, y left, z up'")
    T = np.zeros((3, 3))
    for axis, word in found:
        stem = re.sub(r"wards?$", "", word)
        way = _WORDS.get(stem, stem)
        if way not in _WAYS:
            raise VehicleError(unknown("direction", word, _WAYS))
        line, sign = _WAYS[way]
        T[line, "xyz".index(axis)] = sign
    determinant = round(np.linalg.det(T))
    if determinant != 1:
        what = "two axes along the same line" if determinant == 0 else "left-handed axes"
        raise VehicleError(f"found {text!r}, which are {what}; expected right-handed ones")
    return T


def turned(data: Any, kind: type, T: Floats) -> Any:
    """The content of a file of that kind, with everything that depends on the axes in others.

    Raises:
        FaultsError: local axes that are none.
    """

    def change(value: Any, turns: Turns, _table: Mapping[str, Any], where: str) -> Any:
        if value is None:
            return None
        with at_key(where):
            return turns.turn(value, T)

    return each_annotated(data, kind, Turns, change)


def turn_vectors(value: Any, T: Floats) -> Any:
    """A vector, or several."""
    inner = [isinstance(v, list | tuple) for v in value]
    if len(value) == 3 and not any(inner):
        return (T @ np.array(value, float) + 0.0).tolist()  # no -0.0
    return [turn_vectors(v, T) if many else v for v, many in zip(value, inner, strict=True)]


def turn_direction(value: Any, T: Floats) -> Any:
    """A vector; what a person calls a direction is the same in all axes."""
    return value if isinstance(value, str) else turn_vectors(value, T)


def turn_rates(value: Any, T: Floats) -> Any:
    """Three values along, or about, the axes of a frame; it is turned by `turn_frame`."""
    return (np.abs(T) @ np.array(value, float)).tolist()


def turn_range(axis: int, value: Any, T: Floats) -> Any:
    """The least and the most along that one of our axes, in a frame that is turned by `turn_frame`."""
    return [0.0 - bound for bound in reversed(value)] if T[axis].sum() < 0 else value


def turn_ends(value: Any, T: Floats) -> Any:
    """The least along or about x, y and z, and the most, in others; a pair keeps its order."""
    least, most = np.array(value, float)
    is_reversed = T.sum(axis=0) < 0
    ends = np.where(is_reversed, -most, least), np.where(is_reversed, -least, most)
    return [(np.abs(T) @ end + 0.0).tolist() for end in ends]


def turn_frame(value: Any, T: Floats) -> Any:
    """Local axes as rows; the one along the file's x becomes the one along our axis there."""
    return (T @ whole_frame(value) @ T.T + 0.0).tolist()


def whole_frame(value: Any) -> Floats:
    """Return local axes as rows, (3, 3), of all three, or of x and y of any length."""
    if len(value) == 3:
        return np.array(value, float)
    return axes_of_vectors(dict(zip("xy", np.array(value, float), strict=True)))


def turn_order(value: Any, T: Floats) -> Any:
    """The order of angles about x, y and z, which are then about others."""
    if not value:
        return value
    order = TurnOrder.of(value)
    letters = ("xyz"[int(np.abs(T[:, "xyz".index(letter)]).argmax())] for letter in order.letters)
    return str(replace(order, letters="".join(letters)))


def turn_motions(value: Any, T: Floats) -> Any:
    """Names of motions along and about the axes of a frame."""
    if isinstance(value, bool):
        return value
    new = dict(zip(MOTIONS, np.kron(np.eye(2), np.abs(T)).argmax(axis=0), strict=True))
    return [MOTIONS[new[name]] if name in new else name for name in value]


def turn_inertia(value: Any, T: Floats) -> Any:
    """Moments Ixx, Iyy, Izz and, if any, products Ixy, Ixz, Iyz = +∫ y z dm."""
    moments, products = np.array(value[:3], float), value[3:]
    turned = (np.abs(T) @ moments).tolist()
    if len(products) != 3:
        return [*turned, *products]
    P = np.zeros((3, 3))
    rows, columns = np.triu_indices(3, 1)
    P[rows, columns] = products
    return [*turned, *((T @ (P + P.T) @ T.T)[rows, columns] + 0.0).tolist()]
