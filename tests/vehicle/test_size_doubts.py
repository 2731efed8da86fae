"""Bodies that were read in wrong units are pointed out by size and mass; vehicles as they are, not."""

from dataclasses import replace

import pytest
from builtin_truck import builtin_truck
from oracles import Beam

from modeviz.vehicle.bodies import FlexibleBody, RigidBody
from modeviz.vehicle.size_doubts import size_doubts
from modeviz.vehicle.vehicle import Vehicle

BEAM = Beam(6).body("beam", n_modes=16)


def in_units(body: FlexibleBody, length: float, mass: float) -> FlexibleBody:
    """A body whose numbers are taken for those of units so many times as large."""
    shapes = body.shapes / mass**0.5
    shapes[:, 3:] /= length
    attachments = []
    for a in body.attachments:
        moved = a.shapes / mass**0.5
        moved[3:] /= length
        attachments.append(replace(a, position=a.position * length, shapes=moved))
    return replace(body, nodes=body.nodes * length, shapes=shapes, attachments=tuple(attachments))


def said(*bodies) -> str:
    return " | ".join(size_doubts(Vehicle("v", bodies, ())))


@pytest.mark.parametrize(
    ("length", "mass", "words"),
    [
        (1.0, 1.0, None),
        (1e3, 1e-3, "larger than any part of a vehicle"),
        (1e3, 1.0, "larger than any part of a vehicle"),
        (10.0, 1e-3, "lighter than air"),
        (1e-3, 1e3, "smaller than any part of a vehicle"),
        (1e-2, 1e3, "heavier than any metal"),
        (0.3048, 14.6, None),
    ],
)
def test_a_flexible_body_in_wrong_units(length, mass, words):
    text = said(in_units(BEAM, length, mass))
    assert (f"{words}: are its numbers in other units, such as mm and t" in text) if words else not text


def test_a_body_that_no_other_is_like():
    short = replace(in_units(BEAM, 0.009, 1e-4), name="short")
    assert said(short) == ""
    assert "times as large as any other" in said(short, BEAM)
    assert "times smaller than any other" in said(short, BEAM)


def test_a_rigid_body_whose_inertia_is_in_other_units():
    engine = next(b for b in builtin_truck().bodies if isinstance(b, RigidBody))
    assert "larger than any" in said(replace(engine, inertia=1e6 * engine.inertia))
    assert said(replace(engine, inertia=1e-6 * engine.inertia)) == ""


def test_the_truck_is_as_vehicles_are():
    assert not [*size_doubts(builtin_truck())]
