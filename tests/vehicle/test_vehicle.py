"""What a vehicle refuses to be made of, and what it answers."""

from dataclasses import replace

import numpy as np
import pytest
from folders import connections, engine, flexible_body, mount_group, one_of_everything, road

from modeviz.errors import VehicleError
from modeviz.vehicle.bodies import AddedMass, Attachment, FlexibleBody, Material, MeshPart, RigidBody
from modeviz.vehicle.checks import REACH
from modeviz.vehicle.connections import GROUND, Connection, Spring
from modeviz.vehicle.loads import ResponsePoint, WheelLoad
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

VEHICLE = one_of_everything()
CAB = flexible_body()
ENGINE = engine()
GROUP = mount_group()
SPRING, ROD, BOLT, DAMPER, TYRE = connections()
ROAD = road()
NAN = float("nan")
INF = float("inf")
RATES = MountRates(1.0, 2.0, 3.0)


def refused(value, **changes) -> str:
    with pytest.raises(VehicleError) as caught:
        replace(value, **changes)
    return str(caught.value)


@pytest.mark.parametrize(
    ("value", "changes", "words"),
    [
        (ENGINE, {"mass": 0}, "mass: found 0 kg, expected more than 0"),
        (ENGINE, {"mass": NAN}, "mass: found nan"),
        (ENGINE, {"mass": INF}, "mass: found inf"),
        (ENGINE, {"role": "motor"}, "unknown role 'motor'"),
        (ENGINE, {"center_of_gravity": [0, 0]}, "found shape (2,), expected 3"),
        (ENGINE, {"center_of_gravity": [0, 0, NAN]}, "found 1 values that are not finite"),
        (ENGINE, {"center_of_gravity": ["a", 0, 0]}, "expected an array of numbers"),
        (ENGINE, {"center_of_gravity": [[0], 0, 0]}, "expected an array of numbers"),
        (ENGINE, {"inertia": np.diag([1, 1, 0])}, "expected a symmetric matrix with positive"),
        (ENGINE, {"inertia": np.triu(np.ones((3, 3))) + np.eye(3)}, "expected a symmetric matrix"),
        (ENGINE, {"mesh": (CAB.mesh[0], CAB.mesh[0])}, "mesh part 'skin' is there twice"),
        (CAB, {"damping_ratio": 1.0}, "damping_ratio: found 1.0"),
        (CAB, {"damping_ratio": NAN}, "damping_ratio: found nan"),
        (CAB, {"damping_ratio": -0.1}, "damping_ratio: found -0.1"),
        (CAB, {"n_residuals": 6}, "n_residuals: found 6 with 11 modes, expected 0 to 5"),
        (CAB, {"n_residuals": -1}, "n_residuals: found -1"),
        (CAB, {"omega_n_squared": np.full(11, NAN)}, "found 11 values that are not finite"),
        (CAB, {"omega_n_squared": -np.arange(11.0)}, "expected six zeros, then positive values"),
        (CAB, {"omega_n_squared": np.zeros(11)}, "expected six zeros, then positive values"),
        (CAB, {"shapes": np.full_like(CAB.shapes, INF)}, "values that are not finite"),
        (CAB, {"shapes": CAB.shapes[:, :, :-1]}, "found shape (5, 6, 10), expected 5 x 6 x 11"),
        (CAB, {"nodes": CAB.nodes[:-1]}, "found shape (5, 6, 11), expected 4 x 6 x 11"),
        (
            CAB,
            {"attachments": (Attachment("a", np.zeros(3), np.zeros((6, 3))),)},
            "has 3 modes, the body",
        ),
        (CAB, {"attachments": CAB.attachments[:1] * 2}, "attachment 'origin' is there twice"),
        (CAB.mesh[0], {"faces": [[0, 1, 6]]}, "a face names a vertex that does not exist"),
        (CAB.mesh[0], {"faces": [[0, 1, -1]]}, "a face names a vertex that does not exist"),
        (CAB.mesh[0], {"faces": np.zeros((0, 3))}, "has no faces"),
        (CAB.mesh[0], {"vertices": np.full((6, 3), NAN)}, "found 18 values that are not finite"),
        (CAB.mesh[0].material, {"color": (0, 0, 256)}, "color: found (0, 0, 256)"),
        (CAB.mesh[0].material, {"opacity": NAN}, "opacity: found nan, expected 0 to 1"),
        (CAB.mesh[0].material, {"roughness": 2.0}, "roughness: found 2.0"),
        (CAB.mesh[0].material, {"metallic": -1.0}, "metallic: found -1.0"),
        (SPRING, {"stiffness": [1, -1, 0]}, "stiffness: found [1.0, -1.0, 0.0], expected zero or more"),
        (SPRING, {"stiffness": [1, NAN, 0]}, "stiffness: found 1 values that are not finite"),
        (SPRING, {"rotational_stiffness": [-1, 0, 0]}, "rotational_stiffness: found [-1.0"),
        (DAMPER, {"damping": [0, 0, -1]}, "damping: found [0.0, 0.0, -1.0]"),
        (BOLT, {"loss_factor": NAN}, "loss_factor: found nan"),
        (BOLT, {"loss_factor": -0.1}, "loss_factor: found -0.1"),
        (SPRING, {"axes": np.ones((3, 3))}, "axes: expected three orthogonal unit vectors"),
        (SPRING, {"points": np.zeros(3)}, "points: found shape (3,), expected 2 x 3"),
        (SPRING, {"bodies": ("cab", "cab")}, "joins 'cab' to itself"),
        (TYRE, {"trail": NAN}, "trail: found nan"),
        (TYRE, {"wheel_center": [0, NAN, 0]}, "wheel_center: found 1 values that are not finite"),
        (RATES, {"lateral": -1.0}, "lateral rate: found -1.0 N/m, expected zero or more"),
        (RATES, {"fore_aft": NAN}, "fore-aft rate: found nan"),
        (RATES, {"loss_factor": NAN}, "loss_factor: found nan, expected zero or more"),
        (RATES, {"loss_factor": -0.1}, "loss_factor: found -0.1, expected zero or more"),
        (RATES, {"loss_factor": INF}, "loss_factor: found inf, expected zero or more"),
        (GROUP, {"rates": replace(RATES, loss_factor=0.2)}, "expected it as the group's own"),
        (GROUP, {"bounds": (RATES, replace(RATES, loss_factor=0.2))}, "expected it as the group's own"),
        (GROUP, {"mounts": ()}, "has no mounts"),
        (GROUP, {"loss_factor": NAN}, "loss_factor: found nan"),
        (GROUP, {"bounds": (RATES, RATES)}, "bounds: found the same softest and stiffest rates"),
        (GROUP, {"ratio_limits": (0.8, 0.25)}, "ratio_limits: found (0.8, 0.25)"),
        (GROUP, {"ratio_limits": (NAN, 1.0)}, "ratio_limits: found (nan, 1.0)"),
        (ROAD, {"speed": 0}, "speed: found 0 m/s"),
        (ROAD, {"speed": INF}, "speed: found inf m/s"),
        (ROAD, {"frequency_hz": ROAD.frequency_hz[::-1]}, "expected rising values above zero"),
        (ROAD, {"frequency_hz": ROAD.frequency_hz - 1 / 3}, "expected rising values above zero"),
        (ROAD, {"frequency_hz": ROAD.frequency_hz[:1]}, "found shape (7, 2, 2), expected 1 x 2 x 2"),
        (ROAD, {"spectrum": ROAD.spectrum * NAN}, "values that are not finite"),
        (ROAD, {"spectrum": -ROAD.spectrum}, "no negative power"),
        (ROAD, {"spectrum": ROAD.spectrum * [[1, 1j], [1, 1]]}, "expected Hermitian matrices"),
        (ROAD, {"spectrum": ROAD.spectrum * [[1, 1.5], [1.5, 1]]}, "coherence is above one"),
        (VEHICLE.wheel_loads[0], {"amplitude": NAN}, "amplitude: found nan"),
        (VEHICLE.wheel_loads[0], {"kind": "potholes"}, "there are unbalance, radial force, lateral"),
        (VEHICLE.added_masses[0], {"mass": -1.0}, "added mass 'driver': mass: found -1.0 kg"),
        (VEHICLE.response_points[0], {"position": [0, 0, INF]}, "found 1 values that are not finite"),
    ],
)
def test_part_that_cannot_be_is_refused(value, changes, words):
    assert words in refused(value, **changes)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"bodies": ()}, "has no bodies"),
        ({"bodies": (CAB, CAB, ENGINE)}, "body 'cab' is there twice"),
        ({"bodies": (CAB, replace(ENGINE, name=GROUND))}, "that name means what does not move"),
        ({"bodies": (CAB, replace(ENGINE, name=""))}, "body: found an empty name"),
        ({"bodies": (CAB,)}, "connection 'C1 left': unknown body 'Engine & box': there are cab"),
        ({"bodies": (ENGINE, replace(CAB, attachments=()))}, "body 'cab' has no attachment"),
        ({"speed": 0.0}, "speed: found 0.0 m/s"),
        ({"speed": NAN}, "speed: found nan m/s"),
        ({"connections": (SPRING, SPRING, TYRE)}, "connection 'arm' is there twice"),
        (
            {"connections": (replace(SPRING, name="C1 left"), TYRE)},
            "connection 'C1 left' is there twice",
        ),
        ({"connections": (replace(TYRE, bodies=(GROUND, "cab")),)}, "must be the second of its bodies"),
        ({"connections": (SPRING,)}, "unknown tyre 'tyre left': there are none"),
        (
            {"connections": (TYRE, Connection("link", "links", SPRING.bodies, SPRING.points))},
            "connection 'link': expected a Spring, Rod, Bolt, Damper or Tyre",
        ),
        (
            {"connections": (replace(SPRING, group="cab"), TYRE)},
            "connection 'arm': group 'cab' is the name of a body",
        ),
        ({"mount_groups": (GROUP, GROUP)}, "'C1 left' is there twice"),
        ({"roads": (ROAD, ROAD)}, "random load 'road 1' is there twice"),
        ({"wheel_loads": VEHICLE.wheel_loads[:1] * 2}, "harmonic load 'unbalance left' is there twice"),
        ({"added_masses": VEHICLE.added_masses * 2}, "added mass 'driver' is there twice"),
        ({"added_masses": (AddedMass("tank", "cob", np.zeros(3), 1.0),)}, "did you mean 'cab'"),
        ({"response_points": VEHICLE.response_points * 2}, "'seat track left' is there twice"),
        ({"response_points": (ResponsePoint("seat", GROUND, np.zeros(3)),)}, "unknown body 'ground'"),
        ({"wheel_loads": (WheelLoad("a", "unbalance", "arm", 1.0),)}, "there are tyre left"),
        ({"rate_sets": {"soft": {"C2": RATES}}}, "rates 'soft': unknown mount group 'C2'"),
    ],
)
def test_vehicle_that_does_not_hang_together_is_refused(changes, words):
    assert words in refused(VEHICLE, **changes)


