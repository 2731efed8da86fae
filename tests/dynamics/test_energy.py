import numpy as np
import pytest
from mounted_cabin import SOFT, mounted_cabin, twisted_cabin
from oracles import Beam
from small_systems import mass_on_a_string, spring

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.energy import kinetic_energy, strain_energy
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.vehicle.bodies import AddedMass
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.vehicle import Vehicle


def test_two_masses_share_kinetic_energy_inversely_to_their_mass():
    # Momentum is zero, so v ∝ 1/m and the energy of each is as 1/m.
    bodies = mass_on_a_string("light", 1.0), mass_on_a_string("heavy", 4.0)
    system = assemble(Vehicle("pair", bodies, (spring(("light", "heavy"), 100.0),)))
    stretch = solve_modes(system).shapes[:, -1:]
    energy = kinetic_energy(system, stretch)
    assert energy["light"][0] == pytest.approx(0.8)
    assert energy["heavy"][0] == pytest.approx(0.2)
    assert strain_energy(system, stretch)["springs"][0] == pytest.approx(1.0)


def test_an_added_mass_counts_with_the_body_that_carries_it():
    bodies = mass_on_a_string("a", 3.0), mass_on_a_string("b", 5.0)
    load = AddedMass("load", "a", np.array([0, 0.5, 0]) + bodies[0].center_of_gravity, 2.0)
    system = assemble(Vehicle("pair", bodies, (), added_masses=(load,)))
    shape = np.zeros((12, 1))
    shape[[2, 3, 8], 0] = 1.0, 4.0, 1.0  # a goes up at 1 m/s and rolls at 4 rad/s: its load at 3 m/s
    a = 3.0 * 1.0**2 + bodies[0].inertia[0, 0] * 4.0**2 + 2.0 * 3.0**2
    assert kinetic_energy(system, shape)["a"][0] == pytest.approx(a / (a + 5.0))


def test_shares_of_a_beam_on_springs_sum_to_one_and_move_with_the_stiffness():
    beam = Beam(8)

    def shares(k):
        feet = tuple(
            Spring(
                f"foot {i}", "feet", ("beam", "ground"), np.tile(beam.nodes[i], (2, 1)), np.full(3, k)
            )
            for i in (0, 8)
        )
        system = assemble(Vehicle("beam", (beam.body("beam"),), feet))
        shapes = solve_modes(system, 12).shapes[:, 1:]  # the first spins about the beam's axis
        assert sum(kinetic_energy(system, shapes).values()) == pytest.approx(np.ones(11))
        strain = strain_energy(system, shapes)
        assert sum(strain.values()) == pytest.approx(np.ones(11))
        return strain["feet"][0]

    assert shares(1e2) > 0.99
    assert shares(1e9) < 0.01


def test_strain_energy_over_kinetic_is_rayleighs_quotient():
    bodies = mass_on_a_string("a", 1.0), mass_on_a_string("b", 2.0)
    links = spring(("a", "ground"), 400.0), spring(("a", "b"), 300.0)
    system = assemble(Vehicle("chain", bodies, links))
    shape = np.zeros((12, 1))
    shape[[2, 8], 0] = np.array([1.0, 3.0]) / np.sqrt(19.0)
    share = strain_energy(system, shape)["springs"]
    assert share[0] == pytest.approx(1.0)
    assert kinetic_energy(system, shape)["b"][0] == pytest.approx(18 / 19)


def test_what_moves_freely_has_no_strain_energy():
    system = assemble(Vehicle("free", (Beam(4).body("beam"),), ()))
    strain = strain_energy(system, solve_modes(system, 8).shapes)["beam"]
    np.testing.assert_array_equal(strain[:6], 0.0)
    np.testing.assert_allclose(strain[6:], 1.0)


@pytest.mark.parametrize("vehicle", [mounted_cabin(), twisted_cabin()], ids=["cabin", "twisted"])
def test_other_mount_rates_give_the_shares_of_the_vehicle_that_has_them(vehicle):
    system = assemble(vehicle)
    softer = system.with_rates({"A": SOFT})
    shapes = solve_modes(softer).shapes
    expected = strain_energy(softer, shapes)
    found = strain_energy(system, shapes, mount_stiffness(softer.vehicle).real[:, None])
    assert list(found) == ["A", "B", "tyres"]
    for group in found:
        np.testing.assert_allclose(found[group], expected[group], rtol=1e-12)
    assert np.abs(strain_energy(system, shapes)["A"] - expected["A"]).max() > 0.1


def test_groups_share_a_common_stretch_in_proportion_to_their_rates():
    system = assemble(mounted_cabin().with_rates({"A": SOFT}))
    shape = np.zeros((12, 1))
    shape[2] = 1.0  # the cab goes straight up, the chassis stays
    strain = strain_energy(system, shape)
    assert strain["A"][0] == pytest.approx(SOFT.vertical / (SOFT.vertical + 8e5))
    assert strain["tyres"][0] == 0.0


def test_complex_shape_has_the_energies_of_its_two_parts():
    system = assemble(mounted_cabin())
    both = solve_modes(system).shapes[:, [7, 9]] * [1.0, 1.0]
    for energy in (kinetic_energy, strain_energy):
        shares = energy(system, both[:, :1] + 1j * both[:, 1:])
        # of orthogonal parts the energies add: unit modal masses, and stiffnesses ω²
        weights = solve_modes(system).frequency_hz[[7, 9]] ** (0 if energy is kinetic_energy else 2)
        for name, (one, other) in energy(system, both).items():
            assert shares[name][0] == pytest.approx(np.average([one, other], weights=weights))


def test_kinetic_and_strain_shares_of_one_mode_are_those_among_many():
    system = assemble(mounted_cabin())
    shapes = solve_modes(system).shapes
    for energy in (kinetic_energy, strain_energy):
        many, one = energy(system, shapes), energy(system, shapes[:, 7:8])
        assert {n: e[0] for n, e in one.items()} == pytest.approx({n: e[7] for n, e in many.items()})
