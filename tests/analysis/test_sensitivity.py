from dataclasses import replace

import numpy as np
import pytest
from differences import central_difference, relative_to_largest
from mounted_cabin import mounted_cabin, twisted_cabin

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.sensitivity import (
    RateVariable,
    frequency_sensitivity,
    rate_variables,
    ride_sensitivity,
    spring_shares,
)
from modeviz.vehicle.mount_rates import STIFFNESS_FIELDS, MountRates

FLAT = Conditions("flat", 20.0)
RATES = {"A": MountRates(2e5, 1e5, 3e5, loss_factor=0.4), "B": MountRates(9e5, 4e5, 2e5)}


@pytest.fixture(scope="module")
def prepared():
    return prepare(twisted_cabin(), np.linspace(0.5, 40, 80))


def differences(function):
    """∂ of a function of rates by each of A's and B's, the last axis."""
    every = [
        central_difference(
            lambda rate, g=group, n=name: function({**RATES, g: replace(RATES[g], **{n: rate})}),
            getattr(RATES[group], name),
            step=1e-3,
        )
        for group in RATES
        for name in STIFFNESS_FIELDS
    ]
    return np.stack(every, axis=-1)


def test_variables_are_every_rate_of_every_group():
    assert rate_variables(mounted_cabin()) == tuple(
        RateVariable(g, n) for g in "AB" for n in STIFFNESS_FIELDS
    )


def test_shares_are_how_spring_rates_follow_the_variables(prepared):
    for i, variable in enumerate(rate_variables(prepared.vehicle)):
        more = getattr(RATES[variable.group], variable.direction) + 1.0
        changed = {
            **RATES,
            variable.group: replace(RATES[variable.group], **{variable.direction: more}),
        }
        change = prepared.mount_stiffness(changed) - prepared.mount_stiffness(RATES)
        np.testing.assert_allclose(spring_shares(prepared, RATES)[:, i], change, atol=1e-9)


def test_derivatives_of_frequencies_are_central_differences(prepared):
    found = frequency_sensitivity(solve_modal(prepared, RATES))
    expected = differences(lambda rates: solve_modal(prepared, rates, "exact").modes.frequency_hz)
    assert relative_to_largest(found, expected, over=1).max() < 1e-6


def test_derivatives_of_the_psd_are_central_differences(prepared):
    found = ride_sensitivity(prepared, RATES, FLAT).psd
    expected = differences(lambda rates: solve(prepared, rates, FLAT).psd)
    assert relative_to_largest(found, expected, over=3).max() < 1e-6


def test_derivatives_of_the_rms_are_central_differences(prepared):
    found = ride_sensitivity(prepared, RATES, FLAT).rms
    expected = differences(lambda rates: solve(prepared, rates, FLAT).rms)
    assert relative_to_largest(found, expected, over=2).max() < 1e-6


def test_what_moves_freely_has_no_derivative():
    loose = {g: MountRates(0.0, 0.0, 0.0) for g in "AB"}
    modal = solve_modal(prepare_modes(mounted_cabin()), loose)
    assert (modal.modes.frequency_hz[:6] < 1e-3).all()
    np.testing.assert_array_equal(frequency_sensitivity(modal)[:6], 0)


def test_what_stands_still_has_no_derivative():
    free = replace(mounted_cabin(), connections=(), wheel_loads=())
    sensitivity = ride_sensitivity(prepare(free, np.array([1.0, 2.0])), {}, FLAT)
    np.testing.assert_array_equal(sensitivity.rms, 0)


def test_a_vehicle_without_mounts_has_no_derivatives():
    bare = replace(mounted_cabin(), mount_groups=(), rate_sets={})
    prepared = prepare(bare, np.array([1.0, 2.0]))
    assert ride_sensitivity(prepared, {}, FLAT).psd.shape == (2, 1, 3, 0)
    assert frequency_sensitivity(solve_modal(prepared, {})).shape == (12, 0)
