"""Right column: two charts of responses, and what their colours mean."""

from collections.abc import Callable, Sequence
from html import escape

import numpy as np
import viser

from modeviz.ride.psd import FLOOR
from modeviz.text.axes import shown_hz
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, heading, title
from modeviz.viewer.panels.plots import Line, ResponsePlot, Scale, set_line
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChooseCurve
from modeviz.viewer.session.curves import known_curves
from modeviz.viewer.session.design import set_numbers
from modeviz.viewer.session.responses import Responses, curve_label
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import ChartCurve, State
from modeviz.viewer.session.wheel_responses import NOW


class ChartsPanel:
    """Charts of the responses that are chosen, top down: compared set, overlaid ones, present rates."""

    def __init__(self, gui: viser.GuiApi, session: Session, dark: bool) -> None:
        """Builds the charts; `show` fills them."""
        self._session = session
        self._ends = end_colors(dark)
        self._vehicle = session.vehicle
        self._curves = curve_labels(session.vehicle)
        self._legend = gui.add_html("")
        self._choices: list[viser.GuiDropdownHandle[str]] = []
        self._bindings: list[Binding] = []
        self._plots: list[ResponsePlot] = []
        for i in range(len(session.state.charts.curves)):
            self._add_chart(gui, i, dark)

    def show(
        self,
        solved: Solved,
        responses: Responses,
        peaks: list[list[int]],
        band: Callable[[ChartCurve], tuple[Floats, Floats] | None],
    ) -> None:
        """Draws an answer.

        Args:
            solved: the answer.
            responses: its responses.
            peaks: for each chart the numbers of the frequencies that are marked.
            band: gives frequencies and what a curve scatters between there, (2, n_freqs), if that is
                known.
        """
        state = solved.state
        lines = chart_lines(solved, responses, *self._ends)
        names = [state.against, *responses.overlaid, NOW]
        self._offer(solved.now.prepared.vehicle)
        show_all(self._bindings)
        assign(self._legend, content=block(legend(lines, solved)))
        for curve, choice, plot, marked in zip(
            state.charts.curves, self._choices, self._plots, peaks, strict=True
        ):
            quantity = responses.quantity_of(curve)
            scale = Scale(quantity, state.charts.decibels, state.charts.log_frequency)
            assign(choice, label=quantity.unit_text(state.charts.decibels))
            f = np.unique(np.concatenate([responses.lines(name) for name in names]))
            levels = [drawn_at(f, responses.lines(name), responses.of(name, curve)) for name in names]
            shaded = band(curve)
            between = None if shaded is None else drawn_at(f, *shaded)
            peaks_at = np.searchsorted(f, responses.lines(NOW)[marked])
            subject = curve, state.charts.load, state.conditions
            plot.show(subject, scale, lines, f, np.stack(levels), peaks_at.tolist(), between)

    def _offer(self, vehicle: Vehicle) -> None:
        """Offers the responses that there are of a vehicle, which may have other mounts by now."""
        if vehicle is self._vehicle:
            return
        self._vehicle, self._curves = vehicle, curve_labels(vehicle)
        for choice in self._choices:
            assign(choice, options=tuple(self._curves))

    @property
    def names(self) -> tuple[str, ...]:
        """By which pages know the charts, top down."""
        return tuple(plot.name for plot in self._plots)

    def _add_chart(self, gui: viser.GuiApi, i: int, dark: bool) -> None:
        choice = gui.add_dropdown(
            "dB",
            tuple(self._curves),
            initial_value=curve_label(self._session.vehicle, self._session.state.charts.curves[i]),
            hint="Which point's acceleration is drawn, or which mount's force, and in which direction; "
            "drag in the chart to look closer, double-click to see all, click to put the cursor there",
        )

        def read(state: State) -> str:
            found = (label for label, curve in self._curves.items() if curve == state.charts.curves[i])
            return next(found, choice.value)

        def write(label: str) -> None:
            self._session.do(ChooseCurve(i, self._curves[label]))

        self._choices.append(choice)
        self._bindings.append(Binding(choice, self._session, read, write))
        self._plots.append(ResponsePlot(gui, shown_hz(self._session.vehicle.highest_frequency), dark))


def drawn_at(frequency_hz: Floats, lines: Floats, levels: Floats) -> Floats:
    """A curve that is straight in decibels between its lines, at other frequencies; else no number.

    Args:
        frequency_hz: (n_freqs,).
        lines: (n_lines,).
        levels: (..., n_lines).
    """
    logarithms = np.log(np.maximum(levels, FLOOR))
    rows = [
        np.interp(frequency_hz, lines, row, np.nan, np.nan)
        for row in logarithms.reshape(-1, len(lines))
    ]
    return np.exp(rows).reshape(*levels.shape[:-1], len(frequency_hz))


def chart_lines(solved: Solved, responses: Responses, base: str, now: str) -> list[Line]:
    """Return the styles of a chart's curves, the compared and the present set's in these colours."""
    numbers = set_numbers(solved.now.prepared.vehicle, solved.state.design)
    overlaid = [set_line(name, numbers[name]) for name in responses.overlaid]
    return [Line(solved.state.against, base, 1.5), *overlaid, Line("now", now, 2.2)]


def end_colors(dark: bool) -> tuple[str, str]:
    """The colours of the compared set and of the present rates."""
    return ("#8a95a1", "#5aa9ea") if dark else ("#98a2ad", "#2b7cc4")


def curve_labels(vehicle: Vehicle) -> dict[str, ChartCurve]:
    """The `known_curves` by what they are called."""
    return {curve_label(vehicle, curve): curve for curve in known_curves(vehicle)}


def legend(lines: list[Line], solved: Solved) -> str:
    """The sets with their colours, and what excites the vehicle."""
    return heading(keys(lines), excited_by(solved))


def keys(lines: Sequence[Line]) -> str:
    """What lines are called, each beside a sample."""
    every = (f'<span class="key">{swatch(line)}{escape(line.label)}</span>' for line in lines)
    return f'<span class="keyed">{"".join(every)}</span>'


def swatch(line: Line) -> str:
    """A sample of a line."""
    style = "dashed" if line.dash else "solid"
    return f'<i class="line" style="border-top:3px {style} {line.color}"></i>'


def excited_by(solved: Solved) -> str:
    """Return the excitation of the vehicle as page text."""
    if solved.state.charts.load:
        return title(solved.state.charts.load)
    conditions = solved.now.conditions
    return f"{title(conditions.road)}, {conditions.speed / factor('km/h', 'speed'):.0f} km/h"
