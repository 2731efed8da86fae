"""Pictures that were made in a session."""

from dataclasses import dataclass
from sqlite3 import Connection

from modeviz.journal.contents import content, drop_unheld, put_content
from modeviz.journal.schema import next_id

MOST = 200
"""Of a session: the oldest goes when there is one more."""


@dataclass(frozen=True)
class PictureLine:
    """A picture in a list of them."""

    token: str
    """By which its content is found."""
    caption: str
    author: str
    time: float
    """s since 1970."""


def write_picture(connection: Connection, session: int, line: PictureLine, png: bytes) -> None:
    """Writes a picture of a session."""
    connection.execute(
        "INSERT INTO picture (id, token, session, time, author, caption, png)"
        " VALUES (?, ?, ?, ?, ?, ?, ?)",
        (
            next_id(connection),
            line.token,
            session,
            line.time,
            line.author,
            line.caption,
            put_content(connection, png),
        ),
    )
    _drop_oldest(connection, session)


def pictures(connection: Connection, session: int) -> tuple[PictureLine, ...]:
    """Return the pictures of a session, the first one first."""
    rows = connection.execute(
        "SELECT token, caption, author, time FROM picture WHERE session = ? ORDER BY id", (session,)
    )
    return tuple(PictureLine(*row) for row in rows)


def picture(connection: Connection, session: int, token: str) -> bytes | None:
    """Return a picture of a session as PNG; None where it has none of that token."""
    query = "SELECT png FROM picture WHERE session = ? AND token = ?"
    row = connection.execute(query, (session, token)).fetchone()
    return row and content(connection, row[0])


def _drop_oldest(connection: Connection, session: int) -> None:
    query = "SELECT id, png FROM picture WHERE session = ? ORDER BY id DESC LIMIT -1 OFFSET ?"
    for number, png in connection.execute(query, (session, MOST)).fetchall():
        connection.execute("DELETE FROM picture WHERE id = ?", (number,))
        drop_unheld(connection, png)
