"""All of a study read: other readers check its tables, and of contents those that they ask for."""

import sqlite3
from pathlib import Path

from modeviz.errors import ModevizError, placed
from modeviz.journal.contents import content
from modeviz.journal.opening import check_is_study, connect_as_it_is, damaged
from modeviz.journal.records import Records


def check_whole(path: Path) -> int:
    """Return how many contents a study has; all were read, and are as they were written.

    Raises:
        ModevizError: there is no study, or something in it is not as it was written.
    """
    check_is_study(path)
    n_contents = check_contents(path)
    records = Records.of_file(path)
    records.history()
    for session in records.sessions():
        records.restore(session.id)
    return n_contents


def check_contents(path: Path) -> int:
    """Return how many contents a study has, whose tables were checked; likewise.

    Raises:
        ModevizError: one is not as it was written.
    """
    connection = connect_as_it_is(path)
    try:
        found = connection.execute("PRAGMA integrity_check(1)").fetchone()[0]
        if found != "ok":
            raise ModevizError(damaged(path, str(found)))
        numbers = connection.execute("SELECT id FROM content").fetchall()
        for (number,) in numbers:
            _check_content(connection, path, number)
        return len(numbers)
    except sqlite3.Error as error:
        raise ModevizError(damaged(path, str(error))) from None
    finally:
        connection.close()


def _check_content(connection: sqlite3.Connection, path: Path, number: int) -> None:
    try:
        content(connection, number)
    except ModevizError as error:
        raise ModevizError(placed(str(path), str(error))) from None
