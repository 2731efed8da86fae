"""Right column: the highest peaks of the charts, and the modes in them."""

from dataclasses import dataclass
from html import escape

import viser

from modeviz.analysis.results import Results
from modeviz.errors import ModevizError
from modeviz.ride.participation import Peak
from modeviz.text.axes import shown_hz
from modeviz.text.wording import sentence_case
from modeviz.vehicle.engine import EngineOrder
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import HiddenButtons, block, heading, span
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ShowMode
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ChartCurve, ResponseCurve

PEAK_BAND = (5.0, 25.0)
"""Hz: below it mounts do nothing (Duncan, "The requirement")."""

PEAK_GAP_HZ = 2.0
N_PEAKS = 2
"""Of each chart."""

N_CONTRIBUTORS = 3
SHORT = {"lateral": "Lat.", "vertical": "Vert.", "fore-aft": "Fore-aft"}
HINT = "click: mode and its mounts"
MARK = '<i class="cursor"></i>'
"""Before what is told of the cursor's frequency."""


@dataclass(frozen=True)
class _Contributor:
    """A mode that can be clicked."""

    results: Results
    mode: int

    @property
    def group(self) -> str | None:
        """The mount group that holds most of its strain energy, if there is any."""
        shares = self.results.strain_shares_of_mode(self.mode)
        groups = [group.name for group in self.results.vehicle.mount_groups]
        return max(groups, key=lambda name: shares[name], default=None)


class PeaksPanel:
    """A row for each peak with the modes that make it; a click on one shows it and its mounts."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Makes room; `show` fills it."""
        self._session = session
        self._contributors: list[_Contributor] = []
        n_buttons = len(session.state.charts.curves) * (N_PEAKS + 1) * N_CONTRIBUTORS
        self._buttons = HiddenButtons(gui, n_buttons, self._select)
        self._content = gui.add_html("")

    def show(self, solved: Solved, responses: Responses) -> list[list[int]]:
        """Lists the peaks of an answer; for each chart the numbers of their frequencies."""
        lines = [strongest(responses, curve, solved) for curve in solved.state.charts.curves]
        contributors: list[_Contributor] = []
        rows, at_cursor = [], []
        cursor = solved.state.charts.cursor_hz
        for curve, label, its_lines in zip(
            solved.state.charts.curves, _labels(solved.state.charts.curves), lines, strict=True
        ):
            told = _told(responses, curve, its_lines, cursor)
            for peak in told[: len(its_lines)]:
                rows.append(
                    self._row(f"{label} {peak.frequency_hz:.1f} Hz", peak, solved, contributors)
                )
            for there in told[len(its_lines) :]:
                words = f"{MARK}{label} {cursor:.1f} Hz"
                at_cursor.append(self._row(words, there, solved, contributors))
        self._contributors = contributors
        where = _told_band(solved, responses)
        none = span(f"No peak {where}: look at another point or direction.", "dim")
        listing = "".join(rows) or none
        peaks = heading("Peaks and their modes", HINT) + listing
        assign(self._content, content=block(peaks, *at_cursor))
        return lines

    def _row(self, label: str, peak: Peak, solved: Solved, contributors: list[_Contributor]) -> str:
        """A peak's modes, which are added to those that can be clicked."""
        pills = []
        for part in peak.contributors:
            name = sentence_case(solved.now.part_name(part.mode))
            about = f"{name}: {part.ratio:.2f} of the largest part in this peak"
            text = f"<span>{escape(name)}</span><b>{part.ratio:.2f}</b>"
            on = " on" if part.mode == solved.followed.mode else ""
            button = self._buttons.label(len(contributors), text)
            pills.append(f'<div class="pill{on}" title="{escape(about)}">{button}</div>')
            contributors.append(_Contributor(solved.now, part.mode))
        return f'<div class="peak"><span class="dim">{label}</span>{"".join(pills)}</div>'

    def _select(self, i: int) -> None:
        contributors = self._contributors
        if i < len(contributors):  # else another answer came between the click and here
            chosen, results = contributors[i], contributors[i].results
            if chosen.mode < len(results.names):
                name = results.names[chosen.mode].name
                self._session.do(ShowMode(name, results.rates, chosen.group))


def _told(
    responses: Responses, curve: ChartCurve, lines: list[int], cursor_hz: float
) -> tuple[Peak, ...]:
    """The modes in a response at peaks and, if the load is known there, where the cursor is."""
    try:
        return responses.peaks(curve, N_CONTRIBUTORS, lines, (cursor_hz,))
    except ModevizError:
        return responses.peaks(curve, N_CONTRIBUTORS, lines)


def strongest(responses: Responses, curve: ChartCurve, solved: Solved) -> list[int]:
    """The lines of the `N_PEAKS` highest peaks within `PEAK_BAND` that stand apart, rising."""
    f, levels = responses.lines(""), responses.of("", curve)
    low, high = _band(solved)
    lines = [i for i in responses.peak_lines(curve) if low <= f[i] <= high]
    chosen: list[int] = []
    for line in sorted(lines, key=lambda i: -levels[i]):
        if all(abs(f[line] - f[other]) > PEAK_GAP_HZ for other in chosen):
            chosen.append(line)
    return sorted(chosen[:N_PEAKS])


def _band(solved: Solved) -> tuple[float, float]:
    """Hz: where peaks are told; under an engine's order in all of what is drawn."""
    is_engine = isinstance(Responses(solved).harmonic_load, EngineOrder)
    return shown_hz(solved.now.prepared.vehicle.highest_frequency) if is_engine else PEAK_BAND


def _told_band(solved: Solved, responses: Responses) -> str:
    """Where peaks are looked for, in words: as far as what shakes acts there."""
    (low, high), lines = _band(solved), responses.lines("")
    inside = lines[(lines >= low) & (lines <= high)]
    if not len(inside):
        return f"between {low:g} and {high:g} Hz"
    return f"between {max(low, inside[0]):.4g} and {min(high, inside[-1]):.4g} Hz"


def _labels(curves: tuple[ChartCurve, ...]) -> list[str]:
    """Return the names of charts beside their peaks: the direction, if that tells them apart."""
    directions = [curve.direction for curve in curves if isinstance(curve, ResponseCurve)]
    if len(set(directions)) == len(curves):
        return [SHORT[direction] for direction in directions]
    return [f"Chart {i}," for i in range(1, len(curves) + 1)]
