"""A study that an earlier modeviz has written is read, and brought up to date when it is opened."""

import shutil
import sqlite3
from pathlib import Path

import pytest
from journal_studies import KEY, change, opened

from modeviz.errors import ModevizError
from modeviz.journal import schema, upgrade
from modeviz.journal.backup import backup
from modeviz.journal.changes import Step
from modeviz.journal.note_beside import write_beside
from modeviz.journal.opening import check_file, connect_as_it_is
from modeviz.journal.ownership import Ownership
from modeviz.journal.records import Records
from modeviz.report.notes import Note

FIRST = Path(__file__).with_name("version_1.sql").read_text()
"""A study as the first version has written it: two steps, of which Ben's is undone, and one of each."""

BROKEN = (*schema.STEPS[:-1], f"{schema.STEPS[-1]} DROP TABLE study; ALTER TABLE nothing ADD x TEXT;")


@pytest.fixture
def old(tmp_path):
    path = tmp_path / "truck.modeviz"
    connection = sqlite3.connect(path)
    connection.executescript(FIRST)
    connection.execute("PRAGMA journal_mode = WAL")
    connection.close()
    return path


def version(path: Path) -> int:
    connection = connect_as_it_is(path)
    try:
        return schema.version_of(connection)
    finally:
        connection.close()


def all_told(records: Records) -> tuple:
    return (
        records.restore(KEY),
        records.history(),
        records.notes(),
        records.runs(KEY),
        records.pictures(KEY),
        records.reviews(),
    )


def content(folder: Path) -> dict[str, bytes]:
    return {each.name: each.read_bytes() for each in folder.iterdir()}


def test_tables_that_were_brought_up_are_those_of_a_new_file(old, tmp_path):
    new = tmp_path / "new.modeviz"
    for path in (old, new):
        opened(path).close()
    columns = []
    for path in (old, new):
        connection = connect_as_it_is(path)
        query = "SELECT name, tbl_name FROM sqlite_master ORDER BY name"
        tables = connection.execute(query).fetchall()
        told = [connection.execute(f"PRAGMA table_info({name})").fetchall() for _, name in tables]
        columns.append((tables, told))
        connection.close()
    assert columns[0] == columns[1]


def test_all_of_an_earlier_study_is_there_and_it_goes_on_undoing(old):
    study = opened(old)
    session = study.restore(KEY)
    assert session
    assert session.past == (Step("state 1", "state 2"),)
    assert session.future == (Step("state 2", "state 3"),)
    assert (session.future[0].author, session.future[0].maker) == ("Ben", "")  # nobody said whose
    assert list(session.tuning.variants) == ["v1"]
    assert [entry.kind for entry in study.history()] == [
        "step", "step", "undo", "note", "search", "picture",
    ]  # fmt: skip
    study.record(KEY, change(2, 3, "redo", v1=2))
    assert study.close()
    session = Records.of_file(old).restore(KEY)
    assert session
    assert session.past[1] == Step("state 2", "state 3")


def test_the_file_as_it_was_is_kept_beside(old):
    before = all_told(Records.of_file(old))
    study = opened(old)
    assert study.former == old.with_name("truck-version-1.modeviz")
    assert study.close()
    assert version(study.former) == 1
    assert all_told(Records.of_file(study.former)) == before
    again = opened(old)
    assert again.former is None
    assert again.close()


def test_a_copy_of_before_is_never_written_over(old):
    shutil.copy(old, old.with_name("truck-version-1.modeviz"))
    study = opened(old)
    assert study.former == old.with_name("truck-version-1-2.modeviz")
    study.close()


def test_who_reads_an_earlier_study_changes_nothing_and_sees_all(old):
    before = content(old.parent)
    told = all_told(Records.of_file(old))
    assert content(old.parent) == before
    opened(old).close()
    assert all_told(Records.of_file(old)) == told


def test_a_backup_of_an_earlier_study_is_as_it_is(old, tmp_path):
    copy = backup(old, tmp_path / "copy.modeviz")
    assert (version(copy), version(old)) == (1, 1)


def test_a_note_from_outside_brings_a_study_up_to_date_that_nobody_has(old):
    ownership = Ownership(old, 0.0)  # as an earlier modeviz may have it
    with pytest.raises(ModevizError, match="is open already"):
        write_beside(old, None, Note("too early"))
    assert version(old) == 1
    ownership.release()
    write_beside(old, None, Note("for all"))
    assert version(old) == schema.VERSION
    assert [note.text for note in Records.of_file(old).notes()] == ["too soft", "for all"]


def test_what_goes_wrong_on_the_way_leaves_the_tables_as_they_were(old, monkeypatch):
    monkeypatch.setattr(schema, "STEPS", BROKEN)
    with pytest.raises(ModevizError, match=r"cannot be brought up to date .* it is left as it is"):
        opened(old)
    monkeypatch.undo()
    assert version(old) == 1
    assert check_file(old)
    assert opened(old).close()


def test_an_earlier_study_is_left_as_it_is_where_no_copy_of_it_can_be_made(old, monkeypatch):
    def full(*_):
        raise ModevizError("the disk is full")

    monkeypatch.setattr(upgrade, "backup", full)
    before = content(old.parent)
    with pytest.raises(ModevizError, match="the disk is full"):
        opened(old)
    assert content(old.parent) == before


def test_an_earlier_study_that_is_damaged_is_refused_and_left_as_it_was(old):
    connection = sqlite3.connect(old)
    connection.execute("ALTER TABLE change ADD COLUMN maker TEXT NOT NULL DEFAULT ''")
    connection.close()
    before = content(old.parent)
    for read in (opened, Records.of_file):
        with pytest.raises(ModevizError, match="table change is not one of a study"):
            read(old)
    assert content(old.parent) == before


def test_an_earlier_study_of_which_a_content_is_not_as_written_is_left_as_it_was(old):
    connection = sqlite3.connect(old)
    connection.execute("UPDATE content SET packed = zeroblob(9)")
    connection.commit()
    connection.close()
    before = content(old.parent)
    with pytest.raises(ModevizError, match=r"content \d+ of the study is not as it was written"):
        opened(old)
    assert content(old.parent)[old.name] == before[old.name]
    assert not list(old.parent.glob("*-version-1*"))


def test_a_study_whose_log_cannot_be_read_here_is_not_called_damaged(old, monkeypatch):
    """As on read-only media, where a log lies beside the file and no index of it."""
    error = sqlite3.OperationalError("unable to open database file")
    error.sqlite_errorcode = sqlite3.SQLITE_CANTOPEN

    def connect(_):
        raise error

    monkeypatch.setattr("modeviz.journal.opening.connect_as_it_is", connect)
    with pytest.raises(ModevizError, match=r"cannot be read here: .*truck.modeviz-wal.*copy both"):
        check_file(old)


def test_a_study_whose_tables_have_no_version_is_refused_and_left_as_it_was(old):
    connection = sqlite3.connect(old)
    connection.execute("PRAGMA user_version = 0")
    connection.close()
    before = content(old.parent)
    for read in (opened, Records.of_file):
        with pytest.raises(ModevizError, match="its tables have no version"):
            read(old)
    assert content(old.parent) == before
