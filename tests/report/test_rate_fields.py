"""Rates of every kind are told with their names and units, and go out and in again."""

from dataclasses import replace

import pytest
from bulk_data import bulk_data
from cab_on_struts import cab_on_struts

from modeviz.export.bushes import bush_deck
from modeviz.files.folder import read_vehicle, write_vehicle
from modeviz.files.rate_files import parse_rates, rates_text
from modeviz.formats.component import UNIT_SYSTEMS
from modeviz.report.rate_fields import fields_of_groups, listed_fields, sections
from modeviz.report.records import rates_record
from modeviz.study.study import Study
from modeviz.viewer.session.design import Design


@pytest.fixture(scope="module")
def cab(tmp_path_factory):
    return cab_on_struts(tmp_path_factory.mktemp("vehicle") / "cab")


@pytest.fixture
def tuned(cab):
    """The cab with other rates of every kind."""
    front, rear = cab.rates["F"], cab.rates["R"]
    return cab.with_rates(
        {
            "F": replace(front, damping_vertical=2100.5),
            "R": replace(rear, rz=1234.5),
            "D": replace(cab.rates["D"], damping_vertical=3000.25),
        }
    )


def test_a_record_has_what_is_tuned_beside_the_rates_along_axes(tuned):
    record = rates_record(tuned)
    assert list(record["F"]) == ["vertical", "lateral", "fore_aft", "damping_vertical", "loss_factor"]
    assert record["F"]["damping_vertical"] == pytest.approx(2100.5, rel=1e-12)
    assert record["R"]["rz"] == pytest.approx(1234.5, rel=1e-12)
    assert record["R"]["vertical"] == pytest.approx(22.0, rel=1e-12)


def test_rates_stand_under_what_they_are(cab):
    fields = fields_of_groups(cab.mount_groups)
    assert sections(fields) == [
        ("", ("vertical", "lateral", "fore_aft")),
        ("Rotation", ("rz",)),
        ("Damping", ("damping_vertical",)),
    ]
    assert listed_fields(cab.mount_group("D")) == ("damping_vertical",)


@pytest.mark.parametrize("file_format", ["csv", "json"])
def test_rates_of_every_kind_go_into_a_file_and_out_again(cab, tuned, file_format):
    text = rates_text(tuned.rates, file_format, tuned)
    assert parse_rates(text, file_format, cab) == tuned.rates


def test_rates_of_every_kind_are_in_the_folder_that_is_written(tuned, tmp_path):
    write_vehicle(tuned, tmp_path / "cab")
    again = read_vehicle(tmp_path / "cab")
    for before, after in zip(tuned.mount_groups, again.mount_groups, strict=True):
        assert after.fields == before.fields
        for field in before.fields:
            for one, other in zip(
                (before.rates, *before.bounds), (after.rates, *after.bounds), strict=True
            ):
                assert getattr(other, field) == pytest.approx(getattr(one, field), rel=1e-12)


def test_cards_have_tuned_rates_about_axes_and_of_dampers(tuned):
    cards = bulk_data(bush_deck(tuned, UNIT_SYSTEMS["mm-t-s"]).decode("ascii"))
    front, rear, dampers = (card for card in cards if card[0] == "PBUSH")
    about = rear[rear.index("K") + 1 :][5]
    assert about == pytest.approx(1234.5e3, rel=1e-6)  # N mm/rad
    for card, damping in ((front, 2.1005), (dampers, 3.00025)):
        along = card[card.index("B") + 1 :][2]
        assert along == pytest.approx(damping, rel=1e-6)  # N s/mm
    assert "K" not in dampers or not any(dampers[dampers.index("K") + 1 : dampers.index("B")])


def test_a_study_names_sets_and_lists_them(cab, tmp_path):
    write_vehicle(cab, tmp_path / "cab")
    study = Study(tmp_path / "cab")
    study.rates["F.damping-vertical"] = "3.2 N s/mm"
    study.rates["R.rz"] = 2000.0
    assert study.rates["F.damping_vertical"] == pytest.approx(3200.0)
    assert {"F.damping_vertical", "R.rz", "D.damping_vertical"} <= set(study.rates.keys())
    assert "D.vertical" not in study.rates
    lines = {line.split("  ")[0]: line.split() for line in study.rates.table().splitlines()}
    assert lines["F damping-vertical, N s/m"][-4:-1] == ["1600", "3200", "+100.0"]
    assert lines["R rz, N m/rad"][-4:-1] == ["800", "2000", "+150.0"]


def test_dampers_keep_their_ratios_to_dampers_and_springs_to_springs(cab):
    group = cab.mount_group("F")
    design = Design(cab.rates, linked=frozenset({"F"}))
    harder = design.with_rate(group, "vertical", 70e3).rates["F"]
    assert (harder.lateral, harder.fore_aft) == (300e3, 400e3)
    assert harder.damping_vertical == 1600.0
    damped = design.with_rate(group, "damping_vertical", 800.0).rates["F"]
    assert damped == replace(cab.rates["F"], damping_vertical=800.0)
