"""Operating shapes held against the spectra on the screen and against plain solves."""

from dataclasses import replace

import numpy as np
import pytest
from builtin_truck import builtin_truck
from full_solutions import wheel_forces
from mounted_cabin import mounted_cabin

from modeviz.analysis.deflection_shapes import road_shape, wheel_shape
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import AXIS, Conditions, Results, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.errors import SolveError, VehicleError
from modeviz.ride.roads import road_spectrum, track_forces
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.loads import ResponsePoint, Road
from modeviz.vehicle.mount_rates import MountRates

F = np.array([1.3, 8.0, 11.0, 23.7])
RATES = {"A": MountRates(2e5, 1e5, 1e5)}


@pytest.fixture(scope="module")
def cabin() -> Results:
    return solve(prepare(mounted_cabin(), F), RATES, Conditions("flat", 20.0))


@pytest.fixture(scope="module")
def truck() -> Results:
    vehicle = builtin_truck()
    prepared = prepare(vehicle, np.array([2.1, 8.6, 11.7, 30.0]))
    return solve(prepared, vehicle.rate_sets["optimised"], Conditions("road 1", vehicle.speed))


@pytest.fixture(params=["cabin", "truck"])
def results(request) -> Results:
    return request.getfixturevalue(request.param)


def acceleration_g(results: Results, shape: np.ndarray, line: int) -> np.ndarray:
    """Of x, y, z at every response point, (n_points, 3), complex."""
    omega = 2 * np.pi * results.frequency_hz[line]
    return (results.prepared.outputs @ shape).reshape(-1, 3) * omega**2 / STANDARD_GRAVITY


def test_the_road_shape_squared_is_the_psd_on_the_screen(results):
    for line, f in enumerate(results.frequency_hz):
        for point in range(len(results.vehicle.response_points)):
            for direction, axis in AXIS.items():
                shape = road_shape(results, f, point, direction)
                there = acceleration_g(results, shape, line)[point, axis]
                psd = results.response(point, direction)[line]
                assert there.real > 0
                assert there**2 == pytest.approx(psd, rel=1e-9)


def test_the_wheel_shape_is_the_harmonic_response(results):
    found = solve_wheels(results.prepared, results.rates).acceleration_g
    for line, f in enumerate(results.frequency_hz):
        for i, load in enumerate(results.vehicle.wheel_loads):
            there = np.abs(acceleration_g(results, wheel_shape(results, load.name, f), line))
            np.testing.assert_allclose(there, found[line, i], rtol=1e-9, atol=1e-9 * there.max())


def test_all_coordinates_move_as_a_plain_solve_says(results):
    f = results.frequency_hz[2:3]
    system = assemble(results.vehicle)
    omega = 2 * np.pi * f[0]
    Z = system.stiffness + 1j * system.structural_damping - omega**2 * system.mass
    flexibility = np.linalg.inv(Z + 1j * omega * system.damping)

    forces = wheel_forces(system, system.vehicle.wheel_loads[:1], f)[0, :, 0]
    expected = flexibility @ forces
    shape = wheel_shape(results, system.vehicle.wheel_loads[0].name, f[0])
    np.testing.assert_allclose(shape, expected, rtol=0, atol=1e-9 * np.abs(expected).max())

    H = flexibility @ track_forces(system, f, results.conditions.speed)[0]
    S = road_spectrum(results.drive.load, f, results.conditions.speed)[0]
    seat = system.vehicle.response_points[0]
    row = system.motion(seat.body, seat.position)[AXIS["lateral"]]
    G = H @ S @ H.conj().T
    expected = G @ row / np.sqrt((row @ G @ row).real)
    shape = road_shape(results, f[0], 0, "lateral")
    np.testing.assert_allclose(shape, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("frequency_hz", [0.0, -8.0, 1.2, 23.8, np.nan, np.inf])
def test_a_frequency_out_of_the_band_is_an_error(cabin, frequency_hz):
    for ask in (
        lambda: road_shape(cabin, frequency_hz, 0, "vertical"),
        lambda: wheel_shape(cabin, "front left radial force", frequency_hz),
    ):
        with pytest.raises(SolveError, match=r"operating shape: found .* expected 1\.3 to 23\.7 Hz"):
            ask()


def test_a_load_that_is_not_there_is_an_error(cabin):
    with pytest.raises(VehicleError, match=r"unknown harmonic load 'moon'.*front left radial force"):
        wheel_shape(cabin, "moon", 8.0)


def test_a_symmetric_vehicle_on_equal_tracks_has_no_lateral_reference():
    cabin = mounted_cabin()
    body = cabin.bodies[0]
    middle = replace(body, center_of_gravity=body.center_of_gravity * [1, 0, 1])
    seat = ResponsePoint("seat", "cab", np.array([1.2, 0.0, 0.9]))
    equal = Road("flat", "Flat", 20.0, np.array([0.1, 60.0]), np.ones((2, 2, 2)))
    vehicle = replace(cabin, bodies=(middle, cabin.bodies[1]), response_points=(seat,), roads=(equal,))
    results = solve(prepare(vehicle, F), {}, Conditions("flat", 20.0))
    with pytest.raises(SolveError, match="the reference does not move"):
        road_shape(results, 8.0, 0, "lateral")
    road_shape(results, 8.0, 0, "vertical")
