"""Absorbers tuned to a mode of a vehicle, and what their rates do to it."""

import numpy as np
import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.absorbers import effective_mass, tuned_absorber
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rigid import main_bodies, usual_body
from modeviz.errors import VehicleError
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Spring
from modeviz.vehicle.vehicle import Vehicle

SEAT = np.array([1.2, -0.4, 0.9])


@pytest.fixture(scope="module")
def cabin():
    return solve_modal(prepare_modes(mounted_cabin()), {})


def test_the_effective_mass_of_one_mass_on_a_spring_is_its_own():
    spring = Spring(
        "spring", "springs", ("main", GROUND), np.zeros((2, 3)), np.array([1e4, 2e4, 4e5]),
        rigid=("rx", "ry", "rz"),
    )  # fmt: skip
    body = RigidBody("main", "cabin", "main", 100.0, np.zeros(3), np.eye(3))
    results = solve_modal(prepare_modes(Vehicle("v", (body,), (spring,))), {})
    found = effective_mass(results, 2, "main", np.zeros(3), ("vertical",))
    assert found == pytest.approx(100.0)
    assert effective_mass(results, 2, "main", np.zeros(3), ("lateral", "vertical")) == found
    assert effective_mass(results, 2, "main", np.zeros(3), ("lateral",)) == np.inf
    absorber = tuned_absorber(results, 2, "a", "main", np.zeros(3), 5.0)
    f = np.sqrt(4e5 / 100) / (2 * np.pi)
    assert absorber.frequency_hz == pytest.approx(f / 1.05)
    # c/(2 m Ω) = √(3μ/(8 (1 + μ)³)) with Ω of the main mass, as a fraction of critical at f/(1 + μ)
    damping = 2 * 5.0 * 2 * np.pi * f * np.sqrt(3 * 0.05 / (8 * 1.05**3))
    assert absorber.damping == pytest.approx(damping)
    with pytest.raises(VehicleError, match="hardly moves 'main' there along lateral"):
        tuned_absorber(results, 2, "a", "main", np.zeros(3), 5.0, ("lateral",))


def test_an_absorber_has_modes_of_its_name_and_is_no_body_to_look_at(cabin):
    absorber = tuned_absorber(cabin, 8, "roof", "cab", SEAT, 6.0)
    vehicle = with_absorbers(mounted_cabin(), [absorber])
    found = solve_modal(prepare_modes(vehicle), {})
    assert "roof bounce" in [name.name for name in found.names]
    assert main_bodies(vehicle) == main_bodies(mounted_cabin())
    assert usual_body(vehicle) == usual_body(mounted_cabin())
