"""What happened in a study, in the order in which it was written."""

from dataclasses import dataclass
from sqlite3 import Connection

from modeviz.journal.changes import Difference, differences_of
from modeviz.journal.contents import text


@dataclass(frozen=True)
class Entry:
    """A line of the history."""

    number: int
    """From 1 on for all of a study, in the order of what happened: the clock may have been set back."""
    session: int | None
    """The number of the session; None of what is for all."""
    time: float
    """As the clock said, s since 1970."""
    author: str
    kind: str
    """"step", "undo", "redo", "note", "search", "front", "scatter" or "picture"."""
    title: str
    differences: tuple[Difference, ...] = ()
    is_undone: bool = False
    """Whether it was undone, and not redone."""


ENTRIES = """
SELECT id, session, time, author, kind, title, differences, place FROM change
UNION ALL
SELECT id, session, time, author, 'note',
    CASE WHEN removed IS NULL THEN '' ELSE '(removed) ' END
    || trim(kind || ' ' || name) || ': ' || text, NULL, '' FROM note
UNION ALL
SELECT id, session, time, author, kind, title, NULL, '' FROM run
UNION ALL
SELECT id, session, time, author, 'picture', caption, NULL, '' FROM picture
ORDER BY 1
"""


def history(connection: Connection, session: int | None = None) -> tuple[Entry, ...]:
    """Return all that happened, or what did in one session."""
    rows = connection.execute(ENTRIES).fetchall()
    return tuple(
        Entry(
            number,
            *of_change,
            differences=differences_of(text(connection, differences)) if differences else (),
            is_undone=place in ("undone", "gone"),
        )
        for number, (_, *of_change, differences, place) in enumerate(rows, 1)
        if session is None or of_change[0] in (session, None)
    )
