"""The report's section on sag, static forces and travel; empty where nothing holds the vehicle."""

from collections.abc import Iterator, Sequence
from html import escape

from modeviz.errors import SolveError
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import StaticCase, Statics, solve_statics
from modeviz.mounting.travel import Travel, travels
from modeviz.report.comparison import Comparison
from modeviz.report.statics import carried_cells, motion_cells
from modeviz.text.markup import NONE, note, section, span, table, title
from modeviz.text.wording import number, sentence_case

AXES = ("x", "y", "z")


def statics(comparison: Comparison) -> str:
    """Return how the vehicle stands in its first load case, and what is left of travel in all."""
    if not comparison.vehicle.mounts:
        return ""
    try:
        sets = [
            solve_statics(prepare_statics(r.prepared.system), r.rates)
            for r in (comparison.base, comparison.now)
        ]
    except SolveError:
        return ""
    first = [each.cases[0] for each in sets]
    notes = dict.fromkeys(text for case in first for text in case.notes)
    name = escape(sentence_case(first[0].name))
    return section(
        "Sag and static forces",
        f"<h3>{name}: mounts</h3>",
        _mounts(comparison, first),
        note(
            "Forces on the first body of a mount and how far that has gone from the second, along the "
            "mount’s axes, from where nothing is loaded."
        ),
        f"<h3>{name}: bodies</h3>",
        _bodies(comparison, first),
        *(note(escape(sentence_case(text))) for text in notes),
        *_travel(comparison, sets),
    )


def _mounts(comparison: Comparison, cases: Sequence[StaticCase]) -> str:
    names = list(map(escape, comparison.names))
    rows = [
        [
            escape(mount.name),
            *(c for case in cases for c in _carried(case, mount.name)),
        ]
        for mount in comparison.vehicle.mounts
    ]
    groups = [("", 1), *((f"{what}, {name}", 3) for name in names for what in ("N", "mm"))]
    return table(["Mount", *AXES * 4], rows, groups)


def _carried(case: StaticCase, mount: str) -> list[str]:
    carried = case.connections.get(mount)
    return [NONE] * 6 if carried is None else carried_cells(carried)


def _bodies(comparison: Comparison, cases: Sequence[StaticCase]) -> str:
    rows = [
        [title(body.label) if first else "", escape(name), *_motion(case, body.name)]
        for body in comparison.vehicle.bodies
        for first, name, case in zip((True, False), comparison.names, cases, strict=True)
    ]
    header = [*(f"{axis}, mm" for axis in AXES), *(f"r{axis}, °" for axis in AXES)]
    return table(["Body", "", *header], rows)


def _motion(case: StaticCase, body: str) -> list[str]:
    motion = case.bodies.get(body)
    return [NONE] * 6 if motion is None else motion_cells(motion)


def _travel(comparison: Comparison, sets: Sequence[Statics]) -> Iterator[str]:
    """The margins of all load cases, if any mount has limits."""
    if not any(group.travel for group in comparison.vehicle.mount_groups):
        return
    yield "<h3>Travel, mm</h3>"
    names = list(map(escape, comparison.names))
    rows: list[list[str]] = []
    for cases in zip(*(each.cases for each in sets), strict=True):
        rows.append([escape(sentence_case(cases[0].name))])
        sides = (travels(each, case) for each, case in zip(sets, cases, strict=True))
        rows += [_travel_row(*pair) for pair in zip(*sides, strict=True)]
    margins = [f"Margin, {name}" for name in names]
    yield table(["Mount", *names, "From", "To", *margins], rows)


def _travel_row(before: Travel, after: Travel) -> list[str]:
    """Deflections, limits and margins; what has failed stands out."""
    lengths = (before.deflection, after.deflection, before.least, before.most)
    margins = (span(number(1e3 * t.margin, 2), "good" if t.passed else "bad") for t in (before, after))
    name = escape(f"{before.mount} {before.direction}")
    return [name, *(number(1e3 * length, 2) for length in lengths), *margins]
