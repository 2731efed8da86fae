"""A study is read, compared, copied and noted on from the command line."""

import csv
import json
import logging
import re
import sqlite3
from contextlib import closing, suppress
from pathlib import Path
from unittest.mock import Mock

import pytest
from journal_studies import KEY, change, opened
from mounted_cabin import mounted_cabin
from visitors import wait_until

from benchmarks.kill import write_first_version
from modeviz.cli import main
from modeviz.cli.studies.kept import kept_study
from modeviz.errors import ModevizError
from modeviz.files.state_folder import state_folder
from modeviz.journal import opening
from modeviz.journal.comparison import compare_studies, difference_text
from modeviz.journal.contents import put_text
from modeviz.journal.export import study_record, variants_table
from modeviz.journal.places import own_folder, study_path
from modeviz.journal.records import Records
from modeviz.journal.runs import Run
from modeviz.journal.study_file import StudyFile
from modeviz.journal.told import log_text
from modeviz.report.notes import Note

OTHER = "a" * 64
"""The id of another session."""


@pytest.fixture
def study(tmp_path):
    """A study beside a vehicle's folder, in which somebody tuned a mount."""
    (tmp_path / "truck").mkdir()
    study = opened(study_path(tmp_path / "truck"))
    study.begin(KEY, "Ada", "softer cab")
    study.record(KEY, change(131, 140))
    study.record(KEY, change(140, 150, v1=150))
    study.record(KEY, change(140, 150, "undo", v1=150))
    study.put_note(KEY, Note("too soft\nin roll", "mount", "C2 left", "Bob"))
    study.put_note(None, Note("for Monday"))
    study.put_run(KEY, Run("search", "paper, 20 starts", '{"best": 1.3}', "Ada", 12.0))
    study.put_picture(KEY, b"\x89PNG", "Cab yaw", "Ada")
    assert study.close()
    return study.path


def printed(capsys, *words) -> str:
    assert main(["study", *map(str, words)]) == 0
    return capsys.readouterr().out


def failed(capsys, *words) -> str:
    assert main(["study", *map(str, words)]) == 2
    return capsys.readouterr().err


@pytest.mark.parametrize("of", [Path.absolute, lambda path: path.parent / "truck"])
def test_the_log_tells_when_by_whom_and_what_in_an_engineers_units(study, capsys, of):
    lines = printed(capsys, "log", of(study)).splitlines()
    assert lines[0].startswith("truck.modeviz: study of Truck, begun 20")
    assert lines[1].startswith("session 1 'softer cab', begun ")
    assert lines[3].endswith("1  Ada  Set C2.lateral: C2.lateral 131 → 140 N/mm")
    assert lines[4].endswith("Set C2.lateral: C2.lateral 140 → 150 N/mm (undone)")
    assert lines[5].endswith("Ada  Undo: set C2.lateral")
    assert lines[6].endswith("  1  Bob  note: mount C2 left: too soft in roll")
    assert lines[7].endswith("  all  -  note: study: for Monday")
    assert [line.split("  ")[-1] for line in lines[8:]] == [
        "search: paper, 20 starts",
        "picture: Cab yaw",
    ]


def test_the_log_as_json_has_its_documented_structure(study, capsys):
    record = json.loads(printed(capsys, "log", study, "--session", 1, "--json"))
    assert set(record) == {"vehicle", "begun", "sessions", "entries"}
    assert record["sessions"][0]["variants"] == ["v1"]
    difference = {"what": "C2.lateral", "before": "131 N/mm", "after": "140 N/mm"}
    assert record["entries"][0]["differences"] == [difference]


def test_the_pickups_study_is_in_the_users_own_folder(tmp_path, monkeypatch, capsys):
    for name in ("XDG_STATE_HOME", "LOCALAPPDATA"):
        monkeypatch.setenv(name, str(tmp_path))
    monkeypatch.setattr(Path, "home", lambda: tmp_path)
    assert "there is no such file" in failed(capsys, "log")
    path = own_folder() / "truck.modeviz"
    assert path.parent == state_folder() / "studies"
    monkeypatch.setenv("XDG_STATE_HOME", "not/whole")
    assert own_folder().is_relative_to(tmp_path)
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path))
    assert opened(path).close()
    assert "nothing happened yet" in printed(capsys, "log")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (("log", "missing"), "missing: there is no such folder"),
        (("log", "{study}", "--session", "7"), "--session: found 7, expected one of 1"),
        (("note", "{study}", "x", "--variant", "v2"), "unknown variant 'v2': there are v1"),
        (("note", "{study}", " "), "a note: found no text"),
        (("export", "{study}", "x.txt"), "expected .json for all of a study, or .csv"),
        (("backup", "{study}", "{study}"), "is there already"),
        (("diff", "{study}", "nowhere"), "nowhere: there is no such folder"),
    ],
)
def test_what_the_user_can_put_right_is_one_sentence(study, capsys, words, message):
    assert message in failed(capsys, *(word.format(study=study) for word in words))


