import numpy as np
import pytest
from full_solutions import complex_modes
from oracles import Beam
from small_systems import damper, mass_on_a_string, oscillator, spring

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.errors import SolveError
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.vehicle import Vehicle


def test_two_free_masses_and_a_spring():
    m1, m2, k = 2.0, 3.0, 500.0
    bodies = mass_on_a_string("a", m1), mass_on_a_string("b", m2)
    modes = solve_modes(assemble(Vehicle("pair", bodies, (spring(("a", "b"), k),))))
    expected = np.sqrt(k * (1 / m1 + 1 / m2)) / (2 * np.pi)
    assert modes.frequency_hz[-1] == pytest.approx(expected, rel=1e-12)
    assert np.count_nonzero(modes.frequency_hz < 1e-6) == 11


def test_shapes_are_mass_normalised_and_solve_the_eigenproblem():
    system = assemble(Vehicle("beam", (Beam(6).body("beam"),), (spring(("beam", "ground"), 1e5),)))
    modes = solve_modes(system, 12)
    phi = modes.shapes
    np.testing.assert_allclose(phi.T @ system.mass @ phi, np.eye(12), atol=1e-9)
    np.testing.assert_allclose(
        phi.T @ system.stiffness @ phi, np.diag(modes.omega_n_squared), atol=1e-9 * 1e7
    )


def test_soft_mounts_leave_the_free_body_and_stiff_ones_hold_its_point():
    beam = Beam(8)
    body = beam.body("beam")
    place = np.tile(beam.nodes[0], (2, 1))

    def lowest(k):
        foot = Spring("foot", "feet", ("beam", "ground"), place, np.full(3, k), np.full(3, k))
        modes = solve_modes(assemble(Vehicle("beam", (body,), (foot,))))
        return modes.frequency_hz[modes.frequency_hz > 1.0]

    free = body.natural_frequency_hz[6:]
    np.testing.assert_allclose(lowest(1e-3)[:5], free[:5], rtol=1e-6)
    # Cantilever: βL = 1.8751, EI = 6e4 N m² about y, 20 kg/m, 2 m (beam theory).
    cantilever = 1.8751040687**2 / (2 * np.pi * 2.0**2) * np.sqrt(6e4 / 20.0)
    assert lowest(1e11)[0] == pytest.approx(cantilever, rel=1e-4)


@pytest.mark.parametrize("k", [1e12, 1e14])
def test_a_slow_mode_beside_a_stiff_one_is_right(k):
    """As long as it is found at all: rounding of ω² stays below (0.05 Hz)²."""
    bodies = mass_on_a_string("a", 2.0), mass_on_a_string("b", 3.0)
    system = assemble(Vehicle("pair", bodies, (spring(("a", "b"), k), spring(("b", "ground"), 500.0))))
    slow = solve_modes(system).frequency_hz[-2]
    assert slow**2 == pytest.approx(500.0 / 5.0 / (2 * np.pi) ** 2, abs=RESOLVED_HZ**2)


def test_a_spring_that_drowns_the_slow_modes_is_an_error():
    with pytest.raises(SolveError, match=r"'m z' .* rings at 1e\+09 Hz"):
        solve_modes(oscillator(k=1e20))


def test_damping_ratio_of_an_oscillator():
    viscous = solve_modes(oscillator(c=8.0))
    assert viscous.damping_ratio[-1] == pytest.approx(8.0 / (2 * np.sqrt(2.0 * 800.0)), rel=1e-12)
    structural = solve_modes(oscillator(loss_factor=0.1))
    assert structural.damping_ratio[-1] == pytest.approx(0.05, rel=1e-12)


@pytest.mark.parametrize("zeta", [0.01, 0.3, 0.9])
def test_damped_root_of_a_viscous_oscillator(zeta):
    omega = 20.0
    system = oscillator(c=2 * zeta * omega * 2.0)
    root, _ = complex_modes(system)
    assert root == pytest.approx([omega * (-zeta + 1j * np.sqrt(1 - zeta**2))], rel=1e-10)


def test_damped_root_of_a_structurally_damped_oscillator():
    system = oscillator(loss_factor=0.2)
    root, _ = complex_modes(system)
    assert root == pytest.approx([1j * 20.0 * np.sqrt(1 + 0.2j)], rel=1e-10)


def test_overdamped_motion_is_no_vibration():
    system = oscillator(c=2 * 1.5 * 20.0 * 2.0)
    assert len(complex_modes(system)[0]) == 0


def test_complex_modes_solve_the_quadratic_eigenproblem():
    bodies = mass_on_a_string("a", 1.0), mass_on_a_string("b", 2.0)
    chain = (
        spring(("a", "ground"), 400.0, 0.05),
        spring(("a", "b"), 300.0, 0.2),
        damper(("b", "ground"), 3.0),
    )
    system = assemble(Vehicle("chain", bodies, chain))
    roots, shapes = complex_modes(system)
    assert len(roots) == 2
    K = system.stiffness + 1j * system.structural_damping
    for root, shape in zip(roots, shapes.T, strict=True):
        residual = (root**2 * system.mass + root * system.damping + K) @ shape
        assert np.abs(residual).max() < 1e-9 * np.abs(K @ shape).max()
    assert (roots.real < 0).all()
