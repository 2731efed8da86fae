"""Notes are added on the page, pinned to what it shows, kept in the study and told in the report."""

from contextlib import contextmanager

import pytest
from guests import heard_until
from html_documents import Document
from journal_studies import KEY, opened
from mounted_cabin import mounted_cabin
from opened_app import text
from visitors import CAMERA, encoded, update, visit, wait_until

from modeviz.analysis.results import Conditions
from modeviz.errors import ModevizError
from modeviz.report.notes import Note
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.panels.notes import ADD, STUDY
from modeviz.viewer.session import note_book
from modeviz.viewer.session.commands.decisions import Pin
from modeviz.viewer.session.note_book import NoteBook

OTHER = "of another session"


@pytest.fixture(scope="module")
def app():
    vehicle = mounted_cabin()
    app = App(vehicle, vehicle.rates, Conditions("flat", 20.0), open_server(port=0))
    app.start()
    assert app.session.wait(60)
    yield app
    app.close()


@contextmanager
def page_of(app):
    """A page, and what puts a note on by it."""
    handles = app.server.gui._gui_input_handle_from_uuid.values()
    button = next(each for each in handles if getattr(each, "options", ()) == (ADD,))
    panel = app.screen.controls.notes
    with visit(app.server) as page:
        page.send(encoded(CAMERA))

        def add(words, on=STUDY):
            page.send(update(panel._text, words))
            page.send(update(panel._target, on))
            page.send(update(button, ADD))

        yield page, add


def test_a_note_is_pinned_to_what_the_page_shows_and_is_in_the_report(app):
    app.session.do(Pin("soft"))
    assert app.session.wait_checked(60)
    wait_until(lambda: "Variant soft" in app.screen.controls.notes._target.options)
    group = app.session.vehicle.mount_groups[0]
    mode = app.session.answer.followed.name.name
    with page_of(app) as (page, add):
        for words, on in (
            ("for Monday", STUDY),
            ("too <soft>\nin roll", f"Mount {group.mounts[0].name}"),
            ("best so far", "Variant soft"),
            ("too low", f"Mode {mode}"),
        ):
            n_before = len(app.screen.controls.notes.notes)
            add(words, on)
            wait_until(lambda n=n_before: len(app.screen.controls.notes.notes) == n + 1)
        abouts = [note.about for note in app.screen.controls.notes.notes]
        mount = f"mount {group.mounts[0].name}"
        assert abouts == ["study", mount, "variant soft", f"mode {mode}"]
        assert "too <soft> in roll" in text(app.screen.controls.notes._list)
        rows = Document(app.documents.report([]).decode()).tables["Notes"][1:]
        told = [row[1] for row in rows if len(row) > 1]
        assert told == ["for Monday", "best so far", "too low", "too <soft>in roll"]
        page.send(update(button_of(app, app.screen.controls.notes.notes[-1]), True))
        wait_until(lambda: len(app.screen.controls.notes.notes) == 3)
        assert "too low" not in text(app.screen.controls.notes._list)


def button_of(app, note):
    """The hidden button that removes a note of the list."""
    return app.screen.controls.notes._buttons._buttons[note.token]


def test_two_pages_that_remove_notes_at_once_remove_those_that_were_clicked(app):
    """The second click was made before the list without the first note came."""
    with page_of(app) as (one, add), page_of(app) as (other, _):
        before = [note.text for note in app.screen.controls.notes.notes]
        for i, words in enumerate(("first", "second", "third")):
            add(words)
            wait_until(lambda n=i: len(app.screen.controls.notes.notes) == len(before) + n + 1)
        first, second, third = app.screen.controls.notes.notes[-3:]
        clicks = [update(button_of(app, note), True) for note in (third, second, second)]
        one.send(clicks[0])
        wait_until(lambda: third not in app.screen.controls.notes.notes)
        other.send(clicks[1])
        other.send(clicks[2])
        wait_until(lambda: second not in app.screen.controls.notes.notes)
        app.screen.controls.notes._remove(second.token)
        assert [note.text for note in app.screen.controls.notes.notes] == [*before, "first"]
        assert first.token in app.screen.controls.notes._buttons


def test_an_empty_note_is_refused(app):
    before = app.screen.controls.notes.notes
    with page_of(app) as (page, add):
        add("  ")
        heard_until(page, lambda told: "Not noted" in str(told))
        add("something")
        wait_until(lambda: len(app.screen.controls.notes.notes) == len(before) + 1)
    assert app.screen.controls.notes.notes[-1].text == "something"


def test_notes_are_kept_in_the_study_and_are_there_when_it_opens_again(tmp_path):
    study, book = opened(tmp_path / "truck.modeviz"), NoteBook()
    study.begin(KEY)
    study.begin(OTHER)
    study.put_note(None, Note("for all"))
    study.put_note(OTHER, Note("a secret"))
    book.add(Note("before it was kept"))
    book.keep_in(note_book.StudyNotes(study, KEY), lambda: "Ada")
    book.add(Note("after"))
    assert [note.text for note in book.notes()] == ["for all", "before it was kept", "after"]
    assert [note.author for note in book.notes()] == ["", "", "Ada"]
    book.remove(book.notes()[1].token)
    study.close()
    again = opened(tmp_path / "truck.modeviz")
    assert [note.text for note in again.notes(KEY)] == ["for all", "after"]
    again.close()


def test_a_session_has_no_more_notes_than_are_bounded(monkeypatch):
    monkeypatch.setattr(note_book, "MOST_NOTES", 2)
    book = NoteBook()
    book.add(Note("one"))
    book.add(Note("two"))
    with pytest.raises(ModevizError, match="2 notes already"):
        book.add(Note("three"))
