"""Modes that can hardly be right are pointed out, with what they may be instead; right ones are not."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from oracles import Beam

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.bodies import FlexibleBody, RigidBody
from modeviz.vehicle.doubts import doubts
from modeviz.vehicle.vehicle import Vehicle

BEAM = Beam(6).body("beam", n_modes=16)


def said_of(body: FlexibleBody) -> str:
    return " | ".join(doubts(Vehicle("v", (body,), ())))


def scaled(body: FlexibleBody, factor) -> FlexibleBody:
    """The same with shapes multiplied, (6 or 1, n_modes or 1)."""
    return replace(
        body,
        attachments=tuple(replace(a, shapes=a.shapes * factor) for a in body.attachments),
        shapes=body.shapes * factor,
    )


def test_right_modes_raise_no_doubt():
    assert said_of(BEAM) == ""
    assert said_of(replace(BEAM, stated_mass=40.0)) == ""
    assert not any("body 'cab'" in note for note in builtin_truck().notes)


@pytest.mark.parametrize(
    ("factor", "words"),
    [(180 / np.pi, "57.3 times as large, as if they were in degrees"), (1e3, "1e+03 times as large")],
)
def test_rotations_in_other_units_are_told_by_the_translations(factor, words):
    # Nodes of a straight beam do not tell its spin, so a place beside it is needed.
    wide = replace(BEAM, attachments=(*BEAM.attachments, beside(BEAM)))
    body = scaled(wide, np.repeat([1.0, factor], 3)[:, None])
    assert words in said_of(body)
    assert "its rigid modes are not rigid: the rotations of attachment" in said_of(body)


def beside(body: FlexibleBody):
    """An attachment half a metre from the beam, on an arm."""
    first = body.attachments[0]
    arm = np.array([0.0, 0.5, 0.0])
    shapes = first.shapes.copy()
    shapes[:3] += np.cross(first.shapes[3:], arm, axisa=0, axisc=0)
    return replace(first, name="beside", position=first.position + arm, shapes=shapes)


def test_rigid_modes_that_deform_are_pointed_out_with_place_and_size():
    last = BEAM.attachments[-1]
    bent = last.shapes.copy()
    bent[:3, :6] *= 1.3
    body = replace(BEAM, attachments=(*BEAM.attachments[:-1], replace(last, shapes=bent)))
    assert "its rigid modes are not rigid: the translations of attachment 'node 6' are" in said_of(body)


def test_a_misfit_below_a_percent_is_nothing_to_speak_of():
    rng = np.random.default_rng(1)
    noisy = tuple(
        replace(a, shapes=a.shapes * (1 + 1e-3 * rng.normal(size=a.shapes.shape)))
        for a in BEAM.attachments
    )
    assert said_of(replace(BEAM, attachments=noisy)) == ""


def test_max_normalised_modes_are_told_by_their_scale_and_by_their_mass():
    largest = np.abs(BEAM.shapes[:, :3]).max(axis=(0, 1))
    body = scaled(BEAM, 1 / np.where(largest > 0, largest, 1.0))
    assert "kg along y and" in said_of(body) or "kg along x" in said_of(body)
    elastic = scaled(BEAM, np.where(np.arange(16) < 6, 1.0, 1 / largest))
    assert "the largest motion is 1 in every mode, as if all were max-normalised" in said_of(elastic)


def test_modal_mass_is_held_against_the_stated_mass():
    grams = scaled(BEAM, 1 / np.sqrt(1000))  # as if kilograms were tonnes
    assert "weighs 4e+04 kg, its mass is stated as 40 kg" in said_of(replace(grams, stated_mass=40.0))


@pytest.mark.parametrize("power", [0.5, 1.0])
def test_frequencies_in_place_of_their_squares_are_pointed_out(power):
    hz = BEAM.natural_frequency_hz
    omega = hz if power == 0.5 else 2 * np.pi * hz
    low = np.minimum(omega, 60.0 * 2 * np.pi)
    assert "are its numbers" in said_of(replace(BEAM, omega_n_squared=low))


def test_inertias_that_no_body_has_are_told_of_modes_too():
    body = Beam(6).body("beam", n_modes=6)
    # A beam of which the spin is far too heavy: its rigid mode is scaled down.
    shapes = np.array([a.shapes for a in body.attachments])
    rotation = np.linalg.svd(shapes[0, 3:4])[2]
    T = rotation.T @ np.diag([1e-3, 1, 1, 1, 1, 1])

    def mixed(a):
        return a @ T

    changed = replace(
        body,
        attachments=tuple(replace(a, shapes=mixed(a.shapes)) for a in body.attachments),
        shapes=mixed(body.shapes),
    )
    assert "the largest is more than both others together" in said_of(changed)


def solid(name: str, *moments: float) -> RigidBody:
    return RigidBody(name, "other", name, 1.0, np.zeros(3), np.diag(moments))


def test_an_inertia_may_be_beyond_those_of_bodies_by_rounding_alone():
    assert solid("plate", 1.0, 2.0, 3.0).inertia[2, 2] == 3.0
    assert solid("rounded plate", 1.11, 1.11, 2.222).inertia[2, 2] == 2.222
    words = "body 'engine': inertia: of the principal moments 12, 21 and 33.1 the largest"
    with pytest.raises(VehicleError, match=words):
        solid("engine", 12.0, 33.1, 21.0)


def test_inertias_that_no_body_has_are_refused_with_all_such_bodies_at_once(tmp_path):
    names = ("a", "b", "c")
    write_vehicle(Vehicle("v", tuple(solid(n, 1.11, 1.0, 1.01) for n in names), ()), tmp_path / "v")
    path = tmp_path / "v/vehicle.toml"
    a, *more = path.read_text().split("inertia = [1.11, 1.0, 1.01]")
    path.write_text(
        "inertia = [1.11, 100.11, 1.01]".join([a, *more[:2]]) + "inertia = [1, 1, 1]" + more[2]
    )
    with pytest.raises(VehicleError) as caught:
        read_vehicle(tmp_path / "v")
    words = "1.01, 1.11 and 100.1 the largest is more than both others together, 2.12"
    for index, name in enumerate("ab"):
        assert f"rigid_body[{index}]: body '{name}': inertia: of the principal moments {words}" in str(
            caught.value
        )
    assert "'c'" not in str(caught.value)


def test_modes_out_of_order_are_pointed_out():
    order = np.r_[np.arange(6), np.arange(15, 5, -1)]
    assert "do not rise" in said_of(replace(BEAM, omega_n_squared=BEAM.omega_n_squared[order]))


@pytest.fixture
def folder(tmp_path):
    write_vehicle(Vehicle("v", (BEAM,), ()), tmp_path / "v")
    return tmp_path / "v"


def resave(folder, **arrays):
    path = folder / "bodies/beam.npz"
    with np.load(path) as archive:
        np.savez(path, **(dict(archive) | arrays))


@pytest.mark.parametrize("given", ["three rows", "zeros"])
def test_rotations_that_are_left_out_are_those_of_the_rigid_modes(folder, given):
    wide = replace(BEAM, attachments=(*BEAM.attachments, beside(BEAM)))
    write_vehicle(Vehicle("v", (wide,), ()), folder)
    shapes = np.array([a.shapes for a in wide.attachments])
    left_out = {"attachment_shapes": shapes[:, :3], "shapes": wide.shapes[:, :3]}
    if given == "zeros":
        left_out = {k: np.concatenate([v, 0 * v], axis=1) for k, v in left_out.items()}
    resave(folder, **left_out)
    vehicle = read_vehicle(folder)
    assert "its attachments have no rotations" in vehicle.notes[0]
    assert len(vehicle.notes) == 1
    found = np.array([a.shapes for a in vehicle.body("beam").attachments])
    np.testing.assert_allclose(found[:, :, :6], shapes[:, :, :6], atol=1e-9)
    assert not found[:, 3:, 6:].any()
    frequencies = solve_modes(assemble(vehicle)).frequency_hz
    np.testing.assert_allclose(frequencies, BEAM.natural_frequency_hz, atol=1e-2)


def test_doubts_of_a_folder_are_among_its_notes(folder):
    path = folder / "vehicle.toml"
    path.write_text(path.read_text().replace('label = "beam"', 'label = "beam"\nmass = 41.0'))
    assert "stated as 41 kg" in "".join(read_vehicle(folder).notes)
