"""The row of buttons that go back: undo, redo and resets."""

from collections.abc import Callable

import viser

from modeviz.vehicle.mount_rates import Rates
from modeviz.viewer.page.handles import assign
from modeviz.viewer.page.hotkeys import Hotkeys
from modeviz.viewer.session.commands.decisions import ResetGroups
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State, compared_rates

UNDO, REDO, RESET_GROUP, RESET_ALL = "Undo", "Redo", "Reset group", "Reset all"


class HistoryRow:
    """Undo and redo of everything, and rates back to the set compared with; Ctrl+Z, Ctrl+Shift+Z."""

    def __init__(self, gui: viser.GuiApi, session: Session, hotkeys: Hotkeys) -> None:
        """Builds the buttons and adds the hot keys."""
        self._session = session
        self._marker = gui.add_html("")
        self._buttons = gui.add_button_group(
            "History",
            (UNDO, REDO, RESET_GROUP, RESET_ALL),
            hint="One step back or forward (Ctrl+Z, Ctrl+Shift+Z); the selected group's rates, or all, "
            "back to the set compared with",
        )
        presses: dict[str, Callable[[], None]] = {
            UNDO: session.undo,
            REDO: session.redo,
            RESET_GROUP: lambda: session.do(ResetGroups((session.state.group,))),
            RESET_ALL: lambda: session.do(ResetGroups(tuple(session.state.design.rates))),
        }
        self._buttons.on_click(lambda _: presses[self._buttons.value]())
        hotkeys.add("Undo", "Z", lambda _: session.undo(), "cmd/ctrl")
        hotkeys.add("Redo", "Z", lambda _: session.redo(), "cmd/ctrl+shift")

    def show(self, state: State) -> None:
        """Dims what has nothing to do."""
        compared, group = compared_rates(self._session.vehicle, state), state.group
        idle = {
            "undo": not self._session.can_undo,
            "redo": not self._session.can_redo,
            "group": not group or self._is_as(compared, state, group),
            "all": all(self._is_as(compared, state, name) for name in state.design.rates),
        }
        words = " ".join(word for word, is_idle in idle.items() if is_idle)
        assign(self._marker, content=f'<div class="mv-history" data-idle="{words}"></div>')

    @staticmethod
    def _is_as(compared: Rates, state: State, group: str) -> bool:
        """Whether a group's rates are those compared with, or there are none to compare with."""
        own = state.design.rates[group]
        return compared.get(group, own) == own
