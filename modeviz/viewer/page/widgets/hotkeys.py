"""The keys of the page, in one list, so that the guide can show them."""

from collections.abc import Callable
from dataclasses import dataclass

import viser
from viser._messages import HotkeyKey, KeyModifier

from modeviz.viewer.page.people.looking import let_all_use
from modeviz.viewer.page.widgets import scripts

SPOKEN = {"space": "Space", "cmd/ctrl": "Ctrl", "shift": "Shift"}
"""Keys as the guide writes them."""


@dataclass(frozen=True)
class Hotkey:
    """A key and what it does."""

    keys: tuple[str, ...]
    """To be held together, as people call them: "Ctrl", "Z"."""
    label: str


class Hotkeys:
    """Keys for every page. While somebody types in a box, or behind an open window, they do nothing.

    viser's own camera has W, A, S, D, Q, E and the arrows.
    """

    def __init__(self, gui: viser.GuiApi) -> None:
        """Starts without any."""
        self._gui = gui
        self._listed: list[Hotkey] = []
        scripts.run(gui, "page/browser/keys.js")

    @property
    def listed(self) -> tuple[Hotkey, ...]:
        """All there are, in the order they were added."""
        return tuple(self._listed)

    def add(
        self,
        label: str,
        key: HotkeyKey,
        press: Callable[[viser.CommandEvent], None],
        modifier: KeyModifier | None = None,
        is_for_all: bool = False,
    ) -> None:
        """Gives a key something to do; it is in viser's command palette too.

        Args:
            label: what it does, in sentence case.
            key: such as "N", "1" or "space".
            press: called with the event, which has the page as `client`.
            modifier: such as "cmd/ctrl" or "cmd/ctrl+shift", to be held as well.
            is_for_all: whether pages without control may press it.
        """
        command = self._gui.add_command(label, hotkey=key, modifier=modifier)
        command.on_trigger(press)
        if is_for_all:
            let_all_use(command)
        held = modifier.split("+") if modifier else []
        self._listed.append(Hotkey(tuple(SPOKEN.get(k, k) for k in (*held, key)), label))
