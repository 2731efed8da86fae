from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin, twisted_cabin
from rounding import EPSILON

from modeviz.analysis.preparation import prepare_modes
from modeviz.errors import VehicleError
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.vehicle.mount_rates import MountRates

RATES = {"A": MountRates(2e5, 1e5, 3e5, loss_factor=0.4)}
TOLERANCE = Tolerance(0.1, 0.5)


@pytest.fixture(scope="module")
def prepared():
    return prepare_modes(mounted_cabin())


@pytest.fixture(scope="module")
def parts(prepared):
    return scattered_parts(prepared, RATES, TOLERANCE)


def test_parts_as_drawn_have_the_rates_of_their_groups(prepared, parts):
    expected = prepared.mount_stiffness(RATES)
    np.testing.assert_allclose(parts.stiffness(np.zeros(8)), expected, rtol=8 * EPSILON)


def test_a_harder_mount_has_all_its_rates_higher_and_no_other_mount_changes(parts):
    drawn = parts.stiffness(np.zeros(8))
    ratio = parts.stiffness(np.eye(8)[1]) / drawn
    assert parts.names[1] == "A 0.5"
    np.testing.assert_allclose(ratio[3:6], 1.1, rtol=1e-12)
    np.testing.assert_allclose(np.delete(ratio, [3, 4, 5]), 1, rtol=1e-12)


def test_tuned_dampers_are_as_drawn_however_hard_the_rubber():
    vehicle = mounted_cabin()
    group = vehicle.mount_groups[0]
    softest, stiffest = (
        replace(b, damping_vertical=c) for b, c in zip(group.bounds, (50, 5e3), strict=True)
    )
    damped = replace(
        group, rates=replace(group.rates, damping_vertical=500.0), bounds=(softest, stiffest)
    )
    prepared = prepare_modes(replace(vehicle, mount_groups=(damped, *vehicle.mount_groups[1:])))
    parts, are_dampers = scattered_parts(prepared, {}, TOLERANCE), prepared.basis.law.are_dampers
    deviations = np.ones(parts.n_deviations)
    ratio = parts.stiffness(deviations)[are_dampers] / 500.0
    np.testing.assert_allclose(ratio, np.ones(len(group.mounts)), rtol=8 * EPSILON)
    assert not parts.slopes(deviations)[are_dampers].any()


def test_a_mount_of_more_loss_is_as_stiff(parts):
    drawn = parts.stiffness(np.zeros(8))
    changed = parts.stiffness(np.eye(8)[4])
    np.testing.assert_allclose(changed.real, drawn.real, rtol=8 * EPSILON)
    np.testing.assert_allclose(changed[:3].imag, 1.5 * 0.4 * drawn[:3].real, rtol=1e-12)
    np.testing.assert_allclose(changed[3:], drawn[3:], rtol=8 * EPSILON)


def test_springs_about_an_axis_go_with_their_mount():
    parts = scattered_parts(prepare_modes(twisted_cabin()), RATES, TOLERANCE)
    ratio = parts.stiffness(np.eye(8)[1]) / parts.stiffness(np.zeros(8))
    assert len(ratio) == 16
    np.testing.assert_allclose(ratio[[3, 4, 5, 14, 15]], 1.1, rtol=1e-12)
    np.testing.assert_allclose(np.delete(ratio, [3, 4, 5, 14, 15]), 1, rtol=1e-12)


def test_slopes_are_differences(parts):
    at = parts.samples(1, 3)[0]
    differences = [
        (parts.stiffness(at + 1e-4 * unit) - parts.stiffness(at - 1e-4 * unit)) / 2e-4
        for unit in np.eye(8)
    ]
    np.testing.assert_allclose(parts.slopes(at), np.transpose(differences), rtol=1e-9, atol=1e-3)


def test_samples_fill_every_slice_of_every_deviation_once(parts):
    samples = parts.samples(50, 1)
    assert samples.shape == (50, 8)
    slices = np.sort(np.floor((samples + 1) * 25), axis=0)
    np.testing.assert_array_equal(slices, np.tile(np.arange(50.0)[:, None], 8))


def test_a_seed_repeats_its_samples(parts):
    np.testing.assert_array_equal(parts.samples(9, 4), parts.samples(9, 4))
    assert not np.array_equal(parts.samples(9, 4), parts.samples(9, 5))


@pytest.mark.parametrize("value", [1.0, -0.1, np.nan])
@pytest.mark.parametrize("name", ["rates", "loss_factor"])
def test_a_tolerance_that_is_no_fraction_is_an_error(name, value):
    with pytest.raises(VehicleError, match=rf"tolerance of {name.replace('_', ' ')}: found {value:g}"):
        Tolerance(**{name: value})


def test_what_has_no_tolerance_is_as_drawn(prepared):
    drawn = prepared.mount_stiffness({})
    (d,) = scattered_parts(prepared, {}, Tolerance()).samples(1, 0)
    soft = scattered_parts(prepared, {}, Tolerance(0.2, 0.0)).stiffness(d)
    np.testing.assert_allclose(soft.imag / soft.real, drawn.imag / drawn.real, rtol=1e-12)
    assert (soft.real != drawn.real).all()
    lossy = scattered_parts(prepared, {}, Tolerance(0.0, 0.2)).stiffness(d)
    np.testing.assert_allclose(lossy.real, drawn.real, rtol=1e-12)
    assert (lossy.imag != drawn.imag).all()


def test_nothing_that_scatters_is_an_error():
    with pytest.raises(VehicleError, match="tolerance: found 0 for all, which scatters nothing"):
        Tolerance(0.0, 0.0)
