"""The study of a vehicle while it is served."""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from modeviz.cli.terminal import remark
from modeviz.journal.fingerprint import fingerprint_of
from modeviz.journal.study_file import StudyFile
from modeviz.vehicle.vehicle import Vehicle


@contextmanager
def kept_study(path: Path, vehicle: Vehicle) -> Iterator[StudyFile]:
    """Yields the study that remembers the sessions of a vehicle; says what is not saved at the end.

    Raises:
        ModevizError: it is in use, damaged, or cannot be written.
    """
    study = StudyFile.open(path, vehicle.name, fingerprint_of(vehicle))
    try:
        yield study
    finally:
        if not study.close():
            what = study.trouble or "not saved: the disk is too slow"
            remark(f"{path}: the last {study.n_unsaved} changes are lost ({what})")
