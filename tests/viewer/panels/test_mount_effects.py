from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from tuned_vehicle import tuned_vehicle

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.sensitivity import sensitivity
from modeviz.viewer.panels.mounts.effects import Effect, effects, in_a_sentence

FLAT = Conditions("flat", 20.0)
PART = 1e-3
"""Of a rate: small enough for first order, large enough for rounding."""


def test_ten_percent_do_a_hundred_times_what_a_thousandth_does():
    vehicle, mode = mounted_cabin(), 8
    prepared = prepare(vehicle)
    base = solve(prepared, {}, FLAT)
    found = effects(vehicle, sensitivity(prepared, base), mode)
    assert len(found) == 6
    for (group, field), effect in found.items():
        own = vehicle.rates[group]
        softer, stiffer = (
            solve(prepared, {group: replace(own, **{field: getattr(own, field) * factor})}, FLAT)
            for factor in (1 - PART, 1 + PART)
        )
        by_ten_percent = 0.1 / (2 * PART)
        hz = (stiffer.modes.frequency_hz - softer.modes.frequency_hz)[mode]
        assert effect.frequency_hz == pytest.approx(by_ten_percent * hz, rel=1e-4, abs=1e-7)
        x_y_z = 100 * by_ten_percent * (stiffer.rms - softer.rms)[0] / base.rms[0]
        assert effect.lateral_percent == pytest.approx(x_y_z[1], rel=1e-3, abs=1e-5)
        assert effect.vertical_percent == pytest.approx(x_y_z[2], rel=1e-3, abs=1e-5)


def test_ten_percent_of_a_damper_are_told_by_what_they_do_to_the_damping_ratio():
    vehicle = replace(tuned_vehicle(), highest_frequency=20.0, frequency_step=1.0)
    road = replace(mounted_cabin().roads[0], spectrum=mounted_cabin().roads[0].spectrum)
    vehicle = replace(vehicle, roads=(road,))
    prepared = prepare(vehicle)
    base = solve(prepared, {}, Conditions(road.name, 20.0))
    mode = int(np.flatnonzero(base.modes.frequency_hz > 1.0)[0])
    found = effects(vehicle, sensitivity(prepared, base), mode)
    own, damper = vehicle.rates["S"], found["S", "damping_vertical"]
    firmer = replace(own, damping_vertical=1.1 * own.damping_vertical)
    more = solve(prepared, {"S": firmer}, Conditions(road.name, 20.0))
    change = (more.modes.damping_ratio - base.modes.damping_ratio)[mode]
    assert abs(change) > 1e-4
    assert damper.damping_ratio == pytest.approx(change, rel=1e-9)
    assert damper.frequency_hz == 0
    assert f"roll ζ {100 * change:+.2f} %" in in_a_sentence(damper, "roll")
    assert found["E", "vertical"].damping_ratio is None


def test_without_a_response_point_nothing_is_said_of_what_is_felt():
    vehicle = replace(mounted_cabin(), response_points=())
    prepared = prepare(vehicle)
    found = effects(vehicle, sensitivity(prepared, solve(prepared, {}, FLAT)), 8)
    effect = found["A", "vertical"]
    assert (effect.lateral_percent, effect.vertical_percent) == (None, None)
    assert in_a_sentence(replace(effect, frequency_hz=0.123), "roll") == "+10 %: roll +0.12 Hz."


def test_an_effect_is_said_with_true_signs():
    assert (
        in_a_sentence(Effect(0.123, -1.44, 0.0), "cab yaw")
        == "+10 %: cab yaw +0.12 Hz, lateral RMS −1.4 %, vertical RMS 0.0 %."
    )
