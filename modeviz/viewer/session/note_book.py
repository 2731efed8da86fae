"""The notes of a session: in memory, or in the study file that the session is kept in."""

import time
from collections.abc import Callable
from dataclasses import replace
from typing import Protocol

from modeviz.errors import ModevizError
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile, new_token
from modeviz.report.notes import Note

MOST_NOTES = 500
"""Of a session."""


class NoteStore(Protocol):
    """Where notes are."""

    def notes(self) -> tuple[Note, ...]:
        """Return all of the session and those for all, the first one first."""
        ...

    def put(self, note: Note) -> None:
        """Adds a note."""
        ...

    def remove(self, token: str) -> None:
        """Takes a note of the session away."""
        ...


class MemoryNotes:
    """Notes of a session that is kept nowhere."""

    def __init__(self) -> None:
        """There is none yet."""
        self._notes: tuple[Note, ...] = ()

    def notes(self) -> tuple[Note, ...]:
        return self._notes

    def put(self, note: Note) -> None:
        self._notes = (*self._notes, replace(note, token=new_token(), time=time.time()))

    def remove(self, token: str) -> None:
        self._notes = tuple(note for note in self._notes if note.token != token)


class StudyNotes:
    """Notes of a session in a study file."""

    def __init__(self, study: StudyFile, session: SessionId) -> None:
        """Those that are there already are told, too."""
        self._study, self._session = study, session

    def notes(self) -> tuple[Note, ...]:
        return self._study.notes(self._session)

    def put(self, note: Note) -> None:
        self._study.put_note(self._session, note)

    def remove(self, token: str) -> None:
        self._study.remove_note(self._session, token)


class NoteBook:
    """What is noted in a session, and by whom."""

    def __init__(self) -> None:
        """In memory, by nobody, until `keep_in` says more."""
        self._store: NoteStore = MemoryNotes()
        self._author: Callable[[], str] = str

    def keep_in(self, store: NoteStore, author: Callable[[], str]) -> None:
        """Has notes kept elsewhere from now on; `author` says who adds one, in the thread that does."""
        for note in self._store.notes():
            store.put(note)
        self._store, self._author = store, author

    def notes(self) -> tuple[Note, ...]:
        """Return the notes, the first one first."""
        return self._store.notes()

    def add(self, note: Note) -> None:
        """Adds a note of whoever does.

        Raises:
            ModevizError: there are too many.
        """
        if len(self._store.notes()) >= MOST_NOTES:
            raise ModevizError(f"there are {MOST_NOTES} notes already: remove one first")
        self._store.put(replace(note, author=self._author()))

    def remove(self, token: str) -> None:
        """Takes a note away, if it is still there."""
        self._store.remove(token)
