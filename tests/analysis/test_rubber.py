"""Rates over frequency as they are drawn: those that responses take, and the lines of tables."""

from dataclasses import replace

import numpy as np
import pytest
from dynamic_mounts import HYDRAULIC, MAXWELL, OTHER_RATES, constant, measured, on_mounts

from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.rubber import about_rubber, dynamic_groups, measured_points, rubber_curve
from modeviz.vehicle.mount_rates import MountRates

F = np.array([1.0, 3.0, 8.5, 21.0])


def test_the_curve_is_the_formula_scaled_to_the_rates_at_the_reference():
    prepared = prepare_modes(on_mounts(HYDRAULIC))
    found = rubber_curve(prepared, {"E": OTHER_RATES}, "E", F)
    raw = HYDRAULIC.complex_rates(F)
    at_reference = HYDRAULIC.complex_rates(np.array([3.0]))[0].real
    expected = np.array(OTHER_RATES.local()) * raw / at_reference
    np.testing.assert_allclose(found.rates, expected, rtol=1e-12)
    np.testing.assert_allclose(found.stiffness[1] ** 2, np.abs(expected[1]) ** 2, rtol=1e-12)
    np.testing.assert_allclose(np.tan(found.loss_angle), expected.imag / expected.real, rtol=1e-12)


def test_lines_of_a_table_lie_on_the_curve_and_scale_with_the_rates():
    table = measured(MAXWELL, 13)
    prepared = prepare_modes(on_mounts(table))
    twice = MountRates(520e3, 360e3, 300e3)
    points = measured_points(prepared, {"E": twice}, "E")
    np.testing.assert_array_equal(points.frequency_hz, table.frequency_hz)
    curve = rubber_curve(prepared, {"E": twice}, "E", table.frequency_hz)
    np.testing.assert_allclose(points.rates, curve.rates, rtol=1e-12)
    own = measured_points(prepared, {}, "E")
    np.testing.assert_allclose(points.rates, 2 * own.rates, rtol=1e-12)
    assert measured_points(prepare_modes(on_mounts(MAXWELL)), {}, "E") is None


def test_rates_that_no_frequency_changes_are_straight():
    vehicle = on_mounts(constant(0.1))
    feet = replace(vehicle.mount_groups[1], dynamic=None)
    prepared = prepare_modes(replace(vehicle, mount_groups=(vehicle.mount_groups[0], feet)))
    assert [group.name for group in dynamic_groups(prepared.vehicle)] == ["E"]
    for group in ("E", "F"):
        curve = rubber_curve(prepared, {}, group, F)
        np.testing.assert_allclose(curve.rates, np.tile(curve.rates[0], (4, 1)), rtol=1e-12)


@pytest.mark.parametrize(
    ("rubber", "words"),
    [
        (measured(MAXWELL), "Points: its table, scaled"),
        (replace(measured(MAXWELL), amplitude=2e-4), "Points: its table at 0.2 mm, scaled"),
        (HYDRAULIC, "A hydraulic mount, scaled"),
        (MAXWELL, "A three-parameter rubber, scaled"),
    ],
)
def test_it_is_said_what_the_curve_is_made_of(rubber, words):
    assert about_rubber(on_mounts(rubber).mount_groups[0]).startswith(words)
