"""Tunings are compared in an engineer's words and units."""

from dataclasses import replace

import pytest

from modeviz.journal.changes import Difference
from modeviz.journal.differences import pinned_differences, told
from modeviz.journal.tuning import Pinned, pinned_of, pinned_text
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement

RATES = MountRates(700e3, 131e3, 290e3)
BEFORE = Pinned({"C2": RATES})


def lines(after: Pinned, before: Pinned = BEFORE) -> list[str]:
    return [told(each) for each in pinned_differences(before, after)]


@pytest.mark.parametrize(
    ("changed", "line"),
    [
        ({"lateral": 140e3}, "C2.lateral 131 → 140 N/mm"),
        ({"lateral": 131e3 * (1 + 1e-6)}, "C2.lateral 131 → 131.0001 N/mm"),
        ({"rx": 12.5}, "C2.rx 0 → 12.5 N m/rad"),
        ({"damping_vertical": 800.0}, "C2.damping-vertical 0 → 800 N s/m"),
        ({"loss_factor": 0.2}, "C2.loss-factor the group's → 0.2"),
    ],
)
def test_a_rate_is_told_in_its_unit_with_the_digits_that_tell_it_apart(changed, line):
    assert lines(replace(BEFORE, rates={"C2": replace(RATES, **changed)})) == [line]


def test_places_and_groups_are_told():
    after = Pinned(
        {"C2": RATES, "absorber": RATES},
        {"C2": Placement((0.02, 0.0, -0.01), (0.0, 0.1, 0.0))},
    )
    assert lines(after) == [
        "mounts absorber – → there",
        "C2 moved 0, 0, 0 → 20, 0, -10 mm",
        "C2 turned 0, 0, 0 → 0, 5.73, 0 deg",
    ]


def test_no_change_is_no_difference():
    assert pinned_differences(BEFORE, BEFORE) == ()


def test_a_variant_survives_as_text_to_the_last_bit():
    pinned = Pinned(
        {"C2": replace(RATES, lateral=0.1 + 0.2, loss_factor=0.15)},
        {"C2": Placement((0.1 + 0.2, 0.0, 0.0), (1 / 3, 0.0, 0.0))},
    )
    assert pinned_of(pinned_text(pinned)) == pinned


def test_what_was_not_there_is_told_by_a_dash():
    assert told(Difference("note", "", "there")) == "note – → there"
