"""The command that reads all of a study and says whether it is as it was written."""

from argparse import ArgumentParser

from modeviz.cli.command import Command
from modeviz.cli.results import check_printable
from modeviz.cli.studies.options import StudyOptions, add_study
from modeviz.journal.soundness import check_whole


def check_study(options: StudyOptions) -> None:
    """Prints that the study is sound; raises ModevizError as `check_whole`."""
    check_printable()
    n_contents = check_whole(options.path)
    print(f"{options.path}: sound, all {n_contents} contents are as they were written")


def _add_options(command: ArgumentParser) -> None:
    add_study(command)


CHECK = Command(
    "check",
    "whether all of a study, or of a backup, is as it was written",
    StudyOptions,
    _add_options,
    check_study,
)
