"""Damped modes against polynomials, simulation in time and the full eigenproblem."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from builtin_truck import truck_modes
from full_solutions import complex_modes
from mounted_cabin import mounted_cabin
from scipy.integrate import solve_ivp
from scipy.optimize import linear_sum_assignment
from small_systems import damper, mass_on_a_string, spring

from modeviz.analysis.deflection_shapes import complex_mode
from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.dynamics.modes import vibrating_roots
from modeviz.errors import SolveError
from modeviz.vehicle.connections import Damper, Spring
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

A, B = 2, 8
"""Where the heights of the two masses are among the coordinates."""


def two_masses(*links: Spring | Damper) -> ModalResults:
    """1 kg and 2 kg that are held along z; all else is free."""
    masses = mass_on_a_string("a", 1.0), mass_on_a_string("b", 2.0)
    return solve_modal(prepare_modes(Vehicle("two", masses, links)), {})


def stacked(*, c: float = 0.0, beta: float = 0.0, loss_factor: float = 0.0) -> ModalResults:
    """1 kg on 400 N/m and on it 2 kg on 300 N/m.

    With a damper c from the upper one to the ground, dampers β times the springs, and a loss factor.
    """
    joints = {("a", "ground"): 400.0, ("a", "b"): 300.0}
    springs = (spring(ends, k, loss_factor) for ends, k in joints.items())
    dampers = (damper(ends, beta * k) for ends, k in joints.items())
    return two_masses(*springs, *dampers, damper(("b", "ground"), c))


def swinging(results: ModalResults) -> list[int]:
    return np.flatnonzero(results.modes.frequency_hz > 0.1).tolist()


@pytest.mark.parametrize("c", [0.5, 5.0, 20.0])
def test_two_masses_with_one_damper_have_the_roots_of_their_polynomial(c):
    results = stacked(c=c)
    # (s² + 700) (2s² + cs + 300) - 300² = 0
    expected = np.roots(np.polysub(np.polymul([1, 0, 700], [2, c, 300]), [300.0**2]))
    expected = sorted(expected[expected.imag > 0], key=abs)
    found = [complex_mode(results, i) for i in swinging(results)]
    assert [m.eigenvalue for m in found] == pytest.approx(expected, rel=1e-10)
    for mode in found:
        s = mode.eigenvalue
        assert mode.shape[B] / mode.shape[A] == pytest.approx((s**2 + 700) / 300, rel=1e-9)
        assert mode.damped_frequency_hz == pytest.approx(s.imag / (2 * np.pi))
        assert mode.damping_ratio == pytest.approx(-s.real / abs(s))


def test_free_decay_of_a_damped_mode_keeps_its_phases_in_time():
    results = stacked(c=5.0)
    system = results.prepared.system
    M, C, K = (a[np.ix_([A, B], [A, B])] for a in (system.mass, system.damping, system.stiffness))
    for mode in (complex_mode(results, i) for i in swinging(results)):
        psi, root = mode.shape[[A, B]], mode.eigenvalue
        assert np.ptp(np.angle(psi**2)) > 0.05  # or nothing is tested

        def motion(_, state):
            return np.r_[state[2:], -np.linalg.solve(M, C @ state[2:] + K @ state[:2])]

        start = np.r_[psi.real, (root * psi).real]
        t = np.linspace(0, 3 / mode.damped_frequency_hz, 50)
        x = solve_ivp(motion, t[[0, -1]], start, "DOP853", t, rtol=1e-11, atol=1e-13).y[:2]
        np.testing.assert_allclose(x, (psi[:, None] * np.exp(root * t)).real, atol=1e-8)


def test_dampers_in_proportion_to_the_springs_leave_real_shapes():
    beta = 2e-3
    results = stacked(beta=beta)
    for i in swinging(results):
        mode = complex_mode(results, i)
        np.testing.assert_allclose(mode.shape, results.modes.shapes[:, i], atol=1e-10)
        assert mode.damping_ratio == pytest.approx(
            beta * np.pi * results.modes.frequency_hz[i], rel=1e-10
        )


def test_one_loss_factor_everywhere_leaves_real_shapes():
    results = stacked(loss_factor=0.2)
    for i in swinging(results):
        mode = complex_mode(results, i)
        np.testing.assert_allclose(mode.shape, results.modes.shapes[:, i], atol=1e-10)
        omega = 2 * np.pi * results.modes.frequency_hz[i]
        assert mode.eigenvalue == pytest.approx(1j * omega * np.sqrt(1 + 0.2j), rel=1e-10)


def test_a_mode_keeps_its_place_though_damping_makes_it_the_fastest():
    """|λ|² = ω² √(1 + g²): a loss factor of one lifts the slower of two oscillators over the other."""
    results = two_masses(spring(("a", "ground"), 400.0, 1.0), spring(("b", "ground"), 900.0))
    slow, fast = swinging(results)
    slow, fast = complex_mode(results, slow), complex_mode(results, fast)
    assert abs(slow.eigenvalue) > abs(fast.eigenvalue)
    assert abs(slow.shape[A]) == pytest.approx(1.0)
    assert abs(fast.shape[B]) == pytest.approx(np.sqrt(0.5))


@pytest.mark.parametrize("disturbed", [0.0, 1e-13, -1e-13, 1e-11, -1e-11])
def test_close_modes_that_dampers_mix_in_equal_parts_keep_their_order(disturbed):
    """λ² + λ + 400 = 0 of both together and λ² + 5 λ + 400 = 0 against each other: the same |λ|."""
    springs = (spring((name, "ground"), 400.0) for name in "ab")
    masses = (mass_on_a_string(name, 1.0) for name in "ab")
    dampers = [damper(("a", "ground"), 1.0 + disturbed), damper(("b", "ground"), 1.0)]
    dampers.append(damper(("a", "b"), 2.0))
    results = solve_modal(prepare_modes(Vehicle("equal", tuple(masses), (*springs, *dampers))), {})
    first, second = (complex_mode(results, i) for i in swinging(results))
    assert abs(first.eigenvalue) == pytest.approx(abs(second.eigenvalue), rel=1e-9)
    found = [first.eigenvalue.imag, second.eigenvalue.imag]
    assert found == pytest.approx(np.sqrt([400 - 2.5**2, 400 - 0.5**2]))


def test_what_moves_freely_has_no_frequency_and_its_undamped_shape():
    results = stacked(c=5.0)
    free = complex_mode(results, 0)
    assert (free.eigenvalue, free.damped_frequency_hz, free.damping_ratio) == (0, 0, 0)
    np.testing.assert_array_equal(free.shape, results.modes.shapes[:, 0])


def test_a_mode_that_damping_stops_from_vibrating_is_an_error_and_the_others_are_not():
    springs = spring(("a", "ground"), 400.0), spring(("b", "ground"), 900.0)
    results = two_masses(*springs, damper(("b", "ground"), 200.0))
    swings, overdamped = swinging(results)
    assert complex_mode(results, swings).eigenvalue == pytest.approx(20j, rel=1e-10)
    with pytest.raises(SolveError, match=r"mode 12 at 3\.38 Hz is damped so strongly"):
        complex_mode(results, overdamped)


@pytest.fixture(scope="module")
def cabin():
    """Its groups differ in loss, so that the shapes have phases."""
    vehicle = mounted_cabin()
    front, rear = vehicle.mount_groups
    lossy = replace(vehicle, mount_groups=(replace(front, loss_factor=0.6), rear))
    return solve_modal(prepare_modes(lossy, top_hz=6.0), {"B": MountRates(3e5, 1e5, 2e5)})


def test_the_basis_gives_what_the_modes_of_the_band_leave_out(cabin):
    """The cabin's basis holds all that its twelve coordinates can do; its band does not."""
    n = len(cabin.modes.frequency_hz)
    assert n < cabin.prepared.system.n_dofs
    system = cabin.prepared.system.with_rates(cabin.rates)
    K = system.stiffness + 1j * system.structural_damping
    for i in range(n):
        mode = complex_mode(cabin, i)
        s, psi = mode.eigenvalue, mode.shape
        residual = (s**2 * system.mass + s * system.damping + K) @ psi
        assert np.abs(residual).max() < 1e-9 * np.abs(K @ psi).max()
        assert abs(s - cabin.damped.eigenvalue[i]) > 1e-7 * abs(s)


