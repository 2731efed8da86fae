import re
from dataclasses import replace

import numpy as np
import pytest
import scipy.linalg
from mounted_cabin import mounted_cabin
from oracles import Beam
from small_systems import mass_on_a_string

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.band import band_modes, natural_frequencies
from modeviz.dynamics.basis import prepare_basis
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.errors import SolveError
from modeviz.vehicle.connections import GROUND, Mount, Tyre
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

SOFT, STIFF = MountRates(1.0, 1.0, 1.0), MountRates(1e9, 1e9, 1e9)


def beam_on_mounts(rate=5e4, ground=True):
    """An elastic beam of 66 coordinates on two mounts, on the ground or on a free block."""
    under = GROUND if ground else "block"
    mounts = tuple(
        Mount(f"at {x}", "", ("beam", under), np.tile([x, 0.0, 0.0], (2, 1))) for x in (0.0, 1.6)
    )
    group = MountGroup("M", "M", MountRates(rate, rate, rate), 0.1, (SOFT, STIFF), mounts)
    bodies = (Beam(10).body("beam"),) + (() if ground else (mass_on_a_string("block", 8.0),))
    return assemble(Vehicle("beam", bodies, (), (group,)))


def full_frequencies(system, stiffness, below_hz):
    R = system.mount_motions
    K = system.stiffness + (R.T * (stiffness - mount_stiffness(system.vehicle)).real) @ R
    f = np.sqrt(np.maximum(scipy.linalg.eigvalsh(K, system.mass), 0)) / (2 * np.pi)
    return f[f < below_hz]


@pytest.mark.parametrize("ground", [True, False])
@pytest.mark.parametrize("factor", [0.0, 1e-3, 0.3, 30.0, 1e5])
def test_enriched_frequencies_are_those_of_the_full_model(factor, ground):
    system = beam_on_mounts(ground=ground)
    stiffness = factor * mount_stiffness(system.vehicle)
    solution = band_modes(prepare_basis(system), stiffness)
    true = full_frequencies(system, stiffness, 40)
    # The beam's fastest coordinate leaves a rounding of 1e-6 rad²/s², 1e-4 Hz for what moves freely.
    np.testing.assert_allclose(solution.modes.frequency_hz, true, rtol=1e-6, atol=1e-3)
    assert solution.trust.n_missed == 0


def test_the_band_can_be_wider():
    system = beam_on_mounts()
    stiffness = 7 * mount_stiffness(system.vehicle)
    found = band_modes(prepare_basis(system, 300.0), stiffness).modes.frequency_hz
    np.testing.assert_allclose(found, full_frequencies(system, stiffness, 300), rtol=1e-6, atol=1e-3)


def test_the_basis_is_orthonormal_and_its_matrices_are_the_systems():
    basis = prepare_basis(beam_on_mounts())
    V, system = basis.vectors, basis.system
    np.testing.assert_allclose(V.T @ system.mass @ V, np.eye(V.shape[1]), atol=1e-10)
    np.testing.assert_allclose(basis.spring_motions, system.mount_motions @ V)
    assert V.shape[1] > basis.n_modes


@pytest.mark.parametrize("method", ["enriched", "classic", "exact"])
def test_shapes_are_mass_normalised(method):
    system = beam_on_mounts()
    modes = band_modes(prepare_basis(system), 3 * mount_stiffness(system.vehicle), method).modes
    phi = modes.shapes
    np.testing.assert_allclose(phi.T @ system.mass @ phi, np.eye(phi.shape[1]), atol=1e-9)


def test_all_methods_agree_at_the_base():
    system = assemble(mounted_cabin())
    basis, own = prepare_basis(system), mount_stiffness(system.vehicle)
    exact, *others = (band_modes(basis, own, m) for m in ("exact", "enriched", "classic"))
    for other in others:
        np.testing.assert_allclose(other.modes.frequency_hz, exact.modes.frequency_hz, rtol=1e-12)
        np.testing.assert_allclose(other.modes.damping_ratio, exact.modes.damping_ratio, rtol=1e-9)


