"""Writes what a session accepts to a study file, in a thread of its own: no hand waits for it."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace

from modeviz.journal.changes import Change
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.journal.tuning import Pinned, Tuning
from modeviz.viewer.session.author import OWNER, Author
from modeviz.viewer.session.design import Design
from modeviz.viewer.session.differences import differences, title
from modeviz.viewer.session.encoding.text import text_of
from modeviz.viewer.session.history import Accepted
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State
from modeviz.viewer.session.view import PageView

PACE = 0.2
"""s between two writes of one drag, or of looks: of those between the last counts."""

PATIENCE = 5.0
"""s that closing waits for the disk."""

WORDS = {"undo": "Undo: ", "redo": "Redo: "}

GOES_ON = ("step", "longer")
"""Kinds that a longer change is one with."""

LAZY = ("longer", "look", "view")
"""Kinds of entries that may wait for one that overtakes them."""


@dataclass(frozen=True)
class _Entry:
    """An accepted change or look, or how pages show it all."""

    what: Accepted | PageView
    author: Author = OWNER

    @property
    def kind(self) -> str:
        return self.what.kind if isinstance(self.what, Accepted) else "view"


class Recorder:
    """Keeps a session in a study file from now on: every change, undo and redo, and how one looks.

    A session is opened with what `recorded` gives, and then recorded:

        opening = recorded(study, name, usual, vehicle, fingerprint)
        app = App(vehicle, rates, conditions, server, opening=opening)
        recorder = Recorder(app.session, study, name, author, server.mistake)
        ...
        recorder.close()

    `StudyFile.trouble` says what cannot be saved; nothing is lost by that while the process lives.
    """

    def __init__(
        self,
        session: Session,
        study: StudyFile,
        name: SessionId,
        author: Callable[[], Author],
        mistake: Callable[[Exception], object],
    ) -> None:
        """Begins.

        Args:
            session: what is recorded.
            study: where.
            name: under which the study file knows it.
            author: says who undoes or redoes a step, in the thread in which that is done.
            mistake: told what is our mistake; what is accepted after that is recorded all the same.
        """
        self._study, self._name = study, name
        self._author, self._mistake = author, mistake
        self._changed = threading.Condition()
        self._waiting: list[_Entry] = []
        self._is_busy = self._is_closed = False
        self._n_hurried = 0
        self._written_at = 0.0
        self._texts: list[tuple[State, str]] = []
        study.begin(name, author().name)
        study.look(name, text_of(session.state))
        self._thread = threading.Thread(target=self._run, name="recorder", daemon=True)
        self._thread.start()
        session.watch(self._take)

    def flush(self, timeout: float = PATIENCE) -> bool:
        """Waits until all that was accepted is on the disk; whether that came within `timeout` s."""
        end = time.monotonic() + timeout
        with self._changed:
            self._n_hurried += 1
            self._changed.notify_all()
            is_done = self._changed.wait_for(lambda: not (self._waiting or self._is_busy), timeout)
            self._n_hurried -= 1
        return is_done and self._study.flush(max(0.0, end - time.monotonic()))

    def close(self, timeout: float = PATIENCE) -> bool:
        """Writes what is left and ends; whether all was on the disk within `timeout` s."""
        is_saved = self.flush(timeout)
        with self._changed:
            self._is_closed = True
            self._changed.notify_all()
        self._thread.join(timeout)
        return is_saved

    def see(self, view: PageView) -> None:
        """Notes how pages show the session now."""
        self._put(_Entry(view))

    def _take(self, accepted: Accepted) -> None:
        goes_over = accepted.kind in WORDS  # a step that may be somebody else's
        self._put(_Entry(accepted, self._author() if goes_over else accepted.change.author))

    def _put(self, entry: _Entry) -> None:
        """Notes what is to be written, in place of what that overtakes."""
        with self._changed:
            last = self._waiting[-1].what if self._waiting else None
            if entry.kind == "longer" and isinstance(last, Accepted) and last.kind in GOES_ON:
                self._waiting.pop()
                entry = replace(entry, what=replace(entry.what, kind=last.kind))
            if entry.kind in ("look", "view"):
                self._waiting = [each for each in self._waiting if each.kind != entry.kind]
            self._waiting.append(entry)
            self._changed.notify_all()

    def _run(self) -> None:
        while (entry := self._next()) is not None:
            try:
                self._write(entry)
            except Exception as error:
                self._mistake(error)

    def _next(self) -> _Entry | None:
        """The next entry, once it is due; None when there will be no more."""
        with self._changed:
            self._is_busy = False
            self._changed.notify_all()
            while (wait := self._not_yet()) != 0.0:
                if not self._waiting and self._is_closed:
                    return None
                self._changed.wait(wait)
            self._is_busy, self._written_at = True, time.monotonic()
            return self._waiting.pop(0)

    def _not_yet(self) -> float | None:
        """How long the next entry may wait for one that overtakes it, s; None where there is none."""
        if not self._waiting:
            return None
        is_lazy = all(entry.kind in LAZY for entry in self._waiting)
        if not is_lazy or self._n_hurried or self._is_closed:
            return 0.0
        return max(0.0, self._written_at + PACE - time.monotonic())

    def _write(self, entry: _Entry) -> None:
        accepted = entry.what
        if isinstance(accepted, PageView):
            self._study.see(self._name, text_of(accepted))
            return
        if accepted.kind == "look":
            self._study.look(self._name, self._text(accepted.state))
            return
        before, after = accepted.change.before, accepted.change.after
        self._study.record(
            self._name,
            Change(
                accepted.kind,
                WORDS.get(accepted.kind, "") + title(before.design, after.design),
                self._text(before),
                self._text(after),
                entry.author.name,
                differences(before.design, after.design),
                tuning_of(accepted.state.design),
                entry.author.id,
            ),
        )

    def _text(self, state: State) -> str:
        """A state as text, that of the last few made once."""
        known = next((text for each, text in self._texts if each is state), None)
        text = text_of(state) if known is None else known
        self._texts = [*self._texts[-2:], (state, text)]
        return text


def tuning_of(design: Design) -> Tuning:
    """Return of a design what a study file tells in words."""
    return Tuning(
        design.rates,
        design.alterations.placements,
        {name: Pinned(each.rates, each.placements) for name, each in design.variants.items()},
    )
