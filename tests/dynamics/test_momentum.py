"""What joins bodies keeps momentum: it resists no motion of the whole and pulls both bodies alike."""

from dataclasses import replace

import numpy as np
import pytest
from oracles import Beam, direct_system

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.vehicle.bodies import Attachment, FlexibleBody, RigidBody
from modeviz.vehicle.connections import GROUND, Bolt, Connection, Damper, Mount, Rod, Spring, Tyre
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle

EPS = np.finfo(float).eps


def random_turn(rng):
    Q, R = np.linalg.qr(rng.normal(size=(3, 3)))
    return Q * np.sign(np.diag(R))


def random_rigid_body(rng, name):
    """And its coordinates (6, 6) in the six motions of the whole about the origin."""
    center = rng.uniform(-2, 2, 3)
    # Of points all around: no inertia that a body cannot have.
    points = rng.normal(size=(8, 3))
    inertia = sum(np.dot(p, p) * np.eye(3) - np.outer(p, p) for p in points)
    body = RigidBody(name, "linkage", name, rng.uniform(1, 500), center, inertia)
    return body, rigid_motions(center)


def random_flexible_body(rng, name):
    """Its rigid modes are motions of the whole, mixed at random; its elastic ones are anything."""
    n_elastic, center = rng.integers(0, 9), rng.uniform(-2, 2, 3)
    places = center + rng.uniform(-1, 1, (rng.integers(1, 6), 3))
    mixed = random_turn(rng), random_turn(rng)
    rigid_modes = np.kron(np.diag([0.1, 0.0]), mixed[0]) + np.kron(np.diag([0.0, 0.2]), mixed[1])
    attachments = tuple(
        Attachment(
            f"at {i}",
            place,
            np.hstack(
                [rigid_motions(place - center) @ rigid_modes, 0.1 * rng.normal(size=(6, n_elastic))]
            ),
        )
        for i, place in enumerate(places)
    )
    squares = np.r_[np.zeros(6), rng.uniform(1e3, 1e6, n_elastic)]
    no_nodes = np.zeros((0, 3)), np.zeros((0, 6, 6 + n_elastic))
    body = FlexibleBody(name, "frame", name, squares, 0, 0.03, attachments, *no_nodes)
    whole = np.linalg.solve(rigid_modes, rigid_motions(center))
    return body, np.vstack([whole, np.zeros((n_elastic, 6))])


def random_end(rng, body):
    """Near an attachment of a flexible body, anywhere about a rigid one."""
    if isinstance(body, FlexibleBody):
        at = body.attachments[rng.integers(len(body.attachments))].position
        return at + rng.uniform(-0.05, 0.05, 3)
    return body.center_of_gravity + rng.uniform(-1, 1, 3)


def random_connection(rng, bodies, i):
    kind = (Spring, Bolt, Damper, Mount, Rod)[rng.integers(5)]
    pair = rng.choice(len(bodies), 2, replace=False)
    ends = np.array([random_end(rng, bodies[j]) for j in pair])
    names = bodies[pair[0]].name, bodies[pair[1]].name
    if kind is Rod:
        rates = 10 ** rng.uniform(3, 8), 10 ** rng.uniform(1, 4), rng.uniform(0, 0.5)
        return Rod.between(f"rod {i}", "rods", names, ends, *rates)
    present = rng.integers(0, 2, (3, 3))
    return kind(
        f"{kind.__name__} {i}",
        kind.__name__,
        names,
        ends,
        stiffness=present[0] * 10 ** rng.uniform(3, 8, 3),
        rotational_stiffness=present[1] * 10 ** rng.uniform(0, 5, 3),
        damping=present[2] * 10 ** rng.uniform(1, 4, 3),
        loss_factor=rng.uniform(0, 0.5),
        axes=random_turn(rng),
        elastic_center=rng.choice([0.0, 0.5, 1.0, rng.uniform()]),
    )


def random_vehicle(seed):
    """Free: no ground, no tyres. And its coordinates (n_dofs, 6) in the six motions of the whole."""
    rng = np.random.default_rng(seed)
    makers = rng.choice([random_rigid_body, random_flexible_body], rng.integers(2, 5))
    bodies, whole = zip(*(make(rng, f"body {i}") for i, make in enumerate(makers)), strict=True)
    joints = [random_connection(rng, bodies, i) for i in range(rng.integers(1, 9))]
    mounts = tuple(joint for joint in joints if isinstance(joint, Mount))
    rates = [MountRates(*(10 ** rng.uniform(e, e + 1, 3))) for e in (5.0, 3.0, 7.0)]
    groups = (MountGroup("G", "mounts", rates[0], 0.2, (rates[1], rates[2]), mounts),) if mounts else ()
    fixed = tuple(joint for joint in joints if not isinstance(joint, Mount))
    return Vehicle(f"random {seed}", bodies, fixed, groups), np.vstack(whole)


