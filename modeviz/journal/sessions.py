"""The sessions of a study: what they are called, where they stand, and who may look at them."""

from dataclasses import dataclass
from sqlite3 import Connection
from typing import Literal

from modeviz.journal.changes import Change, Step, steps, write_change
from modeviz.journal.contents import drop_unheld, put_text, text
from modeviz.journal.fingerprint import Fingerprint
from modeviz.journal.schema import next_id
from modeviz.journal.tuning import Pinned, Tuning, pinned_of, pinned_text

SessionId = str
"""The digest of a session's key."""


@dataclass(frozen=True)
class ReviewLine:
    """A review of a session in a list of them."""

    author: str
    """Who shared the session."""
    begun: float
    ended: float | None
    """Both s since 1970; None while its link opens the session."""


@dataclass(frozen=True)
class SessionLine:
    """A session in a list of them."""

    number: int
    id: SessionId
    title: str
    author: str
    """Who began it."""
    begun: float
    used: float
    """When it was last written, both s since 1970."""
    n_changes: int
    variants: tuple[str, ...]
    """Names."""
    reviews: tuple[ReviewLine, ...] = ()
    """The first one first."""


@dataclass(frozen=True)
class StoredSession:
    """A session as it was left."""

    number: int
    title: str
    author: str
    vehicle: Fingerprint
    """Of the vehicle that it was last used with."""
    state: str | None
    """The newest one as text, with how one looked; None: it was begun, and nothing else."""
    view: str
    """How its pages showed that, as text; "" where nobody said."""
    past: tuple[Step, ...]
    """What can be undone, the next one last."""
    future: tuple[Step, ...]
    """What can be redone, the next one last."""
    tuning: Tuning


def begin(
    connection: Connection,
    session: SessionId,
    vehicle: Fingerprint,
    author: str,
    title: str,
    now: float,
) -> None:
    """Writes that a session is used with a vehicle; it is a new one, or one that goes on."""
    of_vehicle = _put_vehicle(connection, vehicle)
    if known_number(connection, session) >= 0:
        update = "UPDATE session SET used = ?, vehicle = ? WHERE digest = ?"
        connection.execute(update, (now, of_vehicle, session))
        return
    tuning = put_text(connection, pinned_text(Pinned({})))
    connection.execute(
        "INSERT INTO session (digest, title, author, begun, used, vehicle, tuning)"
        " VALUES (?, ?, ?, ?, ?, ?, ?)",
        (session, title, author, now, now, of_vehicle, tuning),
    )


def record(connection: Connection, session: SessionId, change: Change, now: float) -> None:
    """Writes a change that a session accepted, and where it stands now."""
    number = number_of(connection, session)
    write_change(connection, number, change, now)
    _put_state(connection, number, change.state, now)
    _put_tuning(connection, number, change, now)


def look(connection: Connection, session: SessionId, state: str, now: float) -> None:
    """Writes the newest state of a session that nobody decided, such as another mode shown."""
    _put_state(connection, number_of(connection, session), state, now)


def see(connection: Connection, session: SessionId, view: str) -> None:
    """Writes how the pages of a session show it."""
    connection.execute("UPDATE session SET view = ? WHERE digest = ?", (view, session))


def name(connection: Connection, session: SessionId, title: str) -> None:
    """Writes what the owner of a session calls it."""
    connection.execute("UPDATE session SET title = ? WHERE digest = ?", (title, session))


def share(connection: Connection, session: SessionId, review: str, author: str, now: float) -> None:
    """Writes that a review, by the digest of its key, shows a session."""
    connection.execute(
        "INSERT OR REPLACE INTO review VALUES (?, ?, ?, ?, NULL)",
        (review, number_of(connection, session), now, author),
    )


def end_reviews(connection: Connection, session: SessionId, now: float) -> None:
    """Writes that the reviews of a session show nothing any more."""
    connection.execute(
        "UPDATE review SET ended = ? WHERE session = ? AND ended IS NULL",
        (now, number_of(connection, session)),
    )


def reviews(connection: Connection) -> dict[str, SessionId]:
    """Return the sessions that reviews show which have not ended, by the digests of their keys."""
    rows = connection.execute(
        "SELECT review.digest, session.digest FROM review JOIN session ON session.id = review.session"
        " WHERE ended IS NULL"
    )
    return dict(rows.fetchall())


