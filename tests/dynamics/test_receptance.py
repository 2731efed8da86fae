from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from builtin_truck import builtin_truck
from differences import row_error
from full_solutions import receptances
from mounted_cabin import mounted_cabin
from oracles import Beam
from rounding import CABIN, assert_near
from small_systems import block, damper, mass_on_a_string, spring

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.receptance import receptance_lines
from modeviz.errors import SolveError
from modeviz.vehicle.bodies import AddedMass, RigidBody
from modeviz.vehicle.connections import GROUND, Bolt, Spring
from modeviz.vehicle.vehicle import Vehicle


def dense(system, frequency_hz, rows):
    """G from the full matrices, one direct solve a frequency."""
    K = system.stiffness + 1j * system.structural_damping
    omegas = 2 * np.pi * np.asarray(frequency_hz)
    Z = [K + 1j * w * system.damping - w**2 * system.mass for w in omegas]
    return np.array([rows @ np.linalg.solve(z, rows.T.astype(complex)) for z in Z])


def read_rows(system):
    """Mounts, response points and tyres: what the live solver asks for."""
    vehicle = system.vehicle
    points = [system.motion(p.body, p.position)[:3] for p in vehicle.response_points]
    tyres = [system.relative_motion(t)[:3] for t in vehicle.tyres]
    return np.vstack([system.mount_motions, *points, *tyres])


@pytest.fixture(scope="module")
def truck():
    system = assemble(builtin_truck())
    groups = system.vehicle.mount_groups
    return system.with_rates({g.name: g.bounds[0] for g in groups})


# Both ways lose to rounding what the softest motion is above the stiffest joint: 1e-12 on the truck.
def test_truck_equals_the_direct_solve(truck):
    f = np.array([0.1, 0.7, 5.0, 11.7, 20.0, 40.0])
    P = read_rows(truck)
    assert row_error(receptances(truck, f, P), dense(truck, f, P)) < 1e-10


def test_no_line_of_the_truck_is_taken_for_a_resonance(truck):
    P = truck.motion("cab", truck.vehicle.response_points[0].position)[:3]
    assert np.isfinite(receptances(truck, np.arange(1, 401) / 10, P)).all()


def test_mounted_cabin_equals_the_direct_solve():
    system = assemble(mounted_cabin())
    f = np.array([0.05, 1.0, 8.0, 60.0])
    assert row_error(receptances(system, f, np.eye(12)), dense(system, f, np.eye(12))) < 1e-11


def chain(k_lower, k_upper, c=0.0):
    """Two masses one above the other, of which only z is read."""
    bodies = mass_on_a_string("low", 2.0), mass_on_a_string("high", 3.0)
    joints = (
        spring(("low", GROUND), k_lower),
        spring(("low", "high"), k_upper, loss_factor=0.1 * (c > 0)),
        damper(("low", "high"), c),
    )
    return assemble(Vehicle("chain", bodies, joints)), np.eye(12)[[2, 8]]


def chain_by_hand(omega, k_lower, k_upper, c=0.0):
    z = k_upper * (1 + 0.1j * (c > 0)) + 1j * omega * c
    low, high = k_lower - 2.0 * omega**2, -3.0 * omega**2
    # The determinant is low high + z (low + high), so a stiff joint takes no digits from it.
    return np.array([[z + high, z], [z, z + low]]) / (low * high + z * (low + high))


@pytest.mark.parametrize("k_upper", [1e-6, 500.0, 1e12])
def test_chain_of_two_masses_follows_the_textbook_from_loose_to_rigid(k_upper):
    system, P = chain(800.0, k_upper, c=5.0)
    G = receptances(system, np.array([0.5, 2.7, 15.0]), P)
    expected = [chain_by_hand(w, 800.0, k_upper, 5.0) for w in 2 * np.pi * np.array([0.5, 2.7, 15.0])]
    assert row_error(G, np.array(expected)) < 1e-11


def test_blocks_bolted_more_often_than_needed_are_one_block():
    low, high = block("low", 10.0, at=(0, 0, -0.1)), block("high", 10.0, at=(0, 0, 0.1))
    offset = 20.0 * 0.1**2 * np.diag([1, 1, 0])
    both = RigidBody("low", "linkage", "low", 20.0, np.zeros(3), 2 * low.inertia + offset)
    corners = [np.array([x, y, 0.0]) for x in (-0.2, 0.2) for y in (-0.3, 0.3)]
    feet = tuple(
        Spring(f"foot {i}", "feet", ("low", GROUND), np.tile(at, (2, 1)), np.full(3, 2e5))
        for i, at in enumerate(corners)
    )
    bolts = tuple(
        Bolt(f"bolt {i}", "bolts", ("low", "high"), np.tile(at, (2, 1)), np.full(3, 1e12))
        for i, at in enumerate(corners)
    )
    joined, one = (
        assemble(Vehicle("blocks", bodies, joints))
        for bodies, joints in (((low, high), feet + bolts), ((both,), feet))
    )
    f = np.array([1.0, 10.0, 30.0])
    P, Q = (s.motion("low", np.array([0.1, 0.2, 0.3])) for s in (joined, one))
    # A joint gives way by ω²m/k, here 1e-7 at most.
    assert row_error(receptances(joined, f, P), receptances(one, f, Q)) < 1e-6


def beam_on_a_foot(**changes):
    ends = np.zeros((2, 3))
    foot = Spring("foot", "feet", ("beam", GROUND), ends, np.full(3, 5e4), np.full(3, 1e3))
    return Vehicle("beam", (Beam(8).body("beam"),), (foot,), **changes)


