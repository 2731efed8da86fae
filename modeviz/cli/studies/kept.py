"""The study of a vehicle while it is served."""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path

from modeviz.cli.terminal import remark
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.study_file import StudyFile
from modeviz.text.log import LOG
from modeviz.vehicle.vehicle import Vehicle


@contextmanager
def kept_study(path: Path, vehicle: Vehicle) -> Iterator[StudyFile]:
    """Yields the study that remembers the sessions of a vehicle; says what is not saved.

    A study that was begun with a vehicle of another name is called so, and where the file is that an
    earlier modeviz had written.

    Raises:
        ModevizError: it is in use, damaged, or cannot be written.
    """
    study = StudyFile.open(path, vehicle.name, fingerprint_of(vehicle), partial(_log, path))
    try:
        if study.former:
            remark(f"{path}: was of an earlier modeviz; as it was it is in {study.former}")
        begun_with = study.study().vehicle_name
        if begun_with != vehicle.name:
            remark(f"{path}: is the study of {begun_with}, and goes on with {vehicle.name}")
        yield study
    finally:
        if not study.close():
            what = study.trouble or "not saved: the disk is too slow"
            remark(f"{path}: {_last(study.n_unsaved)} lost ({what})")


def _log(path: Path, trouble: str) -> None:
    """Logs why nothing can be saved in a study, or, of "", that it is again."""
    event = "unsaved" if trouble else "saved"
    LOG.warning(f"{path}: {trouble or 'saved again'}", extra={"event": event})


def _last(n_changes: int) -> str:
    return "the last change is" if n_changes == 1 else f"the last {n_changes} changes are"
