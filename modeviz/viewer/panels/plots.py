"""The charts of the page: responses as uPlot."""

import math
from collections.abc import Hashable, Sequence
from dataclasses import dataclass

import numpy as np
import viser

from modeviz.text.axes import DECIBELS, USUAL_SHOWN_HZ, Axis
from modeviz.vehicle.arrays import Floats
from modeviz.viewer.page.widgets.handles import name_of, send_together
from modeviz.viewer.session.responses import LevelUnit

SHOWN_HZ = USUAL_SHOWN_HZ
TICKS_HZ, LOG_TICKS_HZ = (1.0, 5.0, 10.0, 15.0, 20.0, 25.0), (1.0, 2.0, 5.0, 10.0, 25.0)
"""Of what is shown of the usual band."""
FONT = '11px -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif'
GRID: dict[str, object] = {"show": True, "width": 1, "stroke": "rgba(128,138,150,0.16)"}
NO_TICKS: dict[str, object] = {"show": False, "size": 0}

HEADROOM = 3
"""dB above the highest curve, so that the scale need not change when the present one grows."""

LETTER = 6.6
"""Pixels: the width of a letter of `FONT`, about."""

SHADE = "40"
"""Hexadecimal opacity of the band around the present curve."""

SET_COLORS = ("#e69f00", "#009e73", "#cc79a7", "#d55e00")
"""Of the sets that are drawn beside, told apart by the colour-blind too (M. Okabe and K. Ito, 2008)."""

SET_DASHES = ((), (7, 3), (2, 3))
"""Of the first four sets, the next four and all others."""


@dataclass(frozen=True)
class Scale:
    """The unit and spacing in which responses are drawn."""

    quantity: LevelUnit
    decibels: bool
    log_frequency: bool


@dataclass(frozen=True)
class Line:
    """The style of a set's curve."""

    label: str
    color: str
    thickness: float
    dash: tuple[int, ...] = ()


def set_line(label: str, number: int) -> Line:
    """Return the style of the set of that number."""
    turn, color = divmod(number, len(SET_COLORS))
    return Line(label, SET_COLORS[color], 1.5, SET_DASHES[min(turn, len(SET_DASHES) - 1)])