def test_mass_on_an_elastic_body_is_as_if_in_its_finite_elements():
    beam, at = Beam(8), np.array([1.5, 0, 0])
    system = assemble(beam_on_a_foot(added_masses=(AddedMass("load", "beam", at, 7.0),)))
    f = np.array([0.5, 6.0, 21.0])
    G = receptances(system, f, system.motion("beam", at))
    beam.stiffness[:6, :6] += np.diag([5e4] * 3 + [1e3] * 3)
    beam.mass[36:39, 36:39] += 7.0 * np.eye(3)
    Z = [beam.stiffness - (2 * np.pi * x) ** 2 * beam.mass for x in f]
    expected = np.array([np.linalg.inv(z)[36:42, 36:42] for z in Z])
    # The body's modes come from an eigensolve that rounds 1e-16 of the stiffest, 1e9 (rad/s)².
    assert row_error(G, expected) < 1e-7


@pytest.mark.parametrize("beside", [0.0, 1e-12, 1e-8, 3e-5, 3e-4])
def test_an_undamped_body_that_resonates_by_itself_is_no_resonance_of_the_whole(beside):
    system = assemble(beam_on_a_foot())
    f = system.vehicle.body("beam").natural_frequency_hz[[6, 8, 9]] * (1 + beside)
    P = system.motion("beam", np.array([1.5, 0, 0]))
    assert row_error(receptances(system, f, P), dense(system, f, P)) < 1e-9


def test_connections_without_rates_change_nothing():
    vehicle = mounted_cabin()
    at = np.array([[1.0, 0, 0.7], [1.0, 0, 0.7]])
    loose = Spring("loose", "loose", ("cab", "chassis"), at)
    with_loose = replace(vehicle, connections=(*vehicle.connections, loose))
    f = np.array([1.0, 12.0])
    found, expected = (receptances(assemble(v), f, np.eye(12)) for v in (with_loose, vehicle))
    assert_near(found, expected, CABIN)


def test_a_free_body_moves_by_its_mass_and_inertia():
    system = assemble(Vehicle("free", (block("a", 10.0),), ()))
    G = receptances(system, np.array([3.0]), np.eye(6))[0]
    expected = np.diag(-1 / (6 * np.pi) ** 2 / np.array([10, 10, 10, 1, 2, 3.0]))
    np.testing.assert_allclose(G, expected, rtol=1e-14)


def test_receptances_are_reciprocal(truck):
    G = receptances(truck, np.array([0.1, 9.3, 40.0]), read_rows(truck))
    assert row_error(G, G.transpose(0, 2, 1)) < 1e-10


def test_progress_rises_to_one():
    told = []
    list(receptance_lines(assemble(mounted_cabin()), np.arange(1.0, 9.0), np.eye(12), told.append))
    assert told == [i / 8 for i in range(1, 9)]


def resonances(k_lower, k_upper):
    K = np.array([[k_lower + k_upper, -k_upper], [-k_upper, k_upper]])
    return np.sqrt(scipy.linalg.eigh(K, np.diag([2.0, 3.0]), eigvals_only=True)) / (2 * np.pi)


@pytest.mark.parametrize("mode", [0, 1])
@pytest.mark.parametrize("beside", [0.0, 1e-15, 1e-12, 1e-10, 1e-8])
def test_an_undamped_resonance_on_a_line_is_an_error(mode, beside):
    system, P = chain(800.0, 500.0)
    f = resonances(800.0, 500.0)[mode] * (1 + beside)
    with pytest.raises(SolveError, match=rf"at {f} Hz.*damping"):
        receptances(system, np.array([0.1, f]), P)


@pytest.mark.parametrize("beside", [0.0, 1e-15, 1e-12, 1e-10])
def test_one_mass_on_a_spring_resonates_too(beside):
    k = (2 * np.pi * 2.0) ** 2 * (1 + beside)
    bodies, joints = (mass_on_a_string("m", 1.0),), (spring(("m", GROUND), k),)
    with pytest.raises(SolveError, match=r"at 2\.0 Hz"):
        receptances(assemble(Vehicle("m", bodies, joints)), np.array([2.0]), np.eye(6)[2:3])


@pytest.mark.parametrize("mode", [0, 1])
def test_a_line_a_thousandth_beside_an_undamped_resonance_is_right(mode):
    system, P = chain(800.0, 500.0)
    f = resonances(800.0, 500.0)[mode] * np.array([0.999, 1.001])
    expected = np.array([chain_by_hand(w, 800.0, 500.0) for w in 2 * np.pi * f])
    assert row_error(receptances(system, f, P), expected) < 1e-9


def test_an_undamped_resonance_that_no_row_sees_does_no_harm():
    system, P = chain(800.0, 500.0)
    f = resonances(800.0, 500.0)[1:]
    K = system.stiffness[np.ix_([2, 8], [2, 8])]
    shape = scipy.linalg.eigh(K, np.diag([2.0, 3.0]))[1][:, 0]
    unseeing = (shape * [2.0, 3.0]) @ P
    omega = 2 * np.pi * resonances(800.0, 500.0)
    expected = 1 / (omega[0] ** 2 - omega[1] ** 2)
    G = receptances(system, f, unseeing[None])
    assert G[0, 0, 0] == pytest.approx(expected, rel=1e-9)


def test_frequencies_are_checked():
    with pytest.raises(SolveError, match="0 Hz at place 1"):
        receptances(assemble(mounted_cabin()), np.array([0.0, 1.0]), np.eye(12))
