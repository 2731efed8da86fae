"""Tables of a body's energy in six directions, coloured by it, and of what is asked of its modes."""

from collections.abc import Sequence
from html import escape

from modeviz.mounting.purity import Gap, Purity
from modeviz.report.rigid import gap_words, percent
from modeviz.text.wording import sentence_case
from modeviz.vehicle.connections import MOTIONS
from modeviz.viewer.page.widgets.html import (
    HiddenButtons,
    heading,
    hinted,
    named,
    row,
    span,
    table,
)
from modeviz.viewer.session.answers import Solved

STRONG = 72
"""Percent of colour that all of a mode's energy has; numbers stay readable on it."""

NONE_LISTED = "It takes no part in any mode of the band with these rates."


def heat_map(solved: Solved, modes: Sequence[int], buttons: HiddenButtons) -> str:
    """Return a row for each mode: its name, frequency, energy in six directions, share and verdict.

    Args:
        solved: the answer.
        modes: which of them.
        buttons: pressed by their names.
    """
    found = solved.purity
    if not modes:
        return span(NONE_LISTED, "dim")
    header = (
        hinted("Mode", "Click a mode to see it move; ~ marks a name that fits weakly"),
        "Hz",
        *(hinted(m, f"Part of the mode's kinetic energy {_where(m)}, percent") for m in MOTIONS),
        hinted("all", "The body's share, also of its bending, percent"),
        hinted("purity", "Of its own modes: the direction's part in the body's energy, percent"),
    )
    rows = [
        row(_cells(solved, found, mode, buttons.label(i, _name(solved, mode))), _is_shown(solved, mode))
        for i, mode in enumerate(modes)
    ]
    return heading("Kinetic energy", "% of each mode") + table(header, rows, "heat")


def _name(solved: Solved, mode: int) -> str:
    return named(sentence_case(solved.now.names[mode].spoken))


def _is_shown(solved: Solved, mode: int) -> bool:
    return mode == solved.followed.mode


def _cells(solved: Solved, found: Purity, mode: int, name: str) -> list[str]:
    motion = found.motion_of(mode)
    return [
        name,
        _frequency(found, mode, motion),
        *(_heat(part, m == motion) for m, part in zip(MOTIONS, found.energy[mode], strict=True)),
        span(f"{100 * found.share[mode]:.0f}", "dim"),
        "" if motion is None else _verdict(found, motion),
    ]


def _frequency(found: Purity, mode: int, motion: str | None) -> str:
    text = f"{found.frequency_hz[mode]:.2f}"
    if motion is None or found.is_in_band(motion):
        return text
    low, high = found.targets.lowest_frequency, found.targets.highest_frequency
    return hinted(span(text, "bad"), f"Outside {low:g} to {high:g} Hz")


def _heat(part: float, is_own: bool) -> str:
    """A number on a ground as strong as it is large; what is below zero on that of what fails."""
    color = "--mv-now" if part >= 0 else "--mv-bad"
    strength = round(STRONG * min(abs(part), 1.0))
    text = percent(part) if abs(part) < 0.0995 else f"{100 * part:.0f}"
    return f'<i{" class=own" if is_own else ""} style="--c:var({color});--s:{strength}%">{text}</i>'


def _verdict(found: Purity, motion: str) -> str:
    kind = "good" if found.is_pure(motion) else "bad"
    return span(f"{motion} {100 * (found.purity(motion) or 0.0):.0f}", kind)


def _where(motion: str) -> str:
    return f"along {motion}" if len(motion) == 1 else f"about {motion[1]}"


def verdicts(found: Purity) -> str:
    """Return what is asked of a body's modes and whether it holds, a line each."""
    targets = found.targets
    missing = [m for m in MOTIONS if found.frequency(m) is None]
    mixed = [m for m in MOTIONS if m not in missing and not found.is_pure(m)]
    outside = [m for m in MOTIONS if m not in missing and not found.is_in_band(m)]
    lines = [_line("A mode for each direction", missing)] if missing else []
    overall = span("holds", "good") if found.passes else span("fails", "bad")
    if len(missing) == len(MOTIONS):
        return heading("Decoupling", overall) + table((), lines, "verdicts")
    lines += [
        _line(f"Purity of {100 * targets.purity:g} %", mixed),
        _line(f"{targets.lowest_frequency:g} to {targets.highest_frequency:g} Hz", outside),
        _line(f"{targets.gap:g} Hz between modes", _close(found.gaps)),
        _line(
            f"{targets.bounce_gap:g} Hz from bounce to {found.crank_word}", _close(found.bounce_gaps)
        ),
    ]
    return heading("Decoupling", overall) + table((), lines, "verdicts")


def _close(gaps: Sequence[Gap]) -> list[str]:
    return [gap_words(gap) for gap in gaps if not gap.passes]


def _line(what: str, failing: Sequence[str]) -> str:
    verdict = span("fails", "bad") if failing else span("holds", "good")
    return row([escape(what), span(escape(", ".join(failing)), "dim"), verdict])
