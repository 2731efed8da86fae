"""The right column: all that an answer says, of which a vehicle has what there can be an answer to."""

from typing import Protocol

import viser

from modeviz.analysis.rubber import dynamic_groups
from modeviz.viewer.page.widgets.layout import NARROW, WIDE
from modeviz.viewer.panels.energy import EnergyPanel
from modeviz.viewer.panels.engine import EnginePanel
from modeviz.viewer.panels.excitation import ExcitationPanel
from modeviz.viewer.panels.figures import TablePanel
from modeviz.viewer.panels.forces import ForcesPanel
from modeviz.viewer.panels.modes import ModesPanel
from modeviz.viewer.panels.paths import PathsPanel
from modeviz.viewer.panels.response import ResponsePanel
from modeviz.viewer.panels.rigid.panel import RigidPanel
from modeviz.viewer.panels.rubber import RubberPanel
from modeviz.viewer.panels.statics import StaticPanel
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.cursor import has_ride, is_shaken
from modeviz.viewer.session.session import Session
from modeviz.viewer.tasks.tasks import Tasks

WIDTHS = {WIDE: 484, NARROW: 380}
"""Pixels; see `layout`."""


class Shows(Protocol):
    """A panel for reading."""

    def show(self, solved: Solved) -> None:
        """Brings it after an answer."""
        ...


class Results:
    """The tabs of the column."""

    def __init__(self, gui: viser.GuiApi, session: Session, tasks: Tasks, dark: bool) -> None:
        """Builds those that the vehicle has.

        Args:
            gui: where.
            session: whose answers they show.
            tasks: whose scatter is drawn as bands.
            dark: whether pages are dark.
        """
        self._gui, self._session, self._dark = gui, session, dark
        self.figures: TablePanel | None = None
        self.excitation: ExcitationPanel | None = None
        self.forces: ForcesPanel | None = None
        self.paths: PathsPanel | None = None
        self.engine: EnginePanel | None = None
        self.rubber: RubberPanel | None = None
        self.panel: viser.PanelHandle = gui.add_panel()
        with self.panel.add_tab("Response", viser.Icon.CHART_LINE):
            self.response: ResponsePanel = ResponsePanel(gui, session, tasks.scatter, dark)
            self._add_below_the_response()
        self._add_of_ride()
        self._add_engine()
        with self.panel.add_tab("Rigid", viser.Icon.AXIS_X):
            self.rigid: RigidPanel = RigidPanel(gui, session)
        with self.panel.add_tab("Static", viser.Icon.ARROW_BAR_TO_DOWN):
            self.static: StaticPanel = StaticPanel(gui, session)
        if dynamic_groups(session.vehicle):
            with self.panel.add_tab("Rubber", viser.Icon.WAVE_SAW_TOOL):
                self.rubber = RubberPanel(gui, session, dark)
        self.panel.dock_right()

    def show(self, solved: Solved) -> None:
        """Brings them after an answer; of one that is not detailed, the response alone."""
        self.response.show(solved)
        if solved.is_detailed:
            for panel in self._for_reading:
                if panel:
                    panel.show(solved)

    @property
    def _for_reading(self) -> tuple[Shows | None, ...]:
        return (
            self.figures,
            self.excitation,
            self.modes,
            self.energy,
            self.rigid,
            self.static,
            self.rubber,
            self.engine,
            self.forces,
            self.paths,
        )

    def _add_below_the_response(self) -> None:
        """Adds the tabs that stand under the charts."""
        gui, session = self._gui, self._session
        vehicle = session.vehicle
        tabs = gui.add_tab_group()
        with tabs.add_tab("Modes", viser.Icon.WAVE_SINE):
            self.modes: ModesPanel = ModesPanel(gui, session)
        with tabs.add_tab("Energy", viser.Icon.CHART_BAR):
            self.energy: EnergyPanel = EnergyPanel(gui, session)
        if is_shaken(vehicle) and vehicle.mounts:
            with tabs.add_tab("Forces", viser.Icon.ARROWS_VERTICAL):
                self.forces = ForcesPanel(gui, session)
        if is_shaken(vehicle) and vehicle.response_points:
            with tabs.add_tab("Paths", viser.Icon.ROUTE):
                self.paths = PathsPanel(gui, session)

    def _add_of_ride(self) -> None:
        """Adds the figures at response points, and what shakes the vehicle."""
        session = self._session
        has_curves, vehicle = bool(session.state.charts.curves), session.vehicle
        if has_curves:
            with self.panel.add_tab("Figures", viser.Icon.TABLE):
                self.figures = TablePanel(self._gui)
        if has_curves or is_shaken(vehicle):
            with self.panel.add_tab("Road" if has_ride(vehicle) else "Load", viser.Icon.ROAD):
                self.excitation = ExcitationPanel(self._gui, session)

    def _add_engine(self) -> None:
        vehicle = self._session.vehicle
        if vehicle.engines and (vehicle.response_points or vehicle.mounts):
            with self.panel.add_tab("Engine", viser.Icon.ENGINE):
                self.engine = EnginePanel(self._gui, self._session, self._dark)
