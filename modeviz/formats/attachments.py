"""Where others hold on to a component: the nodes, and sets of nodes, that people name."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, listed, quoted, unknown
from modeviz.formats.component import Component, UnitSystem
from modeviz.formats.node_sets import NodeSet, set_motion
from modeviz.formats.places import Place
from modeviz.vehicle.arrays import Array, Floats, frozen
from modeviz.vehicle.checks import REACH
from modeviz.vehicle.rigid import rigid_motions

LOOSE = 0.02
"""Nodes that are joined rigidly move apart by less than this part of how they move."""


@dataclass(frozen=True, eq=False)
class Found:
    """The nodes that carry an attachment, in SI."""

    name: str
    position: Floats
    """(3,), m."""
    rows: Array
    """(n,), of the component's nodes."""
    motion: Floats
    """(6, 6 n): its motion is `motion @ shapes[rows].reshape(6 n, n_modes)` of shapes in SI.

    What holds on to it loads the nodes by the transpose.
    """
    distance: float = 0.0
    """m, from where it was asked for to the node that was nearest."""
    is_rigid: bool = False
    """Whether its nodes are meant to move as one piece."""

    def __post_init__(self) -> None:
        frozen(self, "position", self.position, (3,))
        frozen(self, "motion", self.motion, (6, 6 * len(self.rows)))

    def shapes(self, shapes: Array) -> Floats:
        """Return its motion in each mode, (6, n_modes).

        Args:
            shapes: (n_nodes, 6, n_modes), of the component in SI.
        """
        return self.motion @ shapes[self.rows].reshape(6 * len(self.rows), -1)

    def looseness(self, places: Floats, shapes: Array) -> float:
        """Return by what part of their motion its nodes part from one rigid piece, in the worst mode.

        Args:
            places: (n_nodes, 3), m, of the component.
            shapes: (n_nodes, 6, n_modes), of the component in SI.
        """
        moved = shapes[self.rows, :3]
        rigid = rigid_motions(places[self.rows] - self.position)[:, :3] @ self.shapes(shapes)
        apart, size = (np.linalg.norm(u, axis=1).max(axis=0, initial=0) for u in (moved - rigid, moved))
        return float(np.divide(apart, size, out=np.zeros_like(size), where=size > 0).max(initial=0))


def find_attachments(
    component: Component, places: Sequence[Place], units: UnitSystem
) -> tuple[Found, ...]:
    """Return the nodes at or nearest to places, or in the sets that they name.

    Raises:
        VehicleError: there is no such node or set, a set doesn't tell a motion, or two places have
            the same name.
    """
    names = [place.name for place in places]
    if repeated := {name for name in names if names.count(name) > 1}:
        raise VehicleError(f"attachment {quoted(min(repeated))}: two have that name")
    return tuple(_find(component, place, units.length) for place in places)


def far_notes(attachments: Sequence[Found]) -> tuple[str, ...]:
    """Return sentences on attachments that are not where they were asked for, but beyond `REACH`."""
    return tuple(
        f"attachment {quoted(found.name)} is {found.distance:.3g} m from where it was asked for, at "
        f"the nearest node, [{', '.join(f'{value:.4g}' for value in found.position)}] m: is the place "
        "in the files' coordinates and units?"
        for found in attachments
        if found.distance > REACH
    )


def _find(component: Component, place: Place, length: float) -> Found:
    if place.nodes or place.set_name:
        return _of_set(component, place, length)
    distance = 0.0
    if place.node is not None:
        row = _row_of(component, place.name, place.node)
    else:
        placed = np.flatnonzero(component.has_place)
        apart = np.linalg.norm(component.nodes[placed] - np.array(place.position), axis=1)
        row, distance = int(placed[apart.argmin()]), float(apart.min()) * length
    node = component.nodes[row] * length
    position = node if place.at is None else np.array(place.at) * length
    return Found(place.name, position, np.array([row]), rigid_motions(position - node), distance)


def _of_set(component: Component, place: Place, length: float) -> Found:
    chosen = _set_of(component, place)
    rows = np.array([_row_of(component, place.name, node) for node in chosen.nodes])
    places = component.nodes[rows] * length
    if place.at is not None:
        position = np.array(place.at) * length
    elif chosen.center is not None:
        position = component.nodes[_row_of(component, place.name, chosen.center)] * length
    else:
        position = places.mean(axis=0)
    weights = np.ones(len(rows)) if chosen.weights is None else np.array(chosen.weights)
    turns = chosen.kind == "rigid" and component.turn(rows)
    try:
        motion = set_motion(position, places, weights, turns)
    except VehicleError as error:
        raise VehicleError(f"attachment {quoted(place.name)}: {error}") from None
    return Found(place.name, position, rows, motion, is_rigid=chosen.kind == "rigid")


def _set_of(component: Component, place: Place) -> NodeSet:
    if not place.set_name:
        return NodeSet(place.kind or "mean", place.nodes)
    known = {name.upper(): each for name, each in component.node_sets.items()}
    if place.set_name.upper() not in known:
        reason = unknown("set of nodes", place.set_name, component.node_sets)
        raise VehicleError(f"attachment {quoted(place.name)}: {reason}")
    found = known[place.set_name.upper()]
    return replace(found, kind=place.kind or found.kind)


def _row_of(component: Component, name: str, node: int) -> int:
    row = int(np.searchsorted(component.node_ids, node))
    there = component.node_ids[row : row + 1].tolist() == [node]
    if not (there and component.has_place[row]):
        raise VehicleError(
            f"attachment {quoted(name)}: there is no node {node} with a place and a motion; there are "
            f"{listed(component.node_ids[component.has_place][:5].tolist())} and others"
        )
    return row
