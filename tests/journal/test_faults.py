"""What a study does when a disk, a file, a process or a clock lets it down."""

import json
import os
import re
import shutil
import signal
import sqlite3
import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import pytest
from journal_studies import KEY, change, opened

from benchmarks.kill import kill_often
from modeviz.errors import ModevizError
from modeviz.journal import opening, ownership, schema, study_file, waiting, writer
from modeviz.journal import sessions as stored
from modeviz.journal.changes import Step
from modeviz.journal.ownership import lock_path
from modeviz.journal.records import Records
from modeviz.journal.sessions import StoredSession
from modeviz.report.notes import Note

TESTS = Path(__file__).parents[1]

OWNER = """
import sys, time
from pathlib import Path
from journal_studies import opened
study = opened(Path(sys.argv[1]))
print("open", flush=True)
time.sleep(60)
"""

FILLED = """
import resource, sys
from pathlib import Path
from journal_studies import KEY, change, opened
told = []
study = opened(Path(sys.argv[1]), tell=told.append)
study.begin(KEY)
study.record(KEY, change(1, 2))
assert study.flush(5)
hard = resource.getrlimit(resource.RLIMIT_FSIZE)[1]
resource.setrlimit(resource.RLIMIT_FSIZE, (Path(f"{study.path}-wal").stat().st_size, hard))
for i in range(2, 30):
    study.record(KEY, change(i, i + 1))
study.look(KEY, "look")
assert not study.flush(1)
assert study.n_unsaved == 29, study.n_unsaved
assert study.trouble.startswith("not saved since "), study.trouble
resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, hard))
assert study.flush(5)
assert (study.trouble, study.n_unsaved) == ("", 0)
assert len(told) == 2 and told[1] == "", told
session = study.restore(KEY)
assert len(session.past) == 29 and session.state == "look"
assert study.close()
print("all there")
"""


@pytest.fixture
def path(tmp_path):
    return tmp_path / "truck.modeviz"


@pytest.fixture
def written(path):
    study = opened(path)
    study.begin(KEY)
    for i in range(200):
        study.record(KEY, change(i, i + 1))
    assert study.close()
    return path


def fails_with(error: Exception):
    def fails(*_):
        raise error

    return fails


def restored(path: Path) -> StoredSession:
    session = Records.of_file(path).restore(KEY)
    assert session
    return session


def run(program: str, *arguments: object) -> subprocess.Popen:
    return subprocess.Popen(
        [sys.executable, "-c", program, *map(str, arguments)],
        env={**os.environ, "PYTHONPATH": str(TESTS)},
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )


def refused(path: Path) -> str:
    """The words with which a file is refused to those who write and who read, and is left alone."""
    before = {each.name: each.read_bytes() for each in path.parent.iterdir()}
    with pytest.raises(ModevizError) as to_write:
        opened(path)
    with pytest.raises(ModevizError) as to_read:
        Records.of_file(path)
    assert str(to_write.value) == str(to_read.value)
    assert {each.name: each.read_bytes() for each in path.parent.iterdir()} == before
    return str(to_read.value)


def test_ten_kills_at_random_lose_nothing_that_was_saved(tmp_path):
    killed = kill_often(tmp_path, 10, seed=1, rounds_of_a_file=5)
    assert killed.n_saved > 0


def test_what_a_full_disk_keeps_from_being_saved_is_saved_once_there_is_room(path):
    pytest.importorskip("resource")
    process = run(FILLED, path)
    out, errors = process.communicate(timeout=60)
    assert out == "all there\n", errors


@pytest.mark.parametrize("words", ["database or disk is full", "No space left on device"])
def test_a_full_disk_is_called_so(path, monkeypatch, words):
    study = opened(path)

    error = sqlite3.OperationalError(words) if "database" in words else OSError(28, words)
    monkeypatch.setattr("modeviz.journal.writer._commit", fails_with(error))
    study.begin(KEY)
    assert not study.flush(0.5)
    assert re.fullmatch(r"not saved since \d\d:\d\d: the disk is full", study.trouble)
    monkeypatch.undo()
    assert study.close()