def test_the_real_part_has_the_most_energy_and_the_sign_of_the_undamped_mode(cabin):
    M = cabin.prepared.system.mass
    turns = np.exp(1j * np.linspace(0, np.pi, 181))
    for i, undamped in enumerate(cabin.modes.shapes.T):
        psi = complex_mode(cabin, i).shape
        assert (psi.conj() @ M @ psi).real == pytest.approx(1.0, rel=1e-12)
        energy = [(p.real @ M @ p.real) for p in turns[:, None] * psi]
        assert energy[0] == pytest.approx(max(energy), rel=1e-12)
        assert undamped @ M @ psi.real > 0.5


@pytest.fixture(scope="module")
def truck():
    return truck_modes()


@pytest.mark.parametrize("rates", ["original", "optimised"])
def test_a_damped_mode_of_the_truck_is_its_undamped_one_followed_as_damping_grows(truck, rates):
    results = solve_modal(truck, truck.vehicle.rate_sets.get(rates, {}))
    band, n = results.band, len(results.modes.frequency_hz)
    moves = np.flatnonzero(results.modes.frequency_hz > 0.1)
    vectors, roots = np.eye(n, dtype=complex), np.zeros(n, complex)
    for part in np.linspace(0, 1, 21)[1:]:
        K = np.diag(results.modes.omega_n_squared) + 1j * part * band.structural_damping
        found, y = vibrating_roots(part * band.damping, K)
        y /= np.linalg.norm(y, axis=0)
        before, now = linear_sum_assignment(-np.abs(vectors[:, moves].conj().T @ y))
        vectors[:, moves[before]], roots[moves[before]] = y[:, now], found[now]
    np.testing.assert_allclose(results.damped.eigenvalue[moves], roots[moves], rtol=1e-9)