def test_connection_may_hold_on_as_far_as_it_reaches():
    """The cab's only other attachment is 0.37 m from the origin, along (1, 2, 3)."""

    def vehicle(distance: float) -> Vehicle:
        end = np.array([[-distance, 0.0, 0.0], [0.0, 0.0, 0.0]])
        return replace(VEHICLE, connections=(replace(SPRING, points=end), TYRE))

    vehicle(REACH)
    with pytest.raises(VehicleError, match=r"0\.11 m from the nearest attachment of 'cab', 'origin'"):
        vehicle(1.1 * REACH)


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ((101.0, 199.0, 300.0), "it would fit if its numbers were in mm and not in m"),
        ((1e-4, 2e-4, 3.2e-4), "it would fit if its numbers were in m and not in mm"),
        ((2.0, 0.0, 0.0), None),
    ],
)
def test_a_place_that_fits_in_another_unit_is_told_so(place, words):
    cab = replace(CAB, attachments=CAB.attachments[1:])
    with pytest.raises(VehicleError) as caught:
        Vehicle("car", (cab,), (), response_points=(ResponsePoint("seat", "cab", place),))
    text = str(caught.value)
    assert "from the nearest attachment of 'cab'" in text
    assert words in text if words else "if its numbers" not in text


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: VEHICLE.body("Cab"), "unknown body 'Cab': did you mean 'cab'?"),
        (
            lambda: VEHICLE.random_load("road 2"),
            "unknown random load 'road 2': did you mean 'road 1'?",
        ),
        (lambda: VEHICLE.mount_group("F"), "unknown mount group 'F': there are C1"),
        (lambda: VEHICLE.with_rates({"F": RATES}), "unknown mount group 'F': there are C1"),
        (lambda: CAB.attachment("seat"), "body 'cab': unknown attachment 'seat': there are origin"),
        (lambda: CAB.truncated(10), "modes to keep: found 10, expected 6 to 9"),
        (lambda: CAB.truncated(5), "modes to keep: found 5, expected 6 to 9"),
    ],
)
def test_name_that_does_not_exist_is_told_the_names_that_do(ask, words):
    with pytest.raises(VehicleError) as caught:
        ask()
    assert words in str(caught.value)


