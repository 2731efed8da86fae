"""Right column: the frequency of the cursor, dragged along the charts or with a slider."""

from collections.abc import Sequence

import viser

from modeviz.text.axes import shown_hz
from modeviz.viewer.page import scripts
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.handles import name_of
from modeviz.viewer.page.write_back import WriteBack
from modeviz.viewer.session.commands.looks import ChangeCharts
from modeviz.viewer.session.session import Session

STEP_HZ = 0.05


class CursorSlider:
    """A slider of the cursor's frequency, which every page draws as a line in the charts."""

    def __init__(self, gui: viser.GuiApi, session: Session, charts: Sequence[str]) -> None:
        """Builds the slider, where there are charts; `charts` are their names on pages."""
        self._binding: Binding | None = None
        if not charts:
            return
        low, high = shown_hz(session.vehicle.highest_frequency)
        slider = gui.add_slider(
            "Cursor, Hz",
            low,
            high,
            STEP_HZ,
            min(max(session.state.charts.cursor_hz, low), high),
            hint="Where modes, forces and paths are told: drag, or click in a chart",
        )
        self._binding = Binding(
            slider,
            session,
            lambda state: state.charts.cursor_hz,
            lambda f: session.do(ChangeCharts(cursor_hz=float(min(max(f, low), high)))),
            WriteBack(),
        )
        scripts.run(gui, "panels/cursor.js", name_of(slider), list(charts))

    def show(self) -> None:
        """Brings the slider after the newest state."""
        if self._binding:
            self._binding.show()
