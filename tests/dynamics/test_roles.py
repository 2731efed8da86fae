"""Units and axles of vehicles that are not the pickup."""

from dataclasses import replace

from cars import car, rigid
from small_vehicles import tyre, wheel

from modeviz.dynamics.roles import axles, unit_of_role, units
from modeviz.vehicle.vehicle import Vehicle


def on_wheels(*stations):
    bodies = [wheel(f"w{i}", x, y) for i, (x, y) in enumerate(stations)]
    return Vehicle("test", tuple(bodies), tuple(tyre(b) for b in bodies))


def test_axles_are_called_from_front_to_rear():
    three = on_wheels((4.0, 1), (0.0, -1), (0.0, 1), (2.5, 1), (2.6, -1))
    assert [(a.word, a.x, len(a.wheels)) for a in axles(three)] == [
        ("front", 0.0, 2),
        ("axle 2", 2.5, 2),
        ("rear", 4.0, 1),
    ]
    assert [a.word for a in axles(on_wheels((1.0, -1), (1.0, 1)))] == ["wheel"]


def test_wheels_of_a_rigid_axle_are_called_after_it():
    beam = replace(wheel("axle"), label="dead axle")
    tyres = (tyre(beam), replace(tyre(beam), name="other"))
    (axle,) = axles(Vehicle("test", (beam,), tyres))
    assert axle.unit.word == "dead axle"
    (pair,) = axles(on_wheels((0, -1), (0, 1)))
    assert pair.unit.word == "wheels"


def test_every_body_is_in_one_unit():
    vehicle = car()
    found = [b.name for unit in units(vehicle) for b in unit.bodies]
    assert sorted(found) == sorted(b.name for b in vehicle.bodies)


def test_a_unit_is_called_after_its_heaviest_body():
    light, heavy = (rigid(n, "cabin", m, (0, 0, 1), (1, 1, 1)) for n, m in (("nose", 9), ("cab", 90)))
    (unit,) = units(Vehicle("test", (light, heavy), ()))
    assert (unit.word, len(unit.bodies)) == ("cab", 2)
    assert unit_of_role(car(), "bed") is None


def test_an_axles_wheels_turn_about_their_own_centres():
    as_one = {unit.word: len(unit.as_one) for unit in units(car())}
    assert as_one == {"shell": 1, "motor": 1, "front wheels": 2, "rear wheels": 2}
