import numpy as np
import pytest
import scipy.linalg
from mounted_cabin import twisted_cabin
from oracles import Beam, direct_system
from small_systems import block, joined_beams

from modeviz.dynamics.assembly import assemble
from modeviz.errors import VehicleError
from modeviz.vehicle.bodies import AddedMass
from modeviz.vehicle.connections import Damper, Mount, Spring, Tyre
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle


def frequencies(mass, stiffness):
    return np.sqrt(np.maximum(scipy.linalg.eigh(stiffness, mass, eigvals_only=True), 0)) / 2 / np.pi


def test_substructures_with_all_modes_equal_the_directly_assembled_system():
    beams, vehicle = joined_beams()
    system = assemble(vehicle)
    direct = frequencies(*direct_system(beams, vehicle))
    np.testing.assert_allclose(frequencies(system.mass, system.stiffness), direct, rtol=1e-7, atol=1e-5)


def test_residual_vectors_make_the_static_deflection_at_a_connection_exact():
    load, far = (8, 2), (4, 2)
    beams, vehicle = joined_beams(
        10, loads=([*((8, d) for d in range(6)), *((2, d) for d in range(6)), far],
                   [*((0, d) for d in range(6)), *((5, d) for d in range(6))])
    )  # fmt: skip
    mass, stiffness = direct_system(beams, vehicle)
    force = np.zeros(len(mass))
    force[6 * load[0] + load[1]] = 1.0
    deflection = np.linalg.solve(stiffness, force)[6 * far[0] + far[1]]

    system = assemble(vehicle)
    push = system.motion("front", beams["front"].nodes[load[0]])[load[1]]
    read = system.motion("front", beams["front"].nodes[far[0]])[far[1]]
    assert read @ np.linalg.solve(system.stiffness, push) == pytest.approx(deflection, rel=1e-7)

    truncated = assemble(joined_beams(10)[1])
    push = truncated.motion("front", beams["front"].nodes[load[0]])[load[1]]
    read = truncated.motion("front", beams["front"].nodes[far[0]])[far[1]]
    without = read @ np.linalg.solve(truncated.stiffness, push)
    assert without != pytest.approx(deflection, rel=1e-3)


def test_internal_springs_do_not_resist_a_rigid_motion():
    _, vehicle = joined_beams()
    system = assemble(Vehicle("free", vehicle.bodies, vehicle.connections[:1]))
    assert np.allclose(system.stiffness, system.stiffness.T)
    rigid = np.zeros((system.n_dofs, 6))
    for body in vehicle.bodies:
        at = body.attachments[0]
        turn = np.eye(6)
        x, y, z = at.position
        turn[:3, 3:] = [[0, z, -y], [-z, 0, x], [y, -x, 0]]
        start = system.dofs[body.name].start
        rigid[start : start + 6] = np.linalg.solve(at.shapes[:, :6], turn)
    assert np.abs(system.stiffness @ rigid).max() < 1e-9 * np.abs(system.stiffness).max()


def test_a_point_of_a_rigid_body_moves_with_its_rotation():
    system = assemble(Vehicle("one", (block("a", at=(1.0, 0, 0)),), ()))
    motion = system.motion("a", np.array([1.0, 2.0, 0.5]))
    small = 1e-3
    np.testing.assert_allclose(motion @ [0, 0, 0, small, 0, 0], [0, -0.5e-3, 2e-3, small, 0, 0])
    np.testing.assert_allclose(motion @ [0, 0, 0, 0, 0, small], [-2e-3, 0, 0, 0, 0, small])


def test_added_mass_counts_at_its_own_place():
    vehicle = Vehicle(
        "one", (block("a"),), (), added_masses=(AddedMass("load", "a", np.array([0, 0, 0.5]), 4.0),)
    )
    M = assemble(vehicle).mass
    assert M[0, 0] == M[2, 2] == 14.0
    assert M[4, 4] == pytest.approx(2.0 + 4.0 * 0.25)
    assert M[0, 4] == pytest.approx(4.0 * 0.5)