def test_a_note_is_written_while_the_study_is_used(study, capsys):
    used = opened(study)
    printed(capsys, "note", study, "ready", "--variant", "v1", "--author", "Eve", "--session", "1")
    printed(capsys, "note", study, "all read this")
    assert [(n.about, n.text, n.author) for n in used.notes(KEY)][2] == ("variant v1", "ready", "Eve")
    assert used.notes(OTHER)[-1].text == "all read this"
    used.record(KEY, change(140, 141))
    assert used.close()


def test_an_export_has_everything_and_no_key(study, tmp_path, capsys):
    printed(capsys, "export", study, tmp_path / "all.json")
    text = (tmp_path / "all.json").read_text()
    assert KEY not in text
    (session,) = json.loads(text)["sessions"]
    assert session["rates"]["C2"]["lateral"] == pytest.approx(140)
    assert session["pinned"]["v1"]["rates"]["C2"]["lateral"] == pytest.approx(150)
    states, (undo,), (redo,) = (session[name] for name in ("states", "undo", "redo"))
    assert states[session["state"]] == states[undo["after"]] == states[redo["before"]] == "state 140"
    assert (states[undo["before"]], states[redo["after"]]) == ("state 131", "state 150")
    assert session["notes"][0]["text"] == "too soft\nin roll"
    assert session["runs"][0]["record"] == {"best": 1.3}
    assert session["pictures"][0]["png_base64"] == "iVBORw=="
    record = json.loads(text)
    assert [note["text"] for note in record["notes"]] == ["for Monday"]
    assert [entry["kind"] for entry in record["history"]][:3] == ["step", "step", "undo"]


def test_variants_are_exported_as_a_table(study, tmp_path, capsys):
    printed(capsys, "export", study, tmp_path / "variants.csv")
    with (tmp_path / "variants.csv").open() as file:
        (row,) = csv.DictReader(file)
    assert (row["variant"], row["group"]) == ("v1", "C2")
    assert float(row["lateral (N/mm)"]) == pytest.approx(150)


def test_a_backup_is_the_study_and_stays_so_while_the_study_goes_on(study, tmp_path, capsys):
    used = opened(study)
    used.record(KEY, change(140, 160))
    assert used.flush(5)
    printed(capsys, "backup", study, tmp_path / "copy.modeviz")
    used.record(KEY, change(160, 170))
    assert used.close()
    copy = Records.of_file(tmp_path / "copy.modeviz").restore(KEY)
    assert copy
    assert copy.state == "state 160"
    assert not list(tmp_path.glob("copy.modeviz-*"))
    (tmp_path / "kept").mkdir()
    printed(capsys, "backup", study, tmp_path / "kept")
    assert len(list((tmp_path / "kept").glob("truck-20*.modeviz"))) == 1


def test_a_diff_tells_rates_variants_notes_and_runs(study, tmp_path, capsys):
    copy = tmp_path / "copy.modeviz"
    printed(capsys, "backup", study, copy)
    assert "no difference" in printed(capsys, "diff", study, copy)
    used = opened(copy)
    used.begin(KEY)
    used.record(KEY, change(140, 145, v1=155, v2=145))
    used.put_note(KEY, Note("better", "mode", "cab yaw"))
    used.put_run(KEY, Run("front", "two goals", "{}"))
    used.begin(OTHER)
    assert used.close()
    lines = printed(capsys, "diff", study, copy).splitlines()
    assert lines == [
        "- truck.modeviz",
        "+ copy.modeviz",
        "+ session 2",
        "session 1 and session 1:",
        "  C2.lateral 140 → 145 N/mm",
        "  variant v1: C2.lateral 150 → 155 N/mm",
        "  + variant v2",
        "  + note on mode cab yaw: better",
        "  + front: two goals",
    ]
    record = json.loads(printed(capsys, "diff", study, copy, "--json"))
    assert record["sessions"][0]["only_second"][0] == "variant v2"


def test_studies_that_share_no_session_are_compared_by_those_last_used(study, tmp_path, capsys):
    other = opened(tmp_path / "other.modeviz")
    other.begin(OTHER)
    other.record(OTHER, change(131, 133))
    assert other.close()
    assert "C2.lateral 140 → 133 N/mm" in printed(capsys, "diff", study, other.path)


def test_what_is_lost_at_the_end_of_a_server_is_said(tmp_path, monkeypatch, capsys):
    full = sqlite3.OperationalError("database or disk is full")
    monkeypatch.setattr(StudyFile.close, "__defaults__", (0.2,))
    with kept_study(tmp_path / "cabin.modeviz", mounted_cabin()) as study:
        monkeypatch.setattr("modeviz.journal.writer._commit", Mock(side_effect=full))
        study.begin(KEY)
        study.record(KEY, change(1, 2))
    said = capsys.readouterr().err
    assert re.search(
        r"the last 2 changes are lost \(not saved since \d\d:\d\d: the disk is full\)", said
    )


