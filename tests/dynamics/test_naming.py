"""Naming on vehicles that are not the pickup, where what each mode is can be told from theory."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from cars import car, link, rigid
from engine_on_mounts import engine_on_mounts
from mounted_cabin import mounted_cabin
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import Modes, solve_modes
from modeviz.dynamics.naming import ModeName, name_modes, prepare_names
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle


def names_and_frequencies(vehicle, n_modes=None):
    system = assemble(vehicle)
    modes = solve_modes(system, n_modes)
    names = name_modes(prepare_names(system), modes)
    return {n.name: f for n, f in zip(names, modes.frequency_hz, strict=True)}


def test_a_car_is_named_by_the_same_rule():
    found = names_and_frequencies(car())
    for name, expected in (
        ("front hop", 11.8),
        ("rear hop", 11.8),
        ("front tramp", 11.8),
        ("rear tramp", 11.8),
        ("motor pitch", np.sqrt(4 * 4e5 * 0.25**2 / 10) / (2 * np.pi)),
        ("motor roll", np.sqrt(4 * 4e5 * 0.2**2 / 7) / (2 * np.pi)),
        ("motor yaw", np.sqrt(4 * (2e5 * 0.2**2 + 3e5 * 0.25**2) / 9) / (2 * np.pi)),
    ):
        assert found[name] == pytest.approx(expected, rel=0.04), name
    # On its springs: 4 x 20 N/mm in series with the tyres under 1250 kg.
    heave = np.sqrt(4 / (1 / 2e4 + 1 / 2e5) / 1250) / (2 * np.pi)
    assert found["front bounce"] == pytest.approx(heave, rel=0.15)
    assert found["rear bounce"] == pytest.approx(heave, rel=0.15)
    assert found["roll"] < 3.0


def test_the_lowest_bending_of_a_frame_is_its_first_beaming():
    beam = Beam(20, length=4.0)
    found = names_and_frequencies(Vehicle("frame", (beam.body("rail"),), ()), 16)
    bending = 4.7300407**2 / (2 * np.pi * 4.0**2) * np.sqrt(6e4 / 20.0)
    assert found["first beaming"] == pytest.approx(bending, rel=1e-3)


def test_an_engine_on_its_mounts_is_called_after_itself():
    """On four springs at the height of its centre of gravity each mode is one motion."""
    corners = [(x, y, 0) for x in (-0.3, 0.3) for y in (-0.2, 0.2)]
    engine = rigid("engine", "powertrain", 100, (0, 0, 0), (4, 6, 7))
    feet = tuple(
        link(f"m{i}", ("engine", "ground"), at, (1e5, 2e5, 3e5)) for i, at in enumerate(corners)
    )
    found = names_and_frequencies(Vehicle("test", (engine,), feet))
    expected = {"fore-aft": 4e5 / 100, "lateral": 8e5 / 100, "bounce": 12e5 / 100}
    expected |= {
        "roll": 12e5 * 0.04 / 4,
        "pitch": 12e5 * 0.09 / 6,
        "yaw": (4e5 * 0.04 + 8e5 * 0.09) / 7,
    }
    assert found == pytest.approx(
        {f"engine {motion}": np.sqrt(square) / (2 * np.pi) for motion, square in expected.items()}
    )


def test_every_mode_has_a_name_of_its_own():
    system = assemble(car())
    modes = solve_modes(system)
    names = [n.name for n in name_modes(prepare_names(system), modes)]
    assert len(set(names)) == len(names) == len(modes.frequency_hz)


def test_names_follow_the_motion_when_modes_change_places():
    def order(k):
        vehicle = car()
        connections = tuple(
            link(c.name, c.bodies, c.points[0], (2e5, 3e5, k)) if c.name.startswith("mount") else c
            for c in vehicle.connections
        )
        found = names_and_frequencies(Vehicle("car", vehicle.bodies, connections))
        return found["motor pitch"] > found["front hop"]

    assert order(4e5)
    assert not order(1e5)


def test_a_vehicle_of_two_masses_still_gets_names():
    pair = (
        rigid("a", "linkage", 1, (0, 0, 0), (1, 1, 1)),
        rigid("b", "linkage", 2, (1, 0, 0), (1, 1, 1)),
    )
    found = names_and_frequencies(
        Vehicle("pair", pair, (link("s", ("a", "b"), (0, 0, 0), (0, 0, 50)),))
    )
    assert all(name for name in found)


@pytest.fixture(scope="module")
def truck():
    return assemble(builtin_truck())


@pytest.mark.parametrize("rates", ["original", "optimised"])
def test_names_below_25_hz_do_not_depend_on_how_many_modes_are_asked(truck, rates):
    namer = prepare_names(truck)
    modes = solve_modes(truck.with_rates(truck.vehicle.rate_sets[rates]), 100)

    def names(count):
        lowest = Modes(modes.frequency_hz[:count], modes.shapes[:, :count], modes.damping_ratio[:count])
        return [
            n.name
            for n, f in zip(name_modes(namer, lowest), lowest.frequency_hz, strict=True)
            if f < 25
        ]

    assert len(names(40)) > 20
    assert names(40) == names(60) == names(100)


def test_one_namer_serves_whatever_the_rates_are(truck):
    optimised = truck.with_rates(truck.vehicle.rate_sets["optimised"])
    modes = solve_modes(optimised, 40)
    found, expected = (name_modes(prepare_names(system), modes) for system in (truck, optimised))
    assert [n.name for n in found] == [n.name for n in expected]
    assert [n.score for n in found] == pytest.approx([n.score for n in expected], abs=1e-9)


def test_axles_that_are_alike_are_called_the_same_however_arithmetic_rounds():
    """Both axles of a rigid chassis tramp at once, each with as much of the mode."""
    soft = {"A": MountRates(2e5, 1e5, 1e5), "B": MountRates(8e5, 131e3, 4e5)}
    system = assemble(mounted_cabin().with_rates(soft))
    namer, modes, random = prepare_names(system), solve_modes(system), np.random.default_rng(1)
    found = set()
    for _ in range(20):
        rounded = modes.shapes * (1 + 1e-14 * random.normal(size=modes.shapes.shape))
        names = name_modes(namer, replace(modes, shapes=rounded))
        found.add(tuple(n.name for n in names))
    assert len(found) == 1
    assert {"front tramp", "rear tramp"} & set(*found)


def test_a_name_for_less_than_half_of_the_mode_is_spoken_as_a_guess():
    assert ModeName("cab yaw", 0.49).spoken == "~cab yaw"
    assert ModeName("cab yaw", 0.5).spoken == "cab yaw"


def test_an_engine_keeps_its_name_with_an_absorber_on_it():
    alone = engine_on_mounts()
    (body,) = alone.bodies
    at = tuple(body.center_of_gravity.tolist())
    absorber = Absorber("small", body.name, at, 0.02 * body.mass, 30.0, 0.1)
    before, after = (
        [mode.name for mode in name_modes(prepare_names(system), solve_modes(system))]
        for system in map(assemble, (alone, with_absorbers(alone, [absorber])))
    )
    assert set(before) < set(after)
    assert len(after) == len(before) + 1
