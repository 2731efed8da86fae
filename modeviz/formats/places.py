"""How people write where an attachment is to be."""

import re
from dataclasses import dataclass, replace

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.formats.node_sets import SetKind

MOST_IN_SET = 100_000
"""Nodes."""

FORMS = (
    "a node's number, NAME=NODE, NAME=X,Y,Z in the file's units, NAME=rigid:NODE,NODE,… or "
    "NAME=mean:NODE,NODE,… (also FROM-TO), NAME=RBE2:ID or NAME=GROUP:NAME; all but X,Y,Z may end in "
    "@X,Y,Z"
)

SET_NAME = re.compile(r"\w{1,80}:[^:]{1,80}")
"""Of a component's own."""


@dataclass(frozen=True)
class Place:
    """Where an attachment is to be: at a node, at the nearest one, or on a set of nodes."""

    name: str
    node: int | None = None
    """The node it is at."""
    position: tuple[float, float, float] | None = None
    """Instead, in the file's units: it is at the nearest node."""
    kind: SetKind | None = None
    """How a set of nodes is joined; None: as the set says."""
    nodes: tuple[int, ...] = ()
    """Instead: those that carry it."""
    set_name: str = ""
    """Instead: a set of the component's own, such as RBE2:901 or GROUP:left mount."""
    at: tuple[float, float, float] | None = None
    """In the file's units, where the point is that is carried; if not given, as the node or the set."""


def parse_place(text: str) -> Place:
    """Return the place that is written in one of the `FORMS`.

    Raises:
        VehicleError: it is written otherwise.
    """
    name, _, where = text.rpartition("=")
    where, *at = (part.strip() for part in where.split("@"))
    try:
        place = _place(name.strip(), where)
        if at:
            (there,) = at
            if place.position:
                raise ValueError
            return replace(place, at=_point(there))
        return place
    except ValueError:
        raise VehicleError(f"found {quoted(text)}, expected {FORMS}") from None


def _place(name: str, where: str) -> Place:
    """Raises ValueError: it is written otherwise."""
    if re.fullmatch(r"\d{1,18}", where):
        return Place(name or where, node=int(where))
    kind, colon, members = where.partition(":")
    if not name:
        raise ValueError
    if not colon:
        return Place(name, position=_point(where))
    if kind.lower() in ("rigid", "mean"):
        joined: SetKind = "rigid" if kind.lower() == "rigid" else "mean"
        if SET_NAME.fullmatch(members):
            return Place(name, kind=joined, set_name=members)
        return Place(name, kind=joined, nodes=_nodes(members))
    if not SET_NAME.fullmatch(where):
        raise ValueError
    return Place(name, set_name=where)


def _nodes(text: str) -> tuple[int, ...]:
    """The nodes of "12,13,20-25"; raises ValueError."""
    nodes: list[int] = []
    for part in text.split(","):
        if not (found := re.fullmatch(r"\s*(\d{1,18})\s*(?:-\s*(\d{1,18})\s*)?", part)):
            raise ValueError
        first, last = int(found[1]), int(found[2] or found[1])
        if not 0 <= last - first < MOST_IN_SET:
            raise ValueError
        nodes += range(first, last + 1)
    return tuple(dict.fromkeys(nodes))


def _point(text: str) -> tuple[float, float, float]:
    """Raises ValueError."""
    x, y, z = map(float, text.split(","))
    if not np.isfinite([x, y, z]).all():
        raise ValueError
    return x, y, z
