"""The charts of the page: spectra as uPlot."""

import math
from collections.abc import Sequence

import numpy as np
import viser

from modeviz.export.wording import MINUS
from modeviz.ride.psd import power_decibels
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.assign import assign, send

SHOWN_HZ = (1.0, 25.0)
FONT = '11px -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif'
GRID = {"show": True, "width": 1, "stroke": "rgba(128,138,150,0.16)"}
NO_TICKS = {"show": False, "size": 0}
PEAK_GRID = {"show": True, "stroke": "rgba(43,124,196,0.45)", "width": 1, "dash": [3, 3]}


class PsdPlot:
    """A response's acceleration PSD in dB: the original grey, the present blue, its peaks marked."""

    def __init__(self, gui: viser.GuiApi, frequency_hz: Floats, dark: bool, height: int = 130) -> None:
        """Draws an empty chart; `show` fills it."""
        self._inside = (frequency_hz >= SHOWN_HZ[0]) & (frequency_hz <= SHOWN_HZ[1])
        self._f = frequency_hz[self._inside]
        self._now_color = "#5aa9ea" if dark else "#2b7cc4"
        base_color = "#8a95a1" if dark else "#98a2ad"
        self._text_color = "#b4bcc6" if dark else "#5b6670"
        self._frame: tuple[int, int, tuple[float, ...]] = (-80, -20, ())
        self._curves = np.full((2, len(self._f)), -60.0)
        self._chart = gui.add_uplot(
            (self._f, *self._curves),
            (
                {"label": "Hz"},
                {"label": "original", "stroke": base_color, "width": 1.5, "points": {"show": False}},
                {
                    "label": "current",
                    "stroke": self._now_color,
                    "width": 2.2,
                    "points": {"show": False},
                },
            ),
            scales=self._scales(*self._frame[:2]),
            axes=self._axes(*self._frame),
            legend={"show": False},
            cursor={"sync": {"key": "psd"}, "drag": {"x": True, "y": False}},
            padding=(0, 18, 0, 0),
            height=height,
        )

    def show(self, base: Floats, now: Floats, peaks_hz: Sequence[float]) -> None:
        """Replaces the curves.

        Args:
            base: (n_freqs,), g²/Hz, drawn grey.
            now: (n_freqs,), g²/Hz, drawn blue.
            peaks_hz: where to mark a peak.
        """
        curves = power_decibels(np.stack([base[self._inside], now[self._inside]]))
        if not np.array_equal(curves, self._curves):
            self._curves = curves
            send(self._chart, "data", (self._f, *curves))
        frame = (*_range(curves), tuple(round(f, 1) for f in peaks_hz))
        if frame != self._frame:  # a chart with other axes is built anew and forgets its zoom
            low, high, peaks = self._frame = frame
            assign(self._chart, scales=self._scales(low, high), axes=self._axes(low, high, peaks))

    def _scales(self, low: int, high: int) -> dict:
        return {"x": {"time": False, "range": SHOWN_HZ}, "y": {"range": (low, high)}}

    def _axes(self, low: int, high: int, peaks_hz: Sequence[float]) -> tuple:
        x = [1, 5, 10, 15, 20, 25]
        step = 20 if high - low > 40 else 10
        y = list(range(low + low % step, high + 1, step))
        common = {"font": FONT, "stroke": self._text_color, "ticks": NO_TICKS}
        return (
            {"splits": x, "values": [*map(str, x[:-1]), "25 Hz"], "grid": GRID, "size": 20, "gap": 3}
            | common,
            {"splits": y, "values": [_plain(v) for v in y], "grid": GRID, "size": 34, "gap": 4}
            | common,
            {
                "side": 0,
                "scale": "x",
                "splits": list(peaks_hz),
                "values": [f"{f:.1f}" for f in peaks_hz],
                "size": 16,
                "gap": 2,
                "font": f"600 {FONT}",
                "stroke": self._now_color,
                "grid": PEAK_GRID,
                "ticks": {"show": False},
            },
        )


def _range(curves: Floats) -> tuple[int, int]:
    """Whole tens of dB that hold the curves, at most 60 dB below their top."""
    top = 10 * math.ceil(curves.max() / 10)
    bottom = 10 * math.floor(curves.min() / 10)
    return max(bottom, top - 60), top


def _plain(value: int) -> str:
    return (MINUS if value < 0 else "") + str(abs(value))
