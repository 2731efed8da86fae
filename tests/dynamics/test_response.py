import numpy as np
import pytest
from oracles import Beam
from small_systems import mass_on_a_string, oscillator, spring

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import check_frequencies, direct_response, modal_response
from modeviz.errors import SolveError
from modeviz.vehicle.connections import Damper, Spring
from modeviz.vehicle.vehicle import Vehicle

Z = np.eye(6)[2:3]


def force_on_z(n_freqs, n_dofs=6):
    forces = np.zeros((n_freqs, n_dofs, 1), complex)
    forces[:, 2] = 1.0
    return forces


def test_oscillator_follows_the_textbook():
    f = np.array([0.5, 3.0, 3.2, 10.0])
    omega, m, k, c, g = 2 * np.pi * f, 2.0, 800.0, 5.0, 0.1
    H = direct_response(oscillator(m, k, c, g), f, force_on_z(4), Z)
    np.testing.assert_allclose(H[:, 0, 0], 1 / (k * (1 + 1j * g) - m * omega**2 + 1j * c * omega))


def damped_beam():
    ends = np.array([[0.0, 0, 0], [0, 0, 0]]), np.array([[2.0, 0, 0], [2.0, 0, 0]])
    feet = [
        Spring(f"foot {i}", "feet", ("beam", "ground"), at, np.full(3, 5e4), loss_factor=0.15)
        for i, at in enumerate(ends)
    ]
    shock = Damper("shock", "shocks", ("beam", "ground"), ends[0], damping=np.array([0, 0, 400.0]))
    body = Beam(10).body("beam", damping_ratio=0.03)
    system = assemble(Vehicle("beam", (body,), (*feet, shock)))
    push = system.motion("beam", np.array([0.4, 0, 0]))[2]
    read = system.motion("beam", np.array([2.0, 0, 0]))[2:3]
    return system, np.tile(push[:, None], (30, 1, 1)).astype(complex), read


def test_modal_method_with_all_modes_is_the_direct_one():
    system, forces, read = damped_beam()
    f = np.linspace(0.5, 60, 30)
    direct = direct_response(system, f, forces, read)
    modal = modal_response(system, solve_modes(system), f, forces, read)
    np.testing.assert_allclose(modal, direct, rtol=1e-6)


def test_modal_method_converges_as_modes_are_added():
    system, forces, read = damped_beam()
    f = np.linspace(0.5, 30, 30)
    direct = direct_response(system, f, forces, read)

    def error(n_modes):
        modal = modal_response(system, solve_modes(system, n_modes), f, forces, read)
        return np.abs(modal - direct).max() / np.abs(direct).max()

    # What is left out is static flexibility, which falls as 1/ω² of the modes left out.
    assert error(10) > 3 * error(20) > 9 * error(40)
    assert error(40) < 1e-3


def test_damping_off_the_diagonal_counts():
    system, forces, read = damped_beam()
    f = np.linspace(0.5, 60, 30)
    modes = solve_modes(system)
    coupled = modal_response(system, modes, f, forces, read)[:, 0, 0]
    omega = 2 * np.pi * f[:, None]
    omega_n = 2 * np.pi * modes.frequency_hz
    uncoupled = (read @ modes.shapes * (modes.shapes.T @ forces[0]).T) / (
        omega_n**2 - omega**2 + 2j * modes.damping_ratio * omega_n * omega
    )
    assert np.abs(uncoupled.sum(axis=1) / coupled - 1).max() > 0.1


def string(k, m=1.0):
    return assemble(Vehicle("m", (mass_on_a_string("m", m),), (spring(("m", "ground"), k),)))


@pytest.mark.parametrize("beside", [0.0, 1e-15, 1e-12, 1e-10])
def test_an_undamped_resonance_on_the_grid_is_an_error(beside):
    system = string((2 * np.pi * 2.0) ** 2 * (1 + beside))
    with pytest.raises(SolveError, match=r"at 2\.0 Hz.*damping"):
        direct_response(system, np.array([2.0]), force_on_z(1), Z)


def test_a_line_a_thousandth_beside_an_undamped_resonance_is_right():
    k, f = 7.0, np.sqrt(7.0 / 3.0) / (2 * np.pi) * 1.001
    H = direct_response(string(k, 3.0), np.array([f]), force_on_z(1), Z)
    assert H[0, 0, 0] == pytest.approx(1 / (k * (1 - 1.001**2)), rel=1e-11)


def test_a_spring_too_stiff_for_the_direct_solve_is_an_error():
    bodies = mass_on_a_string("a", 2.0), mass_on_a_string("b", 3.0)
    springs = spring(("a", "ground"), 800.0), spring(("a", "b"), 1e14)
    system = assemble(Vehicle("pair", bodies, springs))
    with pytest.raises(SolveError, match=r"at 0\.5 Hz.*too stiff"):
        direct_response(system, np.array([0.5]), force_on_z(1, 12), np.eye(12)[2:3])


def test_an_output_that_no_force_reaches_is_still():
    sideways = np.eye(6)[:1]
    H = direct_response(oscillator(), np.array([0.5, 3.0]), force_on_z(2), sideways)
    assert not H.any()


@pytest.mark.parametrize(
    ("frequency_hz", "found"),
    [
        ([0.0, 1.0], "0 Hz at place 1"),
        ([1.0, -2.0], "-2 Hz at place 2"),
        ([1.0, np.nan], "nan Hz at place 2"),
        ([1.0, np.inf], "inf Hz at place 2"),
        ([1.0, 10.0, 10.0], "10 Hz twice"),
        ([1.0, 3.0, 2.0], "3 Hz before 2 Hz"),
        ([[1.0, 2.0]], r"shape \(1, 2\)"),
        ([], r"shape \(0,\)"),
    ],
)
def test_frequencies_that_cannot_be_solved_are_named(frequency_hz, found):
    with pytest.raises(SolveError, match=f"found {found}"):
        check_frequencies(np.array(frequency_hz))


def test_direct_response_checks_its_frequencies():
    with pytest.raises(SolveError, match="10 Hz twice"):
        direct_response(oscillator(), np.array([10.0, 10.0]), force_on_z(2), Z)
