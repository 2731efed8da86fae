"""A study writes files for other programs with its present rates."""

import pytest
from bulk_data import bulk_data
from progressive_block import progressive_block
from studied_cabin import cabin_study

from modeviz.errors import ModevizError
from modeviz.study.study import Study


def test_rates_are_written_as_they_are_now_and_used_again(tmp_path):
    study = cabin_study()
    study.rates["A.lateral"] = "123 N/mm"
    written = study.export(tmp_path / "rates.csv")
    study.rates.reset()
    study.rates.use(written)
    assert study.rates["A.lateral"] == pytest.approx(123e3)
    assert "rates.csv" in written._repr_html_()


def test_cards_are_in_the_units_asked_for(tmp_path):
    written = cabin_study().export(tmp_path / "rates.bdf", units="m-kg-s", first_id=7)
    cards = bulk_data(written.path.read_text("ascii"))
    assert ["PBUSH", 7, "K", 4e5, 3e5, 8e5] in [card[:6] for card in cards]


def test_progressive_mounts_are_written_as_stiff_as_they_work_and_as_parts_unloaded(tmp_path):
    study = Study(progressive_block())
    written = study.export(tmp_path / "rates.bdf", units="m-kg-s")
    cards = bulk_data(written.path.read_text("ascii"))
    (bush,) = [card for card in cards if card[0] == "PBUSH"]
    assert bush[3:6] == pytest.approx([1e6, 1e6, 1.3 * 300e3])
    table = study.export(tmp_path / "mounts.csv").path.read_text("utf-8")
    header, row = (line.split(",") for line in table.splitlines()[:2])
    (column,) = [i for i, name in enumerate(header) if name.startswith("k_z")]
    assert float(row[column]) == pytest.approx(130.0)


def test_what_is_asked_for_wrongly_is_said_and_nothing_is_written(tmp_path):
    for name, options, sentence in (
        ("rates.doc", {}, "expected rates as one of"),
        ("rates.bdf", {"units": "mm"}, "units: found 'mm'"),
        ("rates.bdf", {"first_id": 10**9}, "first-id: found 1000000000"),
        ("rates.bdf", {"below_hz": -1.0}, "below: found -1 Hz"),
    ):
        with pytest.raises(ModevizError, match=sentence):
            cabin_study().export(tmp_path / name, **options)
    assert not list(tmp_path.iterdir())
