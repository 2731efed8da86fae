"""The elements against published and closed-form answers."""

import numpy as np
import pytest
import scipy.linalg
import scipy.optimize
from small_meshes import BAR, STEEL, bar, plate, shell

from modeviz.fem.elements import TUBE_SHEAR_FACTOR
from modeviz.fem.free import free_modes, lowest_modes
from modeviz.fem.matrices import assemble
from modeviz.fem.mesh import BeamSection, ShellSection
from modeviz.vehicle.rigid import rigid_motions

E, RHO = STEEL["youngs_modulus"], STEEL["density"]
G = E / 2.6


def elastic_hz(mesh, n_modes):
    modes = free_modes(assemble(mesh), n_modes + 6)
    return np.sqrt(modes.omega_n_squared[6:]) / (2 * np.pi)


def extrapolated(coarse, fine):
    """The limit of a value whose error falls by four when the elements are halved."""
    return fine + (fine - coarse) / 3


# A. W. Leissa, "The free vibration of rectangular plates" (1973), completely free square plate, in
# the converged values of later Ritz solutions: omega a² √(rho h / D) at Poisson's ratio 0.3.
FREE_SQUARE_PLATE = np.array([13.4682, 19.5961, 24.2702, 34.8009, 34.8009])


def free_square_plate_hz(thickness):
    rigidity = E * thickness**3 / (12 * (1 - 0.3**2))
    return FREE_SQUARE_PLATE * np.sqrt(rigidity / (RHO * thickness)) / (2 * np.pi)


def test_free_square_plate_agrees_with_leissa():
    # A plate of 1/200 is that much softer at its free edges than Kirchhoff's: J = (1 - 0.63 t/b)
    # b t³/3 of a twisted strip says 0.16 % in frequency.
    found = extrapolated(elastic_hz(plate(16), 5), elastic_hz(plate(32), 5))
    np.testing.assert_allclose(found, free_square_plate_hz(0.005), rtol=2.5e-3)
    assert (found < free_square_plate_hz(0.005)).all()


def test_thin_free_square_plate_converges_with_the_square_of_the_element():
    errors = [elastic_hz(plate(n, 0.001), 5) / free_square_plate_hz(0.001) - 1 for n in (8, 16, 32)]
    # The first mode, which twists the corners, is the last to reach the rate.
    np.testing.assert_allclose(errors[0] / errors[1], 4.0, rtol=0.15)
    np.testing.assert_allclose(errors[1] / errors[2], 4.0, rtol=0.15)


def cantilevered_tapered_membrane_hz(n_x, n_y):
    """NAFEMS FV32: in its plane, fixed at the root of 5 m, tip of 1 m, 10 m long."""
    mesh = shell(
        lambda u, v: (10 * u, (v - 0.5) * (5 - 4 * u), 0),
        n_x,
        n_y,
        ShellSection(0.05, youngs_modulus=200e9, poisson_ratio=0.3, density=8000.0),
    )
    matrices = assemble(mesh)
    in_plane = np.arange(matrices.n_dofs).reshape(-1, 6)[mesh.nodes[:, 0] > 0][:, [0, 1, 5]].ravel()
    omega_n_squared, _ = lowest_modes(
        matrices.mass[in_plane][:, in_plane], matrices.stiffness[in_plane][:, in_plane], 6
    )
    return np.sqrt(omega_n_squared) / (2 * np.pi)


def test_tapered_membrane_agrees_with_nafems_fv32():
    published = [44.623, 130.03, 162.70, 246.05, 379.90, 391.44]
    coarse = cantilevered_tapered_membrane_hz(32, 16)
    fine = cantilevered_tapered_membrane_hz(64, 32)
    np.testing.assert_allclose(fine, published, rtol=4e-3)
    np.testing.assert_allclose(extrapolated(coarse, fine), published, rtol=5e-4)


def test_free_cylinder_agrees_with_rayleigh():
    # Inextensional modes of a ring without Poisson effect, Rayleigh (1894), n waves around:
    # omega² = E h² / (12 rho R⁴) n² (n² - 1)² / (n² + 1), each twice.
    radius, width, thickness = 0.5, 0.1, 0.002
    section = ShellSection(thickness, youngs_modulus=E, poisson_ratio=0.0, density=RHO)

    def ring_hz(n_around):
        mesh = shell(
            lambda u, v: (v * width, radius * np.cos(2 * np.pi * u), radius * np.sin(2 * np.pi * u)),
            n_around,
            2,
            section,
            closed=True,
        )
        # Between the pairs of Rayleigh's modes lies the pair that tilts the section.
        return elastic_hz(mesh, 8)[[0, 1, 2, 3, 6, 7]]

    n = np.repeat([2, 3, 4], 2)
    omega = np.sqrt(E * thickness**2 / (12 * RHO) * n**2 * (n**2 - 1) ** 2 / (n**2 + 1)) / radius**2
    found = extrapolated(ring_hz(64), ring_hz(128))
    np.testing.assert_allclose(found, omega / (2 * np.pi), rtol=5e-4)


