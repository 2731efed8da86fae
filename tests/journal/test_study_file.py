"""What sessions write to a study is there after a restart, and what they undo too."""

import pytest
from journal_studies import KEY, VEHICLE, change, opened, pinned

from modeviz.errors import ModevizError
from modeviz.journal.changes import Step
from modeviz.journal.fingerprint import Fingerprint
from modeviz.journal.runs import Run
from modeviz.report.notes import Note


@pytest.fixture
def path(tmp_path):
    return tmp_path / "truck.modeviz"


def left(path, *changes, look=None):
    """The session that some changes leave, read by another opening of the file."""
    study = opened(path)
    study.begin(KEY, "Ada")
    for each in changes:
        study.record(KEY, each)
    if look:
        study.look(KEY, look)
    assert study.close()
    again = opened(path)
    session = again.restore(KEY)
    again.close()
    assert session
    return session


def test_steps_come_back_in_their_order_with_the_newest_state(path):
    session = left(path, change(1, 2), change(2, 3))
    assert session.past == (Step("state 1", "state 2"), Step("state 2", "state 3"))
    assert session.state == "state 3"
    assert session.tuning.rates == pinned(3).rates


def test_what_was_undone_can_be_redone_after_a_restart(path):
    session = left(path, change(1, 2), change(2, 3), change(2, 3, "undo"), change(1, 2, "undo"))
    assert session.past == ()
    assert session.future == (Step("state 2", "state 3"), Step("state 1", "state 2"))
    assert session.state == "state 1"


def test_redoing_takes_the_last_undone_step(path):
    undone = (change(1, 2), change(2, 3), change(2, 3, "undo"), change(1, 2, "undo"))
    session = left(path, *undone, change(1, 2, "redo"))
    assert session.past == (Step("state 1", "state 2"),)
    assert session.future == (Step("state 2", "state 3"),)


def test_a_new_step_drops_what_was_undone(path):
    session = left(path, change(1, 2), change(1, 2, "undo"), change(1, 5))
    assert (session.past, session.future) == ((Step("state 1", "state 5"),), ())


def test_a_step_that_is_not_there_is_redone_and_undone_without_another_one(path):
    first, missing = Step("state 0", "state 1"), Step("state 1", "state 2")
    session = left(path, change(0, 1), change(1, 2, "redo"))
    assert (session.past, session.future) == ((first, missing), ())
    session = left(path, change(1, 2, "undo"))
    assert (session.past, session.future) == ((first,), (missing,))


def test_a_step_that_is_not_there_is_undone_before_those_that_were_undone_already(path):
    session = left(path, change(1, 2), change(1, 2, "undo"), change(0, 1, "undo"))
    assert session.future == (Step("state 1", "state 2"), Step("state 0", "state 1"))
    session = left(path, change(0, 1, "redo"))
    assert session.past == (Step("state 0", "state 1"),)
    assert session.future == (Step("state 1", "state 2"),)


def test_a_drag_is_one_step(path):
    session = left(path, change(1, 2), *(change(1, 2 + i / 10, "longer") for i in range(9)))
    assert session.past == (Step("state 1", "state 2.8"),)


def test_a_drag_back_to_its_beginning_is_no_step(path):
    session = left(path, change(0, 1), change(1, 2), change(1, 1, "back"))
    assert session.past == (Step("state 0", "state 1"),)
    assert session.state == "state 1"


def test_the_newest_look_counts(path):
    study = opened(path)
    study.begin(KEY)
    for i in range(5):
        study.look(KEY, f"look {i}")
    study.close()
    assert left(path, look="another mode").state == "another mode"


def test_a_variant_is_kept_until_it_is_forgotten(path):
    session = left(path, change(1, 2, v1=2), change(2, 3, v1=2, v2=3), change(3, 4, v2=3))
    assert session.tuning.variants == {"v2": pinned(3)}


def test_a_key_opens_its_own_session_alone(path):
    left(path, change(1, 2))
    study = opened(path)
    assert study.restore(study.session_id("another-key")) is None
    study.close()


def test_a_session_knows_the_vehicle_that_it_was_left_with(path):
    session = left(path, change(1, 2))
    now = Fingerprint({"body cab": "2", "body box": "1"})
    told = now.changed_since(session.vehicle)
    assert told == ("body cab", "new body box", "no mount group C2")
    assert VEHICLE.changed_since(session.vehicle) == ()


def test_a_review_shows_its_session_until_it_ends(path):
    study = opened(path)
    review = study.session_id("a-review-key")
    study.begin(KEY)
    study.share(KEY, review, "Ada")
    assert study.reviews() == {review: KEY}
    study.end_reviews(KEY)
    assert study.reviews() == {}
    (line,) = study.sessions()
    (of_it,) = line.reviews
    assert of_it.author == "Ada"
    assert of_it.ended >= of_it.begun
    study.close()


