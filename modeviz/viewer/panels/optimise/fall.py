"""The chart of how the goal falls while a search runs."""

import math

import numpy as np
import viser

from modeviz.text.axes import Axis, round_top
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.widgets.handles import send_together
from modeviz.viewer.panels.plots import FONT, GRID, NO_TICKS, SET_COLORS
from modeviz.viewer.tasks.search_task import SearchStatus

HEIGHT = 120
FIRST = 100
"""Evaluations that there is room for at first."""

MOST_POINTS = 200
"""Of the curve that is drawn."""


class FallChart:
    """The best goal so far against evaluations, and the original's beside it."""

    def __init__(self, gui: viser.GuiApi, dark: bool) -> None:
        """Draws an empty chart, out of sight."""
        self._ink = "#b4bcc6" if dark else "#5b6670"
        base, now = ("#8a95a1", "#5aa9ea") if dark else ("#98a2ad", "#2b7cc4")
        strokes = ((now, 2.2, []), (base, 1.5, []), (SET_COLORS[0], 1.5, [7, 3]))
        none = {"show": False}
        self._series = (
            {"label": "evaluations"},
            *({"stroke": s, "width": w, "dash": d, "points": none} for s, w, d in strokes),
        )
        self._frame: tuple[Axis, Axis] | None = None
        self._chart = gui.add_uplot(
            tuple(np.zeros((4, 1))),
            tuple({"label": name} for name in ("evaluations", "best", "original", "set")),
            scales={"x": {"time": False}},
            legend={"show": False},
            cursor={"show": False},
            padding=(6, 18, 0, 0),
            height=HEIGHT,
            visible=False,
        )

    def show(self, look: SearchStatus) -> None:
        """Draws the fall of a search."""
        x, best = steps(look)
        ends = np.full(len(x), look.original), np.full(len(x), look.reference)
        data = tuple(a.astype(np.float32) for a in (x, best, *ends))
        highest = np.nanmax([look.original, look.reference, best[-1]])
        frame = (Axis("", 0, _room(x[-1])), Axis("", 0, round_top(1.05 * highest)))
        axes = self._axes(*frame) if frame != self._frame else {}
        self._frame = frame
        send_together(self._chart, data=data, visible=True, **axes)

    def hide(self) -> None:
        """Puts the chart away."""
        self._chart.visible = False

    def _axes(self, x: Axis, y: Axis) -> dict:
        common = {"font": FONT, "stroke": self._ink, "ticks": NO_TICKS, "grid": GRID, "space": 1}
        return {
            "series": self._series,
            "scales": {
                "x": {"time": False, "range": (x.low, x.high)},
                "y": {"range": (y.low, y.high)},
            },
            "axes": tuple(
                {"splits": [v for v, _ in ticks], "values": [text for _, text in ticks]} | size | common
                for ticks, size in (
                    (x.ticks()[::2], {"size": 20, "gap": 3}),
                    (y.ticks()[::2], {"size": 34, "gap": 4}),
                )
            ),
        }


def steps(look: SearchStatus) -> tuple[Floats, Floats]:
    """The best goal so far as a staircase: evaluations and values, of the last history if many."""
    history = look.history[-MOST_POINTS:]
    at = np.array([n for n, _ in history], float)
    values = np.array([v for _, v in history])
    last = float(look.progress.evaluations) if look.progress else at[-1]
    x = np.append(np.repeat(at, 2)[1:], last)
    return x, np.repeat(values, 2)


def _room(evaluations: float) -> float:
    """Twice `FIRST` as often as it takes: the axis seldom changes."""
    return FIRST * 2.0 ** max(0, math.ceil(math.log2(max(evaluations, 1) / FIRST)))
