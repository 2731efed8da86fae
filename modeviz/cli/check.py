"""The command that tells everything that is wrong with a vehicle folder, and what is in it."""

from argparse import ArgumentParser
from collections.abc import Iterator
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from modeviz.cli.command import Command
from modeviz.cli.options import JsonOptions, add_folder, add_json
from modeviz.cli.results import check_printable, print_result
from modeviz.errors import ModevizError
from modeviz.files import builtin_vehicle
from modeviz.files.folder import check_is_folder
from modeviz.files.survey import Problem, Survey, survey
from modeviz.report.check import summarised, summary_record
from modeviz.report.check_text import summary_text
from modeviz.report.static_doubts import static_doubts
from modeviz.report.stiff_connections import stiff_record, stiff_table
from modeviz.report.truncation import truncation_doubts
from modeviz.vehicle.doubts import road_doubts
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, kw_only=True)
class CheckOptions(JsonOptions):
    """What `modeviz check` is asked for."""

    vehicle: Path | None = None
    """Its folder; None: the pickup's."""


def check(options: CheckOptions) -> None:
    """Prints all problems and doubts of a folder and a summary of what is in it.

    Raises:
        ModevizError: there is no folder, or there are problems, so that no other command reads it.
    """
    check_printable()
    folder = options.vehicle or builtin_vehicle()
    check_is_folder(folder)
    found = survey(folder)
    if whole := _whole(found):
        more = (*road_doubts(whole), *truncation_doubts(whole), *static_doubts(whole))
        found = replace(found, doubts=(*found.doubts, *more))
    if options.json:
        print_result(_record(folder, found))
    else:
        print_result("\n".join(_lines(folder, found)))
    if found.problems:
        raise ModevizError(f"{folder}: {_counted(len(found.problems), 'problem')} to put right")


def _whole(found: Survey) -> Vehicle | None:
    """The vehicle if it is read as it stands, so that it can be told what it feels."""
    return None if found.problems else found.vehicle


def _record(folder: Path, found: Survey) -> dict[str, object]:
    """`{"folder", "problems": [{"file", "key", "line", "words", "left_out"}], "doubts", "summary",
    "stiff_connections": of bodies that lack residual vectors, the fields of
    dynamics.truncation_gap.StiffConnection}`.
    """
    return {
        "folder": str(folder),
        "problems": [asdict(problem) for problem in found.problems],
        "doubts": list(found.doubts),
        "summary": found.vehicle and summary_record(summarised(found.vehicle)),
        "stiff_connections": stiff_record(whole) if (whole := _whole(found)) else [],
    }


def _lines(folder: Path, found: Survey) -> Iterator[str]:
    problems, doubts = len(found.problems), len(found.doubts)
    yield f"{folder}: {_counted(problems, 'problem')}, {_counted(doubts, 'doubt')}"
    for number, problem in enumerate(found.problems, 1):
        yield f"{number:3d}. {_told(problem)}"
    yield from (f"doubt: {doubt}" for doubt in found.doubts)
    yield ""
    if found.vehicle is None:
        yield "No body can be read, so there is nothing to sum up."
        return
    if problems:
        yield "What can be read so far:"
    yield summary_text(summarised(found.vehicle))
    if (whole := _whole(found)) and (stiff := stiff_table(whole)):
        yield f"\nStiffer than a tenth of bodies that lack residual vectors:\n{stiff}"


def _told(problem: Problem) -> str:
    without = f" (the rest is read without {problem.left_out})" if problem.left_out else ""
    return f"{problem}{without}"


def _counted(number: int, what: str) -> str:
    return f"{number or 'no'} {what}{'s' if number != 1 else ''}"


def _add_options(command: ArgumentParser) -> None:
    add_folder(command)
    add_json(command)


CHECK = Command(
    "check",
    "every problem of a vehicle folder at once, and a summary of what is in it",
    CheckOptions,
    _add_options,
    check,
)
"""The command, as the program offers it."""
