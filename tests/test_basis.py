import numpy as np
import pytest
import scipy.linalg

from modeviz.dynamics.assembly import System, assemble, mount_stiffness
from modeviz.dynamics.basis import band_modes, prepare_basis
from modeviz.vehicle.files import builtin_vehicle, read_vehicle

FREE_HZ = 0.3
"""The propeller shaft of the truck spins freely."""


@pytest.fixture(scope="module")
def truck() -> System:
    return assemble(read_vehicle(builtin_vehicle()))


@pytest.fixture(scope="module")
def basis(truck):
    return prepare_basis(truck)


def rate_sets(truck: System) -> dict[str, np.ndarray]:
    """Original, optimised, mounts removed, practically rigid ones, and 50 random sets."""
    own = mount_stiffness(truck.vehicle)
    optimised = mount_stiffness(truck.vehicle.with_rates(truck.vehicle.rate_sets["optimised"]))
    removed, rigid = own.copy(), own.copy()
    removed[6:9] = 0
    rigid[6:9] *= 1e6
    rng = np.random.default_rng(2)
    random = {f"random {i}": own * 10 ** rng.uniform(-2, 2, len(own)) for i in range(50)}
    return {
        "original": own, "optimised": optimised, "one removed": removed, "one rigid": rigid,
        "all removed": 0 * own, "all rigid": 1e6 * own, **random,
    }  # fmt: skip


def full_frequencies(truck: System, stiffness: np.ndarray) -> np.ndarray:
    """Below 40 Hz from scipy's generalised eigenproblem of the full matrices."""
    R = truck.mount_motions
    K = truck.stiffness + (R.T * (stiffness - mount_stiffness(truck.vehicle)).real) @ R
    omega_squared = scipy.linalg.eigvalsh(K, truck.mass)
    f = np.sqrt(np.maximum(omega_squared, 0)) / (2 * np.pi)
    return f[f < 40]


def test_enriched_frequencies_are_those_of_the_full_model(truck, basis):
    for name, stiffness in rate_sets(truck).items():
        true = full_frequencies(truck, stiffness)
        found = band_modes(basis, stiffness).modes.frequency_hz
        assert len(found) == len(true), name
        moves = true > FREE_HZ
        # With every mount rigid the full matrices themselves are off by rounding, ε 10¹² N/m.
        tolerance = 2e-5 if name == "all rigid" else 1e-6
        np.testing.assert_allclose(found[moves], true[moves], rtol=tolerance, err_msg=name)
