"""The command that writes all of a study as JSON, or its variants as CSV."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.results import json_text
from modeviz.cli.studies.options import StudyOptions, add_study_and_target
from modeviz.errors import ModevizError
from modeviz.files.disk import check_writable, write_text
from modeviz.journal.export import study_record, variants_table

ENDINGS = (".json", ".csv")


@dataclass(frozen=True, kw_only=True)
class StudyExportOptions(StudyOptions):
    """What `modeviz study export` is asked for."""

    file: Path
    """Its name ends in ".json" or ".csv"."""


def export_study(options: StudyExportOptions) -> None:
    """Writes the file, and prints which.

    Raises:
        ModevizError: its name says no format, it cannot be written, or the study not be read.
    """
    ending = options.file.suffix.lower()
    if ending not in ENDINGS:
        raise ModevizError(
            f"{options.file}: found {ending or 'no ending'}, expected .json for all of a study, or "
            ".csv for its variants"
        )
    records = options.read()
    check_writable(options.file)
    text = variants_table(records) if ending == ".csv" else f"{json_text(study_record(records))}\n"
    write_text(options.file, text)
    print(options.file)


def _add_options(command: ArgumentParser) -> None:
    about = "its name ends in .json for all of the study, or .csv for its variants"
    add_study_and_target(command, "file", about)


EXPORT = Command(
    "export",
    "all of a study as JSON, or its variants as CSV",
    StudyExportOptions,
    _add_options,
    export_study,
)