def rounding(rows, rates, motion):
    """What rounding may leave of RᵀkR r, where the rows are sums of products of arms, shapes and axes
    themselves (N. J. Higham, "Accuracy and Stability of Numerical Algorithms", section 3.5)."""
    norm = np.linalg.norm
    return 100 * EPS * norm(rows) ** 2 * max(rates.max(), 1.0) * norm(motion)


@pytest.mark.parametrize("seed", range(200))
def test_nothing_in_a_free_vehicle_resists_a_motion_of_the_whole(seed):
    vehicle, whole = random_vehicle(seed)
    system = assemble(vehicle)
    rates = np.concatenate([[1.0], system.connection_stiffness])
    dampers = np.concatenate([c.damping for c in vehicle.all_connections])
    stiff, damped = (rounding(system.connection_motions, r, whole) for r in (rates, dampers))
    assert np.abs(system.stiffness @ whole).max() <= stiff
    assert np.abs(system.structural_damping @ whole).max() <= stiff
    assert np.abs(system.damping @ whole).max() <= damped
    # Not because nothing is joined at all.
    assert np.linalg.norm(system.connection_motions) > 0.1


@pytest.mark.parametrize("seed", range(200))
def test_a_connection_pulls_its_two_bodies_with_opposite_forces_and_moments(seed):
    vehicle, whole = random_vehicle(seed)
    system = assemble(vehicle)
    motion = np.random.default_rng(seed).normal(size=system.n_dofs)
    for connection in vehicle.all_connections:
        rows = system.relative_motion(connection)
        k = np.concatenate([connection.stiffness, connection.rotational_stiffness])
        force = -rows.T @ (k * (rows @ motion))
        # Force and moment about the origin: the work per unit of each motion of the whole.
        on = [whole[own].T @ force[own] for own in map(system.dofs.get, connection.bodies)]
        np.testing.assert_allclose(
            on[0], -on[1], atol=rounding(rows, k, whole) * np.linalg.norm(motion)
        )
        assert k.max() == 0 or np.linalg.norm(on[0]) > 0


MOUNT_CORNERS = [(x, y) for x in (-0.5, 0.5) for y in (-0.4, 0.4)]
GAP = 0.3
RATES = MountRates(vertical=1.1e6, lateral=6e5, fore_aft=4e5)


def two_on_four_mounts(elastic_center=0.5, gap=GAP):
    """A body above another, on mounts whose ends lie a gap apart in height, alike left and right."""
    inertia = np.diag([20.0, 30.0, 40.0])
    above, below = (
        RigidBody(name, "linkage", name, mass, np.array([0.0, 0, z]), inertia)
        for name, mass, z in (("above", 100.0, 0.7), ("below", 150.0, -0.2))
    )
    mounts = tuple(
        Mount(
            f"M {x} {y}", "M", ("above", "below"), np.array([[x, y, gap], [x, y, 0]]),
            elastic_center=elastic_center,
        )
        for x, y in MOUNT_CORNERS
    )  # fmt: skip
    bounds = MountRates(1.0, 1.0, 1.0), MountRates(1e9, 1e9, 1e9)
    return Vehicle("two", (above, below), (), (MountGroup("M", "mounts", RATES, 0.1, bounds, mounts),))


def test_turning_everything_about_x_stores_nothing():
    """Along fixed axes between ends 0.3 m apart it would store 4 · 6e5 · 0.3² N m."""
    system = assemble(two_on_four_mounts())
    roll = np.concatenate([rigid_motions(b.center_of_gravity)[:, 3] for b in system.vehicle.bodies])
    along_fixed_axes = 4 * 6e5 * 0.3**2
    assert along_fixed_axes == pytest.approx(216_000)
    assert abs(roll @ system.stiffness @ roll) < 1e-12 * along_fixed_axes


