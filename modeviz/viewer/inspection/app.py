"""The page of bodies as a whole."""

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass, replace
from pathlib import Path

import viser

from modeviz.compute.stop import Stop
from modeviz.errors import ModevizError
from modeviz.formats.component import UNIT_SYSTEMS, Component
from modeviz.formats.solving import Wanted, solved
from modeviz.viewer.inspection.import_panel import TAB, ImportPanel
from modeviz.viewer.inspection.panels import LookPanel, MissingPanel, ModesPanel
from modeviz.viewer.inspection.point_panel import PointPanel
from modeviz.viewer.inspection.scene import InspectionScene
from modeviz.viewer.inspection.sources import Source
from modeviz.viewer.inspection.state import Content, Inspection, State
from modeviz.viewer.inspection.subject import subject_of_component
from modeviz.viewer.page.doors.secret import Secret
from modeviz.viewer.page.doors.surroundings import Surroundings
from modeviz.viewer.page.server import Server, open_server
from modeviz.viewer.page.widgets.hotkeys import Hotkeys
from modeviz.viewer.page.widgets.layout import NARROW, WIDE, Layout
from modeviz.viewer.page.widgets.theme import dress
from modeviz.viewer.page.widgets.title import Title
from modeviz.viewer.panels.animation import AnimationCard
from modeviz.viewer.panels.pictures import PicturePanel
from modeviz.viewer.scene.stage import DARK, LIGHT
from modeviz.viewer.session.coloring import ColorScale

LEFT = {WIDE: 420, NARROW: 320}
CARD = {WIDE: 380, NARROW: 300}
"""Pixels; see `layout`."""

MOTION = ColorScale("Displacement", "100 %", "Relative to the largest")


@dataclass(frozen=True)
class Named:
    """What moves, as the card names it."""

    title: str
    frequency_hz: float
    about: str
    problem: str = ""
    is_still: bool = False


class InspectionApp:
    """A server with one page of bodies; everybody who opens it sees the same."""

    def __init__(
        self,
        server: Server,
        source: Source,
        dark: bool = False,
    ) -> None:
        """Builds the page and shows what there is.

        Args:
            server: an open one, see `page.server.open_server`.
            source: of what is looked at.
            dark: whether the page is dark.

        Raises:
            VehicleError: it cannot be read.
        """
        self.server: Server = server
        self._source, self._content = source, source.read()
        gui = server.gui
        self._title = Title(server)
        dress(gui, dark)
        self.inspection: Inspection = Inspection(self._content, self._show)
        self.scene: InspectionScene = InspectionScene(server, dark)
        self._hotkeys = Hotkeys(gui)
        self._lay_out(source.folder, dark)
        self._show(self.inspection.state)

    @property
    def content(self) -> Content:
        """What was there when it was last read."""
        return self._content

    def end(self) -> None:
        """Forgets what pages have sent."""
        self._import.close()

    def _lay_out(self, folder: Path | None, dark: bool) -> None:
        gui, inspection = self.server.gui, self.inspection
        gui.main_panel.dock_left()
        tabs = gui.add_tab_group()
        with tabs.add_tab("Modes", viser.Icon.WAVE_SINE):
            self._modes = ModesPanel(gui, inspection)
        with tabs.add_tab("View", viser.Icon.EYE):
            self._look = LookPanel(gui, inspection, self.scene.look)
        with tabs.add_tab("Pictures", viser.Icon.CAMERA):
            theme = DARK if dark else LIGHT
            driver = self.scene.driver
            self._pictures = PicturePanel(
                gui, self.server, theme, self._subject, lambda: driver.is_real, self._scale
            )
        with tabs.add_tab(TAB, viser.Icon.PACKAGE_IMPORT):
            self._import = ImportPanel(self.server, folder, self._look_at, self._added)
            self._points = self._point_panel(folder) if folder else None
        self._missing = MissingPanel(gui)
        card = gui.add_panel()
        with card.add_tab("Motion", viser.Icon.PLAYER_PLAY):
            self._animation = AnimationCard(gui, self.scene.driver, inspection.step)
        card.float(x=24, y=-24)
        Layout(self.server, ((gui.main_panel, LEFT), (card, CARD)))
        self._hotkeys.add("Play or pause", "space", lambda event: self._animation.toggle(event.client))
        self._hotkeys.add("Next mode", "N", lambda _: inspection.step(1))
        self._hotkeys.add("Mode before", "P", lambda _: inspection.step(-1))

    def _point_panel(self, folder: Path) -> PointPanel:
        lock = self._import.lock
        return PointPanel(self.server.gui, folder, lock, lambda: self._added(""))

    def _look_at(self, component: Component, name: str, units: str | None) -> None:
        """Shows a component that is not in the vehicle beside what is."""
        taken = {subject.name for subject in self._content.subjects}
        chosen = component.units or UNIT_SYSTEMS.get(units or "")
        label = f"{name} (new)" if name in taken else name
        subject = subject_of_component(solved(component, Wanted()), label, chosen)
        subjects = (*self._content.subjects, subject)
        self.inspection.replace_content(replace(self._content, subjects=subjects), subject.name)

    def _added(self, name: str) -> None:
        """Shows the vehicle after something was put into it, and the body if it is one."""
        self._content = self._source.read()
        self.inspection.replace_content(self._content, name or self.inspection.state.subject)

    def _subject(self) -> str:
        """Return what is to be seen in a picture: "frame.op2 mode 7"."""
        named = _named(self.inspection.state)
        return f"{named.title} {named.about}"

    def _scale(self) -> ColorScale | None:
        """Return what the colours mean; raises ModevizError if there is nothing to be seen."""
        if not self.inspection.state.content.subjects:
            raise ModevizError("there is nothing to draw yet")
        return _scale_of(self.inspection.state)

    def _show(self, state: State) -> None:
        with self.server.atomic():
            self._title.show(state.content.name, state.subject or "no bodies")
            self._modes.show(state)
            self._look.show()
            self._missing.show(state.content.missing)
            if self._points:
                self._points.show(self._content.subjects)
            self._animation.show(_named(state), _scale_of(state))
        self.scene.show(state)


def _scale_of(state: State) -> ColorScale | None:
    """What the colours mean, if they mean something."""
    moves = state.moving is not None and bool(state.moving.modes)
    return MOTION if moves and state.coloring != "bodies" else None


def _named(state: State) -> Named:
    moving = state.moving
    if moving is None or not moving.modes:
        return Named(state.subject or state.content.name, 0.0, "at rest")
    mode = moving.modes[state.mode]
    return Named(f"{state.subject}", mode.frequency_hz, f"{mode.kind} {state.mode + 1}")


def inspect(
    source: Source,
    host: str,
    port: int,
    token: Secret | None,
    dark: bool,
    around: Surroundings,
    tell: Callable[[str], None],
    stop: Stop | None = None,
) -> None:
    """Shows bodies until interrupted.

    Args:
        source: of the bodies.
        host: address to listen on.
        port: to listen on.
        token: asked of every visitor, if any.
        dark: whether the page is dark.
        around: the server.
        tell: told what cannot be computed yet, a sentence at a time.
        stop: ends it; if not given, only an exception in the main thread does.

    Raises:
        ModevizError: they cannot be read, the port is in use, or the address needs a token.
    """
    with ExitStack() as ending:
        server = open_server(host, port, token, "modeviz", around)
        ending.callback(server.stop)
        app = InspectionApp(server, source, dark)
        ending.callback(app.end)
        for sentence in app.content.missing:
            tell(sentence)
        print(f"{app.content.name} is at {server.link}  (Ctrl+C ends)", flush=True)
        (stop or Stop()).wait()
