"""The floating card: the shown mode and how it moves. Nothing here solves anything."""

from collections.abc import Callable
from html import escape
from typing import Protocol

import numpy as np
import viser

from modeviz.text.wording import sentence_case
from modeviz.viewer.page.widgets import scripts
from modeviz.viewer.page.widgets.handles import assign, name_of
from modeviz.viewer.page.widgets.html import block, heading, title
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.color_scale import color_scale_text
from modeviz.viewer.scene.driver import ShapeDriver
from modeviz.viewer.session.coloring import ColorScale
from modeviz.viewer.session.view import (
    FASTEST_HZ,
    LARGEST_AMPLITUDE,
    WHOLE_TURN,
    Animation,
)

USUAL = Animation()
PLAY, PAUSE, PREVIOUS, NEXT = "Play", "Pause", "◀ Mode", "Mode ▶"


class Moving(Protocol):
    """What moves, as the card names it."""

    @property
    def title(self) -> str:
        """What it is called."""
        ...

    @property
    def frequency_hz(self) -> float:
        """At which it moves."""
        ...

    @property
    def about(self) -> str:
        """What else to know, short."""
        ...

    @property
    def problem(self) -> str:
        """Why this is not what was asked for; "" if it is."""
        ...

    @property
    def is_still(self) -> bool:
        """Whether it is no motion but a place."""
        ...


class AnimationCard:
    """Name and frequency of the shown mode, amplitude, speed, phase, play, previous and next."""

    def __init__(
        self,
        gui: viser.GuiApi,
        driver: ShapeDriver,
        step_mode: Callable[[int], None],
        animation: Animation = USUAL,
        changed: Callable[[], None] = lambda: None,
    ) -> None:
        """Builds the controls and sets the shapes in motion.

        Args:
            gui: where.
            driver: what moves the shapes.
            step_mode: shows the next mode (+1) or the one before (-1).
            animation: how they move at first.
            changed: told that they move otherwise.
        """
        self._driver, self._step_mode, self._changed = driver, step_mode, changed
        self._write_back = WriteBack()
        self._head = gui.add_html("")
        self._amplitude = gui.add_slider(
            "Amplitude",
            0.0,
            LARGEST_AMPLITUDE,
            0.05,
            animation.amplitude,
            marks=(USUAL.amplitude,),
            hint="How far the shape is drawn",
        )
        self._speed = gui.add_slider(
            "Speed",
            0.0,
            FASTEST_HZ,
            0.05,
            animation.speed_hz,
            marks=(USUAL.speed_hz,),
            hint="Cycles a second on screen",
        )
        self._phase = gui.add_slider(
            "Phase",
            0.0,
            WHOLE_TURN,
            5.0,
            animation.phase,
            marks=(90.0, 180.0, 270.0),
            hint="Stops at this phase, degrees",
        )
        self._stands = gui.add_number("Stands at", animation.phase, visible=False)
        self._transport = gui.add_button_group(
            "Motion", (PAUSE, PREVIOUS, NEXT), hint="Stop or go on; the mode before or after this one"
        )
        self._amplitude.on_update(lambda _: driver.drive(amplitude=self._amplitude.value))
        self._speed.on_update(lambda _: driver.drive(frequency_hz=self._speed.value))
        self._phase.on_update(self._hold)
        for slider in (self._amplitude, self._speed, self._phase):
            slider.on_update(lambda _: self._changed())
        self._stands.on_update(lambda _: self._say_phase())
        self._transport.on_click(lambda event: self._press(self._transport.value, event.client))
        driver.drive(amplitude=animation.amplitude, frequency_hz=animation.speed_hz)
        if not animation.is_running:
            driver.seek(np.deg2rad(animation.phase))
        self._ran_before_still: bool | None = None
        self._run(animation.is_running)

    @property
    def animation(self) -> Animation:
        """How what moves is drawn."""
        amplitude, speed_hz, phase = (s.value for s in (self._amplitude, self._speed, self._phase))
        is_running = self._is_running if self._ran_before_still is None else self._ran_before_still
        return Animation(amplitude, speed_hz, phase, is_running)

    def show(self, moving: Moving, scale: ColorScale | None) -> None:
        """Names what moves, and says what the colours of bodies mean, if they do."""
        hertz = f"  {moving.frequency_hz:.2f} Hz" if moving.frequency_hz > 0 else ""
        name = f'<span class="title">{title(moving.title)}{hertz}</span>'
        problem = f'<div class="bad">{_said(moving.problem)}</div>' if moving.problem else ""
        content = block(heading(name, escape(moving.about)), color_scale_text(scale), problem)
        assign(self._head, content=content)
        self._stand(moving.is_still)

    def _stand(self, is_still: bool) -> None:
        """Stands at the whole of a place while there is one, and then goes on as before."""
        if is_still and self._ran_before_still is None:
            self._ran_before_still = self._is_running
            self._run(False)
            assign(self._phase, value=0.0)
            self._driver.seek(0.0)
        elif not is_still and self._ran_before_still is not None:
            self._run(self._ran_before_still)
            self._ran_before_still = None

    def toggle(self, client: viser.ClientHandle | None) -> None:
        """Stops the motion for all pages where it is in one of them, or lets it go on."""
        self._run(not self._is_running)
        self._changed()
        if client is not None and not self._is_running:
            scripts.run(client.gui, "page/browser/tell_phase.js", name_of(self._stands))

    def _say_phase(self) -> None:
        """Takes over the phase at which a page stands, unless the motion has gone on meanwhile."""
        if not self._is_running:
            assign(self._phase, value=self._stands.value)
            self._changed()

    def _hold(self, event: viser.GuiEvent) -> None:
        if event.client is not None:  # its value may cross what `_say_phase` sends
            self._write_back.touch(event.target)
        self._run(False)
        self._driver.seek(np.deg2rad(self._phase.value))

    def _run(self, running: bool) -> None:
        self._driver.drive(running=running)
        self._is_running = running
        self._transport.options = (PAUSE if running else PLAY, PREVIOUS, NEXT)

    def _press(self, button: str, client: viser.ClientHandle | None) -> None:
        if button in (PREVIOUS, NEXT):
            self._step_mode(1 if button == NEXT else -1)
        elif (button == PLAY) != self._is_running:
            self.toggle(client)


def _said(problem: str) -> str:
    """Return why what was asked for does not move, and what to do."""
    return f"{escape(sentence_case(problem))}. This moved before: choose something else."
