"""The tables of a study file, and the numbers by which one is known."""

from sqlite3 import Connection

APPLICATION_ID = 0x6D647673
"""In the header of a study file: "mdvs"."""

VERSION = 1
"""Of the tables; a file of a later one is not read."""

TABLES = """
CREATE TABLE study (name TEXT NOT NULL, begun REAL NOT NULL);
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
    tuning TEXT NOT NULL
);
CREATE TABLE review (
    digest TEXT PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    begun REAL NOT NULL,
    author TEXT NOT NULL,
    ended REAL
);
CREATE TABLE change (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    session INTEGER NOT NULL REFERENCES session,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    kind TEXT NOT NULL,
    title TEXT NOT NULL,
    differences TEXT NOT NULL,
    place TEXT NOT NULL,
    before INTEGER REFERENCES content,
    after INTEGER REFERENCES content
);
CREATE INDEX change_of_session ON change (session, place, id);
CREATE INDEX change_before ON change (before);
CREATE INDEX change_after ON change (after);
CREATE INDEX session_state ON session (state);
CREATE TABLE variant (
    id INTEGER PRIMARY KEY AUTOINCREMENT,
    session INTEGER NOT NULL REFERENCES session,
    name TEXT NOT NULL,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    pinned TEXT NOT NULL,
    gone REAL
);
CREATE INDEX variant_of_session ON variant (session, gone);
CREATE TABLE note (
    id TEXT PRIMARY KEY,
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
    id TEXT PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    kind TEXT NOT NULL,
    title TEXT NOT NULL,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    duration REAL NOT NULL,
    outcome TEXT NOT NULL,
    record INTEGER NOT NULL REFERENCES content
);
CREATE TABLE picture (
    id TEXT PRIMARY KEY,
    session INTEGER NOT NULL REFERENCES session,
    time REAL NOT NULL,
    author TEXT NOT NULL,
    caption TEXT NOT NULL,
    png INTEGER NOT NULL REFERENCES content
);
"""
"""Times are seconds since 1970, as the clock said; what came first is told by ids alone.

Of a change `place` is "done", "undone", or "gone" where something else was decided after undoing it;
undoing and redoing are changes of other kinds, whose place is "". Keys of sessions and reviews are
not here, only their digests.
"""


def create(connection: Connection, vehicle_name: str, now: float) -> None:
    """Makes the tables of a new file; in a transaction of its own."""
    script = "".join(f"{statement};" for statement in TABLES.split(";") if statement.strip())
    connection.executescript(
        f"BEGIN IMMEDIATE; PRAGMA application_id = {APPLICATION_ID}; PRAGMA user_version = {VERSION};"
        f"{script}"
    )
    connection.execute("INSERT INTO study VALUES (?, ?)", (vehicle_name, now))
    connection.execute("COMMIT")
