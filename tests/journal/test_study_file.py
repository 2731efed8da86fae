"""What sessions write to a study is there after a restart, and what they undo too."""

import pytest
from journal_studies import KEY, VEHICLE, change, opened, pinned

from modeviz.journal.changes import Step
from modeviz.journal.fingerprint import Fingerprint


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
    study.share(KEY, review)
    assert study.reviewed(review) == KEY
    study.end_review(review)
    assert study.reviewed(review) is None
    study.close()


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
        assert connection.execute("SELECT count(*) FROM content").fetchone() == (3,)
    study.close()
