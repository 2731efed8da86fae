"""Notes on a study: those of a session, and those that all of its sessions see."""

from sqlite3 import Connection

from modeviz.journal.schema import next_id
from modeviz.report.notes import Note


def write_note(connection: Connection, session: int | None, note: Note) -> None:
    """Writes a note of a session, or with None one for all; or anew what one of its token says.

    One that was removed stays so.
    """
    update = "UPDATE note SET text = ?, changed = ? WHERE token = ? AND session IS ?"
    if connection.execute(update, (note.text, note.time, note.token, session)).rowcount:
        return
    connection.execute(
        "INSERT INTO note (id, token, session, kind, name, time, author, text)"
        " VALUES (?, ?, ?, ?, ?, ?, ?, ?)",
        (
            next_id(connection),
            note.token,
            session,
            note.kind,
            note.name,
            note.time,
            note.author,
            note.text,
        ),
    )


def remove_note(connection: Connection, session: int | None, token: str, now: float) -> None:
    """Takes a note away; it stays in the history."""
    update = "UPDATE note SET removed = ? WHERE token = ? AND session IS ?"
    connection.execute(update, (now, token, session))


def notes(connection: Connection, session: int | None) -> tuple[Note, ...]:
    """Return the notes of a session, or with None of every one, and those for all, in their order."""
    rows = connection.execute(
        "SELECT session, text, kind, name, author, time, token FROM note WHERE removed IS NULL"
        " ORDER BY id"
    )
    wanted = ((of, row) for of, *row in rows if session is None or of in (session, None))
    return tuple(Note(*row, is_for_all=of is None) for of, row in wanted)