@pytest.mark.parametrize("method", ["enriched", "exact"])
def test_damping_is_that_of_the_springs_there_are_now(method):
    system = assemble(mounted_cabin())
    rates = {"A": MountRates(2e5, 1e5, 1e5)}
    solution = band_modes(
        prepare_basis(system), mount_stiffness(system.vehicle.with_rates(rates)), method
    )
    tuned, phi = system.with_rates(rates), solution.modes.shapes
    np.testing.assert_allclose(solution.damping, phi.T @ tuned.damping @ phi, atol=1e-9)
    np.testing.assert_allclose(
        solution.structural_damping, phi.T @ tuned.structural_damping @ phi, atol=1e-6
    )


def test_a_complete_basis_leaves_nothing_out():
    system = assemble(mounted_cabin())
    basis = prepare_basis(system)
    assert basis.vectors.shape == (12, 12)
    for factor in (0.0, 0.2, 20.0):
        trust = band_modes(basis, factor * mount_stiffness(system.vehicle)).trust
        assert (trust.residual < 1e-8).all()
        assert (trust.frequency_error_hz < 1e-6).all()


def test_the_residual_is_that_of_the_full_equations():
    system = beam_on_mounts()
    stiffness = 9 * mount_stiffness(system.vehicle)
    R = system.mount_motions
    K = system.stiffness + 8 * (R.T * mount_stiffness(system.vehicle).real) @ R
    L = np.linalg.cholesky(system.mass)
    for method in ("enriched", "classic"):
        solution = band_modes(prepare_basis(system), stiffness, method)
        phi = solution.modes.shapes
        r = np.linalg.solve(L, K @ phi - system.mass @ phi * solution.modes.omega_n_squared)
        expected = np.linalg.norm(r, axis=0)
        np.testing.assert_allclose(solution.trust.residual, expected, rtol=1e-6, atol=1e-4)


def test_frequencies_alone_are_those_of_the_modes():
    system = beam_on_mounts()
    basis, stiffness = prepare_basis(system), 2 * mount_stiffness(system.vehicle)
    modes = band_modes(basis, stiffness).modes
    found = natural_frequencies(basis, stiffness)
    assert len(found) == basis.n_below
    n = min(len(found), len(modes.frequency_hz))
    np.testing.assert_allclose(found[:n], modes.frequency_hz[:n], rtol=1e-9, atol=1e-3)


def test_a_mode_on_the_top_of_the_band_moves_the_top():
    system = beam_on_mounts()
    own = mount_stiffness(system.vehicle)
    mode = full_frequencies(system, own, 200)[4]
    basis = prepare_basis(system, mode)
    assert mode < basis.top_hz < 1.001 * mode
    assert band_modes(basis, own).trust.n_missed == 0


def test_a_vehicle_without_mounts_has_the_modes_it_has():
    vehicle = replace(mounted_cabin(), mount_groups=(), rate_sets={})
    basis = prepare_basis(assemble(vehicle))
    for method in ("enriched", "classic", "exact"):
        solution = band_modes(basis, np.zeros(0, complex), method)
        f = solution.modes.frequency_hz
        np.testing.assert_allclose(f[:6], 0, atol=1e-4)
        np.testing.assert_allclose(f, full_frequencies(basis.system, np.zeros(0), 40), atol=1e-4)
        assert solution.trust.n_missed == 0


def test_a_free_vehicle_keeps_six_modes_at_zero():
    vehicle = mounted_cabin()
    on_tyres = tuple(c for c in vehicle.connections if isinstance(c, Tyre))
    assert on_tyres == vehicle.connections
    system = assemble(replace(vehicle, connections=(), wheel_loads=()))
    solution = band_modes(prepare_basis(system), 0.1 * mount_stiffness(system.vehicle))
    f = solution.modes.frequency_hz
    np.testing.assert_allclose(f[:6], 0, atol=1e-4)
    assert f[6] > 1
    assert solution.trust.n_missed == 0


@pytest.mark.parametrize("rate", [1e18, 1e100, 1e300])
@pytest.mark.parametrize("method", ["enriched", "classic", "exact"])
def test_a_spring_that_drowns_the_slow_modes_is_named(rate, method):
    system = assemble(mounted_cabin())
    stiffness = mount_stiffness(system.vehicle)
    stiffness[4] = rate
    with pytest.raises(SolveError, match=re.escape(f"mount 'A 0.5' has a rate of {rate:.2g} N/m")):
        band_modes(prepare_basis(system), stiffness, method)