def sessions(connection: Connection) -> tuple[SessionLine, ...]:
    """Return every session, the one that was begun first first."""
    rows = connection.execute(
        "SELECT id, digest, title, author, begun, used,"
        " (SELECT count(*) FROM change WHERE change.session = session.id) FROM session ORDER BY id"
    ).fetchall()
    return tuple(
        SessionLine(
            *row,
            variants=tuple(_variants(connection, row[0])),
            reviews=_reviews(connection, row[0]),
        )
        for row in rows
    )


def restore(connection: Connection, session: SessionId) -> StoredSession | None:
    """Return a session as it was left; None where there is none of that key."""
    row = connection.execute(
        "SELECT session.id, title, author, parts, state, view, tuning FROM session"
        " JOIN vehicle ON vehicle.id = session.vehicle WHERE session.digest = ?",
        (session,),
    ).fetchone()
    if row is None:
        return None
    number, title, author, parts, state, view, tuning = row
    present = pinned_of(text(connection, tuning))
    places: tuple[Literal["done"], Literal["undone"]] = ("done", "undone")
    past, future = (steps(connection, number, place) for place in places)
    return StoredSession(
        number,
        title,
        author,
        Fingerprint.of_text(parts),
        None if state is None else text(connection, state),
        view,
        past,
        future,
        Tuning(present.rates, present.placements, _variants(connection, number)),
    )


def number_of(connection: Connection, session: SessionId) -> int:
    """Return the number of a session.

    Raises:
        LookupError: it was not begun.
    """
    row = connection.execute("SELECT id FROM session WHERE digest = ?", (session,)).fetchone()
    if row is None:
        raise LookupError("a session that was not begun")
    return row[0]


def known_number(connection: Connection, session: SessionId) -> int:
    """Return the number of a session; -1 of one that was not begun, which has nothing."""
    try:
        return number_of(connection, session)
    except LookupError:
        return -1


def _put_vehicle(connection: Connection, vehicle: Fingerprint) -> int:
    insert = "INSERT OR IGNORE INTO vehicle (digest, parts) VALUES (?, ?)"
    connection.execute(insert, (vehicle.digest, vehicle.text))
    query = "SELECT id FROM vehicle WHERE digest = ?"
    return connection.execute(query, (vehicle.digest,)).fetchone()[0]


def _put_state(connection: Connection, number: int, state: str, now: float) -> None:
    query = "SELECT state FROM session WHERE id = ?"
    (before,) = connection.execute(query, (number,)).fetchone()
    after = put_text(connection, state)
    update = "UPDATE session SET state = ?, used = ? WHERE id = ?"
    connection.execute(update, (after, now, number))
    if before != after:
        drop_unheld(connection, before)


def _put_tuning(connection: Connection, number: int, change: Change, now: float) -> None:
    """Writes the present rates, and what became of variants."""
    tuning = change.tuning
    query = "SELECT tuning FROM session WHERE id = ?"
    (before,) = connection.execute(query, (number,)).fetchone()
    update = "UPDATE session SET tuning = ? WHERE id = ?"
    connection.execute(update, (put_text(connection, pinned_text(tuning.present)), number))
    drop_unheld(connection, before)
    known, wanted = (
        {name: pinned_text(pinned) for name, pinned in variants.items()}
        for variants in (_variants(connection, number), tuning.variants)
    )
    for name, pinned in known.items():
        if wanted.get(name) != pinned:
            gone = "UPDATE variant SET gone = ? WHERE session = ? AND name = ? AND gone IS NULL"
            connection.execute(gone, (now, number, name))
    for name, pinned in wanted.items():
        if known.get(name) != pinned:
            connection.execute(
                "INSERT INTO variant (id, session, name, time, author, pinned)"
                " VALUES (?, ?, ?, ?, ?, ?)",
                (next_id(connection), number, name, now, change.author, put_text(connection, pinned)),
            )


def _reviews(connection: Connection, number: int) -> tuple[ReviewLine, ...]:
    query = "SELECT author, begun, ended FROM review WHERE session = ? ORDER BY rowid"
    return tuple(ReviewLine(*row) for row in connection.execute(query, (number,)))


def _variants(connection: Connection, number: int) -> dict[str, Pinned]:
    rows = connection.execute(
        "SELECT name, pinned FROM variant WHERE session = ? AND gone IS NULL ORDER BY id", (number,)
    )
    return {name: pinned_of(text(connection, pinned)) for name, pinned in rows.fetchall()}
