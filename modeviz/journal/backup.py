"""A copy of a study, also of one that is being written."""

import sqlite3
import time
from pathlib import Path
from tempfile import TemporaryDirectory

from modeviz.errors import ModevizError, reason
from modeviz.journal.opening import check_file, check_is_study, connect_as_it_is
from modeviz.journal.places import ENDING


def backup(study: Path, target: Path) -> Path:
    """Copies a study as it is at one moment, and returns the copy, which was read again.

    Args:
        study: the file.
        target: a new file, or a folder, in which the copy is called after the study and the time.

    Raises:
        ModevizError: there is no sound study, or a file already, or it cannot be written.
    """
    moment = time.strftime("%Y-%m-%d-%H%M%S")
    path = target / f"{study.stem}-{moment}.{ENDING}" if target.is_dir() else target
    if path.exists():
        raise ModevizError(f"{path}: is there already; give a new file, or a folder")
    check_is_study(study)
    source = connect_as_it_is(study)
    try:
        with TemporaryDirectory(prefix=".modeviz-", dir=path.absolute().parent) as scratch:
            new = Path(scratch, path.name)
            _copy(source, new)
            check_file(new)
            new.rename(path)
    except (OSError, sqlite3.Error) as error:
        raise ModevizError(f"{path}: cannot be written ({reason(error)})") from None
    finally:
        source.close()
    return path


def _copy(source: sqlite3.Connection, new: Path) -> None:
    copy = sqlite3.connect(new)
    try:
        source.backup(copy)
    finally:
        copy.close()
