"""Which rates a search keeps, and what it says of rates that it could not find."""

from dataclasses import replace

import pytest
from cabin_problem import PROBLEM, cabin_search
from mounted_cabin import mounted_cabin

from modeviz.optimise.design_space import design_space
from modeviz.optimise.outside import kept_ratios, outside_search, outside_space
from modeviz.report.space import outside_words, ratio_words, space_lines
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import FrequencyWindow

OTHER = {"B": MountRates(8e5, 2e5, 4e5)}
"""Rates to start from with other ratios than the vehicle's 3/8 and 1/2."""


def space(base=None, groups=PROBLEM.groups, locked=frozenset()):
    return design_space(mounted_cabin(), groups, base, locked)


def test_fixed_ratios_are_those_of_the_rates_one_starts_from():
    for base, lateral in ((None, 0.375), (OTHER, 0.25)):
        expected = {"lateral": lateral, "fore_aft": 0.5}
        assert kept_ratios(space(base))["B"] == pytest.approx(expected, rel=1e-12)
    assert ratio_words(space(OTHER)) == "B lateral 0.25 and fore-aft 0.5 of vertical"
    assert ratio_words(space(groups=PROBLEM.groups[:1])) == ""


@pytest.mark.parametrize("base", [None, OTHER])
def test_every_design_of_a_space_lies_in_it(base):
    designs = space(base)
    for x in designs.samples(50, seed=1):
        assert outside_space(designs, designs.rates(x)) == ()


def test_the_best_of_one_space_lies_outside_of_another():
    assert outside_space(space(), {}) == ()
    assert outside_space(space(OTHER), {}) == ("B lateral is 0.375 of vertical, kept at 0.25",)


@pytest.mark.parametrize(
    ("rates", "reason"),
    [
        ({"A": MountRates(3e6, 1e6, 1e6)}, "past A vertical: upper bound by 50 %"),
        ({"A": MountRates(8e5, 1e5, 4e5)}, "past A lateral: lower ratio limit by 100 %"),
        ({"B": MountRates(8e4, 3e4, 4e4)}, "past B rates: lower bound by 233 %"),
        ({"A": MountRates(8e5, 3e5, 4e5, 0.3)}, "A loss factor is 0.3, kept at 0.15"),
        ({"A": MountRates(8e5, 0.0, 4e5)}, "past A lateral: lower bound"),
        ({"A": MountRates(0.0, 3e5, 4e5)}, "past A vertical: lower bound"),
        ({"B": MountRates(0.0, 3e5, 4e5)}, "past B rates: lower bound"),
    ],
)
def test_what_keeps_rates_out_is_named(rates, reason):
    assert reason in outside_space(space(), rates)


def test_rates_that_may_not_change_are_named():
    only_front = space(groups=PROBLEM.groups[:1])
    assert outside_space(only_front, OTHER) == ("B lateral is 200 N/mm, kept at 300",)
    locked = space(locked=frozenset({("A", "lateral")}))
    rates = {"A": MountRates(8e5, 3.1e5, 4e5)}
    assert outside_space(locked, rates) == ("A lateral is 310 N/mm, kept at 300",)


def test_a_mode_where_no_design_may_have_it_is_named():
    search = cabin_search(windows=(FrequencyWindow("cab yaw", high_hz=9.0),))
    (reason,) = outside_search(search, {})
    assert reason.startswith("cab yaw is at 10.")
    assert outside_search(replace(search, windows=None), {}) == ()


def test_few_reasons_are_given_and_the_rest_is_counted():
    assert outside_words("paper", ()) == ""
    assert outside_words("paper", ["a", "b", "c", "d", "e"]) == (
        "paper lies outside of what is searched: a; b; c; 2 more"
    )
    assert space_lines(space(), {"original": (), "soft": ("a",)}) == [
        "ratios kept as in the rates it starts from: B lateral 0.375 and fore-aft 0.5 of vertical",
        "soft lies outside of what is searched: a",
    ]