def test_arrays_of_a_vehicle_cannot_be_written_to():
    for array in (CAB.shapes, CAB.nodes, ENGINE.inertia, SPRING.points, ROAD.spectrum):
        with pytest.raises(ValueError, match="read-only"):
            array[...] = 0


def test_array_given_stays_the_givers():
    position = np.zeros(3)
    mass = AddedMass("a", "cab", position, 1.0)
    position[0] = 1.0
    assert mass.position[0] == 0.0


def test_rates_of_a_group_are_its_mounts_stiffness_along_x_y_z():
    rates = MountRates(vertical=3.0, lateral=2.0, fore_aft=1.0)
    vehicle = VEHICLE.with_rates({"C1": rates})
    assert vehicle.rates == {"C1": rates}
    for mount in vehicle.mounts:
        np.testing.assert_array_equal(mount.stiffness, [1.0, 2.0, 3.0])
        assert (mount.group, mount.loss_factor) == ("C1", GROUP.loss_factor)
    assert VEHICLE.rates["C1"] == GROUP.rates


def test_a_loss_factor_among_rates_becomes_the_groups_and_its_mounts():
    tuned = VEHICLE.with_rates({"C1": replace(RATES, loss_factor=0.2)})
    assert tuned.rates == {"C1": RATES}
    assert {g.loss_factor for g in (*tuned.mount_groups, *tuned.mounts)} == {0.2}
    assert tuned.with_rates({"C1": RATES}).mount_group("C1").loss_factor == 0.2


