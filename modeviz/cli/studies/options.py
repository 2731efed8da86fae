"""Which study, and which of its sessions."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import ModevizError, listed
from modeviz.files import builtin_vehicle
from modeviz.files.folder import check_is_folder
from modeviz.journal.places import ENDING, study_path
from modeviz.journal.records import Records
from modeviz.journal.sessions import SessionId


@dataclass(frozen=True, kw_only=True)
class StudyOptions:
    """Which study."""

    study: Path | None = None
    """Its file, or the folder of its vehicle; None: the pickup's."""

    @property
    def path(self) -> Path:
        """The file of the study."""
        return file_of(self.study)

    def read(self) -> Records:
        """Return what there is to read of it; raises ModevizError as `Records.of_file`."""
        return Records.of_file(self.path)


def file_of(study: Path | None) -> Path:
    """Return the file of a study: that itself, or of the vehicle in a folder, or of the pickup.

    Raises:
        ModevizError: there is no such file or folder.
    """
    if study is None:
        return study_path(builtin_vehicle(), is_ours=True)
    if study.is_file() or study.suffix == f".{ENDING}":
        return study
    check_is_folder(study)
    return study_path(study)


def session_of(records: Records, number: int | None) -> SessionId | None:
    """Return a session by its number; None for None, which means all of them.

    Raises:
        ModevizError: the study has no session of that number.
    """
    if number is None:
        return None
    known = {line.number: line.id for line in records.sessions()}
    if number not in known:
        raise ModevizError(f"session: found {number}, expected one of {listed(known)}")
    return known[number]


def add_study(command: ArgumentParser, is_needed: bool = False) -> None:
    """Reads `StudyOptions`."""
    command.add_argument(
        "study",
        type=Path,
        metavar="STUDY",
        help="the file of a study, or the folder of its vehicle"
        + ("" if is_needed else " (default: the pickup)"),
        **({} if is_needed else {"nargs": "?", "default": None}),
    )


def add_study_and_target(command: ArgumentParser, name: str, about: str) -> None:
    """Reads `StudyOptions` of a study that is named, and a field with the path that is written."""
    add_study(command, is_needed=True)
    command.add_argument(name, type=Path, metavar=name.upper(), help=about)


def add_session(command: ArgumentParser) -> None:
    """Reads a field `session`."""
    command.add_argument("--session", type=int, metavar="N", help="by its number (default: all)")
