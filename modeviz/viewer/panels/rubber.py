"""Right column: dynamic stiffness and loss angle of the selected group's mounts over frequency."""

from html import escape

import numpy as np
import viser

from modeviz.analysis.results import AXIS
from modeviz.analysis.rubber import about_rubber, dynamic_groups, measured_points, rubber_curve
from modeviz.errors import ModevizError
from modeviz.text.axes import shown_hz
from modeviz.text.wording import number, percent_change, sentence_case, significant
from modeviz.units import factor
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DIRECTIONS
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, heading, row, span, table
from modeviz.viewer.panels.charts import chart_lines, end_colors, keys
from modeviz.viewer.panels.linear_plot import LinearPlot
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChangeCharts
from modeviz.viewer.session.responses import Responses
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

N_LINES = 200
"""Of a curve, besides those of its table."""


class RubberPanel:
    """Two charts along one direction, and a table at the reference and at the cursor."""

    def __init__(self, gui: viser.GuiApi, session: Session, dark: bool) -> None:
        """Builds the choice of direction and the charts; `show` fills them."""
        self._groups = {group.name: group for group in dynamic_groups(session.vehicle)}
        self._ends, self._shown = end_colors(dark), shown_hz(session.vehicle.highest_frequency)
        words = {sentence_case(direction): direction for direction in DIRECTIONS}
        choice = gui.add_dropdown(
            "Direction",
            tuple(words),
            initial_value=sentence_case(session.state.charts.rubber_direction),
            hint="Of the mount's own axes",
        )
        self._binding: Binding[State] = Binding(
            choice,
            session,
            lambda state: sentence_case(state.charts.rubber_direction),
            lambda word: session.do(ChangeCharts(rubber_direction=words[word])),
        )
        self._about = gui.add_html("")
        self._stiffness = LinearPlot(gui, self._shown, dark)
        self._angle_heading = gui.add_html(block(heading("Loss angle, °")))
        self._angle = LinearPlot(gui, self._shown, dark)
        self._content = gui.add_html("")

    def show(self, solved: Solved) -> None:
        """Draws the rates of an answer: of the selected group, or of the first that has such."""
        self._binding.show()
        group = self._groups.get(solved.state.group) or next(iter(self._groups.values()))
        try:
            self._draw(solved, group)
        except ModevizError as error:
            assign(self._content, content=block(span(escape(str(error)), "dim")))

    def _draw(self, solved: Solved, group: MountGroup) -> None:
        responses, axis = Responses(solved), AXIS[solved.state.charts.rubber_direction]
        sets = [solved.named.results[n] for n in (solved.state.against, *responses.overlaid)]
        points = measured_points(solved.now.prepared, solved.base.rates, group.name)
        low, high = self._shown
        measured = np.zeros(0) if points is None else points.frequency_hz
        measured = measured[(measured >= low) & (measured <= high)]
        f = np.union1d(np.linspace(low, high, N_LINES), measured)
        curves = [rubber_curve(r.prepared, r.rates, group.name, f) for r in (*sets, solved.now)]
        lines, unit = chart_lines(solved, responses, *self._ends), solved.state.units["stiffness"]
        stiffness = np.array([curve.stiffness[:, axis] for curve in curves]) / factor(unit, "stiffness")
        angle = np.degrees([curve.loss_angle[:, axis] for curve in curves])
        told = heading(f"{escape(group.title)}: dynamic stiffness, {escape(unit)}")
        about = span(escape(about_rubber(group)), "dim")
        assign(self._about, content=block(heading(keys(lines)), about, told))
        self._stiffness.show(lines, f, stiffness, measured)
        self._angle.show(lines, f, angle, measured)
        assign(self._content, content=block(*_at_lines(solved, group)))


def _at_lines(solved: Solved, group: MountGroup) -> list[str]:
    """Stiffness and loss angle along all directions at the reference and at the cursor."""
    assert group.dynamic is not None
    f = np.array([group.dynamic.reference_hz, solved.state.charts.cursor_hz])
    base, now = (rubber_curve(r.prepared, r.rates, group.name, f) for r in (solved.base, solved.now))
    per_unit = factor(solved.state.units["stiffness"], "stiffness")
    rows = []
    for direction in DIRECTIONS:
        axis = AXIS[direction]
        cells = []
        for i in range(len(f)):
            k = now.stiffness[i, axis]
            cells += [
                significant(float(f"{k / per_unit:.4g}")),
                number(float(np.degrees(now.loss_angle[i, axis])), 1),
            ]
        more = percent_change(now.stiffness[1, axis], base.stiffness[1, axis])
        cells.append(span(more, "dim"))
        rows.append(row([direction, *cells]))
    unit = escape(solved.state.units["stiffness"])
    header = ("", f"{f[0]:g} Hz, {unit}", "°", f"{f[1]:.4g} Hz, {unit}", "°", "change")
    return [heading("At the reference and at the cursor"), table(header, rows)]
