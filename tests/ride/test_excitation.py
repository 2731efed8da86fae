from dataclasses import replace

import numpy as np
import pytest
from shaken_blocks import (
    DASHPOT,
    FLAT,
    MASS,
    RATE,
    UP,
    F,
    shaken_block,
    softer,
    stiffness_of,
    vertical_peaks,
)
from small_vehicles import tyre, wheel

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.wheel_peaks import wheel_peaks
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.errors import VehicleError
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.loads import BaseMotion, Force, ResponsePoint, Road, Spectrum
from modeviz.vehicle.vehicle import Vehicle


@pytest.mark.parametrize("rate", [RATE, 4e4, 9e5])
def test_a_shaken_ground_is_transmitted_as_the_textbook_says_at_any_rate(rate):
    z = 1e-3
    found = vertical_peaks(shaken_block(BaseMotion("shaker", UP, "displacement", z)), softer(rate))
    omega, k = 2 * np.pi * F, stiffness_of(rate, F)
    expected = np.abs(k / (k - MASS * omega**2)) * z * omega**2
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-9)


def test_a_ground_acceleration_is_the_displacement_twice_differentiated():
    loads = (
        BaseMotion("by displacement", UP, "displacement", 1e-3),
        BaseMotion("by acceleration", UP, "acceleration", 1.0),
    )
    by_displacement, by_acceleration = vertical_peaks(shaken_block(*loads)).T
    expected = by_displacement / (1e-3 * (2 * np.pi * F) ** 2)
    np.testing.assert_allclose(by_acceleration, expected, rtol=1e-12)


def test_only_the_named_connections_are_shaken():
    z = 1e-3
    found = vertical_peaks(shaken_block(BaseMotion("shaker", UP, "displacement", z, ("dashpot",))))
    omega = 2 * np.pi * F
    expected = np.abs(1j * omega * DASHPOT / (stiffness_of(RATE, F) - MASS * omega**2)) * z * omega**2
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-9)


def test_a_force_acts_along_its_direction_at_any_rate():
    slanted = Force("slanted", "block", np.zeros(3), np.array([0.0, 3.0, 4.0]), 10.0)
    found = vertical_peaks(shaken_block(slanted), softer(5e5))
    omega = 2 * np.pi * F
    expected = 8.0 * omega**2 / np.abs(stiffness_of(5e5, F) - MASS * omega**2)
    np.testing.assert_allclose(found[:, 0], expected, rtol=1e-9)


@pytest.mark.parametrize(
    "load",
    [
        Force("random", "block", np.zeros(3), UP, FLAT),
        BaseMotion("random", UP, "acceleration", FLAT),
        BaseMotion("random", UP, "displacement", FLAT),
    ],
    ids=lambda load: f"{type(load).__name__} {getattr(load, 'quantity', '')}",
)
def test_a_random_load_has_the_spectrum_of_its_transfer(load):
    prepared = prepare(shaken_block(load))
    found = solve(prepared, softer(6e4), Conditions("random", 20.0)).response(0, "vertical")
    omega, k = 2 * np.pi * F, stiffness_of(6e4, F)
    transfer = 1 / (k - MASS * omega**2)
    if isinstance(load, BaseMotion):
        transfer = transfer * k / (omega**2 if load.quantity == "acceleration" else 1)
    expected = np.abs(omega**2 * transfer) ** 2 * 2e-3 / STANDARD_GRAVITY**2
    np.testing.assert_allclose(found, expected, rtol=1e-9)


def test_a_spectrum_is_a_power_law_between_its_values():
    table = Spectrum(np.array([0.1, 1.0, 50.0]), np.array([4.0, 1e-2, 1e-2]))
    vehicle = shaken_block(Force("random", "block", np.zeros(3), UP, table))
    found = solve(prepare(vehicle), {}, Conditions("random", 20.0)).drive.spectrum_at(F)[:, 0, 0]
    np.testing.assert_allclose(found[F == 0.2], 4.0 * 2 ** np.log10(1e-2 / 4.0), rtol=1e-9)
    np.testing.assert_allclose(found[F == 20.0], 1e-2, rtol=1e-12)


def coherent_road():
    """Both tracks the same, met by all wheels at once as fast as it is driven."""
    f = np.array([0.05, 100.0])
    return Road("even", "even", 1e9, f, np.full((2, 2, 2), 1e-4, complex))


def test_shaking_all_tyres_is_driving_over_both_tracks_at_once():
    wheels = wheel("left", y=-0.7), wheel("right", y=0.7)
    tyres = tuple(
        tyre(w, stiffness=np.array([1e4, 2e4, 2e5]), damping=np.full(3, 90.0)) for w in wheels
    )
    vehicle = Vehicle(
        "axle", wheels, tyres, roads=(coherent_road(),), speed=1e9,
        base_motions=(BaseMotion("posts", UP, "displacement", Spectrum([0.05, 100.0], [1e-4, 1e-4])),),
        response_points=(ResponsePoint("hub", "left", wheels[0].center_of_gravity),),
    )  # fmt: skip
    prepared = prepare(vehicle)
    on_road, on_posts = (solve(prepared, {}, Conditions(n, 1e9)).psd for n in ("even", "posts"))
    np.testing.assert_allclose(on_posts, on_road, rtol=1e-9, atol=1e-12 * on_road.max())


def test_the_modes_of_a_peak_are_those_that_the_load_makes():
    vehicle = shaken_block(BaseMotion("shaker", UP, "displacement", 1e-3))
    prepared = prepare(replace(vehicle, roads=(coherent_road(),)))
    results = solve(prepared, {}, Conditions("even", 1e9))
    (peak, *_) = wheel_peaks(results, solve_wheels(prepared, {}), 0, 0, "vertical")
    bounce = np.sqrt(RATE / MASS) / (2 * np.pi)
    assert results.modes.frequency_hz[peak.contributors[0].mode] == pytest.approx(bounce, rel=1e-6)


@pytest.mark.parametrize(
    ("load", "words"),
    [
        (
            BaseMotion("b", UP, "displacement", 1.0, ("turn",)),
            "connection to the ground 'turn'",
        ),
        (Force("f", "bloc", np.zeros(3), UP, 1.0), "unknown body 'bloc'"),
    ],
)
def test_a_load_on_what_is_not_there_is_refused(load, words):
    with pytest.raises(VehicleError, match=words):
        shaken_block(load)


def test_loads_that_are_none_are_refused():
    with pytest.raises(VehicleError, match="force 'f': direction: found three zeros"):
        Force("f", "block", np.zeros(3), np.zeros(3), 1.0)
    with pytest.raises(VehicleError, match="amplitude: found -1"):
        BaseMotion("b", UP, "displacement", -1.0)
    with pytest.raises(VehicleError, match="psd: found -2, expected no negative power"):
        Spectrum(np.array([1.0, 2.0]), np.array([1.0, -2.0]))
