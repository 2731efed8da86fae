"""Right column: where the cursor of charts is, dragged along them or with a slider."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import viser

from modeviz.text.axes import shown_hz
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import name_of
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.commands.looks import ChangeCharts
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

STEP_HZ = 0.05


@dataclass(frozen=True)
class Cursor:
    """What a cursor moves along."""

    unit: str
    low: float
    high: float
    step: float
    hint: str
    read: Callable[[State], float]
    """Where it is."""
    move: Callable[[float], Command]
    """What moves it there."""

    def inside(self, value: float) -> float:
        """The closest place there is."""
        return float(min(max(value, self.low), self.high))


class CursorSlider:
    """A slider of a cursor, which every page draws as a line in its charts."""

    def __init__(
        self, gui: viser.GuiApi, session: Session, charts: Sequence[str], cursor: Cursor
    ) -> None:
        """Builds the slider, where there are charts; `charts` are their names on pages."""
        self._binding: Binding[State] | None = None
        if not charts:
            return
        slider = gui.add_slider(
            f"Cursor, {cursor.unit}",
            cursor.low,
            cursor.high,
            cursor.step,
            cursor.inside(cursor.read(session.state)),
            hint=cursor.hint,
        )
        self._binding = Binding(
            slider,
            session,
            cursor.read,
            lambda value: session.do(cursor.move(cursor.inside(value))),
            WriteBack(),
        )
        scripts.run(gui, "panels/cursor.js", name_of(slider), list(charts), cursor.unit)

    def show(self) -> None:
        """Brings the slider after the newest state."""
        if self._binding:
            self._binding.show()


def frequency_cursor(vehicle: Vehicle) -> Cursor:
    """The cursor of charts over frequency."""
    return Cursor(
        "Hz",
        *shown_hz(vehicle.highest_frequency),
        STEP_HZ,
        "Where modes, forces and paths are told: drag, or click in a chart",
        lambda state: state.charts.cursor_hz,
        lambda f: ChangeCharts(cursor_hz=f),
    )
