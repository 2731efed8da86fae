"""The tables of a study file, and the numbers by which one is known."""

from sqlite3 import Connection

APPLICATION_ID = 0x6D647673
"""In the header of a study file: "mdvs"."""

BEGUN = """
CREATE TABLE study (name TEXT NOT NULL, begun REAL NOT NULL, n_entries INTEGER NOT NULL);
CREATE TABLE vehicle (
    id INTEGER PRIMARY KEY,
    digest TEXT NOT NULL UNIQUE,
    parts TEXT NOT NULL
);
CREATE TABLE content (
    id INTEGER PRIMARY KEY,
    sha256 BLOB NOT NULL UNIQUE,
    packed BLOB NOT NULL
);
CREATE TABLE session (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    digest TEXT NOT NULL UNIQUE,
    title TEXT NOT NULL,
    author TEXT NOT NULL,
    begun REAL NOT NULL,
    used REAL NOT NULL,
    vehicle INTEGER NOT NULL REFERENCES vehicle,
    state INTEGER REFERENCES content,
    view TEXT NOT NULL DEFAULT '',
    tuning INTEGER NOT NULL REFERENCES content
);
CREATE TABLE review (
    digest TEXT PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    begun REAL NOT NULL,
    author TEXT NOT NULL,
    ended REAL
);
CREATE TABLE change (
    id INTEGER PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    kind TEXT NOT NULL,
    title TEXT NOT NULL,
    differences INTEGER NOT NULL REFERENCES content,
    place TEXT NOT NULL,
    before INTEGER REFERENCES content,
    after INTEGER REFERENCES content
);
CREATE INDEX change_of_session ON change (session, place, id);
CREATE TABLE variant (
    id INTEGER PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    name TEXT NOT NULL,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    pinned INTEGER NOT NULL REFERENCES content,
    gone REAL
);
CREATE INDEX variant_of_session ON variant (session, gone);
CREATE TABLE note (
    id INTEGER PRIMARY KEY,
    token TEXT NOT NULL UNIQUE,
    session INTEGER REFERENCES session,
    kind TEXT NOT NULL,
    name TEXT NOT NULL,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    text TEXT NOT NULL,
    changed REAL,
    removed REAL
);
CREATE TABLE run (
    id INTEGER PRIMARY KEY,
    token TEXT NOT NULL UNIQUE,
    session INTEGER NOT NULL REFERENCES session,
    kind TEXT NOT NULL,
    title TEXT NOT NULL,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    duration REAL NOT NULL,
    record INTEGER NOT NULL REFERENCES content
);
CREATE TABLE picture (
    id INTEGER PRIMARY KEY,
    token TEXT NOT NULL UNIQUE,
    session INTEGER NOT NULL REFERENCES session,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    caption TEXT NOT NULL,
    png INTEGER NOT NULL REFERENCES content
);
CREATE INDEX change_before ON change (before);
CREATE INDEX change_after ON change (after);
CREATE INDEX change_differences ON change (differences);
CREATE INDEX session_state ON session (state);
CREATE INDEX session_tuning ON session (tuning);
CREATE INDEX variant_pinned ON variant (pinned);
CREATE INDEX run_record ON run (record);
CREATE INDEX picture_png ON picture (png);
"""
"""The tables of version 1. Times are seconds since 1970, as the clock said; what came first is told by
ids alone, which changes, variants, notes, runs and pictures have from one count.

Of a change `place` is "done", "undone", or "gone" where something else was decided after undoing it;
undoing and redoing are changes of other kinds, whose place is "". Keys of sessions and reviews are
not here, only their digests.
"""

MAKERS = """
ALTER TABLE change ADD COLUMN maker TEXT NOT NULL DEFAULT '';
"""
"""Version 2: by which visitor a change is, `Maker.id`."""

STEPS: tuple[str, ...] = (BEGUN, MAKERS)
"""What makes of the tables of each version those of the next, of a file without tables those of 1.
A step that is in use is never changed: another one is added."""

VERSION = len(STEPS)
"""Of the tables; a file of a later one is not read."""

HOLDERS = (
    ("change", "before"),
    ("change", "after"),
    ("change", "differences"),
    ("session", "state"),
    ("session", "tuning"),
    ("variant", "pinned"),
    ("run", "record"),
    ("picture", "png"),
)
"""The columns that refer to contents: what an engineer relies on is there with its digest."""


def create(connection: Connection, vehicle_name: str, now: float) -> None:
    """Makes the tables of a new file; in a transaction of its own."""
    _begin(connection, 0)
    connection.execute(f"PRAGMA application_id = {APPLICATION_ID}")
    connection.execute("INSERT INTO study VALUES (?, ?, 0)", (vehicle_name, now))
    connection.execute("COMMIT")


def version_of(connection: Connection) -> int:
    """Return the version of the tables that a connection sees."""
    return connection.execute("PRAGMA user_version").fetchone()[0]


def bring_up(connection: Connection) -> None:
    """Makes of the tables of an earlier version those of today; all in one transaction, or nothing."""
    try:
        _begin(connection, version_of(connection))
        connection.execute("COMMIT")
    except BaseException:
        connection.rollback()
        raise


def _begin(connection: Connection, version: int) -> None:
    """Goes on from a version to today's, in a transaction that stays open."""
    steps = "".join(STEPS[version:])
    connection.executescript(f"BEGIN IMMEDIATE; {steps} PRAGMA user_version = {VERSION};")


def next_id(connection: Connection) -> int:
    """Return the id of what is written now."""
    connection.execute("UPDATE study SET n_entries = n_entries + 1")
    return connection.execute("SELECT n_entries FROM study").fetchone()[0]
