"""The command that prints in what two studies differ."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, add_json
from modeviz.cli.results import check_printable, print_result
from modeviz.cli.studies.options import file_of
from modeviz.journal.comparison import compare_studies, difference_record, difference_text
from modeviz.journal.records import Records


@dataclass(frozen=True, kw_only=True)
class DiffOptions(JsonOptions):
    """What `modeviz study diff` is asked for."""

    first: Path
    second: Path
    """Files of studies, or folders of their vehicles."""


def print_difference(options: DiffOptions) -> None:
    """Prints the rates, variants, notes and runs in which two studies differ."""
    check_printable()
    first, second = (Records.of_file(file_of(path)) for path in (options.first, options.second))
    found = compare_studies(first, second)
    print_result((difference_record if options.json else difference_text)(found))


def _add_options(command: ArgumentParser) -> None:
    for name in ("first", "second"):
        command.add_argument(
            name, type=Path, metavar="STUDY", help="the file of a study, or the folder of its vehicle"
        )
    add_json(command)


DIFF = Command(
    "diff",
    "rates, variants, notes and runs in which two studies differ",
    DiffOptions,
    _add_options,
    print_difference,
)