@pytest.mark.parametrize("elastic_center", [0.0, 0.25, 0.5, 1.0])
def test_two_bodies_rock_at_the_frequencies_of_their_reduced_motion(elastic_center):
    """Two free bodies move relative to each other as one with an effective mass there.

    In roll that has two freedoms, how far (y) and how much (rx) the bodies part there; its mass is the
    inverse of J₁ + J₂, with J = TM⁻¹Tᵀ each body's mobility at that place.
    """
    vehicle = two_on_four_mounts(elastic_center)
    z = GAP * (1 - elastic_center)
    mobility = np.zeros((2, 2))
    for body in vehicle.bodies:
        assert isinstance(body, RigidBody)
        T = np.array([[1.0, -(z - body.center_of_gravity[2])], [0.0, 1.0]])
        mobility += T @ np.diag([1 / body.mass, 1 / body.inertia[0, 0]]) @ T.T
    stiffness = np.diag([4 * RATES.lateral, sum(RATES.vertical * y**2 for _, y in MOUNT_CORNERS)])
    expected = np.sqrt(np.sort(np.linalg.eigvals(mobility @ stiffness).real)) / (2 * np.pi)
    found = solve_modes(assemble(vehicle)).frequency_hz
    assert np.count_nonzero(found < 1e-3) == 6
    for f in expected:
        assert np.abs(found / f - 1).min() < 1e-10


def test_on_rigid_bodies_a_gap_is_the_same_as_none_at_the_elastic_centre():
    apart = two_on_four_mounts(0.3)
    (group,) = apart.mount_groups
    met = tuple(replace(m, points=np.stack([m.center, m.center])) for m in group.mounts)
    together = replace(apart, mount_groups=(replace(group, mounts=met),))
    found, expected = assemble(apart), assemble(together)
    scale = np.abs(expected.stiffness).max()
    np.testing.assert_allclose(found.stiffness, expected.stiffness, atol=1e-14 * scale)
    np.testing.assert_allclose(
        found.structural_damping, expected.structural_damping, atol=1e-14 * scale
    )


def test_beams_joined_across_a_gap_are_as_the_directly_assembled_system():
    beams = {"upper": Beam(6, 1.5, start=(0.0, 0.1, 0.4)), "lower": Beam(5, 1.5)}
    bodies = tuple(beam.body(name) for name, beam in beams.items())
    nodes = [(1, 1), (5, 4)]
    axes = random_turn(np.random.default_rng(3))
    joints = tuple(
        Spring(
            f"link {i}", "links", ("upper", "lower"),
            np.array([beams["upper"].nodes[i], beams["lower"].nodes[j]]),
            np.array([3e5, 2e5, 1e5]), np.array([4e3, 5e3, 6e3]), axes=axes, elastic_center=0.2,
        )
        for i, j in nodes
    )  # fmt: skip
    vehicle = Vehicle("two beams", bodies, joints)
    mass, stiffness = direct_system(beams, vehicle)
    # L⁻¹KL⁻ᵀ of the direct system has its squares, six of them zero.
    direct = np.sort(np.linalg.eigvals(np.linalg.solve(mass, stiffness)).real)
    found = solve_modes(assemble(vehicle)).omega_n_squared
    np.testing.assert_allclose(found[6:20], direct[6:20], rtol=1e-6)
    assert np.abs(direct[:6]).max() < 1e-6 * direct[6]


def test_the_ground_end_does_not_move_and_pushes_at_the_elastic_centre():
    body = RigidBody("a", "linkage", "a", 10.0, np.zeros(3), np.eye(3))
    ends = np.array([[0.0, 0.0, -0.2], [0.0, 0.0, -0.6]])
    link = Spring("s", "s", ("a", GROUND), ends, stiffness=np.array([0.0, 5e4, 0.0]))
    stiffness = assemble(Vehicle("one", (body,), (link,))).stiffness
    # Pushed sideways at z = -0.4 the body moves by y + 0.4 rx there.
    np.testing.assert_allclose(
        stiffness[np.ix_([1, 3], [1, 3])], 5e4 * np.array([[1, 0.4], [0.4, 0.16]])
    )


