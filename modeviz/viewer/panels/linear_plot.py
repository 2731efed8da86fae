"""A chart of values from zero on, over frequency: a curve for each set, and points on the first."""

from collections.abc import Hashable, Sequence

import numpy as np
import viser

from modeviz.text.axes import Axis, round_top
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.widgets.handles import send_together
from modeviz.viewer.panels.plots import FONT, GRID, NO_TICKS, Line

POINT = 6
"""Pixels."""


class LinearPlot:
    """Curves of several sets; points mark where the first was measured."""

    def __init__(self, gui: viser.GuiApi, shown_hz: tuple[float, float], dark: bool) -> None:
        """Draws an empty chart from one frequency to another; `show` fills it."""
        self._shown_hz = shown_hz
        self._ink = "#b4bcc6" if dark else "#5b6670"
        self._paper = "#242424" if dark else "#ffffff"
        self._frame: Hashable = None
        self._chart = gui.add_uplot(
            (np.array(shown_hz), np.full(2, np.nan)),
            ({"label": "Hz"}, {"label": "now"}),
            scales={"x": {"time": False, "range": shown_hz}, "y": {"range": (0.0, 1.0)}},
            legend={"show": False},
            cursor={"sync": {"key": "rubber"}, "drag": {"x": True, "y": False}},
            padding=(6, 22, 0, 0),
            height=120,
        )

    def show(self, lines: Sequence[Line], frequency_hz: Floats, values: Floats, marked: Floats) -> None:
        """Replaces the curves.

        Args:
            lines: one for each curve.
            frequency_hz: (n_freqs,), all that are marked too.
            values: (n_curves, n_freqs), zero or more.
            marked: Hz: where the first curve has points.
        """
        at = np.isin(frequency_hz, marked)
        data = np.vstack([values, np.where(at, values[0], np.nan)])
        top = round_top(1.05 * float(values.max(initial=0.0)))
        frame = top, tuple(lines)
        axes = {} if frame == self._frame else self._axes(top) | {"series": self._series(lines)}
        self._frame = frame
        drawn = (frequency_hz, *data.astype(np.float32))
        send_together(self._chart, data=drawn, **axes)

    def _series(self, lines: Sequence[Line]) -> tuple[dict, ...]:
        none = {"show": False}
        curves = (
            {"label": line.label, "stroke": line.color, "width": line.thickness, "points": none}
            for line in lines
        )
        dots = {"show": True, "size": POINT, "stroke": lines[0].color, "fill": self._paper}
        return ({"label": "Hz"}, *curves, {"label": "measured", "width": 0, "points": dots})

    def _axes(self, top: float) -> dict:
        common = {"font": FONT, "stroke": self._ink, "ticks": NO_TICKS, "grid": GRID, "space": 1}
        *inner, (end, _) = Axis("", *self._shown_hz).ticks()
        along = [*inner, (end, f"{end:g} Hz")]
        up = Axis("", 0, top).ticks()[::2]
        return {
            "scales": {
                "x": {"time": False, "range": self._shown_hz},
                "y": {"range": (0.0, top)},
            },
            "axes": tuple(
                {"splits": [v for v, _ in ticks], "values": [text for _, text in ticks]} | size | common
                for ticks, size in ((along, {"size": 20, "gap": 3}), (up, {"size": 34, "gap": 4}))
            ),
        }