def test_however_much_is_done_on_a_full_disk_memory_is_bounded_and_the_newest_is_saved(
    path, monkeypatch
):
    """Two sessions that are used without a pause, and more pictures than memory is to hold."""
    monkeypatch.setattr(waiting, "LARGEST", 10_000)
    study, other = opened(path), "another session"
    for each in (KEY, other):
        study.begin(each)
        study.record(each, change(0, 1))
    assert study.flush(5)
    full = sqlite3.OperationalError("database or disk is full")
    monkeypatch.setattr(writer, "_commit", fails_with(full))
    study.look(KEY, "first look")
    assert not study.flush(0.2)
    for i in range(1, 6001):
        study.record(KEY, change(i, i + 1))
        if i % 3:
            study.record(KEY, change(i, i + 1, "undo"))
            study.record(KEY, change(i, i + 1, "redo"))
        study.look(KEY, f"look {i}")
        study.look(other, f"look {i}")
        assert study.n_unsaved < 2 * study_file.EVERY + writer.MOST_AT_ONCE + 20
    for i in range(30):
        study.put_picture(KEY, b"x" * 1000, f"picture {i}")
    assert not study.flush(0.2)
    assert re.fullmatch(r"not saved since .*: the disk is full; lost: 20 pictures", study.trouble)
    monkeypatch.undo()
    assert study.flush(60)
    session = study.restore(KEY)
    assert session
    assert session.state == "look 6000"
    assert session.past == tuple(Step(f"state {i}", f"state {i + 1}") for i in range(5501, 6001))
    assert not session.future
    assert session.tuning == change(6000, 6001).tuning
    assert [line.caption for line in study.pictures(KEY)] == [f"picture {i}" for i in range(20, 30)]
    assert study.trouble == ""
    assert study.close()


def test_a_session_that_is_not_saved_is_not_opened_as_it_was_before(path, monkeypatch):
    study = opened(path)
    study.begin(KEY)
    assert study.flush(5)
    monkeypatch.setattr(
        "modeviz.journal.writer._commit", fails_with(sqlite3.DatabaseError("malformed"))
    )
    study.record(KEY, change(1, 2))
    assert not study.flush(0.2)
    assert not study.is_saved(KEY)
    with pytest.raises(ModevizError, match=r"cannot be opened now \(not saved"):
        study.restore(KEY)
    assert study.restore("another session") is None
    monkeypatch.undo()
    assert study.flush(60)
    session = study.restore(KEY)
    assert session
    assert session.state == "state 2"
    assert study.is_saved(KEY)
    assert study.close()


def test_room_that_appears_while_a_session_is_read_does_not_let_an_old_state_through(path, monkeypatch):
    study = opened(path)
    study.begin(KEY)
    study.look(KEY, "old")
    assert study.flush(5)
    read, commit = stored.restore, writer._commit

    def read_then_room(connection, session):
        found = read(connection, session)
        monkeypatch.setattr(writer, "_commit", commit)
        assert study.flush(20)
        return found

    monkeypatch.setattr(stored, "restore", read_then_room)
    monkeypatch.setattr(writer, "_commit", fails_with(OSError(28, "No space left on device")))
    study.look(KEY, "new")
    assert not study.flush(0.2)
    with pytest.raises(ModevizError, match=r"cannot be opened now \(not saved"):
        study.restore(KEY)
    monkeypatch.setattr(writer, "_commit", commit)
    assert study.flush(20)
    assert study.restore(KEY).state == "new"
    assert study.close()


def test_a_note_is_not_lost_to_make_room_for_pictures(path, monkeypatch):
    monkeypatch.setattr(waiting, "LARGEST", 10_000)
    study = opened(path)
    study.begin(KEY)
    assert study.flush(5)
    with monkeypatch.context() as full:
        full.setattr(writer, "_commit", fails_with(OSError(28, "No space left on device")))
        study.look(KEY, "first look")
        assert not study.flush(0.2)
        study.put_note(KEY, Note("rear mounts are too soft"))
        for i in range(3):
            study.put_picture(KEY, b"x" * 6000, f"picture {i}")
        assert not study.flush(0.2)
        assert study.trouble.endswith("lost: 2 pictures")
    assert study.flush(20)
    assert [note.text for note in study.notes(KEY)] == ["rear mounts are too soft"]
    assert [line.caption for line in study.pictures(KEY)] == ["picture 2"]
    assert study.close()


def test_who_fails_to_hear_of_trouble_does_not_end_the_writing(path, monkeypatch):
    def deaf(trouble):
        raise RuntimeError("not now")

    told = []
    study = opened(path, tell=deaf)
    study.watch(told.append)
    monkeypatch.setattr("modeviz.journal.writer._commit", fails_with(MemoryError()))
    study.begin(KEY)
    assert not study.flush(0.3)
    assert len(told) == 1
    monkeypatch.undo()
    assert study.close()


