"""Left column: what is noted on the study, its variants, modes and mounts."""

import threading
import time
from collections.abc import Callable, Mapping
from html import escape

import viser

from modeviz.errors import ModevizError
from modeviz.journal.sessions import SessionId
from modeviz.journal.study_file import StudyFile
from modeviz.report.notes import Note, PinnedTo
from modeviz.text.wording import sentence_case
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, span
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.note_book import NoteBook, StudyNotes
from modeviz.viewer.session.session import Session

N_ROWS = 30
"""So many of the newest notes can be removed; older ones are listed only."""

ADD = "Add note"
STUDY = "The study"

Target = tuple[PinnedTo, str]


class NotesPanel:
    """The notes, and a box for another one."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls."""
        self._session = session
        self._book = NoteBook()
        self._targets: Mapping[str, Target] = {STUDY: ("study", "")}
        self._lock = threading.Lock()
        with gui.add_folder("Notes", expand_by_default=False):
            self._buttons = NamedButtons(gui, self._remove)
            self._list = gui.add_html("")
            self._text = gui.add_text("Note", "", multiline=True, hint="The report has it, too")
            self._target = gui.add_dropdown(
                "On",
                tuple(self._targets),
                hint="The study, a pinned set of rates, the mode that is shown, or mounts of the "
                "selected group",
            )
            add = gui.add_button_group("Keep", (ADD,), hint="With the time and your name")
        add.on_click(self._add)
        self._draw()

    @property
    def notes(self) -> tuple[Note, ...]:
        """All there are, the first one first."""
        return self._book.notes()

    def keep_in(self, study: StudyFile, session: SessionId, author: Callable[[], str]) -> None:
        """Keeps notes in a study file from now on, and shows those that are there.

        Args:
            study: where.
            session: whose notes they are.
            author: says who adds one, in the thread in which that is done.
        """
        self._book.keep_in(StudyNotes(study, session), author)
        self._draw()

    def show(self, solved: Solved) -> None:
        """Offers what there is in an answer to pin notes to."""
        self._targets = targets(self._session, solved)
        chosen = self._target.value
        assign(self._target, options=tuple(self._targets))
        if chosen in self._targets:
            assign(self._target, value=chosen)

    def _add(self, event: viser.GuiEvent) -> None:
        kind, name = self._targets.get(self._target.value, ("study", ""))
        try:
            self._book.add(Note(self._text.value.strip(), kind, name))
        except ModevizError as error:
            if event.client:
                event.client.add_notification("Not noted", sentence_case(str(error)), color="red")
            return
        self._text.value = ""
        self._draw()

    def _remove(self, token: str) -> None:
        self._book.remove(token)
        self._draw()

    def _draw(self) -> None:
        """Lists the notes, the newest first; may be called in any thread."""
        with self._lock:
            notes = self.notes[::-1]
            self._buttons.keep([note.token for note in notes if not note.is_for_all][:N_ROWS])
            items = [self._item(note) for note in notes]
            assign(self._list, content=block(*(items or [span("Nothing is noted yet.", "dim")])))

    def _item(self, note: Note) -> str:
        told = filter(None, (note.author, "for all sessions" if note.is_for_all else "", _day(note)))
        head = f"{escape(sentence_case(note.about))} {span(escape(', '.join(told)), 'dim')}"
        text = "<br>".join(map(escape, note.text.splitlines()))
        return f'<div class="remark"><div>{head}{self._cross(note)}</div>{text}</div>'

    def _cross(self, note: Note) -> str:
        """What removes a note, where that is possible."""
        if note.token not in self._buttons:
            return ""
        return self._buttons.label(note.token, '<span title="Remove this note">×</span>')


def targets(session: Session, solved: Solved) -> dict[str, Target]:
    """Return what a note can be pinned to, by what the page calls it.

    That is the study, every pinned set, the mode that is followed, the selected group and its mounts.
    """
    found: dict[str, Target] = {STUDY: ("study", "")}
    found |= {f"Variant {name}": ("variant", name) for name in solved.state.design.variants}
    mode = solved.followed.name.name
    found[f"Mode {mode}"] = ("mode", mode)
    if solved.state.group:
        found[f"Mounts {solved.state.group}"] = ("mount", solved.state.group)
        group = session.vehicle.mount_group(solved.state.group)
        found |= {f"Mount {mount.name}": ("mount", mount.name) for mount in group.mounts}
    return found


def _day(note: Note) -> str:
    return time.strftime("%Y-%m-%d %H:%M", time.localtime(note.time))
