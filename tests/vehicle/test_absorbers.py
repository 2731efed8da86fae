"""Absorbers: closed forms of J. P. Den Hartog, and what they are made of."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from small_systems import joined_beams

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.vehicle.absorber import Absorber, den_hartog
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.bodies import AddedMass, RigidBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.vehicle.vehicle import Vehicle

MASS, MAIN_HZ, RATIO = 100.0, 10.0, 0.05
STIFFNESS = MASS * (2 * np.pi * MAIN_HZ) ** 2
ROOF = Absorber("roof", "cab", (1.0, 0.2, 1.4), 6.0, 12.0, 0.1)


def main_mass() -> Vehicle:
    """A mass that only moves along z, on a spring without damping."""
    body = RigidBody("main", "cabin", "main", MASS, np.zeros(3), np.eye(3))
    spring = Spring(
        "spring", "springs", ("main", GROUND), np.zeros((2, 3)), np.array([0, 0, STIFFNESS]),
        rigid=("x", "y", "rx", "ry", "rz"),
    )  # fmt: skip
    return Vehicle("main mass", (body,), (spring,))


def amplification(vehicle: Vehicle, frequency_hz) -> np.ndarray:
    """|x/x_static| of the main mass under a force on it."""
    system = assemble(vehicle)
    row = system.motion("main", np.zeros(3))[2:3]
    forces = np.tile(row.T.astype(complex), (len(frequency_hz), 1, 1))
    return STIFFNESS * np.abs(direct_response(system, frequency_hz, forces, row)[:, 0, 0])


def on_main_mass(damping_times=1.0, **fields) -> Vehicle:
    tuned = den_hartog(RATIO, MAIN_HZ)
    own = {"frequency_hz": tuned.frequency_hz, "damping_ratio": damping_times * tuned.damping_ratio}
    absorber = Absorber("small", "main", (0.0, 0.0, 0.0), RATIO * MASS, **own | fields)
    return with_absorbers(main_mass(), [absorber])


@pytest.mark.parametrize("damping_times", [0.1, 1.0, 5.0])
def test_both_fixed_points_are_as_high_whatever_the_damping(damping_times):
    ratio = np.sqrt((1 + np.array([-1, 1]) * np.sqrt(RATIO / (2 + RATIO))) / (1 + RATIO))
    found = amplification(on_main_mass(damping_times), MAIN_HZ * ratio)
    np.testing.assert_allclose(found, np.sqrt(1 + 2 / RATIO), rtol=1e-9)


def test_with_its_damping_no_peak_is_much_higher_than_the_fixed_points():
    f = np.linspace(8, 12, 801)
    highest = amplification(on_main_mass(), f).max()
    assert 1.0 <= highest / np.sqrt(1 + 2 / RATIO) < 1.003
    for damping_times in (0.7, 1.4):
        assert amplification(on_main_mass(damping_times), f).max() > 1.03 * highest


def test_undamped_it_stills_what_it_sits_on_at_its_own_frequency():
    still = on_main_mass(frequency_hz=9.0, damping_ratio=0.0)
    # K/(kᵃ - ω²mᵃ) is singular there, to as many digits as the frequency has
    assert amplification(still, np.array([9.0 * (1 + 1e-7)]))[0] < 1e-5


def test_along_all_directions_it_splits_the_mode_of_each():
    """ω of two masses in a row: (kM/m + K + k ± √...)/2M, from the determinant of their equations."""
    body = replace(main_mass().bodies[0], role="cabin")
    every = np.array([1.0, 2.0, 3.0]) * STIFFNESS
    spring = Spring("spring", "s", ("main", GROUND), np.zeros((2, 3)), every, rigid=("rx", "ry", "rz"))
    absorber = Absorber(
        "a", "main", (0, 0, 0), 5.0, 9.0, directions=("vertical", "lateral", "fore-aft")
    )
    vehicle = with_absorbers(Vehicle("v", (body,), (spring,)), [absorber])
    k, m = absorber.stiffness_at(9.0), absorber.mass
    pencils = [np.array([[K + k, -k], [-k, k]]) / [[MASS], [m]] for K in every]
    expected = np.sort(np.concatenate([np.linalg.eigvals(p).real for p in pencils]))
    np.testing.assert_allclose(solve_modes(assemble(vehicle)).omega_n_squared, expected, rtol=1e-9)


def test_on_a_flexible_body_its_mass_adds_to_it_while_it_is_stiff():
    _, vehicle = joined_beams()
    absorber = Absorber("a", "rear", (3.0, 0.0, 0.0), 4.0, 5000.0)
    edge = np.cbrt(4.0 / 7850)
    carried = replace(vehicle, added_masses=(AddedMass("m", "rear", np.array([3.0, 0, 0]), 4.0),))
    expected = solve_modes(assemble(carried)).frequency_hz[:6]
    found = solve_modes(assemble(with_absorbers(vehicle, [absorber]))).frequency_hz[:6]
    # its own inertia, m a²/6 = 4e-3 kg m², is all that differs
    assert 4.0 * edge**2 / 6 < 5e-3
    np.testing.assert_allclose(found, expected, rtol=2e-4)


def test_along_one_direction_it_goes_along_in_all_others():
    system = assemble(with_absorbers(mounted_cabin(), [ROOF]))
    own, cab = (
        system.motion("roof mass", np.array(ROOF.position)),
        system.motion("cab", np.array(ROOF.position)),
    )
    shapes = solve_modes(system).shapes
    moved = (own - cab) @ shapes
    assert np.abs(moved[[0, 1, 3, 4, 5]]).max() < 1e-9 * np.abs(own @ shapes).max()
    assert np.abs(moved[2]).max() > 1e-2


def test_its_parts_are_a_body_a_mount_group_with_its_rate_and_a_guide():
    vehicle = with_absorbers(mounted_cabin(), [ROOF])
    group = vehicle.mount_group("roof")
    assert group.rates.vertical == pytest.approx(6.0 * (2 * np.pi * 12.0) ** 2)
    assert group.rates.lateral == group.rates.fore_aft == 0
    critical = 2 * 6.0 * 2 * np.pi * 12.0
    assert group.rates.damping() == (0, 0, pytest.approx(0.1 * critical))
    assert group.fields == ("vertical", "damping_vertical")
    softest, stiffest = group.bounds
    assert softest.damping_vertical == pytest.approx(0.1 * critical / 4)
    assert stiffest.damping_vertical == pytest.approx(4 * 0.1 * critical)
    assert vehicle.body("roof mass").role == "absorber"
    assert vehicle.connections[-1].rigid == ("x", "y", "rx", "ry", "rz")
    assert [g.name for g in vehicle.mount_groups] == ["A", "B", "roof"]


@pytest.mark.parametrize(
    ("fields", "words"),
    [
        ({"mass": 0.0}, "absorber 'roof': mass: found 0.0 kg, expected more than 0"),
        ({"frequency_hz": -1.0}, "absorber 'roof': frequency_hz: found -1.0 Hz, expected more than 0"),
        ({"damping_ratio": -0.1}, "damping_ratio: found -0.1, expected zero or more"),
        ({"directions": ("up",)}, "absorber 'roof': unknown direction 'up'"),
        ({"directions": ()}, "expected some of vertical, lateral, fore-aft"),
        ({"position": (0.0, np.nan, 0.0)}, "position: found"),
        ({"frequency_range": (9.0, 9.0)}, "frequency_range: found 9 to 9 Hz, expected the lower one"),
        ({"damping_range": (0.2, 0.1)}, "damping_range: found 0.2 to 0.1, expected the lower one"),
    ],
)
def test_what_no_absorber_is_is_said(fields, words):
    with pytest.raises(VehicleError) as caught:
        replace(ROOF, **fields)
    assert words in str(caught.value)


def test_an_absorber_on_no_body_or_of_a_taken_name_is_refused():
    with pytest.raises(VehicleError, match="absorber 'roof': unknown body 'roof rack'"):
        with_absorbers(mounted_cabin(), [replace(ROOF, body="roof rack")])
    with pytest.raises(VehicleError, match="'A'"):
        with_absorbers(mounted_cabin(), [replace(ROOF, name="A")])


@pytest.mark.parametrize("directions", [("vertical",), ("vertical", "lateral")])
def test_an_absorber_of_a_vehicle_is_placed_as_a_whole(directions):
    absorber = replace(ROOF, directions=directions)
    placement = Placement(offset=(0.1, -0.2, 0.05), angles=(0.2, -0.1, 0.3))
    moved = with_placements(with_absorbers(mounted_cabin(), [absorber]), {"roof": placement})
    made_there = with_absorbers(mounted_cabin(), [absorber.placed(placement)])
    found, expected = (solve_modes(assemble(v), 40.0).frequency_hz for v in (moved, made_there))
    np.testing.assert_allclose(found, expected, rtol=1e-9)
    at = solve_modes(assemble(with_absorbers(mounted_cabin(), [absorber])), 40.0).frequency_hz
    assert np.abs(found / at - 1).max() > 1e-4


def test_an_absorber_that_was_turned_is_turned_on_by_its_placement():
    slanted = replace(ROOF, angles=(0.3, -0.2, 0.1))
    placement = Placement((0.1, 0.0, -0.05), (0.0, 0.4, 0.2))
    placed = with_absorbers(mounted_cabin(), [slanted.placed(placement)]).mount_group("roof").mounts[0]
    whole = with_absorbers(mounted_cabin(), [slanted])
    expected = with_placements(whole, {"roof": placement}).mount_group("roof").mounts[0]
    np.testing.assert_allclose(placed.axes, expected.axes, atol=1e-12)
    np.testing.assert_allclose(placed.points, expected.points, atol=1e-12)
    assert slanted.placed(Placement()).angles == pytest.approx(slanted.angles)