def test_a_tyre_pushes_at_its_patch():
    body = RigidBody("wheel", "unsprung", "wheel", 40.0, np.array([0.0, 0.8, 0.35]), np.eye(3))
    ends = np.array([[0.0, 0.8, 0.35], [0.0, 0.8, 0.0]])
    rates = np.array([0.0, 1e5, 0.0])
    at_patch, midway = (
        Tyre("t", "tyres", ("wheel", GROUND), ends, rates, wheel_center=ends[0], **where)
        for where in ({}, {"elastic_center": 0.5})
    )
    assert at_patch.center.tolist() == [0.0, 0.8, 0.0]
    for tyre, arm in ((at_patch, 0.35), (midway, 0.175)):
        assert assemble(Vehicle("one", (body,), (tyre,))).stiffness[3, 3] == pytest.approx(1e5 * arm**2)


def test_two_masses_on_a_slanted_rod_vibrate_along_it():
    a, b = (
        RigidBody(n, "linkage", n, m, np.array(at), np.eye(3))
        for n, m, at in (("a", 3.0, (0.0, 0.0, 0.0)), ("b", 5.0, (1.0, 2.0, -2.0)))
    )
    ends = np.array([a.center_of_gravity, b.center_of_gravity])
    rod = Rod.between("rod", "rods", ("a", "b"), ends, 4e5, damping=30.0, loss_factor=0.1)
    system = assemble(Vehicle("two", (a, b), (rod,)))
    modes = solve_modes(system)
    assert modes.omega_n_squared[-1] == pytest.approx(4e5 * (1 / 3 + 1 / 5), rel=1e-12)
    assert np.abs(modes.omega_n_squared[:-1]).max() < 1e-9 * modes.omega_n_squared[-1]
    along = np.array([1.0, 2.0, -2.0]) / 3
    moved = modes.shapes[:3, -1]
    np.testing.assert_allclose(np.abs(moved @ along), np.linalg.norm(moved), rtol=1e-12)
    np.testing.assert_allclose(
        system.damping, 30.0 / 4e5 * system.stiffness, atol=1e-12 * system.damping.max()
    )
    np.testing.assert_allclose(
        system.structural_damping, 0.1 * system.stiffness, atol=1e-9 * system.stiffness.max()
    )


def test_where_a_rod_acts_along_its_line_does_not_matter():
    bodies = [random_rigid_body(np.random.default_rng(i), name)[0] for i, name in enumerate("ab")]
    ends = np.array([[0.3, 1.0, 0.2], [-0.4, 0.3, 0.5]])
    rod = Rod.between("rod", "rods", ("a", "b"), ends, 1e6)
    first, last = (
        assemble(Vehicle("two", tuple(bodies), (replace(rod, elastic_center=s),))).stiffness
        for s in (0.0, 1.0)
    )
    np.testing.assert_allclose(first, last, atol=1e-13 * first.max())


@pytest.mark.parametrize("elastic_center", [-0.01, 1.2, np.nan, np.inf])
def test_an_elastic_centre_beyond_the_ends_is_refused(elastic_center):
    with pytest.raises(VehicleError, match=r"'s': elastic_center: found .*, expected 0 .* to 1"):
        Connection("s", "s", ("a", "b"), np.eye(3)[:2], elastic_center=elastic_center)


def test_a_rod_whose_ends_meet_is_refused():
    with pytest.raises(VehicleError, match=r"rod 'r': found both ends at .*expected two places"):
        Rod.between("r", "rods", ("a", "b"), np.ones((2, 3)), 1e6)


@pytest.mark.parametrize("key", ["stiffness", "damping", "rotational_stiffness"])
def test_a_rod_with_rates_across_it_is_refused(key):
    with pytest.raises(VehicleError, match="rod 'r': found rates across the rod or about it"):
        Rod("r", "rods", ("a", "b"), np.eye(3)[:2], **{key: np.array([1.0, 1.0, 0.0])})


def test_a_rigid_rod_keeps_its_length_and_leaves_the_rest():
    a, b = (
        RigidBody(n, "linkage", n, 2.0, np.array(at), np.eye(3))
        for n, at in (("a", (0.0, 0.0, 0.0)), ("b", (0.0, 3.0, 4.0)))
    )
    ends = np.array([a.center_of_gravity, b.center_of_gravity])
    rod = Rod.between("rod", "rods", ("a", "b"), ends, rigid=True)
    modes = solve_modes(assemble(Vehicle("two", (a, b), (rod,))))
    assert modes.shapes.shape == (12, 11)
    stretch = (modes.shapes[6:9] - modes.shapes[:3]).T @ np.array([0.0, 0.6, 0.8])
    np.testing.assert_allclose(stretch, 0.0, atol=1e-12)
