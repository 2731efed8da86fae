from dataclasses import replace

from marked_group import group

from modeviz.units import WRITTEN_UNITS
from modeviz.vehicle.mount_rates import MountRates
from modeviz.viewer.scene.group_card import CARD_LETTERS, card_text

UNITS = WRITTEN_UNITS
RATES = MountRates(1.64e6, 1.21e6, 4.8e5)


def test_long_names_make_a_card_of_more_lines():
    text = card_text(group("C1"), RATES, UNITS, 0.1, f"yaw of the {'very ' * 12}long cab")
    assert max(map(len, text.splitlines())) <= CARD_LETTERS
    assert len(text.splitlines()) == 5


def test_card_names_the_group_its_sides_its_rates_and_its_share():
    text = card_text(group("C1 left", "C1 right"), RATES, UNITS, 0.234, "cab yaw")
    assert text == (
        "C1  cab front, left + right\n"
        "vertical 1640  lateral 1210  fore-aft 480 N/mm\n"
        "23 % of strain energy in cab yaw"
    )


def test_a_group_whose_label_is_its_name_is_named_once():
    """As an import names the groups of a table of mounts that has no labels."""
    same = replace(group("C1 left", "C1 right"), label="C1")
    assert card_text(same, RATES, UNITS, 0.1, "pitch").splitlines()[0] == "C1, left + right"
    assert (same.title, same.meaning) == ("C1", "")
    assert (group("C1").title, group("C1").meaning) == ("C1  cab front", "cab front")


def test_card_says_rates_in_the_unit_that_was_chosen():
    text = card_text(group("C1 left"), RATES, {**UNITS, "stiffness": "N/cm"}, 0.234, "cab yaw")
    assert text.splitlines()[1] == "vertical 16400  lateral 12100  fore-aft 4800 N/cm"


def test_lone_mount_has_no_side():
    assert card_text(group("C1"), RATES, UNITS, 0.0, "pitch").splitlines()[0] == "C1  cab front"
