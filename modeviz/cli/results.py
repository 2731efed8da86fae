"""What a run has found at its end: kept, whatever fails."""

import json
import sys
from collections.abc import Callable

from modeviz.cli.streams import Printed, plain
from modeviz.errors import ModevizError
from modeviz.report.places import placements_record
from modeviz.report.records import Record
from modeviz.vehicle.placement import Placements


def check_printable() -> None:
    """Checks that there is somewhere to print to, before the work for it begins.

    Raises:
        ModevizError: standard output is closed or full.
    """
    if isinstance(sys.stdout, Printed):
        sys.stdout.check()


def print_result(result: Record | str, placements: Placements | None = None) -> None:
    """Prints a table, or the record that `--json` asks for; with the errors if nowhere else.

    Of a record names stay to the letter, whatever letters the terminal has.

    Args:
        result: the one or the other.
        placements: where mounts are, which a record has too where they were moved; None: as given.

    Raises:
        ModevizError: standard output cannot be written.
    """
    if isinstance(result, dict) and placements:
        result = {**result, "placements": placements_record(placements)}
    text = result if isinstance(result, str) else _json(result)
    try:
        print(text, flush=True)
    except ModevizError:
        print(text, file=sys.stderr)
        raise


def json_text(record: Record) -> str:
    """Return a record as it is printed."""
    return json.dumps(record, indent=1, ensure_ascii=False)


def _json(record: Record) -> str:
    text = json_text(record)
    encoding = sys.stdout.encoding or "utf-8"
    return text if plain(text, encoding) == text else json.dumps(record, indent=1)


def keep(*steps: Callable[[], None]) -> None:
    """Takes every step, such as to write and to print, whatever becomes of the others.

    Raises:
        ModevizError: a step failed, the first to do so.
    """
    failed: list[ModevizError] = []
    for step in steps:
        try:
            step()
        except ModevizError as error:
            failed.append(error)
    if failed:
        raise failed[0]
