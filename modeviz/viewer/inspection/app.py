"""The page of bodies as a whole."""

import threading
from collections.abc import Sequence
from dataclasses import dataclass

import viser

from modeviz.viewer.inspection.panels import LookPanel, MissingPanel, ModesPanel
from modeviz.viewer.inspection.scene import InspectionScene
from modeviz.viewer.inspection.state import Content, Inspection, State
from modeviz.viewer.page import scripts
from modeviz.viewer.page.hotkeys import Hotkeys
from modeviz.viewer.page.html import style_sheet
from modeviz.viewer.page.layout import NARROW, WIDE, Layout
from modeviz.viewer.page.server import Server, open_server
from modeviz.viewer.page.title import Title
from modeviz.viewer.panels.animation import AnimationCard
from modeviz.viewer.session.coloring import ColorScale

LEFT = {WIDE: 420, NARROW: 320}
CARD = {WIDE: 380, NARROW: 300}
"""Pixels; see `layout`."""

BRAND = {False: (32, 104, 168), True: (64, 146, 214)}
MOTION = ColorScale("Displacement", "100 %", "Relative to the largest")


@dataclass(frozen=True)
class Named:
    """What moves, as the card names it."""

    title: str
    frequency_hz: float
    about: str
    problem: str = ""


class InspectionApp:
    """A server with one page of bodies; everybody who opens it sees the same."""

    def __init__(self, server: Server, content: Content, dark: bool = False) -> None:
        """Builds the page and shows what there is.

        Args:
            server: an open one, see `page.server.open_server`.
            content: what there is to look at.
            dark: whether the page is dark.
        """
        self.server: Server = server
        gui = server.gui
        self._title = Title(server)
        for script, *arguments in (
            ("page/style.js", style_sheet()),
            ("page/delivery.js",),
            ("page/zoom.js",),
        ):
            scripts.run(gui, script, *arguments)
        gui.configure_theme(
            dark_mode=dark, show_logo=False, show_share_button=False, brand_color=BRAND[dark]
        )
        self.inspection: Inspection = Inspection(content, self._show)
        self.scene: InspectionScene = InspectionScene(server, dark)
        self._hotkeys = Hotkeys(gui)
        self._lay_out()
        self._show(self.inspection.state)

    def _lay_out(self) -> None:
        gui, inspection = self.server.gui, self.inspection
        gui.main_panel.dock_left()
        tabs = gui.add_tab_group()
        with tabs.add_tab("Modes", viser.Icon.WAVE_SINE):
            self._modes = ModesPanel(gui, inspection)
        with tabs.add_tab("View", viser.Icon.EYE):
            self._look = LookPanel(gui, inspection, self.scene.look)
        self._missing = MissingPanel(gui)
        card = gui.add_panel()
        with card.add_tab("Motion", viser.Icon.PLAYER_PLAY):
            self._animation = AnimationCard(gui, self.scene.driver, inspection.step)
        card.float(x=24, y=-24)
        Layout(self.server, ((gui.main_panel, LEFT), (card, CARD)))
        self._hotkeys.add("Play or pause", "space", lambda event: self._animation.toggle(event.client))
        self._hotkeys.add("Next mode", "N", lambda _: inspection.step(1))
        self._hotkeys.add("Mode before", "P", lambda _: inspection.step(-1))

    def _show(self, state: State) -> None:
        with self.server.atomic():
            self._title.show(state.content.name, state.subject)
            self._modes.show(state)
            self._look.show()
            self._missing.show(state.content.missing)
            self._animation.show(_named(state), MOTION if state.coloring != "bodies" else None)
        self.scene.show(state)


def _named(state: State) -> Named:
    moving = state.moving
    if moving is None or not moving.modes:
        return Named(state.subject or state.content.name, 0.0, "at rest")
    mode = moving.modes[state.mode]
    return Named(f"{state.subject}", mode.frequency_hz, f"{mode.kind} {state.mode + 1}")


def inspect(
    content: Content,
    host: str,
    port: int,
    token: str | None,
    dark: bool,
    public_names: Sequence[str] = (),
) -> None:
    """Shows bodies until interrupted; arguments and errors as `viewer.app.serve`."""
    server = open_server(host, port, token, f"{content.name} · modeviz", public_names)
    try:
        InspectionApp(server, content, dark)
        print(f"{content.name} is at {server.link}  (Ctrl+C ends)", flush=True)
        threading.Event().wait()
    finally:
        server.stop()
