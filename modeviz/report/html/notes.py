"""What people remarked on a study: on the whole, on variants, modes and mounts."""

import time
from collections.abc import Sequence
from html import escape

from modeviz.report.notes import Note, PinnedTo
from modeviz.text.markup import section, table

TITLES: dict[PinnedTo, str] = {
    "study": "On the study",
    "variant": "On variants",
    "mode": "On modes",
    "mount": "On mounts",
}
"""Of the notes of each kind, in their order."""


def study_notes(notes: Sequence[Note]) -> str:
    """The section of notes, by what they are pinned to; nothing where there are none."""
    if not notes:
        return ""
    rows: list[list[str]] = []
    for kind, heading in TITLES.items():
        its = [note for note in notes if note.kind == kind]
        rows += [[heading]] * bool(its) + [_row(note) for note in its]
    return section("Notes", table(["", "Note", "By", "On"], rows, words=(1, 2, 3)))


def _row(note: Note) -> list[str]:
    day = time.strftime("%Y-%m-%d", time.localtime(note.time)) if note.time else ""
    text = "<br>".join(map(escape, note.text.splitlines()))
    return [escape(note.name) or "Study", text, escape(note.author), day]