@pytest.mark.parametrize("rates", ["original", "optimised"])
def test_damped_modes_of_the_truck_are_those_of_the_full_model(truck, rates):
    """430 coordinates: shapes within 1 %, roots as near as the basis can have them.

    λ is off by rᵀ P⁻¹ r / ψᵀP'ψ with the residual r = Pψ, P = λ²M + λC + K over all that the basis
    leaves out, by less than twice that where it gives way, too. It is what strong dampers couple to the
    modes above, up to 9e-4 of |λ|.
    """
    results = solve_modal(truck, truck.vehicle.rate_sets.get(rates, {}))
    system = truck.system.with_rates(results.rates)
    roots, shapes = complex_modes(system)
    size = np.einsum("ij,ij->j", shapes.conj(), system.momentum(shapes)).real
    shapes = shapes / np.sqrt(size)
    left_out = scipy.linalg.null_space(system.momentum(truck.basis.vectors).T)
    K = system.stiffness + 1j * system.structural_damping
    for i in np.flatnonzero(results.modes.frequency_hz > 0.1):
        mode = complex_mode(results, i)
        likeness = np.abs(shapes.conj().T @ system.momentum(mode.shape[:, None])[:, 0])
        root = roots[likeness.argmax()]
        s, psi = mode.eigenvalue, mode.shape
        P = s**2 * system.mass + s * system.damping + K
        r = left_out.T @ (P @ psi)
        missing = r @ np.linalg.solve(left_out.T @ P @ left_out, r)
        per_root = psi @ (2 * s * system.mass + system.damping) @ psi
        assert abs(root - s) < 2 * abs(missing / per_root) + 1e-9 * abs(root)
        assert abs(root - s) < 1e-3 * abs(root)
        assert 1 - likeness.max() ** 2 < 1e-4