def test_sheet_with_swages_bends_stiffer_and_stretches_alike():
    flat, swaged = (
        shell(lambda u, v: (u, v, 0), 8, 8, ShellSection(0.001, **STEEL, bending_factor=b))
        for b in (1.0, 9.0)
    )
    np.testing.assert_allclose(elastic_hz(swaged, 5) / elastic_hz(flat, 5), 3.0, rtol=2e-3)
    in_plane = np.arange(6 * 81).reshape(-1, 6)[:, [0, 1]].ravel()
    K_flat, K_swaged = (assemble(m).stiffness[in_plane][:, in_plane] for m in (flat, swaged))
    assert abs(K_flat - K_swaged).max() <= 1e-12 * abs(K_flat).max()


def test_swages_turn_with_the_inertia_of_their_depth():
    # About its middle line a sheet of mass m and section depth d, d² = factor t², has m d² / 12 more.
    def turning(bending_factor):
        section = ShellSection(0.01, **STEEL, bending_factor=bending_factor)
        matrices = assemble(shell(lambda u, v: (u, v - 0.5, 0), 2, 2, section))
        R = rigid_motions(matrices.nodes).reshape(-1, 6)[:, 3]
        return R @ (matrices.mass @ R)

    np.testing.assert_allclose(turning(9.0) - turning(1.0), RHO * 0.01 * 8 * 0.01**2 / 12, rtol=1e-9)


def test_added_mass_lowers_frequencies_as_mass_does():
    def hz(added_mass):
        return elastic_hz(
            shell(lambda u, v: (u, v, 0), 6, 6, ShellSection(0.001, **STEEL, added_mass=added_mass)), 4
        )

    np.testing.assert_allclose(hz(0.0) / hz(3 * RHO * 0.001), 2.0, rtol=1e-5)


def test_slender_free_beam_agrees_with_euler():
    # beta L = 4.7300, 7.8532, 10.9956; shear and rotary inertia take (beta r)² (1 + E / k G) / 2.
    length, r = 20.0, np.sqrt(BAR.bending_inertia_up / BAR.area)
    found = elastic_hz(bar(40, length), 6)
    beta = np.array([4.730041, 7.853205, 10.995608]) / length
    for inertia, hz in (BAR.bending_inertia_across, found[::2]), (BAR.bending_inertia_up, found[1::2]):
        expected = beta**2 * np.sqrt(E * inertia / (RHO * BAR.area)) / (2 * np.pi)
        np.testing.assert_allclose(
            np.sort(hz), expected, rtol=(beta[-1] * r) ** 2 * (1 + 2.6 / TUBE_SHEAR_FACTOR) / 2
        )


STUBBY = BeamSection(
    area=4e-3,
    bending_inertia_up=1.2e-5,
    bending_inertia_across=6e-6,
    torsion_constant=4e-6,
    **STEEL,
)


def hz_of_motion(mesh, motion):
    """Elastic frequencies of a straight beam that moves along x, y or z (0 to 2) or twists (3)."""
    modes = free_modes(assemble(mesh), 36)
    moves = np.abs(modes.shapes[:, 6:].reshape(-1, 6, 30))[:, :4].max(axis=0)
    moves[3] *= 0.01  # a section's radius: twist counts as the motion of its edge
    return np.sqrt(modes.omega_n_squared[6:])[np.argmax(moves, axis=0) == motion] / (2 * np.pi)


def timoshenko_free_hz(inertia, length, between):
    """The frequency of a free Timoshenko beam in an interval, by exact transfer over its length."""
    A, EI = STUBBY.area, E * inertia

    def moment_and_shear_left_over(hz):
        omega_squared = (2 * np.pi * hz) ** 2
        slopes = np.array(  # of deflection, rotation, moment, shear
            [
                [0, 1, 0, 1 / (TUBE_SHEAR_FACTOR * G * A)],
                [0, 0, 1 / EI, 0],
                [0, -RHO * inertia * omega_squared, 0, -1],
                [-RHO * A * omega_squared, 0, 0, 0],
            ]
        )
        return np.linalg.det(scipy.linalg.expm(slopes * length)[2:, :2])

    return scipy.optimize.brentq(moment_and_shear_left_over, *between, xtol=1e-9)


@pytest.mark.parametrize(
    ("inertia", "axis"), [(STUBBY.bending_inertia_up, 2), (STUBBY.bending_inertia_across, 1)]
)
def test_stubby_free_beam_agrees_with_timoshenko_in_each_plane(inertia, axis):
    length = 1.0
    coarse, fine = (hz_of_motion(bar(n, length, STUBBY), axis)[:2] for n in (32, 64))
    exact = [timoshenko_free_hz(inertia, length, (0.98 * f, 1.02 * f)) for f in fine]
    np.testing.assert_allclose(extrapolated(coarse, fine), exact, rtol=1e-5)
    euler = (4.730041 / length) ** 2 * np.sqrt(E * inertia / (RHO * STUBBY.area)) / (2 * np.pi)
    assert exact[0] < 0.95 * euler


def test_free_rod_agrees_with_theory_in_tension_and_torsion():
    # omega = n pi c / L, with c² = E / rho and G J / (rho (Iy + Iz)); linear elements add
    # (n pi / N)² / 24.
    n = 40
    polar = BAR.bending_inertia_up + BAR.bending_inertia_across
    torsion_speed = np.sqrt(G * BAR.torsion_constant / (RHO * polar))
    for motion, speed in (0, np.sqrt(E / RHO)), (3, torsion_speed):
        found = hz_of_motion(bar(n), motion)[0]
        np.testing.assert_allclose(found, speed / 2 * (1 + (np.pi / n) ** 2 / 24), rtol=1e-5)
