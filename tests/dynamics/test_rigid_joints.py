from dataclasses import replace

import numpy as np
import pytest
from differences import row_error
from full_solutions import receptances
from mounted_cabin import mounted_cabin
from oracles import Beam
from small_systems import block, joined_beams

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.band import band_modes
from modeviz.dynamics.basis import prepare_basis
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, MOTIONS, Bolt, Damper, Spring
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

F = np.array([0.3, 2.0, 9.0, 31.0])


def rigidly(vehicle, *names):
    """The vehicle with some of its connections rigid in every motion."""
    rates = {"stiffness": np.zeros(3), "rotational_stiffness": np.zeros(3), "damping": np.zeros(3)}
    return replace(
        vehicle,
        connections=tuple(
            replace(c, rigid=MOTIONS, **rates) if c.name in names else c for c in vehicle.connections
        ),
    )


def test_beams_joined_rigidly_have_the_modes_of_the_whole_beam():
    halves = {"front": Beam(8, 2.0), "rear": Beam(8, 2.0, start=(2.0, 0, 0))}
    bolt = Bolt("bolt", "bolts", ("front", "rear"), np.tile([2.0, 0, 0], (2, 1)), rigid=MOTIONS)
    bodies = tuple(beam.body(name) for name, beam in halves.items())
    found = solve_modes(assemble(Vehicle("halves", bodies, (bolt,))), 30).frequency_hz
    whole = solve_modes(assemble(Vehicle("whole", (Beam(16, 4.0).body("whole"),), ())), 30).frequency_hz
    np.testing.assert_allclose(found[6:], whole[6:], rtol=1e-8)
    assert found[:6] == pytest.approx(0, abs=1e-2)


def test_a_rigid_joint_is_the_limit_of_stiff_ones():
    vehicle = joined_beams()[1]
    joint, *others = vehicle.connections
    rigid = solve_modes(assemble(rigidly(vehicle, "joint")), 20).frequency_hz

    def distance(rate):
        rates = {"stiffness": np.full(3, rate), "rotational_stiffness": np.full(3, rate)}
        stiff = replace(vehicle, connections=(replace(joint, **rates), *others))
        return np.abs(solve_modes(assemble(stiff), 20).frequency_hz / rigid - 1)[6:].max()

    # To first order what yields is 1/k.
    assert distance(1e9) == pytest.approx(distance(1e8) / 10, rel=0.1)
    assert distance(1e9) < 0.02


def test_shapes_keep_a_rigid_joint_and_are_mass_normalised():
    system = assemble(rigidly(joined_beams()[1], "joint"))
    phi = solve_modes(system).shapes
    assert phi.shape[1] == system.n_dofs - 6
    np.testing.assert_allclose(phi.T @ system.mass @ phi, np.eye(phi.shape[1]), atol=1e-9)
    assert np.abs(system.connection_motions[:6] @ phi).max() < 1e-9 * np.abs(phi).max()


def grounded_block():
    """A block with a rigid arm to a second one, on springs: one body of both masses."""
    low, high = block("low", 10.0), block("high", 4.0, at=(0.2, 0.0, 0.5))
    springs = tuple(
        Spring(f"foot {i}", "feet", ("low", GROUND), np.tile([x, y, 0.0], (2, 1)),
               np.array([2e4, 3e4, 5e4]), loss_factor=0.1, damping=np.full(3, 20.0))
        for i, (x, y) in enumerate([(-0.3, -0.3), (-0.3, 0.3), (0.3, -0.3), (0.3, 0.3)])
    )  # fmt: skip
    return low, high, springs


def one_body():
    """The two blocks as one rigid body, by Huygens and Steiner."""
    low, high, springs = grounded_block()
    mass = low.mass + high.mass
    center = (low.mass * low.center_of_gravity + high.mass * high.center_of_gravity) / mass
    inertia = np.zeros((3, 3))
    for body in (low, high):
        r = body.center_of_gravity - center
        inertia += body.inertia + body.mass * (r @ r * np.eye(3) - np.outer(r, r))
    whole = RigidBody("low", "linkage", "low", mass, center, inertia)
    return assemble(Vehicle("one", (whole,), springs))


def two_bodies(n_bolts=1):
    """The same as two bodies, bolted rigidly at as many places, though one would do."""
    low, high, springs = grounded_block()
    bolts = tuple(
        Bolt(
            f"bolt {i}", "bolts", ("low", "high"), np.tile([0.1 * i, 0.0, 0.25], (2, 1)), rigid=MOTIONS
        )
        for i in range(n_bolts)
    )
    return assemble(Vehicle("two", (low, high), (*springs, *bolts)))


@pytest.mark.parametrize("n_bolts", [1, 4])
def test_bodies_bolted_rigidly_are_one_body_in_modes_and_responses(n_bolts):
    one, two = one_body(), two_bodies(n_bolts)
    np.testing.assert_allclose(solve_modes(two).frequency_hz, solve_modes(one).frequency_hz, rtol=1e-9)
    seat = np.array([0.4, 0.3, 0.6])
    own, other = (s.motion("low", seat) for s in (one, two))
    expected = receptances(one, F, own)
    assert row_error(receptances(two, F, other), expected) < 1e-10
    forces = np.broadcast_to(other.T.astype(complex), (len(F), two.n_dofs, 6))
    assert row_error(direct_response(two, F, forces, other), expected) < 1e-10
    # The second body moves with the first: the same point on it does the same.
    assert row_error(receptances(two, F, two.motion("high", seat)), expected) < 1e-10


