"""The floating card: how what is shown moves, and what moves."""

from collections.abc import Callable
from functools import partial

import viser

from modeviz.viewer.page.widgets.layout import NARROW, WIDE
from modeviz.viewer.panels.animation import AnimationCard
from modeviz.viewer.panels.modes import step_mode
from modeviz.viewer.panels.shape import ShapePanel
from modeviz.viewer.scene.driver import ShapeDriver
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import color_scale
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.view import Animation

WIDTHS = {WIDE: 380, NARROW: 300}
"""Pixels; see `layout`."""


class MotionCard:
    """The tabs of the card."""

    def __init__(
        self,
        gui: viser.GuiApi,
        session: Session,
        driver: ShapeDriver,
        animation: Animation,
        changed: Callable[[], None],
    ) -> None:
        """Builds them.

        Args:
            gui: where.
            session: whose motion it is.
            driver: what moves the shapes.
            animation: how they move at first.
            changed: told that they move otherwise.
        """
        self.panel: viser.PanelHandle = gui.add_panel()
        with self.panel.add_tab("Motion", viser.Icon.PLAYER_PLAY):
            self.animation: AnimationCard = AnimationCard(
                gui, driver, partial(step_mode, session), animation, changed
            )
        with self.panel.add_tab("What moves", viser.Icon.WAVE_SINE):
            self.shape: ShapePanel = ShapePanel(gui, session)
        self.panel.float(x=24, y=-24)

    def show(self, solved: Solved) -> None:
        """Says what moves in an answer."""
        self.animation.show(solved.movement, color_scale(solved))
        self.shape.show(solved)
