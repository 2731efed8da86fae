"""Cards of mounts, read by pyyeti, which is nobody's here."""

import io
from pathlib import Path

import elsewhere
import pytest
from bulk_data import bulk_data
from many_mounts import many_mounts

from modeviz.cli import main
from modeviz.export.bushes import bush_deck
from modeviz.files import write_vehicle
from modeviz.formats.component import UNIT_SYSTEMS

NAMES = ("PBUSH", "CBUSH", "GRID", "CORD2R")


def cards(text: str, name: str) -> list[list]:
    return elsewhere.bulk.rdcards(io.StringIO(text), name, return_var="list", keep_name=True) or []


def whole(card: list) -> list:
    """The card without the empty fields at its end, and without marks of large fields."""
    last = max(i for i, field in enumerate(card) if field != "")
    return [card[0].rstrip("*"), *card[1 : last + 1]]


@pytest.mark.parametrize("units", UNIT_SYSTEMS)
def test_another_program_finds_the_same_fields_of_every_card(units):
    text = bush_deck(many_mounts(), UNIT_SYSTEMS[units], 90001).decode("ascii")
    ours = bulk_data(text)
    for name in NAMES:
        expected = [whole(card) for card in ours if card[0] == name]
        assert expected
        assert [whole(card) for card in cards(text, name)] == expected


def test_tuned_rates_are_those_that_were_set_to_another_program(tmp_path: Path):
    """From a folder and a command; N/mm, to the digits that were typed."""
    folder, deck = tmp_path / "vehicle", tmp_path / "rates.bdf"
    write_vehicle(many_mounts(), folder)
    rates = {"fore_aft": 123.456789, "lateral": 98.7654321, "vertical": 456.789123}
    sets = [word for name, rate in rates.items() for word in ("--set", f"A.{name}={rate} N/mm")]
    assert main(["export", str(folder), str(deck), *sets]) == 0
    first = cards(deck.read_text(), "PBUSH")[0]
    pid, key, *found = first[1:6]
    assert (pid, key) == (1, "K")
    assert found == pytest.approx(list(rates.values()), rel=1e-12)
    assert first[first.index("GE") + 1 :][:3] == [0.15] * 3
    tied = [card for card in cards(deck.read_text(), "CBUSH") if card[2] == pid]
    assert len(tied) == len(next(g for g in many_mounts().mount_groups if g.name == "A").mounts)