def test_receptances_of_flexible_bodies_equal_the_condensed_solve():
    system = assemble(rigidly(joined_beams()[1], "joint", "foot front"))
    rows = np.vstack(
        [system.motion("rear", np.array([3.5, 0, 0])), system.motion("front", np.zeros(3))]
    )
    T = system.rigid_joints.freedom
    K = system.stiffness + 1j * system.structural_damping
    for f, G in zip(F, receptances(system, F, rows), strict=True):
        omega = 2 * np.pi * f
        Z = T.T @ (K + 1j * omega * system.damping - omega**2 * system.mass) @ T
        expected = rows @ T @ np.linalg.solve(Z, T.T @ rows.T.astype(complex))
        assert np.abs(G - expected).max() < 1e-8 * np.abs(expected).max()


def test_a_ball_joint_turns():
    arm = block("arm", 6.0, at=(0.5, 0.0, 0.0))
    joint = Spring("ball", "joints", ("arm", GROUND), np.zeros((2, 3)), rigid=MOTIONS[:3])
    hold = Spring(
        "coil", "springs", ("arm", GROUND), np.tile([1.0, 0, 0], (2, 1)), np.array([0, 0, 8e3])
    )
    f = solve_modes(assemble(Vehicle("arm", (arm,), (joint, hold)))).frequency_hz
    assert len(f) == 3
    # About y through the joint: k L² / (I + m r²).
    assert f[-1] == pytest.approx(np.sqrt(8e3 / (2.0 + 6.0 * 0.25)) / (2 * np.pi), rel=1e-9)


def bolted_cabin():
    """The cabin with a rigidly bolted box on it."""
    cabin = mounted_cabin()
    carrier = cabin.bodies[0]
    place = carrier.center_of_gravity + np.array([0.0, 0.1, 0.4])
    box = RigidBody("tool box", "linkage", "tool box", 30.0, place, np.diag([2.0, 1.0, 2.0]))
    bolt = Bolt("bolt", "bolts", (carrier.name, "tool box"), np.tile(place, (2, 1)), rigid=MOTIONS)
    return replace(cabin, bodies=(*cabin.bodies, box), connections=(*cabin.connections, bolt))


def test_the_enriched_basis_holds_the_modes_at_any_rates():
    vehicle = bolted_cabin()
    system = assemble(vehicle)
    basis = prepare_basis(system)
    for factor in (0.1, 1.0, 7.0):
        group = vehicle.mount_groups[0]
        rates = {group.name: MountRates(*(factor * k for k in group.rates.as_tuple()))}
        changed = system.with_rates(rates)
        stiffness = mount_stiffness(changed.vehicle)
        direct = solve_modes(changed, below_hz=basis.top_hz).frequency_hz
        for method in ("enriched", "exact"):
            found = band_modes(basis, stiffness, method)
            np.testing.assert_allclose(found.modes.frequency_hz, direct, rtol=1e-6, atol=1e-4)
            assert found.trust.n_missed == 0


def test_a_rate_in_a_rigid_direction_is_refused():
    with pytest.raises(VehicleError, match="connection 'b': x is rigid and has a rate"):
        Bolt(
            "b", "bolts", ("a", "c"), np.zeros((2, 3)), np.array([1e6, 0, 0]), np.array([0, 0, 10.0]),
            rigid=MOTIONS,
        )  # fmt: skip


@pytest.mark.parametrize("rigid", [MOTIONS, ("x", "z", "ry")])
def test_a_rigid_joint_is_written_and_read(tmp_path, rigid):
    vehicle = bolted_cabin()
    *others, bolt = vehicle.connections
    write_vehicle(replace(vehicle, connections=(*others, replace(bolt, rigid=rigid))), tmp_path / "v")
    read = read_vehicle(tmp_path / "v")
    assert next(c for c in read.connections if c.name == "bolt").rigid == rigid
    assert ("rigid = true" in (tmp_path / "v" / "vehicle.toml").read_text()) == (rigid == MOTIONS)


def test_only_springs_rods_and_bolts_are_rigid():
    damper = Damper("damper", "dampers", ("a", GROUND), np.zeros((2, 3)), rigid=("z",))
    with pytest.raises(VehicleError, match="'damper': only a spring, a rod or a bolt can be rigid"):
        Vehicle("held", (block("a"),), (damper,))


def test_a_vehicle_that_is_held_altogether_is_refused():
    joint = Bolt("b", "bolts", ("a", GROUND), np.zeros((2, 3)), rigid=MOTIONS)
    with pytest.raises(VehicleError, match="the rigid connections hold everything"):
        assemble(Vehicle("held", (block("a"),), (joint,)))


def test_an_unknown_motion_is_named():
    with pytest.raises(VehicleError, match=r"rigid: unknown motion 'up'.*x, y, z, rx, ry, rz"):
        Bolt("b", "bolts", ("a", "c"), np.zeros((2, 3)), rigid=("up",))