def test_local_axes_turn_a_springs_stiffness():
    s = np.sqrt(0.5)
    turned = Spring(
        "s", "s", ("a", "ground"), np.zeros((2, 3)), stiffness=np.array([100.0, 0, 0]),
        axes=np.array([[s, 0, s], [0, 1, 0], [-s, 0, s]]),
    )  # fmt: skip
    K = assemble(Vehicle("one", (block("a"),), (turned,))).stiffness
    np.testing.assert_allclose(K[:3, :3], [[50, 0, 50], [0, 0, 0], [50, 0, 50]], atol=1e-12)


def test_damping_is_kept_apart_by_kind():
    beam = Beam(4).body("beam", damping_ratio=0.02)
    foot = np.array([[0.0, 0, 0], [0, 0, 0]])
    vehicle = Vehicle(
        "damped",
        (beam,),
        (
            Damper("shock", "shocks", ("beam", "ground"), foot, damping=np.array([0, 0, 70.0])),
            Tyre("tyre", "tyres", ("beam", "ground"), foot, np.array([0, 0, 5e4]), loss_factor=0.1),
        ),
    )
    system = assemble(vehicle)
    row = system.motion("beam", foot[0])[2]
    omega = np.sqrt(beam.omega_n_squared)
    np.testing.assert_allclose(
        system.damping, np.diag(0.04 * omega) + 70 * np.outer(row, row), atol=1e-9
    )
    np.testing.assert_allclose(system.structural_damping, 5e3 * np.outer(row, row), atol=1e-9)


def test_coordinates_have_names():
    beam = Beam(2).body("beam", n_modes=8, loads=[(0, 2)])
    names = assemble(Vehicle("named", (beam, block("a")), ())).dof_names
    assert names[7:10] == ("beam mode 8", "beam residual 1", "a x")
    assert len(names) == 15


def vehicle_on_mounts(rates):
    mounts = tuple(
        Mount(f"M {x}", "", ("front", "ground"), np.tile([x, 0, 0.0], (2, 1))) for x in (0.0, 2.0)
    )
    limits = MountRates(1.0, 1.0, 1.0), MountRates(1e9, 1e9, 1e9)
    group = MountGroup("M", "feet", MountRates(*rates), 0.1, limits, mounts)
    return Vehicle("on mounts", (Beam(8, 2.0).body("front"),), (), (group,))


def test_other_rates_give_what_assembling_anew_gives():
    tuned = assemble(vehicle_on_mounts((3e4, 2e4, 1e4))).with_rates({"M": MountRates(5e4, 1e3, 0.0)})
    anew = assemble(vehicle_on_mounts((5e4, 1e3, 0.0)))
    scale = np.abs(anew.stiffness).max()
    np.testing.assert_allclose(tuned.stiffness, anew.stiffness, atol=1e-12 * scale)
    np.testing.assert_allclose(tuned.structural_damping, anew.structural_damping, atol=1e-9)
    assert tuned.vehicle.rates["M"].vertical == 5e4


def test_another_loss_factor_gives_what_assembling_anew_gives():
    """Of springs along and about the axes of mounts."""
    rates = {"A": MountRates(2e5, 1e5, 1e5, loss_factor=0.4)}
    tuned, anew = (
        assemble(twisted_cabin()).with_rates(rates),
        assemble(twisted_cabin().with_rates(rates)),
    )
    scale = np.abs(anew.structural_damping).max()
    np.testing.assert_allclose(tuned.structural_damping, anew.structural_damping, atol=1e-12 * scale)
    np.testing.assert_allclose(
        tuned.stiffness, anew.stiffness, atol=1e-12 * np.abs(anew.stiffness).max()
    )


def test_rates_of_a_group_that_is_not_there_are_an_error():
    with pytest.raises(VehicleError, match=r"unknown mount group 'N'.*there are M"):
        assemble(vehicle_on_mounts((3e4, 2e4, 1e4))).with_rates({"N": MountRates(1, 1, 1)})
