"""Opening a study file: what is none, is damaged or is of a later modeviz is refused and left alone."""

import sqlite3
from pathlib import Path
from sqlite3 import Connection

from modeviz.errors import ModevizError, reason
from modeviz.journal.columns import wrong_table
from modeviz.journal.schema import APPLICATION_ID, VERSION, bring_up, version_of

MAGIC = b"SQLite format 3\0"
HEADER = 100
"""Bytes with which a file of SQLite begins, https://www.sqlite.org/fileformat.html."""

BUSY = 10.0
"""s: how long to wait for another process that writes."""


def check_file(path: Path) -> bool:
    """Return whether there is a study in a file that can be read; False of an empty or missing one.

    Nothing is written, neither to the file nor beside it.

    Raises:
        ModevizError: it is something else, damaged, or of a later version.
    """
    header = _header(path)
    if not header:
        return False
    if len(header) < HEADER or not header.startswith(MAGIC):
        raise ModevizError(
            f"{path}: is no study of modeviz, or damaged at its beginning; it is left as it is"
        )
    version, application = (int.from_bytes(header[at : at + 4], "big") for at in (60, 68))
    _check_version(path, application, version)
    return _check_sound(path)


def check_is_study(path: Path) -> None:
    """Raises ModevizError as `check_file`, or if there is no study."""
    if not check_file(path):
        raise ModevizError(
            f"{path}: there is no study in it" if path.exists() else f"{path}: there is no such file"
        )


def is_of_before(path: Path) -> bool:
    """Return whether a study that was checked has tables of an earlier version."""
    connection = connect_as_it_is(path)
    try:
        return version_of(connection) < VERSION
    finally:
        connection.close()


def connect_to_read(path: Path) -> Connection:
    """Return a connection to a study that was checked, which changes nothing of it.

    One with tables of an earlier version is read from a copy that has today's, and that nobody sees.
    """
    connection = connect_as_it_is(path)
    if version_of(connection) == VERSION:
        return connection
    try:
        copy = sqlite3.connect("", isolation_level=None, check_same_thread=False)
        connection.backup(copy)
        bring_up(copy)
        return copy
    finally:
        connection.close()


def connect_as_it_is(path: Path) -> Connection:
    """Return a connection that writes nothing; where no log lies beside, it takes not even a lock."""
    has_log = path.with_name(f"{path.name}-wal").exists()
    mode = "mode=ro" if has_log else "mode=ro&immutable=1"
    uri = f"{path.resolve().as_uri()}?{mode}"
    return sqlite3.connect(uri, uri=True, timeout=BUSY, isolation_level=None, check_same_thread=False)


def open_to_write(path: Path) -> Connection:
    """Return a connection whose commits are on the disk when they return; it begins no transactions.

    Raises:
        sqlite3.Error: it cannot be written.
    """
    connection = sqlite3.connect(path, timeout=BUSY, isolation_level=None, check_same_thread=False)
    try:
        connection.execute("PRAGMA journal_mode = WAL")
        connection.execute("PRAGMA synchronous = FULL")
        connection.execute("PRAGMA foreign_keys = ON")
    except sqlite3.Error:
        connection.close()
        raise
    return connection


def _header(path: Path) -> bytes:
    try:
        if path.exists() and not path.is_file():
            raise ModevizError(f"{path}: found a folder or device, expected a study file or a new name")
        with path.open("rb") as file:
            return file.read(HEADER)
    except FileNotFoundError:
        return b""
    except OSError as error:
        raise ModevizError(f"{path}: cannot be read ({reason(error)})") from None


def _check_version(path: Path, application: int, version: int) -> None:
    if application == APPLICATION_ID and version > VERSION:
        raise ModevizError(
            f"{path}: was written by a later modeviz (version {version} of its tables, expected at "
            f"most {VERSION}): open it with that one; it is left as it is"
        )


def _check_sound(path: Path) -> bool:
    """Return whether a database is a study; an empty one, of a process that was killed, is none yet."""
    try:
        connection = connect_as_it_is(path)
        try:
            return _is_study(connection, path)
        finally:
            connection.close()
    except sqlite3.Error as error:
        if error.sqlite_errorcode == sqlite3.SQLITE_CANTOPEN:
            raise ModevizError(
                f"{path}: cannot be read here: what was written last lies in {path.name}-wal, which is "
                "read only in a folder that can be written; copy both into one"
            ) from None
        raise ModevizError(damaged(path, str(error))) from None


def _is_study(connection: Connection, path: Path) -> bool:
    """Return the same of a connection: what was written last may be in the log beside the file."""
    application, version, found = (
        connection.execute(f"PRAGMA {what}").fetchone()[0]
        for what in ("application_id", "user_version", "quick_check(1)")
    )
    if found != "ok":
        raise ModevizError(damaged(path, str(found)))
    if application == APPLICATION_ID:
        _check_version(path, application, version)
        if version < 1:
            raise ModevizError(damaged(path, "its tables have no version"))
        if table := wrong_table(connection):
            raise ModevizError(damaged(path, f"table {table} is not one of a study"))
        return True
    if connection.execute("SELECT 1 FROM sqlite_master").fetchone():
        raise ModevizError(f"{path}: is a database, but no study of modeviz; it is left as it is")
    return False


def damaged(path: Path, words: str) -> str:
    """Return the sentence that refuses a file in which something is wrong."""
    first = " ".join(words.split())[:120]
    return (
        f"{path}: is damaged ({first}): put a backup in its place, or give another file; it is left as "
        "it is"
    )
