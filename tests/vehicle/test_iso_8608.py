"""Roads of ISO 8608: levels of the standard, isotropy by integrals and surfaces, a quarter car."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from scipy.integrate import quad
from small_vehicles import tyre, wheel

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.errors import VehicleError
from modeviz.ride.roads import road_spectrum
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.connections import Spring
from modeviz.vehicle.iso_8608 import (
    CLASSES,
    isotropic_coherence,
    named_road,
    rough_road,
    track_spectrum,
)
from modeviz.vehicle.loads import ResponsePoint, Roughness
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle

SPEED = 20.0


@pytest.mark.parametrize(
    ("name", "cubic_cm", "upper_limit", "per_radian"),
    [
        ("A", 16, 32, 1),
        ("B", 64, 128, 4),
        ("C", 256, 512, 16),
        ("D", 1024, 2048, 64),
        ("E", 4096, 8192, 256),
        ("F", 16384, 32768, 1024),
        ("G", 65536, 131072, 4096),
    ],
)
def test_a_class_has_the_levels_of_the_standard(name, cubic_cm, upper_limit, per_radian):
    """ISO 8608, annex C: geometric means, limits, and G_d(Ω₀) at 1 rad/m, printed rounded."""
    assert CLASSES[name] == pytest.approx(cubic_cm * 1e-6, rel=1e-12)
    following = CLASSES["BCDEFGH"["ABCDEFG".index(name)]]
    assert np.sqrt(CLASSES[name] * following) == pytest.approx(upper_limit * 1e-6, rel=1e-12)
    at_one_radian = track_spectrum(Roughness(CLASSES[name]), np.array([1 / (2 * np.pi)])) / (2 * np.pi)
    assert at_one_radian[0] == pytest.approx(per_radian * 1e-6, rel=0.006)


@pytest.mark.parametrize("waviness", [1.5, 2.0, 2.5, 3.0])
@pytest.mark.parametrize("n", [0.02, 0.2, 0.6])
def test_the_coherence_is_the_integral_of_an_isotropic_spectrum(waviness, n):
    """∫ Φ cos(2πmd) dm / ∫ Φ dm with Φ = (n² + m²)^(-(w+1)/2), by quadrature over m/n."""

    def surface(m):
        return (1 + m**2) ** (-(waviness + 1) / 2)

    distance = 1.6
    both, _ = quad(surface, 0, np.inf, weight="cos", wvar=2 * np.pi * n * distance, epsabs=1e-10)
    one, _ = quad(surface, 0, np.inf)
    assert isotropic_coherence(n, distance, waviness) == pytest.approx(both / one, abs=1e-6)


@pytest.mark.parametrize("waviness", [2.0, 2.6])
def test_two_lines_of_a_surface_alike_in_all_directions_have_its_coherence(waviness):
    """Surfaces of 256 m by 64 m made of random waves; their lines 1.5 m apart are averaged."""
    step, shape, distance = 0.25, (1024, 256), 6
    n, m = (np.fft.fftfreq(size, step) for size in shape)
    radius = np.hypot(n[:, None], m[None, :])
    radius[0, 0] = np.inf
    random = np.random.default_rng(3)
    power = cross = 0.0
    for _ in range(24):
        waves = random.standard_normal(shape) + 1j * random.standard_normal(shape)
        height = np.fft.ifft2(waves * radius ** (-(waviness + 1) / 2)).real
        lines = np.fft.fft(height, axis=0)
        power = power + (np.abs(lines) ** 2).mean(axis=1)
        cross = cross + (lines * np.roll(lines, distance, axis=1).conj()).mean(axis=1)
    seen = slice(13, 93)  # 0.05 to 0.36 cycles/m
    measured = (cross.real[seen] / power[seen]).reshape(-1, 4).mean(axis=1)
    theory = isotropic_coherence(n[seen], distance * step, waviness).reshape(-1, 4).mean(axis=1)
    assert np.abs(measured - theory).max() < 0.03
    assert np.abs(measured - theory).mean() < 0.015


def test_the_coherence_is_one_in_one_place_and_falls_with_the_track_width():
    n = np.geomspace(1e-4, 1e3, 200)
    assert (isotropic_coherence(n, 0.0, 2.0) == 1).all()
    by_width = np.array([isotropic_coherence(n, d, 2.0) for d in (0.01, 0.5, 1.0, 1.6, 2.5)])
    assert (np.diff(by_width, axis=0) <= 1e-12).all()
    assert by_width.max() <= 1
    assert by_width.min() >= 0


def test_the_coherence_falls_from_one_as_rough_surfaces_do_where_waves_are_long():
    """2x K₁(2x) = 1 + 2x² (ln x + γ - 1/2) + ... with x = πnd and Euler's γ."""
    x = np.array([1e-4, 1e-3, 1e-2])
    expected = 1 + 2 * x**2 * (np.log(x) + np.euler_gamma - 0.5)
    assert isotropic_coherence(x / np.pi, 1.0, 2.0) == pytest.approx(expected, abs=1e-6)