def test_a_study_of_another_vehicle_is_called_so_when_it_is_served(study, capsys):
    cabin = mounted_cabin()
    with kept_study(study, cabin):
        said = capsys.readouterr().err
    assert f"truck.modeviz: is the study of Truck, and goes on with {cabin.name}" in said
    with kept_study(study.parent / "cabin.modeviz", cabin):
        assert not capsys.readouterr().err


def test_one_change_that_is_lost_is_said_as_one(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr(StudyFile.close, "__defaults__", (0.2,))
    with kept_study(tmp_path / "cabin.modeviz", mounted_cabin()) as study:
        study.begin(KEY)
        assert study.flush(5)
        study.path.unlink()
        study.record(KEY, change(1, 2))
    said = capsys.readouterr().err
    assert re.search(r"the last change is lost \(not saved since .*: the study file is gone\)", said)


def test_a_study_that_cannot_be_written_is_logged_at_once_and_once_it_can_be_again(
    tmp_path, monkeypatch, caplog
):
    full = sqlite3.OperationalError("database or disk is full")
    caplog.set_level(logging.WARNING, "modeviz")
    with kept_study(tmp_path / "cabin.modeviz", mounted_cabin()) as study:
        with monkeypatch.context() as patch:
            patch.setattr("modeviz.journal.writer._commit", Mock(side_effect=full))
            study.begin(KEY)
            study.record(KEY, change(1, 2))
            wait_until(lambda: caplog.records)
        assert study.flush(5)
    (lost, saved) = caplog.records
    assert re.search(r"cabin.modeviz: not saved since \d\d:\d\d: the disk is full$", lost.getMessage())
    assert saved.getMessage().endswith("cabin.modeviz: saved again")
    assert [lost.event, saved.event] == ["unsaved", "saved"]


VALUES = ("zeroblob(3)", "1e300", "'text'", "-7")


def tell_everything(study):
    records = Records.of_file(study)
    log_text("study", records.study(), records.sessions(), records.history())
    study_record(records)
    variants_table(records)
    difference_text(compare_studies(records, records))


def test_no_value_that_somebody_puts_into_a_study_ends_in_a_traceback(study):
    whole = study.read_bytes()
    with closing(sqlite3.connect(study)) as connection:
        tables = connection.execute("SELECT name FROM sqlite_master WHERE type = 'table'").fetchall()
        columns = [
            (table, name)
            for (table,) in tables
            for _, name, *_ in connection.execute(f"PRAGMA table_info({table})")
        ]
    n_refused = 0
    for i, (table, column) in enumerate(columns):
        study.write_bytes(whole)
        with closing(sqlite3.connect(study)) as connection, suppress(sqlite3.IntegrityError):
            connection.execute(f"UPDATE {table} SET {column} = {VALUES[i % len(VALUES)]}")
            connection.commit()
        try:
            tell_everything(study)
        except ModevizError:
            n_refused += 1
    assert n_refused > len(columns) / 3


@pytest.mark.parametrize("said", ["7", '{"rates": {"C2": {"x": 1}}, "placements": {}}', "[" * 9999])
def test_contents_that_say_something_else_are_damage(study, capsys, said):
    with closing(sqlite3.connect(study)) as connection:
        number = put_text(connection, said)
        connection.execute("UPDATE session SET tuning = ?", (number,))
        connection.execute("UPDATE change SET differences = ?", (number,))
        connection.commit()
    assert "damaged" in failed(capsys, "log", study)
    assert "damaged" in failed(capsys, "diff", study, study)


def test_a_server_says_that_it_brought_a_study_up_to_date(tmp_path, capsys):
    path = tmp_path / "cabin.modeviz"
    write_first_version(path)
    with kept_study(path, mounted_cabin()):
        pass
    said = capsys.readouterr().err
    assert f"{path}: was of an earlier modeviz" in said
    assert f"it is in {tmp_path}/cabin-version-1.modeviz" in said
    with kept_study(path, mounted_cabin()):
        pass
    assert "earlier" not in capsys.readouterr().err


def test_a_command_looks_once_whether_the_tables_are_whole(study, capsys, monkeypatch):
    looked, sound = [], opening._check_sound
    monkeypatch.setattr(opening, "_check_sound", lambda path: looked.append(path) or sound(path))
    for words in (["log", study], ["export", study, study.with_suffix(".json")]):
        printed(capsys, *words)
        assert len(looked) == 1
        looked.clear()


def test_a_check_says_that_all_is_as_it_was_written_or_what_is_not(study, capsys):
    assert "truck.modeviz: sound, all " in printed(capsys, "check", study)
    connection = sqlite3.connect(study)
    (number,) = connection.execute("SELECT png FROM picture").fetchone()
    connection.execute("UPDATE content SET packed = zeroblob(9) WHERE id = ?", (number,))
    connection.commit()
    connection.close()
    printed(capsys, "log", study)  # which reads no picture
    said = failed(capsys, "check", study)
    assert f"content {number} of the study is not as it was written" in said
    assert "there is no such file" in failed(capsys, "check", study.with_name("none.modeviz"))
