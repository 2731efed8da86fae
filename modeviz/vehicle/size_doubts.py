"""Doubts about the size and the mass of bodies, as those have that are read in wrong units."""

from collections.abc import Iterator

import numpy as np

from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.vehicle import Vehicle

THINNEST, DENSEST = 1e-3, 2.5e4
"""kg/m³ of a body's mass over its diagonal cubed: air has a thousand times more than the least, and
nothing is denser than osmium, with the most."""

LARGE, SMALL = 50.0, 0.005
"""m across: no part of a vehicle is larger or smaller."""

DIFFERENT = 100.0
"""How many times as large as all other bodies, or as small, one may be."""

UNITS = "are its numbers in other units, such as mm and t taken for m and kg, or the reverse?"


def size_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Sentences on bodies whose size or mass says that they are in other units."""
    sizes = {body.name: _size(body) for body in vehicle.bodies}
    for body in vehicle.bodies:
        size = sizes[body.name]
        others = [other for name, other in sizes.items() if name != body.name and other > 0]
        if size > 0 and (words := _of_itself(body, size) or _beside(size, others)):
            found = f"is {size:.3g} m across and weighs {body.mass:.3g} kg"
            yield f"body {body.name!r}: {found}, {words}: {UNITS}"


def _size(body: Body) -> float:
    """m, the diagonal of a body, of a rigid one by its inertia; zero where nothing tells it."""
    if not isinstance(body, FlexibleBody):
        # A block has (b² + c²) m / 12 about its first axis, so the sum of all three is m d² / 6.
        return float(np.sqrt(6 * np.trace(body.inertia) / body.mass))
    places = body.nodes if len(body.nodes) else np.array([a.position for a in body.attachments])
    return float(np.linalg.norm(np.ptp(places, axis=0))) if len(places) else 0.0


def _of_itself(body: Body, size: float) -> str:
    """What no part of a vehicle is; rigid bodies may be points, as heavy as they like."""
    if size > LARGE:
        return "larger than any part of a vehicle"
    if body.mass < THINNEST * size**3:
        return "lighter than air"
    if not isinstance(body, FlexibleBody):
        return ""
    if size < SMALL:
        return "smaller than any part of a vehicle"
    return "heavier than any metal" if body.mass > DENSEST * size**3 else ""


def _beside(size: float, others: list[float]) -> str:
    """How it differs from all others."""
    if others and size > DIFFERENT * max(others):
        return f"{size / max(others):.3g} times as large as any other"
    if others and size < min(others) / DIFFERENT:
        return f"{min(others) / size:.3g} times smaller than any other"
    return ""