def test_residual_compliance_is_what_the_residual_vectors_give():
    """A force f deflects a mode by φᵀf/ω², and the point by φ times that."""
    force = np.array([1.0, -2.0, 3.0])
    attachment = CAB.attachment("floor link")
    deflection = np.zeros(3)
    for mode in (9, 10):
        phi = attachment.shapes[:3, mode]
        deflection += phi * (phi @ force) / CAB.omega_n_squared[mode]
    np.testing.assert_allclose(CAB.residual_compliance("floor link") @ force, deflection, rtol=1e-13)
    assert not CAB.truncated(9).residual_compliance("floor link").any()


def test_residual_compliance_at_the_end_of_an_arm_has_the_arms_rotation_in_it():
    at = CAB.attachment("floor link")
    arm = np.array([0.3, -0.1, 0.2])
    expected = np.zeros((3, 3))
    for mode in (9, 10):
        phi = at.shapes[:3, mode] + np.cross(at.shapes[3:, mode], arm)
        expected += np.outer(phi, phi) / CAB.omega_n_squared[mode]
    found = CAB.residual_compliance("floor link", at.position + arm)
    np.testing.assert_allclose(found, expected, rtol=1e-12)


def test_smallest_parts_are_accepted():
    MeshPart("triangle", np.eye(3), np.array([[0, 1, 2]]), Material((0, 0, 255), 0.0, 1.0, 0.0))
    RigidBody("a", "linkage", "", 1e-9, np.zeros(3), np.eye(3))
    FlexibleBody("b", "bed", "", np.zeros(6), 0, 0.0, (), np.zeros((1, 3)), np.eye(6)[None])
    Spring("c", "springs", ("a", GROUND), np.zeros((2, 3)))
    Vehicle("d", (ENGINE,), ())