class ResponsePlot:
    """Responses of several sets; the last is the present one, whose peaks are marked.

    uPlot forgets how far it is zoomed when its axes change; zoom.js gives that back. They only change
    with what is drawn, and where the present curve would leave the top; peaks are points of a curve of
    their own.
    """

    def __init__(
        self,
        gui: viser.GuiApi,
        shown: tuple[float, float],
        dark: bool,
        height: int = 130,
        unit: str = "Hz",
    ) -> None:
        """Draws an empty chart from one frequency to another, or from speed to speed.

        `show` fills it.
        """
        self._shown, self._unit = shown, unit
        self._f = np.array(shown)
        self._text_color = "#b4bcc6" if dark else "#5b6670"
        self._paper = "#242424" if dark else "#ffffff"
        self._subject: Hashable = None
        self._top = 0
        self._data = np.zeros((1, 0))
        self._chart = gui.add_uplot(
            (self._f, np.full(len(self._f), np.nan)),
            ({"label": unit}, {"label": "now"}),
            scales={"x": {"time": False, "range": shown}, "y": {"range": (-80, -20)}},
            legend={"show": False},
            cursor={"sync": {"key": unit}, "drag": {"x": True, "y": False}},
            padding=(6, self._room_for_end(), 0, 0),
            height=height,
        )

    @property
    def name(self) -> str:
        """By which pages know the chart."""
        return name_of(self._chart)

    def show(
        self,
        subject: Hashable,
        scale: Scale,
        lines: Sequence[Line],
        frequency_hz: Floats,
        levels: Floats,
        peaks: Sequence[int],
        band: Floats | None = None,
    ) -> None:
        """Replaces the curves.

        Args:
            subject: what is drawn; with another one the axes are chosen anew.
            scale: how.
            lines: one for each curve.
            frequency_hz: (n_freqs,), or speeds in the chart's unit.
            levels: (n_curves, n_freqs), in the unit of the scale's quantity; the last is the present.
            peaks: numbers of the frequencies at which that one is marked.
            band: (2, n_freqs), the levels between which the paper is shaded, if any.
        """
        inside = (frequency_hz >= self._shown[0]) & (frequency_hz <= self._shown[1])
        f, levels = frequency_hz[inside], levels[:, inside]
        shaded = np.zeros((0, len(f))) if band is None else band[:, inside]
        decibels = scale.quantity.decibels(levels)
        every = np.vstack([shaded, levels])
        drawn = scale.quantity.decibels(every) if scale.decibels else every
        data = np.vstack([drawn, np.where(np.isin(np.flatnonzero(inside), peaks), drawn[-1], np.nan)])
        axes = {}
        key = (subject, scale, tuple(lines), band is None)
        highest = np.nanmax(decibels[-1], initial=-np.inf)
        if key != self._subject or highest > self._top:
            self._subject = key
            bottom, self._top = level_range(decibels[np.isfinite(decibels)])
            axes = self._axes(scale, bottom, self._top) | self._series(lines, band is not None)
        data = np.vstack([f, data])
        if axes or not np.array_equal(data, self._data, equal_nan=True):
            self._data = data
            drawn_from = (f, *data[1:].astype(np.float32))  # a chart can only be sent as a whole
            send_together(self._chart, data=drawn_from, **axes)

    def _series(self, lines: Sequence[Line], is_shaded: bool) -> dict:
        """The ends of what is shaded, the curves, and the marks on the last."""
        none = {"show": False}
        ends = 2 * [{"label": "band", "width": 0, "points": none}] if is_shaded else []
        curves = [
            {
                "label": line.label,
                "stroke": line.color,
                "width": line.thickness,
                "dash": list(line.dash),
                "points": none,
            }
            for line in lines
        ]
        color = lines[-1].color
        points = {"show": True, "size": 7, "width": 2, "stroke": color, "fill": self._paper}
        marks = {"label": "peaks", "width": 0, "points": points}
        return {
            "series": ({"label": self._unit}, *ends, *curves, marks),
            "bands": ({"series": (2, 1), "fill": f"{color}{SHADE}"},) if is_shaded else (),
        }

    def _axes(self, scale: Scale, bottom: int, top: int) -> dict:
        y = level_axis(scale, bottom, top)
        *inner, end = self._ticks_along(scale.log_frequency)
        x_ticks = [*((f, f"{f:g}") for f in inner), (end, self._end_text(end))]
        common = {"font": FONT, "stroke": self._text_color, "ticks": NO_TICKS, "grid": GRID, "space": 1}
        return {
            "scales": {
                "x": {"time": False, "range": self._shown} | _distribution(scale.log_frequency),
                "y": {"range": (y.low, y.high)} | _distribution(y.is_logarithmic),
            },
            "axes": (
                _ticks(x_ticks) | {"size": 20, "gap": 3} | common,
                _ticks(_thinned(y.ticks())) | {"size": 34, "gap": 4} | common,
            ),
        }

    def _end_text(self, end: float) -> str:
        return f"{end:g} {self._unit}"

    def _room_for_end(self) -> int:
        """Pixels right of the end for half of what is written below it."""
        return max(18, round(LETTER * len(self._end_text(self._ticks_along(False)[-1])) / 2))

    def _ticks_along(self, is_logarithmic: bool) -> Sequence[float]:
        if self._shown == SHOWN_HZ:
            return LOG_TICKS_HZ if is_logarithmic else TICKS_HZ
        return [f for f, _ in Axis("", *self._shown, is_logarithmic).ticks()]


def level_axis(scale: Scale, bottom: int, top: int) -> Axis:
    """From `bottom` to `top` dB."""
    title = scale.quantity.unit_text(scale.decibels)
    if scale.decibels:
        return Axis(title, bottom, top)
    decade = 10 * scale.quantity.bels_per_decade
    return Axis(title, 10 ** (bottom / decade), 10 ** (top / decade), is_logarithmic=True)


def _distribution(is_logarithmic: bool) -> dict:
    return {"distr": 3, "log": 10} if is_logarithmic else {}


def _ticks(ticks: Sequence[tuple[float, str]]) -> dict:
    return {"splits": [value for value, _ in ticks], "values": [text for _, text in ticks]}


def _thinned(ticks: list[tuple[float, str]]) -> list[tuple[float, str]]:
    """Every other one where they would stand too close, counted from the top."""
    return ticks[::-1][::2][::-1] if len(ticks) > 5 else ticks


def level_range(decibels: Floats) -> tuple[int, int]:
    """Whole tens of dB that hold the curves, at most `DECIBELS` below the top."""
    decibels = decibels[np.isfinite(decibels)]
    if not decibels.size:
        return -80, -20
    top = 10 * math.ceil((decibels.max() + HEADROOM) / 10)
    bottom = 10 * math.floor(decibels.min() / 10)
    return max(min(bottom, top - 20), top - DECIBELS), top
