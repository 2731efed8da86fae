"""A report of one set of mount rates against another, as studies and the command line write it."""

from collections.abc import Callable, Sequence
from datetime import date
from functools import partial
from pathlib import Path

from modeviz.analysis.exact_check import Check, checked
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Conditions
from modeviz.files.disk import write_text
from modeviz.report.comparison import Comparison, RateSet, compare
from modeviz.report.html import Picture, report
from modeviz.report.notes import Note
from modeviz.study.telling import Tell


def write_report(
    path: Path,
    prepare: Sequence[Callable[[], Prepared]],
    sets: tuple[RateSet, RateSet],
    conditions: Conditions | None,
    pictures: Sequence[Picture],
    tell: Tell,
    remarks: Sequence[Note] = (),
) -> None:
    """Solves with both sets of rates, checks the second against the full model and writes the file.

    Args:
        path: of the file.
        prepare: makes the vehicle ready: that compared with and the other, if these are two.
        sets: what is compared with, and what is compared.
        conditions: road and speed; None for a vehicle without a road.
        pictures: what it begins with.
        tell: told how far it is.
        remarks: what people noted on the study.

    Raises:
        ModevizError: it cannot be solved, or the file cannot be written.
    """
    ready = [each() for each in prepare]
    comparison = compare(ready[-1], *sets, conditions, ready[0])
    page = report(comparison, date.today(), pictures, _checked(comparison, tell), remarks)
    write_text(path, page)


def _checked(comparison: Comparison, tell: Tell) -> Check | None:
    """The second set of rates against the full model, solved from scratch; None without a road."""
    if comparison.rides is None:
        return None
    found = checked(comparison.rides[1], partial(tell, "checking"))
    tell("checking", 1.0)
    return found
