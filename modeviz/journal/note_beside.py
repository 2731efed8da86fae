"""A note that is written into a study from outside of the process that may have it open."""

import sqlite3
import time
from dataclasses import replace
from pathlib import Path

from modeviz.errors import ModevizError, reason
from modeviz.journal.notes import write_note
from modeviz.journal.opening import check_is_study, open_to_write
from modeviz.journal.sessions import SessionId, number_of
from modeviz.journal.study_file import new_token
from modeviz.journal.upgrade import upgrade_beside
from modeviz.report.notes import Note


def write_beside(study: Path, session: SessionId | None, note: Note) -> None:
    """Writes a note of a session, or with None one for all.

    Raises:
        ModevizError: there is no sound study, or it cannot be written.
    """
    check_is_study(study)
    upgrade_beside(study)
    written = replace(note, token=new_token(), time=time.time())
    try:
        connection = open_to_write(study)
        try:
            connection.execute("BEGIN IMMEDIATE")
            number = None if session is None else number_of(connection, session)
            write_note(connection, number, written)
            connection.execute("COMMIT")
        finally:
            connection.close()
    except sqlite3.Error as error:
        raise ModevizError(f"{study}: cannot be written ({reason(error)})") from None
