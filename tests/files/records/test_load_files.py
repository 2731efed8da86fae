"""Forces and motions of the ground in a vehicle's folder."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.files import read_vehicle
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.loads import Spectrum

VEHICLE = """
name = "block"
{axes}
[units]
length = "mm"
mass = "kg"
inertia = "kg m²"
stiffness = "N/mm"
force = "kN"
acceleration = "g"
[[rigid_body]]
name = "block"
mass = 10.0
center_of_gravity = [0.0, 0.0, 0.0]
inertia = [1.0, 1.0, 1.0]
[[spring]]
name = "foot"
bodies = ["block", "ground"]
at = [0.0, 0.0, 0.0]
stiffness = [100.0, 100.0, 100.0]
"""
FORCE = """
[[force]]
name = "shaker"
body = "block"
at = [100.0, 200.0, 300.0]
direction = {direction}
{amplitude}
"""
MOTION = """
[[base_motion]]
name = "floor"
direction = "lateral"
{amplitude}
"""


@pytest.fixture
def read(tmp_path):
    """The vehicle with some more tables, and a spectrum beside it."""

    def read(tables, axes=""):
        text = VEHICLE.format(axes=axes) + tables
        (tmp_path / "vehicle.toml").write_text(text, encoding="utf-8")
        (tmp_path / "psd.csv").write_text("frequency_hz,psd\n0.5,4.0\n50.0,9.0\n", encoding="utf-8")
        return read_vehicle(tmp_path)

    return read


@pytest.mark.parametrize(
    ("direction", "expected"),
    [('"vertical"', (0, 0, 1)), ('"lateral"', (0, 1, 0)), ('"fore-aft"', (1, 0, 0)),
     ("[0.0, 3.0, 4.0]", (0, 0.6, 0.8))],
)  # fmt: skip
def test_a_force_acts_along_a_direction_or_a_vector(read, direction, expected):
    (force,) = read(FORCE.format(direction=direction, amplitude="amplitude = 0.02")).forces
    np.testing.assert_allclose(force.direction, expected)
    np.testing.assert_allclose(force.position, (0.1, 0.2, 0.3))
    assert force.amplitude == pytest.approx(20.0)


def test_a_vector_and_a_place_turn_with_the_axes(read):
    tables = FORCE.format(direction="[1.0, 1.0, 0.0]", amplitude="amplitude = 1.0")
    (force,) = read(tables, 'axes = "x forward, y left, z up"').forces
    np.testing.assert_allclose(force.direction, -np.array([1, 1, 0]) / np.sqrt(2))
    np.testing.assert_allclose(force.position, (-0.1, -0.2, 0.3))


@pytest.mark.parametrize(
    ("key", "unit"),
    [("displacement_psd", 1e-3), ("acceleration_psd", STANDARD_GRAVITY)],
)
def test_a_spectrum_has_the_square_of_its_unit(read, key, unit):
    (motion,) = read(MOTION.format(amplitude=f'{key} = "psd.csv"')).base_motions
    assert isinstance(motion.amplitude, Spectrum)
    np.testing.assert_allclose(motion.amplitude.power, np.array([4.0, 9.0]) * unit**2)
    assert motion.quantity == key.removesuffix("_psd")


@pytest.mark.parametrize(("key", "unit"), [("displacement", 1e-3), ("acceleration", STANDARD_GRAVITY)])
def test_a_peak_has_its_unit(read, key, unit):
    (motion,) = read(MOTION.format(amplitude=f"{key} = 0.5")).base_motions
    assert (motion.quantity, motion.amplitude) == (key, pytest.approx(0.5 * unit))


@pytest.mark.parametrize(
    ("tables", "words"),
    [
        (
            FORCE.format(direction='"vertical"', amplitude=""),
            r"force\[0\]: found none, expected one of",
        ),
        (
            FORCE.format(direction='"vertical"', amplitude='amplitude = 1.0\npsd = "psd.csv"'),
            "found amplitude and psd, expected one of amplitude, psd",
        ),
        (FORCE.format(direction='"up"', amplitude="amplitude = 1.0"), "force"),
        (FORCE.format(direction="[0.0, 0.0, 0.0]", amplitude="amplitude = 1.0"), "three zeros"),
        (MOTION.format(amplitude="displacement = -1.0"), "displacement"),
        (MOTION.format(amplitude='displacement_psd = "none.csv"'), r"none\.csv"),
        (MOTION.format(amplitude='displacement_psd = "../psd.csv"'), r"displacement_psd"),
        (
            MOTION.format(amplitude='displacement = 1.0\nconnections = ["feet"]'),
            "unknown connection to the ground 'feet': there are foot",
        ),
    ],
)
def test_what_is_no_load_is_refused(read, tables, words):
    with pytest.raises(VehicleError, match=words):
        read(tables)
