"""Right column: what a running engine does, by order and in all, over its speed."""

from html import escape

import numpy as np
import viser

from modeviz.analysis.engine_results import EngineResults, orders_rms, run_up_ends
from modeviz.errors import ModevizError
from modeviz.text.wording import significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import HiddenButtons, block, change, heading, row, span, table
from modeviz.viewer.panels.charts import chart_lines, curve_labels, end_colors, keys
from modeviz.viewer.panels.cursor import Cursor, CursorSlider
from modeviz.viewer.panels.plots import Line, ResponsePlot, Scale, set_line
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChangeCharts, LookAtEngine
from modeviz.viewer.session.responses import PEAK_ACCELERATION, Responses, order_peaks, peak_unit
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.wheel_responses import NOW

PER_MINUTE = 60
STEP_RPM = 5.0
N_ORDERS = 16
"""That are listed."""

BEFORE = (2, 3)
"""Dashes of an order with the set compared with."""


class EnginePanel:
    """Two charts over speed, of all orders with every set and of each order, and a table at a speed."""

    def __init__(self, gui: viser.GuiApi, session: Session, dark: bool) -> None:
        """Builds the choices and charts; `show` fills them."""
        self._session, self._ends = session, end_colors(dark)
        vehicle, look = session.vehicle, session.state.engine
        self._bindings: list[Binding] = []
        if len(vehicle.engines) > 1:
            self._bindings.append(self._engine_choice(gui))
        self._curves = curve_labels(vehicle)
        labels = {curve: label for label, curve in self._curves.items()}
        self._choice = gui.add_dropdown(
            peak_unit(look.curve).unit,
            tuple(self._curves),
            initial_value=labels[look.curve],
            hint="Which point's acceleration is drawn over the engine's speed, or which mount's force",
        )
        self._bindings.append(
            Binding(
                self._choice,
                session,
                lambda state: labels[state.engine.curve],
                lambda label: session.do(LookAtEngine(curve=self._curves[label])),
            )
        )
        shown = _shown_rpm(vehicle)
        self._total_legend = gui.add_html("")
        self._total = ResponsePlot(gui, shown, dark, unit="rpm")
        self._legend = gui.add_html("")
        self._by_order = ResponsePlot(gui, shown, dark, unit="rpm")
        cursor = Cursor(
            "rpm",
            *shown,
            STEP_RPM,
            "The speed at which orders are told: drag, or click in a chart",
            lambda state: PER_MINUTE * state.engine.speed_hz,
            lambda rpm: LookAtEngine(speed_hz=rpm / PER_MINUTE),
        )
        self._cursor = CursorSlider(gui, session, (self._total.name, self._by_order.name), cursor)
        self._rows: list[tuple[EngineOrder, float]] = []
        self._buttons = HiddenButtons(gui, N_ORDERS, self._select)
        self._content = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Draws what the engine does with the rates of an answer."""
        show_all(self._bindings)
        self._cursor.show()
        responses, curve = Responses(solved), solved.state.engine.curve
        try:
            names = (solved.state.against, *responses.overlaid, NOW)
            runs = [responses.run_up(name) for name in names]
            levels = [order_peaks(run, curve) for run in runs]
        except ModevizError as error:
            assign(self._content, content=block(span(escape(str(error)), "dim")))
            return
        scale = Scale(peak_unit(curve), solved.state.charts.decibels, log_frequency=False)
        assign(self._choice, label=scale.quantity.unit_text(scale.decibels))
        self._draw_total(solved, responses, scale, runs[-1], levels)
        self._draw_orders(solved, scale, runs[-1], levels[0], levels[-1])
        assign(self._content, content=block(*self._at_speed(solved, runs[-1], levels[0], levels[-1])))

    def _draw_total(
        self,
        solved: Solved,
        responses: Responses,
        scale: Scale,
        run: EngineResults,
        levels: list[Floats],
    ) -> None:
        lines = chart_lines(solved, responses, *self._ends)
        words = f"{escape(run.engine.name)}, RMS of all orders"
        assign(self._total_legend, content=block(heading(keys(lines), words)))
        every = np.array([_total(level) for level in levels])
        subject = "all", run.engine.name, solved.state.engine.curve
        self._total.show(subject, scale, lines, PER_MINUTE * run.speed_hz, every, ())

    def _draw_orders(
        self, solved: Solved, scale: Scale, run: EngineResults, base: Floats, now: Floats
    ) -> None:
        """The peaks of each order, dashed with the set compared with."""
        lines = [set_line(f"order {o.order:g}", i) for i, o in enumerate(run.engine.orders)]
        before = [Line(line.label, line.color, 1.0, BEFORE) for line in lines]
        words = f"peak, dashed: {escape(solved.state.against)}"
        assign(self._legend, content=block(heading(keys(lines), words)))
        both = np.concatenate([base, now], axis=1).T
        highest = float(np.nanmax(scale.quantity.decibels(both), initial=-np.inf))
        subject = run.engine.name, solved.state.engine.curve, highest // 10
        self._by_order.show(subject, scale, (*before, *lines), PER_MINUTE * run.speed_hz, both, ())

    def _at_speed(self, solved: Solved, run: EngineResults, base: Floats, now: Floats) -> list[str]:
        """Each order's frequency and peaks at the cursor, and the RMS of all."""
        at = int(np.argmin(np.abs(run.speed_hz - solved.state.engine.speed_hz)))
        speed = float(run.speed_hz[at])
        swept = {load.name for load in run.vehicle.swept_loads}
        self._rows, rows = [], []
        scale, unit = _table_unit(solved)
        for number, order in enumerate(run.engine.orders[:N_ORDERS]):
            name = f"Order {order.order:g}"
            if order.name in swept:
                name = self._buttons.label(len(self._rows), name)
                self._rows.append((order, order.order * speed))
            cells = _compared(scale * base[at, number], scale * now[at, number])
            is_drawn = order.name == solved.state.charts.load
            rows.append(row([name, f"{order.order * speed:.1f}", *cells], chosen=is_drawn))
        before, after = (scale * float(_total(level)[at]) for level in (base, now))
        rows.append(row(["All, RMS", "", *_compared(before, after)]))
        idle = ", idle" if at == run.idle else ""
        header = ("", "Hz", escape(solved.state.against), "now", "change")
        told = f"At {PER_MINUTE * speed:.0f} rpm{idle}, peak, {unit}"
        return [heading(told, "click: draw it over frequency"), table(header, rows)]

    def _select(self, place: int) -> None:
        if place < len(self._rows):
            order, f = self._rows[place]
            highest = self._session.vehicle.highest_frequency
            self._session.do(ChangeCharts(load=order.name, cursor_hz=min(f, highest)))

    def _engine_choice(self, gui: viser.GuiApi) -> Binding:
        session = self._session
        names = tuple(engine.name for engine in session.vehicle.engines)
        choice = gui.add_dropdown("Engine", names, initial_value=session.state.engine.engine)
        return Binding(
            choice,
            session,
            lambda state: state.engine.engine,
            lambda name: session.do(LookAtEngine(engine=name)),
        )


