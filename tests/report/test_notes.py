"""What reading a vehicle has to say reaches whoever asked for it, and changes nothing else."""

from dataclasses import replace
from datetime import date

import numpy as np
import pytest
from html_documents import Document
from mounted_cabin import mounted_cabin
from noted_vehicle import noted_vehicle
from one_element import OneElement

from modeviz.analysis.preparation import prepare
from modeviz.cli import main
from modeviz.files import read_vehicle, write_vehicle
from modeviz.files.source import MOST_NOTES, Source
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import report
from modeviz.viewer.panels.status import StatusPanel

NOTE = "body 'cab': omega_n_squared: 5 of the first 6 modes are near zero, up to 0.0001 Hz"


@pytest.fixture
def folder(tmp_path):
    return noted_vehicle(tmp_path / "noted")


def test_frequencies_near_zero_are_taken_for_zero_and_said(folder):
    vehicle = read_vehicle(folder)
    assert not vehicle.body("cab").omega_n_squared[:6].any()
    assert any(NOTE in note for note in vehicle.notes)


def test_notes_stay_with_a_vehicle_whose_rates_change(folder):
    vehicle = read_vehicle(folder)
    assert vehicle.with_rates({}).notes == vehicle.notes


def test_a_folder_that_is_written_again_has_nothing_to_be_said_of_its_zeros(folder, tmp_path):
    write_vehicle(read_vehicle(folder), tmp_path / "again")
    assert not any("near zero" in note for note in read_vehicle(tmp_path / "again").notes)


def test_commands_say_a_note_once_in_a_line_of_its_own_and_go_on(capsys, folder):
    assert main(["modes", str(folder), "--json"]) == 0
    captured = capsys.readouterr()
    assert captured.out.startswith("{")
    assert captured.err.count(f"modeviz: note: {NOTE}") == 1


def test_a_report_has_the_notes():
    prepared = prepare(replace(mounted_cabin(), notes=("mesh <far> away",)))
    comparison = compare(prepared, RateSet("original", {}), RateSet("now", {}), None)
    document = Document(report(comparison, date(2026, 11, 22)))
    assert "Notes on the vehicle" in document.headings
    assert "mesh <far> away" in document.words


def test_the_page_has_the_notes_from_the_first_moment():
    page = OneElement()
    StatusPanel(page, ("mesh <far> away",)).show_progress(0.1)
    assert "mesh &lt;far&gt; away" in page.content


def test_very_many_notes_are_counted_not_told(tmp_path):
    source = Source(tmp_path)
    for i in range(MOST_NOTES + 7):
        source.note(str(i))
    assert source.notes[-1] == "7 more notes of this kind"
    assert len(source.notes) == MOST_NOTES + 1
    assert np.all([a == str(i) for i, a in enumerate(source.notes[:-1])])
