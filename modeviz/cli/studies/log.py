"""The command that prints the history of a study."""

from argparse import ArgumentParser
from dataclasses import dataclass

from modeviz.cli.command import Command, of_options
from modeviz.cli.options import JsonOptions, add_json
from modeviz.cli.results import check_printable, print_result
from modeviz.cli.studies.options import StudyOptions, add_session, add_study, session_of
from modeviz.journal.told import log_record, log_text


@dataclass(frozen=True, kw_only=True)
class LogOptions(StudyOptions, JsonOptions):
    """What `modeviz study log` is asked for."""

    session: int | None = None


def print_log(options: LogOptions) -> None:
    """Prints what happened in a study."""
    check_printable()
    records = options.read()
    with of_options():
        only = session_of(records, options.session)
    sessions = [line for line in records.sessions() if only in (None, line.id)]
    study, entries = records.study(), records.history(only)
    if options.json:
        print_result(log_record(study, sessions, entries))
    else:
        print_result(log_text(records.path.name, study, sessions, entries))


def _add_options(command: ArgumentParser) -> None:
    add_study(command)
    add_session(command)
    add_json(command)


LOG = Command(
    "log",
    "what happened in a study: when, by whom, and what changed",
    LogOptions,
    _add_options,
    print_log,
)
