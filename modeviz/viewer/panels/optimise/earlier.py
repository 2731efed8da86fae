"""What was computed in a session, also before it was opened: a line each, which shows it again."""

import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import viser

from modeviz.journal.runs import Run, RunKind
from modeviz.journal.tuning import Pinned
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, heading, hinted, span
from modeviz.viewer.page.widgets.named_buttons import NamedButtons
from modeviz.viewer.session.commands.decisions import TakeDesign
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.earlier_runs import Front, Scattering, design_of, front_of, scatter_of
from modeviz.viewer.tasks.front_task import FrontTask
from modeviz.viewer.tasks.scatter_task import ScatterTask

MOST = 12
"""Lines, of the newest."""

SHOWN_AT_ONCE: tuple[RunKind, ...] = ("front", "scatter")
"""Kinds of which the newest is shown when a session is opened."""

HINTS: dict[RunKind, str] = {
    "search": "Click to take over the rates that it found",
    "front": "Click to show its designs again",
    "scatter": "Click to show its figures again, and its band at the rates of then",
}


@dataclass(frozen=True)
class _Earlier:
    """A run, and what is kept of what it found."""

    run: Run
    front: Front | None
    scatter: Scattering | None
    design: Pinned | None

    @classmethod
    def of(cls, run: Run) -> "_Earlier":
        """Reads what a run found."""
        return cls(run, front_of(run), scatter_of(run), design_of(run))

    @property
    def can_be_shown(self) -> bool:
        """Whether anything is kept."""
        return any((self.front, self.scatter, self.design))


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
        """Lists runs.

        Args:
            gui: where.
            session: that takes over what a search found.
            trader: shows fronts.
            scatterer: shows scatter.
            runs: the first one first.
        """
        self._session, self._trader, self._scatterer = session, trader, scatterer
        self._lock = threading.Lock()
        self._runs: dict[str, _Earlier] = {run.token: _Earlier.of(run) for run in runs[-MOST:]}
        self._buttons = NamedButtons[str](gui, self._show)
        self._list = gui.add_html("")
        self._draw()

    def show_newest(self) -> None:
        """Shows the newest front and scatter, once the panels that draw them are there."""
        for kind in SHOWN_AT_ONCE:
            runs = self._runs.values()
            newest = [each for each in runs if each.run.kind == kind and each.can_be_shown]
            if newest:
                self._show(newest[-1].run.token)

    def add(self, run: Run) -> None:
        """Lists one more; may be called in any thread."""
        with self._lock:
            self._runs = dict([*self._runs.items(), (run.token, _Earlier.of(run))][-MOST:])
        self._draw()

    def _show(self, token: str) -> None:
        """Shows what a run found.

        Raises:
            ModevizError: another one is running, or the vehicle has not what it found any more.
        """
        earlier = self._runs.get(token)
        if earlier is None:
            return
        if earlier.front:
            self._trader.show(earlier.front)
        if earlier.scatter:
            self._scatterer.show(earlier.scatter)
        if earlier.design:
            self._session.do(TakeDesign(earlier.design.rates, earlier.design.placements))

    def _draw(self) -> None:
        with self._lock:
            self._buttons.keep([token for token, each in self._runs.items() if each.can_be_shown])
            lines = [self._line(each.run) for each in reversed(self._runs.values())]
            assign(self._list, content=block(heading("Earlier"), *lines) if lines else "")

    def _line(self, run: Run) -> str:
        when = time.strftime("%d %b %H:%M", time.localtime(run.time))
        who = f", {run.author}" if run.author else ""
        text = f"{escape(run.kind)} {escape(run.title)}"
        if run.token in self._buttons:
            text = self._buttons.label(run.token, hinted(text, HINTS[run.kind]))
        return f"<div>{text} {span(escape(f'{when}{who}'), 'dim')}</div>"
