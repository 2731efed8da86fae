from dataclasses import replace

import pytest
from mounted_cabin import mounted_cabin

from modeviz.analysis.results import Conditions
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.session.design import (
    Variant,
    known_sets,
    next_name,
    rate_sets,
    set_numbers,
    variant_name,
)
from modeviz.viewer.session.state import first_state

RATES = MountRates(8e5, 3e5, 4e5)
GROUPS = {group.name: group for group in mounted_cabin().mount_groups}


@pytest.fixture
def design():
    vehicle = mounted_cabin()
    return first_state(vehicle, vehicle.rates, Conditions("flat", 20.0)).design


def test_a_rate_moves_alone(design):
    moved = design.with_rate(GROUPS["B"], "lateral", 1e5)
    assert moved.rates == {"A": RATES, "B": replace(RATES, lateral=1e5)}


def test_linked_rates_keep_their_ratios(design):
    moved = replace(design, linked=frozenset({"A"})).with_rate(GROUPS["A"], "vertical", 4e5)
    assert moved.rates["A"] == MountRates(4e5, 1.5e5, 2e5)
    assert moved.rates["B"] == RATES


def test_linked_rates_have_no_more_digits_than_a_box_shows(design):
    moved = replace(design, linked=frozenset({"A"})).with_rate(GROUPS["A"], "vertical", 8e5 / 7)
    assert moved.rates["A"] == MountRates(8e5 / 7, 42860.0, 57140.0)


def test_a_linked_rate_at_zero_has_no_ratio_and_moves_alone(design):
    gone = replace(RATES, lateral=0.0)
    linked = replace(design, linked=frozenset({"A"}), rates={"A": gone, "B": RATES})
    assert linked.with_rate(GROUPS["A"], "lateral", 1e5).rates["A"] == replace(RATES, lateral=1e5)


def test_a_locked_rate_stays_whatever_moves(design):
    locked = replace(design, locked=frozenset({("A", "lateral")}), linked=frozenset({"A"}))
    assert locked.with_rate(GROUPS["A"], "lateral", 1e5) == locked
    assert locked.with_rate(GROUPS["A"], "vertical", 4e5).rates["A"] == MountRates(4e5, 3e5, 2e5)
    assert locked.with_rates({"A": MountRates(1e5, 1e5, 1e5)}).rates["A"].lateral == 3e5


def test_sets_are_the_vehicles_and_then_the_pinned_ones(design):
    vehicle = mounted_cabin()
    soft = {"A": MountRates(2e5, 1e5, 1e5), "B": RATES}
    assert known_sets(vehicle) == {"Original": vehicle.rates, "Soft": soft}
    pinned = replace(design, variants={"Mine": Variant(soft, 0)})
    assert list(rate_sets(vehicle, pinned)) == ["Original", "Soft", "Mine"]


def test_rates_are_called_after_the_set_they_are_of_or_the_next_trial(design):
    vehicle = mounted_cabin()
    assert variant_name(vehicle, design) == "Original"
    moved = design.with_rate(GROUPS["A"], "lateral", 1e5)
    assert variant_name(vehicle, moved) == "Trial 1"
    assert next_name(replace(design, variants={"Trial 1": {}, "Trial 3": {}})) == "Trial 2"


def test_a_set_keeps_its_number_whatever_is_pinned_or_forgotten_beside_it(design):
    vehicle, rates = mounted_cabin(), design.rates
    three = design.with_variant("a", rates).with_variant("b", rates).with_variant("c", rates)
    assert set_numbers(vehicle, three) == {"Original": 0, "Soft": 1, "a": 2, "b": 3, "c": 4}
    two = replace(three, variants={name: three.variants[name] for name in ("b", "c")})
    assert set_numbers(vehicle, two) == {"Original": 0, "Soft": 1, "b": 3, "c": 4}
    again = two.with_variant("d", rates).with_variant("b", {"A": RATES})
    assert set_numbers(vehicle, again) == {"Original": 0, "Soft": 1, "b": 3, "c": 4, "d": 2}
