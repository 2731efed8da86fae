"""Right column, upper part: what the rates do to the ride."""

from functools import partial

import viser

from modeviz.viewer.panels.charts import ChartsPanel
from modeviz.viewer.panels.cursor import CursorSlider, frequency_cursor
from modeviz.viewer.panels.figures import FiguresPanel
from modeviz.viewer.panels.peaks import PeaksPanel
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.scatter_task import ScatterTask


class ResponsePanel:
    """Four figures, two charts with a cursor, and the modes in their peaks and there."""

    def __init__(self, gui: viser.GuiApi, session: Session, scatterer: ScatterTask, dark: bool) -> None:
        """Builds the parts; `show` fills them."""
        self._scatterer = scatterer
        self._figures = FiguresPanel(gui)
        self._charts = ChartsPanel(gui, session, dark)
        self._cursor = CursorSlider(gui, session, self._charts.names, frequency_cursor(session.vehicle))
        self._peaks = PeaksPanel(gui, session)
        self._marked: list[list[int]] = [[] for _ in session.state.charts.curves]

    def show(self, solved: Solved) -> None:
        """Draws an answer; while rates move, curves every time and the rest only now and then."""
        responses = Responses(solved)
        if solved.is_detailed:
            self._figures.show(solved, responses)
        if not solved.state.charts.curves:
            return
        self._cursor.show()
        if solved.is_detailed:
            self._marked = self._peaks.show(solved, responses)
        shaded = partial(self._scatterer.shaded, solved.state)
        self._charts.show(solved, responses, self._marked, shaded)
