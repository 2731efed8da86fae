"""Attachments of flexible bodies where they had none: their shapes there, by those around."""

from collections.abc import Sequence

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Attachment, FlexibleBody
from modeviz.vehicle.carriers import SAME_PLACE, motions_by_nodes
from modeviz.vehicle.checks import REACH
from modeviz.vehicle.rigid import rigid_motions


def attachment_elsewhere(body: FlexibleBody, held: Attachment, place: Floats, name: str) -> Attachment:
    """Return an attachment for what was held by another one and is moved to a place.

    Its motion is that of the nodes around it, see `motions_by_nodes`, and, within `REACH` of places
    whose motion is known better, by what these differ from the nodes there, carried along: of d from
    the nearest one (1 - d²/REACH²)² of the weighted mean, as of nodes. So it is exact where the body
    has an attachment, and moves away from where it was held without a step.

    Residual vectors are those that the body has: what a force at the new place would deform it by
    beyond them and its modes is missing, as at any place that the body was not imported with.

    Args:
        body: with nodes; without any it is carried by a rigid arm.
        held: where it was, with the body's motion there.
        place: (3,), m.
        name: of the new one.

    Raises:
        VehicleError: the place is off the body.
    """
    check_reach(body, held.position, place)
    if not len(body.nodes):
        return Attachment(name, place, _arm(held, place))
    others = [a for a in body.attachments if _apart(a.position, held.position) > SAME_PLACE]
    near = [known for known in (held, *others) if _apart(known.position, place) < REACH]
    by_nodes = _by_nodes(body, np.array([place, *(known.position for known in near)]))
    return Attachment(name, place, by_nodes[0] + _correction(near, by_nodes[1:], place))


def _by_nodes(body: FlexibleBody, places: Floats) -> Floats:
    """The motion of places by the nodes around them, (n_places, 6, n_modes); rigid ones are exact."""
    shapes = motions_by_nodes(body.nodes, body.shapes, places)
    shapes[:, :, : body.n_rigid] = body.rigid_fit.moved(places)
    return shapes


def _correction(near: Sequence[Attachment], by_nodes: Floats, place: Floats) -> Floats:
    """What is added at a place to the motion of its nodes, (6, n_modes)."""
    if not near:
        return np.zeros(by_nodes.shape[1:])
    d = np.maximum([_apart(known.position, place) for known in near], SAME_PLACE)
    weights = (1 / d - 1 / REACH) ** 2
    if d.min() <= SAME_PLACE:
        weights = np.where(d <= SAME_PLACE, weights, 0.0)
    off = [
        _arm(Attachment(known.name, known.position, known.shapes - shapes), place)
        for known, shapes in zip(near, by_nodes, strict=True)
    ]
    fade = (1 - (d.min() / REACH) ** 2) ** 2 if d.min() > SAME_PLACE else 1.0
    return fade * np.einsum("i,ijk->jk", weights / weights.sum(), off)


def _arm(held: Attachment, place: Floats) -> Floats:
    """The motion of a place that a rigid arm holds to an attachment, (6, n_modes)."""
    return rigid_motions(place - held.position) @ held.shapes


def check_reach(body: FlexibleBody, before: Floats, place: Floats) -> None:
    """Raises VehicleError if a place is farther off the body than something may be held.

    That is `REACH`, or as far as it was off before, or as nodes are apart there.
    """
    if not len(body.nodes):
        away, reach, what = _apart(before, place), REACH, "where it was, as the body has no nodes"
    else:
        was, away = (np.linalg.norm(body.nodes - end, axis=1) for end in (before, place))
        reach = max(REACH, float(was.min()), _spacing(body, int(away.argmin())))
        away, what = float(away.min()), "the nearest node"
    if away > reach:
        raise VehicleError(
            f"{np.round(place, 4).tolist()} m is off body {body.name!r}: {away:.2f} m from {what}, "
            f"expected at most {reach:.2f} m"
        )


def _spacing(body: FlexibleBody, node: int) -> float:
    """How far from a node the next one is, m; zero if there is no other."""
    apart = np.linalg.norm(body.nodes - body.nodes[node], axis=1)
    others = apart[apart > SAME_PLACE]
    return float(others.min()) if len(others) else 0.0


def _apart(one: Floats, other: Floats) -> float:
    return float(np.linalg.norm(one - other))