def _shown_rpm(vehicle: Vehicle) -> tuple[float, float]:
    """From the slowest to the fastest speed of any of its engines, as far as charts reach."""
    ends = np.array([run_up_ends(vehicle, engine) for engine in vehicle.engines])
    low, high = PER_MINUTE * ends[:, 0].min(), PER_MINUTE * ends[:, 1].max()
    return float(low), float(max(high, low + STEP_RPM))


def _total(peaks: Floats) -> Floats:
    """The RMS of all orders, (n_speeds,); nan where none is in the band."""
    return np.where(np.isnan(peaks).all(axis=1), np.nan, orders_rms(peaks))


def _table_unit(solved: Solved) -> tuple[float, str]:
    """What values are multiplied by to be read, and their unit."""
    quantity = peak_unit(solved.state.engine.curve)
    return (1000.0, "10⁻³ g") if quantity is PEAK_ACCELERATION else (1.0, quantity.unit)


def _compared(base: float, now: float) -> list[str]:
    if np.isnan(now):
        return ["", span("beyond the band", "dim"), ""]
    after = significant(float(f"{now:.3g}"))
    if np.isnan(base):
        return [span("without", "dim"), after, ""]
    before = significant(float(f"{base:.3g}"))
    return [span(before, "dim"), after, change(now, base)]