def test_a_session_is_called_what_its_owner_called_it_last(path):
    study = opened(path)
    study.begin(KEY, "Ada")
    for title in ("stiffer", "softer"):
        study.name(KEY, title)
    study.close()
    again = opened(path)
    assert [line.title for line in again.sessions()] == ["softer"]
    assert again.restore(KEY).title == "softer"
    again.close()


def test_keys_are_nowhere_in_the_file(path):
    left(path, change(1, 2))
    assert b"the-key-of-one-session" not in path.read_bytes()


def test_states_that_nothing_leads_to_are_dropped(path):
    study = opened(path)
    study.begin(KEY)
    study.record(KEY, change(1, 2))
    for i in range(20):
        study.record(KEY, change(1, 2 + i, "longer"))
        study.look(KEY, f"look {i}")
        assert study.flush(5)
    with study._reading() as connection:
        assert connection.execute("SELECT count(*) FROM content").fetchone() == (5,)
    study.close()


def test_notes_are_of_their_session_or_of_all(path):
    study = opened(path)
    other = study.session_id("another-key")
    study.begin(KEY)
    study.begin(other)
    study.put_note(KEY, Note("too soft", "mount", "C2 left", "Ada"))
    study.put_note(other, Note("secret"))
    token = study.put_note(None, Note("for the review on Monday", author="Bob"))
    assert [note.text for note in study.notes(KEY)] == ["too soft", "for the review on Monday"]
    assert study.notes(KEY)[0].about == "mount C2 left"
    study.put_note(None, Note("for the review on Tuesday", author="Bob", token=token))
    study.remove_note(other, study.notes(other)[0].token)
    assert [note.text for note in study.notes(other)] == ["for the review on Tuesday"]
    study.close()


def test_a_note_of_another_session_can_be_neither_changed_nor_removed(path):
    study = opened(path)
    other = study.session_id("another-key")
    study.begin(KEY)
    study.begin(other)
    token = study.put_note(KEY, Note("mine"))
    study.remove_note(other, token)
    study.put_note(other, Note("yours", token=token))
    assert [note.text for note in study.notes(KEY)] == ["mine"]
    study.close()


@pytest.mark.parametrize(
    "wrong",
    [
        {"text": " "},
        {"text": "x" * 10_001},
        {"text": "x", "name": "C2"},
        {"text": "x", "kind": "mode"},
        {"text": "x\udcff"},
    ],
)
def test_a_note_that_says_nothing_too_much_or_of_nothing_is_refused(wrong):
    with pytest.raises(ModevizError, match="a note: "):
        Note(**wrong)


def test_a_run_goes_on_under_its_token(path):
    study = opened(path)
    study.begin(KEY)
    token = study.put_run(KEY, Run("search", "paper, 3 of 20 starts", '{"best": 1.9}', "Ada"))
    study.put_run(KEY, Run("search", "paper, 20 starts", '{"best": 1.3}', "Ada", 12.0, token=token))
    (run,) = study.runs(KEY)
    assert (run.title, run.record, run.duration) == ("paper, 20 starts", '{"best": 1.3}', 12.0)
    study.close()


def test_a_picture_is_given_to_its_session_alone(path):
    study = opened(path)
    other = study.session_id("another-key")
    study.begin(KEY)
    study.begin(other)
    token = study.put_picture(KEY, b"\x89PNG...", "Cab yaw", "Ada")
    assert study.picture(KEY, token) == b"\x89PNG..."
    assert study.picture(other, token) is None
    assert [line.caption for line in study.pictures(KEY)] == ["Cab yaw"]
    study.close()


def test_the_history_is_in_the_order_of_what_happened_though_the_clock_is_set_back(path, monkeypatch):
    study = opened(path)
    for i, happens in enumerate(
        (
            lambda: study.begin(KEY),
            lambda: study.record(KEY, change(1, 2, v1=2)),  # a variant is no entry of its own
            lambda: study.put_note(KEY, Note("better")),
            lambda: study.record(KEY, change(2, 3)),
            lambda: study.record(KEY, change(2, 3, "undo")),
            lambda: study.put_run(KEY, Run("scatter", "10 000 vehicles", "{}")),
        )
    ):
        monkeypatch.setattr("time.time", lambda i=i: 1e9 - 1e6 * i)
        happens()
    entries = study.history()
    assert [entry.kind for entry in entries] == ["step", "note", "step", "undo", "scatter"]
    assert [entry.number for entry in entries] == [1, 2, 3, 4, 5]
    assert [entry.is_undone for entry in entries] == [False, False, True, False, False]
    assert entries[0].differences[0].what == "C2.lateral"
    study.close()


def test_a_write_that_cannot_be_is_left_out_and_the_others_are_there(path, caplog):
    study = opened(path)
    study.record("of a session that was not begun", change(1, 2))
    study.begin(KEY)
    study.record(KEY, change(1, 2))
    session = study.restore(KEY)
    assert session
    assert session.past == (Step("state 1", "state 2"),)
    assert "left out" in caplog.text
    study.close()
