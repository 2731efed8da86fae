import numpy as np
import pytest

from benchmarks.scaled_vehicle import MASS, Size, scaled_vehicle
from modeviz.dynamics.assembly import assemble


@pytest.fixture(scope="module")
def road_train():
    return scaled_vehicle(Size(n_wagons=3, n_modes=40, n_mounts=2))


def test_scaled_vehicle_has_the_size_that_was_asked_for(road_train):
    system = assemble(road_train)
    assert system.n_dofs == 3 * 40
    assert system.mount_motions.shape == (3 * 2 * 2, 3 * 40)


def test_scaled_vehicle_is_the_same_every_time(road_train):
    again = assemble(scaled_vehicle(Size(n_wagons=3, n_modes=40, n_mounts=2)))
    np.testing.assert_array_equal(again.stiffness, assemble(road_train).stiffness)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_wagon_moves_rigidly_with_its_mass(road_train, axis):
    for wagon in road_train.bodies:
        motions = np.vstack([a.shapes for a in wagon.attachments])
        unit = np.zeros((len(wagon.attachments), 6))
        unit[:, axis] = 1.0
        q, *_ = np.linalg.lstsq(motions[:, : wagon.N_RIGID], unit.ravel())
        np.testing.assert_allclose(motions[:, : wagon.N_RIGID] @ q, unit.ravel(), atol=1e-12)
        assert q @ q == pytest.approx(MASS, rel=1e-12)


def test_elastic_modes_of_a_wagon_carry_no_momentum(road_train):
    for wagon in road_train.bodies:
        momentum = wagon.shapes[:, :3, wagon.N_RIGID :].mean(axis=0) * np.sqrt(MASS)
        # Its lumps weigh the same; shapes are kept in single precision.
        assert np.abs(momentum).max() < 1e-5


def test_wagons_hang_together_and_stand_on_the_ground(road_train):
    system = assemble(road_train)
    assert np.linalg.eigvalsh(system.stiffness)[0] > 0
