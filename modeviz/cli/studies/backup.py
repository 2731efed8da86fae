"""The command that copies a study, also while it is used."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.studies.options import StudyOptions, add_study_and_target
from modeviz.journal.backup import backup


@dataclass(frozen=True, kw_only=True)
class BackupOptions(StudyOptions):
    """What `modeviz study backup` is asked for."""

    to: Path
    """A new file, or a folder."""


def back_up(options: BackupOptions) -> None:
    """Writes the copy, and prints which."""
    print(backup(options.path, options.to))


def _add_options(command: ArgumentParser) -> None:
    add_study_and_target(command, "to", "a new file, or a folder")


BACKUP = Command("backup", "copy a study, also while it is used", BackupOptions, _add_options, back_up)
