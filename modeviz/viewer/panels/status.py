"""Left column, foot: how long an answer took, and how far it can be trusted."""

from collections.abc import Iterable, Sequence
from html import escape

import viser

from modeviz.analysis.results import Results
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.report.components import believed, change_words, is_doubtful
from modeviz.report.tables import own_frequencies
from modeviz.text.wording import sentence_case
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, heading, hinted, span, title
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.findings import Findings

LEAST_SHOWN = 1e-3
"""Hz and percent: smaller errors are shown as this."""

ALARMING = 1e-3
"""Percent: a larger difference from the exact answer is shown as bad."""


class StatusPanel:
    """Progress while the vehicle is prepared, then time, health and check of every answer."""

    def __init__(
        self, gui: viser.GuiApi, notes: Sequence[str] = (), remarks: Sequence[str] = ()
    ) -> None:
        """Makes room.

        Args:
            gui: where.
            notes: of the vehicle, which stand below everything else until there is an answer.
            remarks: on what the session opened with, sentences without their stops, which stay.
        """
        self._notes = _listed(notes)
        self._remarks = _listed(f"{sentence_case(each)}." for each in remarks)
        self._trouble = ""
        self._shown: tuple[str, ...] = ()
        self._content = gui.add_html("")

    def show_trouble(self, trouble: str) -> None:
        """Says why what is done here is not saved, above all else; "" once it is."""
        said = span(f"{escape(sentence_case(trouble))}.", "bad")
        self._trouble = f'<div role="alert">{said}</div>' if trouble else ""
        self._draw(*self._shown)

    def show_progress(self, fraction: float) -> None:
        """Says how far the preparation is."""
        bar = f'<div class="bar"><i style="width:{fraction:.0%};background:var(--mv-now)"></i></div>'
        self._draw(heading("Preparing", f"{100 * fraction:.0f} %"), bar)

    def show(self, solved: Solved) -> None:
        """Says how an answer came about and how good it is, and the notes of its vehicle."""
        self._notes = _listed(solved.now.prepared.vehicle.notes)
        lines = [_found(solved.now), _checked(solved.findings), *_believed(solved.findings)]
        if solved.missing:
            lines.append(_compared(solved))
        if solved.state.classic:
            lines.append(_classic(solved))
        text = "<br>".join(lines)
        self._draw(_solved(solved), f'<div class="dim">{text}</div>')

    def _draw(self, *content: str) -> None:
        """Shows content as long as a page is connected: else it is not known whether it still holds."""
        status = f'<div class="status">{"".join(content)}</div>'
        self._shown = content
        assign(self._content, content=block(self._trouble, status, self._remarks, self._notes))


def _listed(notes: Iterable[str]) -> str:
    return "".join(f'<div class="note">{escape(note)}</div>' for note in notes)


def _solved(solved: Solved) -> str:
    doubtful = solved.findings.check is not None and 100 * solved.findings.check.error > ALARMING
    color = "--mv-bad" if doubtful or solved.now.trust.n_missed else "--mv-good"
    dot = f'<i class="swatch" style="background:var({color});border-radius:50%"></i>'
    milliseconds = 1000 * solved.seconds
    return heading(f"{dot}Solved", f"{milliseconds:.{0 if milliseconds >= 10 else 1}f} ms")


def _found(now: Results) -> str:
    """Return the line on what is known without another solve."""
    modes, trust = now.modes, now.trust
    band = f"{len(modes.frequency_hz)} modes below {now.prepared.basis.top_hz:.0f} Hz"
    if trust.n_missed:
        return span(f"{band}, {trust.n_missed} not found", "bad")
    moves = modes.frequency_hz > RESOLVED_HZ
    worst = float(trust.frequency_error_hz[moves].max(initial=0.0))
    exact = f"{band}, none missed, each within {_rounded(worst)} Hz for the model as given"
    return "<br>".join([exact, *map(escape, own_frequencies(now.prepared.vehicle))])


def _believed(rest: Findings) -> list[str]:
    """Return how far the bodies are believed: the worst of them, and all where the pointer rests."""
    if not rest.components:
        return [] if rest.components is not None or rest.problem else _believed_later(rest.now)
    top_hz = rest.now.prepared.basis.top_hz
    worst = max(rest.components, key=lambda c: (is_doubtful(c, top_hz), c.change))
    lowest = min(rest.components, key=lambda c: c.highest_hz)
    text = (
        f"bodies: modes up to {lowest.highest_hz:.3g} Hz ({escape(lowest.body)}) or more; without the "
        f"last fifth of {escape(worst.body)}'s modes {change_words(worst)}"
    )
    shown = span(text, "bad") if is_doubtful(worst, top_hz) else text
    return [hinted(shown, escape("\n".join(believed(rest.now)), quote=True))]


def _believed_later(now: Results) -> list[str]:
    """Return that it is not known how far the bodies are believed, of a vehicle that has some."""
    is_flexible = any(isinstance(body, FlexibleBody) for body in now.prepared.vehicle.bodies)
    return ["the truncation of bodies is not looked into yet"] if is_flexible else []


def _compared(solved: Solved) -> str:
    """Return a line that the set asked for has no answer, and which one stands in its place."""
    text = f"{solved.missing} has no answer, see Variants: compared with {solved.state.against}"
    return span(escape(text), "bad")


def _checked(rest: Findings) -> str:
    """Return the verdict of the exact solve."""
    check = rest.check
    if rest.problem:
        return f"not checked: {escape(rest.problem)}"
    if check is None:
        return "exact solve follows"
    if check.impossible:
        return f"not checked: {escape(check.impossible)}"
    progress = "" if check.is_complete else f", {check.n_lines} of {check.n_freqs} lines so far"
    text = f"within {percent(check.error)} of exact{progress}"
    return span(text, "bad") if 100 * check.error > ALARMING else text


def _classic(solved: Solved) -> str:
    """Return the error of the classic method."""
    classic = solved.classic_error
    if classic is None:
        return ""
    name = title(solved.now.names[classic.mode].spoken)
    true = solved.now.modes.frequency_hz[classic.mode]
    return (
        f"classic: up to {percent(classic.error)} off ({name} "
        f"{classic.frequency_hz:.2f} instead of {true:.2f} Hz)"
    )


def percent(error: float) -> str:
    """A relative error as people read it: "0.004 %"."""
    return f"{_rounded(100 * error)} %"


def _rounded(value: float) -> str:
    """One significant digit without an exponent, two from one up, at least `LEAST_SHOWN`."""
    digits = f"{value:.1e}" if value >= 1 else f"{max(value, LEAST_SHOWN):.0e}"
    return f"{float(digits):.10f}".rstrip("0").rstrip(".")
