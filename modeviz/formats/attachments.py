"""Where others hold on to a component: the nodes that people name."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, listed, quoted
from modeviz.formats.component import Component, UnitSystem


@dataclass(frozen=True)
class Place:
    """Where an attachment is to be."""

    name: str
    node: int | None = None
    """The node it is at."""
    position: tuple[float, float, float] | None = None
    """Instead, in the file's units: it is at the nearest node."""


def parse_place(text: str) -> Place:
    """Return the place that is written as "NAME=NODE", "NODE", or "NAME=X,Y,Z".

    Raises:
        VehicleError: it is written otherwise.
    """
    name, _, where = text.rpartition("=")
    parts = [part.strip() for part in where.split(",")]
    try:
        if len(parts) == 1 and re.fullmatch(r"\d{1,18}", parts[0]):
            return Place(name.strip() or parts[0], node=int(parts[0]))
        x, y, z = map(float, parts)
    except ValueError:
        pass
    else:
        if name.strip() and np.isfinite([x, y, z]).all():
            return Place(name.strip(), position=(x, y, z))
    raise VehicleError(
        f"found {quoted(text)}, expected a node's number, NAME=NODE, or NAME=X,Y,Z in the file's units"
    )


@dataclass(frozen=True)
class Found:
    """The node that an attachment is at."""

    name: str
    row: int
    distance: float
    """m, from where it was asked for."""


def find_attachments(
    component: Component, places: Sequence[Place], units: UnitSystem
) -> tuple[Found, ...]:
    """Return the nodes at or nearest to places.

    Raises:
        VehicleError: there is no such node, or two places have the same name.
    """
    placed = np.flatnonzero(component.has_place)
    names = [place.name for place in places]
    if repeated := {name for name in names if names.count(name) > 1}:
        raise VehicleError(f"attachment {quoted(min(repeated))}: two have that name")
    found = []
    for place in places:
        if place.position is None:
            row, distance = _row_of(component, place), 0.0
        else:
            apart = np.linalg.norm(component.nodes[placed] - place.position, axis=1)
            row, distance = int(placed[apart.argmin()]), float(apart.min()) * units.length
        found.append(Found(place.name, row, distance))
    return tuple(found)


def _row_of(component: Component, place: Place) -> int:
    row = int(np.searchsorted(component.node_ids, place.node or 0))
    there = component.node_ids[row : row + 1].tolist() == [place.node]
    if not (there and component.has_place[row]):
        raise VehicleError(
            f"attachment {quoted(place.name)}: there is no node {place.node} with a place and a "
            f"motion; there are {listed(component.node_ids[component.has_place][:5].tolist())} and "
            "others"
        )
    return row
