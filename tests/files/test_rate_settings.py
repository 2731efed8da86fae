"""Mount rates as people name them."""

from dataclasses import replace

import pytest
from folders import one_of_everything

from modeviz.errors import VehicleError
from modeviz.files.rate_files import write_rates
from modeviz.files.rate_settings import parse_setting, resolve_rates
from modeviz.vehicle.mount_rates import MountRates

VEHICLE = one_of_everything()
RATES = VEHICLE.rates["C1"]


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("C1.lateral=131 N/mm", MountRates(RATES.vertical, 131e3, RATES.fore_aft)),
        ("C1.vertical = 1310 N/cm", MountRates(131e3, RATES.lateral, RATES.fore_aft)),
        ("C1.fore-aft=0.5kN/mm", MountRates(RATES.vertical, RATES.lateral, 5e5)),
        (" C1.fore_aft=5e5 N/m", MountRates(RATES.vertical, RATES.lateral, 5e5)),
        ("C1.loss_factor= 0.2", replace(RATES, loss_factor=0.2)),
        ("C1.loss_factor=0", replace(RATES, loss_factor=0.0)),
    ],
)
def test_setting_changes_one_value_of_one_group(text, expected):
    assert parse_setting(text, VEHICLE.rates) == {"C1": expected}


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("C2.lateral=131 N/mm", "unknown mount group 'C2': there are C1"),
        ("C1.sideways=131 N/mm", "there are vertical, lateral, fore-aft, rx, ry, rz"),
        ("C1.loss_factor=0.2 N/mm", "found '0.2 N/mm', expected a number without a unit"),
        ("C1.loss_factor=20 %", "found '20 %', expected a number without a unit"),
        ("C1.loss_factor=-0.2", "loss_factor: found -0.2, expected zero or more"),
        ("C1.loss_factor=1e999", "expected a finite number"),
        ("C1.loss=0.2", "unknown direction 'loss': there are"),
        ("C1.lateral=131", "without a unit, expected one of N/m, N/mm"),
        ("C1.lateral=131 kg", "unknown unit of stiffness 'kg'"),
        ("C1.lateral=-131 N/mm", "found -131000.0 N/m, expected zero or more"),
        ("C1.lateral=nan N/mm", "expected a number and a unit"),
        ("C1.lateral=1e308 N/mm", "expected a finite number"),
        ("C1.lateral=soft", "expected a number and a unit"),
        ("C1=131 N/mm", "expected GROUP.DIRECTION=RATE UNIT"),
        ("C1.lateral", "expected GROUP.DIRECTION=RATE UNIT"),
        ("", "expected GROUP.DIRECTION=RATE UNIT"),
    ],
)
def test_wrong_setting_is_explained(text, words):
    with pytest.raises(VehicleError) as caught:
        parse_setting(text, VEHICLE.rates)
    assert str(caught.value).startswith(f"setting {text!r}: ")
    assert words in str(caught.value)


def test_original_rates_are_the_vehicles_own():
    assert resolve_rates(VEHICLE, "original") == VEHICLE.rates


def test_settings_change_the_chosen_set_one_after_the_other():
    settings = ("C1.lateral=10 N/mm", "C1.vertical=20 N/mm", "C1.lateral=30 N/mm")
    rates = resolve_rates(VEHICLE, "optimised", settings)
    assert rates == {"C1": replace(VEHICLE.rate_sets["optimised"]["C1"], vertical=2e4, lateral=3e4)}
    rates = resolve_rates(VEHICLE, "optimised", (*settings, "C1.loss_factor=0.4"))
    assert rates["C1"].loss_factor == 0.4
    own = VEHICLE.mount_group("C1").loss_factor
    assert resolve_rates(VEHICLE, "original", (f"C1.loss_factor={own}",)) == VEHICLE.rates


def test_a_file_is_a_choice(tmp_path):
    rates = {"C1": MountRates(1.0, 2.0, 3.0, loss_factor=0.2)}
    write_rates(tmp_path / "mine.json", rates)
    assert resolve_rates(VEHICLE, str(tmp_path / "mine.json")) == rates


def test_unknown_choice_lists_the_sets_there_are():
    with pytest.raises(VehicleError, match=r"there are original, optimised, or give a \.json or \.csv"):
        resolve_rates(VEHICLE, "optimized set")
    with pytest.raises(VehicleError, match="did you mean 'optimised'"):
        resolve_rates(VEHICLE, "optimized")
