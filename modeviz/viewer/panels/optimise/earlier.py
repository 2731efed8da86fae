"""What was computed in a session, also before it was opened: a line each, which shows it again."""

import threading
import time
from collections.abc import Sequence
from html import escape

import viser

from modeviz.journal.runs import Run, RunKind
from modeviz.journal.tuning import Pinned
from modeviz.viewer.page.handles import assign
from modeviz.viewer.page.html import block, heading, hinted, span
from modeviz.viewer.page.named_buttons import NamedButtons
from modeviz.viewer.session.commands.decisions import TakeDesign
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.earlier_runs import found_of
from modeviz.viewer.tasks.front_task import FrontTask, Goals
from modeviz.viewer.tasks.scatter_task import Built, ScatterTask

MOST = 12
"""Lines, of the newest."""

SHOWN_AT_ONCE: tuple[RunKind, ...] = ("front", "scatter")
"""Kinds of which the newest is shown when a session is opened."""

HINTS: dict[RunKind, str] = {
    "search": "Click to take over the rates that it found",
    "front": "Click to show its designs again",
    "scatter": "Click to show its figures again, and its band at the rates of then",
}


class EarlierRuns:
    """The lines; nothing where there are no runs."""

    def __init__(
        self,
        gui: viser.GuiApi,
        session: Session,
        trader: FrontTask,
        scatterer: ScatterTask,
        runs: Sequence[Run],
    ) -> None:
        """Lists runs, and shows the newest front and scatter.

        Args:
            gui: where.
            session: that takes over what a search found.
            trader: shows fronts.
            scatterer: shows scatter.
            runs: the first one first.
        """
        self._session, self._trader, self._scatterer = session, trader, scatterer
        self._lock = threading.Lock()
        self._runs: dict[str, Run] = {}
        self._buttons = NamedButtons[str](gui, self._show)
        self._list = gui.add_html("")
        for run in runs[-MOST:]:
            self._runs[run.token] = run
        self._draw()
        for kind in SHOWN_AT_ONCE:
            newest = [run for run in self._runs.values() if run.kind == kind and found_of(run)]
            if newest:
                self._show(newest[-1].token)

    def add(self, run: Run) -> None:
        """Lists one more; may be called in any thread."""
        with self._lock:
            self._runs = dict([*self._runs.items(), (run.token, run)][-MOST:])
        self._draw()

    def _show(self, token: str) -> None:
        """Shows what a run found.

        Raises:
            ModevizError: another one is running, or the vehicle has not what it found any more.
        """
        run = self._runs.get(token)
        found = run and found_of(run)
        if isinstance(found, Pinned):
            self._session.do(TakeDesign(found.rates, found.placements))
        elif found and isinstance(found.asked, Goals):
            self._trader.show(found)
        elif found and isinstance(found.asked, Built):
            self._scatterer.show(found)

    def _draw(self) -> None:
        with self._lock:
            self._buttons.keep([token for token, run in self._runs.items() if found_of(run)])
            lines = [self._line(run) for run in reversed(self._runs.values())]
            assign(self._list, content=block(heading("Earlier"), *lines) if lines else "")

    def _line(self, run: Run) -> str:
        when = time.strftime("%d %b %H:%M", time.localtime(run.time))
        who = f", {run.author}" if run.author else ""
        text = f"{escape(run.kind)} {escape(run.title)}"
        if run.token in self._buttons:
            text = self._buttons.label(run.token, hinted(text, HINTS[run.kind]))
        return f"<div>{text} {span(escape(f'{when}{who}'), 'dim')}</div>"
