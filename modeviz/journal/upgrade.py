"""A study that an earlier modeviz has written: brought to the tables of today before it is written."""

import sqlite3
import time
from pathlib import Path

from modeviz.errors import ModevizError, reason
from modeviz.journal.backup import backup
from modeviz.journal.opening import connect_as_it_is, is_of_before, open_to_write
from modeviz.journal.ownership import Ownership
from modeviz.journal.schema import bring_up, version_of
from modeviz.journal.soundness import check_contents


def upgrade(study: Path) -> Path | None:
    """Brings a study to the tables of today, and returns a copy of how it was; None if it has them.

    The process has the study. Whatever goes wrong, it is as before or has all of today's tables.

    Raises:
        ModevizError: something in it is not as it was written, the copy cannot be made, or the study
            not be written.
    """
    if not is_of_before(study):
        return None
    check_contents(study)
    copy = backup(study, _new_name(study))
    try:
        connection = open_to_write(study)
        try:
            bring_up(connection)
        finally:
            connection.close()
    except (sqlite3.Error, OSError) as error:
        raise ModevizError(
            f"{study}: is of an earlier modeviz and cannot be brought up to date ({reason(error)}); it "
            f"is left as it is"
        ) from None
    return copy


def upgrade_beside(study: Path) -> None:
    """Does the same of a study that nobody has.

    Raises:
        ModevizError: as `upgrade`, or a process has it, which is then of an earlier modeviz.
    """
    if is_of_before(study):
        ownership = Ownership(study, time.time())
        try:
            upgrade(study)
        finally:
            ownership.release()


def _new_name(study: Path) -> Path:
    """A name for the copy: "truck-version-1.modeviz", or with a number where that is taken."""
    connection = connect_as_it_is(study)
    try:
        stem = f"{study.stem}-version-{version_of(connection)}"
    finally:
        connection.close()
    name, number = study.with_name(f"{stem}{study.suffix}"), 1
    while name.exists():
        number += 1
        name = study.with_name(f"{stem}-{number}{study.suffix}")
    return name
