"""What was computed at length in a session: searches, trade-offs and scatter."""

from dataclasses import dataclass
from sqlite3 import Connection
from typing import Literal

from modeviz.journal.contents import drop_unheld, put_text, text
from modeviz.journal.schema import next_id

RunKind = Literal["search", "front", "scatter"]


@dataclass(frozen=True)
class Run:
    """A computation, with what it found."""

    kind: RunKind
    title: str
    """In a line: "paper, 20 starts: 1.82 to 1.31"."""
    record: str
    """What was asked and found, as JSON."""
    author: str = ""
    duration: float = 0.0
    """s."""
    time: float = 0.0
    """When it ended, s since 1970."""
    token: str = ""
    """By which it is found again."""


def write_run(connection: Connection, session: int, run: Run) -> None:
    """Writes a run of a session, in place of what there is of one with its token."""
    record = put_text(connection, run.record)
    there = "SELECT id, record FROM run WHERE token = ? AND session = ?"
    found = connection.execute(there, (run.token, session)).fetchone()
    if found:
        number, before = found
        connection.execute(
            "UPDATE run SET title = ?, record = ?, duration = ?, time = ? WHERE id = ?",
            (run.title, record, run.duration, run.time, number),
        )
        drop_unheld(connection, before)
        return
    connection.execute(
        "INSERT INTO run (id, token, session, kind, title, time, author, duration, record)"
        " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)",
        (
            next_id(connection),
            run.token,
            session,
            run.kind,
            run.title,
            run.time,
            run.author,
            run.duration,
            record,
        ),
    )


def runs(connection: Connection, session: int) -> tuple[Run, ...]:
    """Return the runs of a session, the first one first."""
    rows = connection.execute(
        "SELECT kind, title, record, author, duration, time, token FROM run"
        " WHERE session = ? ORDER BY id",
        (session,),
    ).fetchall()
    return tuple(
        Run(kind, title, text(connection, record), *more) for kind, title, record, *more in rows
    )