def test_a_damaged_table_keeps_what_is_written_in_memory(path, monkeypatch):
    study = opened(path)
    monkeypatch.setattr(
        "modeviz.journal.sessions.begin",
        fails_with(sqlite3.DatabaseError("database disk is malformed")),
    )
    study.begin(KEY)
    assert not study.flush(0.3)
    assert re.fullmatch(r"not saved since \d\d:\d\d: database disk is malformed", study.trouble)
    monkeypatch.undo()
    study.close(0.1)


def test_a_second_process_is_told_who_has_the_study(path):
    owner = run(OWNER, path)
    assert owner.stdout is not None
    assert owner.stdout.readline() == "open\n"
    try:
        said = rf"is open already, in process {owner.pid} on .* since {time.strftime('%d %b')}"
        with pytest.raises(ModevizError, match=said):
            opened(path)
        assert Records.of_file(path).sessions() == ()
    finally:
        owner.send_signal(signal.SIGKILL)
        owner.communicate()
    assert lock_path(path).exists()  # what is left of the lock
    assert opened(path).close()
    assert not lock_path(path).exists()


def test_a_lock_that_its_owner_removes_meanwhile_is_taken_anew(path, monkeypatch):
    lock, n_taken = ownership._lock, []

    def late(file):
        if not n_taken:
            lock_path(path).unlink()
        n_taken.append(file)
        lock(file)

    monkeypatch.setattr(ownership, "_lock", late)
    study = opened(path)
    assert len(n_taken) == 2
    with pytest.raises(ModevizError, match="is open already"):
        opened(path)
    assert study.close()


def test_a_look_that_comes_while_the_one_before_is_written_is_written_too(path, monkeypatch):
    study, commit = opened(path), writer._commit
    study.begin(KEY)
    assert study.flush(5)

    def slow(*arguments):
        if not seen:
            seen.append(study.look(KEY, "newest"))
        commit(*arguments)

    seen = []
    monkeypatch.setattr(writer, "_commit", slow)
    study.look(KEY, "before")
    session = study.restore(KEY)
    assert session
    assert session.state == "newest"
    assert study.close()


def test_a_study_that_is_open_twice_in_one_process_is_refused_too(path):
    study = opened(path)
    with pytest.raises(ModevizError, match=f"process {os.getpid()}"):
        opened(path)
    assert study.close()


@pytest.mark.parametrize(
    "said", ["", "{", "[]", '{"pid": 1}', json.dumps({"pid": 1, "host": "x" * 999, "since": 1e99})]
)
def test_a_lock_that_says_nonsense_is_believed_no_more_than_it_says(path, said, monkeypatch):
    study = opened(path)
    lock_path(path).write_text(said)
    with pytest.raises(ModevizError, match="is open already, in another process"):
        opened(path)
    assert study.close()


@pytest.mark.parametrize("at", [0, 5, 4096 + 1])
def test_a_damaged_file_is_refused_and_left_as_it_was(written, at):
    content = bytearray(written.read_bytes())
    content[at : at + 300] = b"\xa5" * 300
    written.write_bytes(content)
    assert "damaged" in refused(written)


def test_rates_and_states_are_read_as_they_were_written_or_not_at_all(written):
    content, rng = written.read_bytes(), np.random.default_rng(3)
    whole = restored(written)
    n_refused = 0
    for at in rng.integers(0, len(content) - 16, 40):
        written.write_bytes(content[:at] + rng.bytes(16) + content[at + 16 :])
        try:
            found = restored(written)
        except ModevizError:
            n_refused += 1
        else:
            assert (found.past, found.state, found.tuning) == (whole.past, whole.state, whole.tuning)
    assert n_refused > 5


