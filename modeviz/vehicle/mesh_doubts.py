"""Doubts about display meshes: their size and place against the mounts and mass of their bodies."""

from collections.abc import Iterator

import numpy as np

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, Mesh, RigidBody
from modeviz.vehicle.vehicle import Vehicle

DIFFERENT = 5.0
"""How many times as large, or as small, a mesh may be as all else suggests."""

FAR = 0.5
"""How far from the body's mounts or mass a mesh may be, by the size of the larger of both."""

FACTORS = {
    1000.0: "millimetres for metres",
    100.0: "centimetres for metres",
    39.37: "inches for metres",
    25.4: "millimetres for inches",
    10.0: "millimetres for centimetres",
}
"""How many times too large a mesh is, and what was taken for what."""

MOST_DRAWN = 100_000
"""Faces of a body that are drawn: a page sends a shape of all their vertices at every change."""

NEAR_FACTOR = 2.0
"""How far off a factor may be from how much a mesh is too large, which is known roughly."""


def mesh_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on what is likely wrong with the display meshes of a vehicle."""
    for body in vehicle.bodies:
        if not body.mesh:
            continue
        if words := coarser_words(body.mesh):
            yield f"body {body.name!r}: mesh: {words}"
        mesh = _ends(np.concatenate([part.vertices[part.faces].reshape(-1, 3) for part in body.mesh]))
        known = _known(vehicle, body)
        doubt = _of_size(mesh, known) or _of_place(mesh, known)
        if doubt:
            yield f"body {body.name!r}: mesh: {doubt}"


def coarser_words(mesh: Mesh) -> str:
    """Words for how a mesh of very many faces is drawn; empty if it is drawn as it is."""
    n_faces = sum(len(part.faces) for part in mesh)
    if n_faces <= MOST_DRAWN:
        return ""
    return f"has {n_faces:,} faces; a coarser surface is drawn, of at most {MOST_DRAWN:,}"


def _known(vehicle: Vehicle, body: Body) -> dict[str, tuple[Floats, float]]:
    """The space, (2, 3), and the size, m, of a body as other things than its mesh tell them."""
    known: dict[str, tuple[Floats, float]] = {}
    places = [
        point
        for connection in vehicle.all_connections
        for name, point in zip(connection.bodies, connection.points, strict=True)
        if name == body.name
    ]
    places += [tyre.wheel_center for tyre in vehicle.tyres if tyre.bodies[0] == body.name]
    if places:
        mounts = _ends(np.array(places))
        known["what is connected to it"] = mounts, _size(mounts)
    if isinstance(body, RigidBody):
        center = np.array([body.center_of_gravity, body.center_of_gravity])
        # A block has (b² + c²) m / 12 about its first axis, so the sum of all three is m d² / 6.
        known["its mass and inertia"] = center, float(np.sqrt(6 * np.trace(body.inertia) / body.mass))
    elif len(body.nodes):
        nodes = _ends(body.nodes)
        known["its nodes"] = nodes, _size(nodes)
    return known


def _of_size(mesh: Floats, known: dict[str, tuple[Floats, float]]) -> str:
    """Words on the mesh's size, if there is something to say."""
    sizes = {what: size for what, (_, size) in known.items() if size > 0}
    size = _size(mesh)
    if not sizes or not size:
        return ""
    ratio = size / np.exp(np.mean(np.log([*sizes.values()])))
    told = " and ".join(f"{other:.3g} m by {what}" for what, other in sizes.items())
    told = f"is {size:.3g} m across, expected about {told}: it would fit"
    if size > DIFFERENT * max(sizes.values()):
        return f"{told} {_factors(ratio)} times smaller"
    if size < min(sizes.values()) / DIFFERENT:
        return f"{told} {_factors(1 / ratio)} times larger"
    return ""


def _factors(ratio: float) -> str:
    """The factors by which a mesh is likely wrong, the likeliest first."""
    by_nearness = sorted(FACTORS, key=lambda factor: abs(np.log(factor / ratio)))
    near = [f for f in by_nearness if 1 / NEAR_FACTOR <= f / ratio <= NEAR_FACTOR]
    named = [f"{factor:g} ({FACTORS[factor]})" for factor in near]
    return " or ".join(named) if named else f"about {ratio:.2g}"


def _of_place(mesh: Floats, known: dict[str, tuple[Floats, float]]) -> str:
    """Words on the mesh's place, if there is something to say."""
    for what, (space, _) in known.items():
        gap = np.linalg.norm(np.maximum(0, np.maximum(space[0] - mesh[1], mesh[0] - space[1])))
        if gap > FAR * max(_size(mesh), _size(space)):
            middle, other = (", ".join(f"{x:.3g}" for x in ends.mean(axis=0)) for ends in (mesh, space))
            return (
                f"is {gap:.3g} m away from {what}, its middle at ({middle}) m and not near ({other}) "
                "m; meshes are in vehicle coordinates"
            )
    return ""


def _ends(points: Floats) -> Floats:
    """The corners of the space that points take, (2, 3)."""
    return np.array([points.min(axis=0), points.max(axis=0)])


def _size(ends: Floats) -> float:
    """The diagonal of a space, m."""
    return float(np.linalg.norm(ends[1] - ends[0]))
