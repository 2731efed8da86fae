"""Buttons without a face for things that come and go: each thing has one of its own."""

import threading
from collections.abc import Callable, Collection, Hashable
from typing import Generic, TypeVar

import viser

from modeviz.errors import ModevizError
from modeviz.text.wording import sentence_case
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import assign, name_of
from modeviz.viewer.page.widgets.html import hidden

Name = TypeVar("Name", bound=Hashable)

FACELESS = "hidden"
"""What the buttons are called, which nobody sees."""


class NamedButtons(Generic[Name]):
    """As `HiddenButtons`, by what they are for in place of a number.

    The button of a thing that is gone presses nothing, whatever stands in its place: a click on one
    page can cross a change on another.
    """

    def __init__(self, gui: viser.GuiApi, press: Callable[[Name], None]) -> None:
        """Makes none yet.

        Args:
            gui: where.
            press: gets what the button that is pressed is for; a ModevizError is told on the page.
        """
        self._gui, self._press = gui, press
        self._lock = threading.Lock()
        self._buttons: dict[Name, viser.GuiButtonHandle] = {}
        self._part = gui.add_folder(None)
        with self._part:
            self._style = gui.add_html("")

    def keep(self, names: Collection[Name]) -> None:
        """Makes buttons for what is new, and takes away those of what is gone."""
        with self._lock:
            for name in self._buttons.keys() - set(names):
                self._buttons.pop(name).remove()
            for name in names:
                if name not in self._buttons:
                    self._buttons[name] = self._made(name)
            assign(self._style, content=hidden(map(name_of, self._buttons.values())))

    def label(self, name: Name, text: str) -> str:
        """Text that presses the button of what is kept."""
        return f'<label for="{name_of(self._buttons[name])}">{text}</label>'

    def __contains__(self, name: Name) -> bool:
        return name in self._buttons

    def _made(self, name: Name) -> viser.GuiButtonHandle:
        with self._part:
            button = self._gui.add_button(FACELESS)
        button.on_click(lambda event: self._heard(name, event.client))
        return button

    def _heard(self, name: Name, client: viser.ClientHandle | None) -> None:
        """Does what the button is for; says on the page what keeps it from being done."""
        try:
            self._press(name)
        except ModevizError as refusal:
            if client is not None:
                refuse(client, f"{sentence_case(str(refusal))}.")