def test_a_file_that_was_cut_off_is_refused_and_left_as_it_was(written):
    for size in (written.stat().st_size // 2, 4096, 50):
        written.write_bytes(written.read_bytes()[:size])
        assert "damaged" in refused(written)


def test_a_state_that_is_not_as_written_is_said_and_other_sessions_open(written):
    other = "another session"
    study = opened(written)
    study.begin(other)
    study.record(other, change(1000, 1001))
    study.close()
    connection = sqlite3.connect(written)
    connection.execute(
        "UPDATE content SET packed = zeroblob(9) WHERE id = (SELECT before FROM change WHERE id = 50)"
    )
    connection.commit()
    connection.close()
    study = opened(written)
    with pytest.raises(ModevizError, match=r"truck.modeviz: content \d+ .*damaged"):
        study.restore(KEY)
    session = study.restore(other)
    assert session
    assert session.past == (Step("state 1000", "state 1001"),)
    study.close()


def test_a_later_version_is_refused_and_left_as_it_was(written, monkeypatch):
    monkeypatch.setattr(opening, "VERSION", schema.VERSION - 1)
    assert "was written by a later modeviz" in refused(written)


def test_a_later_version_is_called_so_though_nothing_else_of_it_can_be_read(written):
    content = bytearray(written.read_bytes())
    content[60:64] = (schema.VERSION + 1).to_bytes(4, "big")
    content[4096:] = b"\xa5" * len(content[4096:])
    written.write_bytes(content)
    assert "was written by a later modeviz" in refused(written)


def test_a_later_version_that_is_in_the_log_alone_is_refused(written):
    connection = opening.open_to_write(written)
    connection.execute("PRAGMA user_version = 99")
    copies = [
        shutil.copy(each, written.with_name(each.name.replace("truck", "copy")))
        for each in written.parent.iterdir()
        if not each.name.endswith("-shm")
    ]
    assert len(copies) == 2
    connection.close()
    with pytest.raises(ModevizError, match="version 99"):
        opened(written.with_name("copy.modeviz"))


def test_another_database_and_another_file_are_refused(path, tmp_path):
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE mine (x)")
    connection.commit()
    connection.close()
    assert "no study of modeviz" in refused(path)
    path.write_text("[vehicle]\n" * 50)
    assert "no study of modeviz" in refused(path)


@pytest.mark.parametrize("begin", [b"", None])
def test_a_file_whose_making_was_killed_is_a_new_study(path, begin):
    if begin is None:
        opening.open_to_write(path).close()  # a header, no tables
    else:
        path.write_bytes(begin)
    study = opened(path)
    study.begin(KEY)
    assert len(study.sessions()) == 1
    assert study.close()


def test_a_file_that_cannot_be_written_is_said(path, tmp_path):
    with pytest.raises(ModevizError, match=r"cannot be written \(there is no folder"):
        opened(tmp_path / "missing" / "truck.modeviz")
    path.mkdir()
    with pytest.raises(ModevizError, match="expected a study file"):
        opened(path)


def test_a_folder_where_nothing_can_be_written_is_said(path, monkeypatch):
    def refuses(*_):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr("modeviz.journal.ownership.os.open", refuses)
    with pytest.raises(ModevizError, match=r"truck.modeviz: cannot be locked \(Permission"):
        opened(path)


def test_a_file_that_is_read_only_is_said(written, monkeypatch):
    monkeypatch.setattr("modeviz.journal.study_file.os.access", lambda *_: False)
    with pytest.raises(ModevizError, match="is read-only: give another file with --study"):
        opened(written)
    assert not lock_path(written).exists()


def test_who_has_no_room_to_say_so_has_the_lock_nevertheless(path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("modeviz.journal.ownership.os.write", full)
    study = opened(path)
    monkeypatch.undo()
    with pytest.raises(ModevizError, match="is open already, in another process"):
        opened(path)
    assert study.close()


def test_a_study_that_was_taken_away_says_so_and_goes_on_when_it_is_back(path, tmp_path):
    study = opened(path)
    study.begin(KEY)
    assert study.flush(5)
    for each in list(tmp_path.iterdir()):
        each.rename(tmp_path.parent / each.name)
    study.record(KEY, change(1, 2))
    assert not study.flush(0.5)
    assert re.fullmatch(r"not saved since \d\d:\d\d: the study file is gone", study.trouble)
    for each in tmp_path.parent.glob("truck.modeviz*"):
        each.rename(path.parent / each.name)
    session = study.restore(KEY)
    assert session
    assert session.past == (Step("state 1", "state 2"),)
    assert study.close()


def test_a_study_is_read_while_it_is_written(path):
    study = opened(path)
    study.begin(KEY)
    assert study.flush(5)
    ended = threading.Event()

    def write():
        for i in range(200):
            study.record(KEY, change(i, i + 1))
            study.flush(5)
        ended.set()

    threading.Thread(target=write).start()
    seen = []
    while not ended.is_set():
        seen.append(len(Records.of_file(path).history()))
    assert seen == sorted(seen)
    assert len(Records.of_file(path).history()) == 200
    assert study.close()


def test_many_threads_write_and_nothing_is_lost(path):
    study = opened(path)
    keys = [study.session_id(f"key {i}") for i in range(8)]

    def write(key):
        study.begin(key)
        for i in range(50):
            study.record(key, change(i, i + 1))
            study.look(key, f"look {i}")

    threads = [threading.Thread(target=write, args=(key,)) for key in keys]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [line.n_changes for line in study.sessions()] == [50] * 8
    assert study.close()