def test_where_the_spectrum_is_flat_the_coherence_is_that_of_such_a_surface():
    """Φ(q) = -(1/π) ∫ G'(n) (n² - q²)^(-1/2) dn from q up is the surface of a track spectrum G (Abel).

    Of G = n⁻² above 0.01 and flat below, it is 2/π ∫ (q² + u²)⁻² du from where n is 0.01.
    """
    flat, distance = 0.01, 1.6
    m = np.concatenate([[0], np.geomspace(1e-6, 20, 200_000)])
    road = rough_road("flat", "Flat", Roughness(1e-4, 2.0, distance))
    for n in (0.002, 0.005, 0.0095):
        q = np.hypot(n, m)
        u = np.sqrt(np.maximum(flat**2 - q**2, 0))
        surface = (np.arctan2(q, u) / q - u / (q**2 + u**2)) / q**2
        exact = np.trapezoid(surface * np.cos(2 * np.pi * m * distance), m) / np.trapezoid(surface, m)
        S = road_spectrum(road, np.array([n, 2 * n]), 1.0)[0]
        assert S[0, 1].real / S[0, 0].real == pytest.approx(exact, abs=3e-3)


def test_a_road_is_met_by_speed():
    """G(f) = G_d(f/V) / V, to the accuracy of its table in the coherence."""
    road = rough_road("C", "C", Roughness(CLASSES["C"], 2.3, 1.6))
    f = np.linspace(0.3, 50, 400)
    S = road_spectrum(road, f, SPEED)
    expected = 256e-6 * (f / SPEED / 0.1) ** -2.3 / SPEED
    assert S[:, 0, 0].real == pytest.approx(expected, rel=1e-9)
    ratio = S[:, 0, 1].real / expected
    assert np.abs(ratio - isotropic_coherence(f / SPEED, 1.6, 2.3)).max() < 1e-4


def quarter_car():
    """A body on spring and damper over a wheel on its tyre; nothing else moves."""
    low, high = wheel("wheel", y=-0.8), wheel("body", y=-0.8, mass=350.0)
    spring = Spring(
        "spring",
        "springs",
        ("body", "wheel"),
        np.zeros((2, 3)) + high.center_of_gravity,
        stiffness=np.array([0.0, 0.0, 2e4]),
        damping=np.array([0.0, 0.0, 1500.0]),
    )
    point = ResponsePoint("seat", "body", high.center_of_gravity)
    return Vehicle(
        "quarter car",
        (low, high),
        (tyre(low), spring),
        response_points=(point,),
        highest_frequency=200.0,
    )


def test_a_quarter_car_without_roads_shakes_as_white_noise_in_velocity_makes_it():
    """σ² = (W/2) [(M + m) k²/(M² c) + k_t c/M²] of the body's acceleration, W two-sided per Hz.

    At waviness 2 the road's velocity has the same spectrum everywhere, one-sided (2πn₀)² G_d(n₀) V. The
    integrals are those of D. E. Newland, "An introduction to random vibrations", appendix 1; what is
    left out below 0.1 Hz and above 200 Hz is 1.6e-5 of it each.
    """
    vehicle = quarter_car()
    big, small, k, c, k_tyre = 350.0, 40.0, 2e4, 1500.0, 2e5
    intensity = (2 * np.pi * 0.1) ** 2 * 256e-6 * SPEED / 2
    variance = intensity / 2 * ((big + small) * k**2 / (big**2 * c) + k_tyre * c / big**2)
    ride = solve(prepare(vehicle), {}, Conditions("ISO C", SPEED))
    assert ride.rms[0, 2] * STANDARD_GRAVITY == pytest.approx(np.sqrt(variance), rel=1e-4)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("ISO K", "expected a class from A to H, or G_d"),
        ("ISO 100", "without a unit"),
        ("ISO -3 cm³", "expected more than 0"),
        ("ISO C, waviness 9", "waviness: found 9, expected 1.2 to 4"),
        ("ISO C waviness high", "expected a number"),
    ],
)
def test_a_name_that_means_no_road_is_told_what_would(name, words):
    with pytest.raises(VehicleError, match=f"road '{name}'.*{words}"):
        named_road(name, 1.6)


@pytest.mark.parametrize(
    "name", ["ISO C", "iso 8608 c", "ISO-8608 256 cm³", "ISO 256e-6 m^3, waviness 2"]
)
def test_a_road_has_several_names(name):
    road = named_road(name, 1.6)
    assert road is not None
    assert road.roughness is not None
    assert road.roughness.level == pytest.approx(256e-6)


def test_the_track_width_is_that_of_the_tyres():
    wheels = [wheel(f"{x} {y}", x, y) for x, y in ((0, -0.8), (0, 0.8), (2.6, -0.7), (2.6, 0.7))]
    vehicle = Vehicle("cart", tuple(wheels), tuple(map(tyre, wheels)))
    road = vehicle.usual_load
    assert road is not None
    assert road.roughness.track_width == pytest.approx(1.5)
    assert [load.name for load in vehicle.offered_loads] == [f"ISO {name}" for name in "ABCDEFGH"]


def test_without_tyres_no_road_is_offered():
    vehicle = Vehicle("stone", (wheel("stone"),), ())
    assert vehicle.usual_load is None
    assert not vehicle.offered_loads


def test_a_problem_names_roads_of_iso_8608_without_a_table():
    def with_road(name):
        shaken = Performance(np.array([8.0]), roads=(name,))
        problem = Problem("ride", (DesignGroup("A"),), (shaken,))
        return replace(mounted_cabin(), roads=(), problems=(problem,))

    assert with_road("ISO C").problems[0].performance[0].roads == ("ISO C",)
    with pytest.raises(VehicleError, match="problem 'ride': road 'ISO X': found 'X', expected a class"):
        with_road("ISO X")
