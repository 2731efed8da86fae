"""Small pictures in the table of the selected mount group that lock its rates and take them back."""

from html import escape

import viser

from modeviz.vehicle.mount_rates import RATE_FIELDS
from modeviz.viewer.page.widgets.html import HiddenButtons, span
from modeviz.viewer.session.commands.decisions import ResetGroups, ResetRate, ToggleLock
from modeviz.viewer.session.session import Session

PADLOCK = (
    '<svg viewBox="0 0 12 12" width="12" height="12"><path fill="none" stroke="currentColor" '
    'stroke-width="1.2" d="{shackle}"/><rect x="2" y="5.6" width="8" height="5.4" rx="1" '
    'fill="currentColor"/></svg>'
)
OPEN = PADLOCK.format(shackle="M3.8 5.6V3.6a2.2 2.2 0 0 1 4.2-.9")
CLOSED = PADLOCK.format(shackle="M3.8 5.6V3.6a2.2 2.2 0 0 1 4.4 0v2")
BACK = (
    '<svg viewBox="0 0 12 12" width="12" height="12"><path fill="none" stroke="currentColor" '
    'stroke-width="1.3" d="M2.2 6a3.9 3.9 0 1 0 1.3-2.9"/><path fill="currentColor" '
    'd="M1.4 1.2l.4 3.5 3.2-1.4z"/></svg>'
)

N_RATES = len(RATE_FIELDS)


class Signs:
    """A lock and a way back for each rate of the selected group, and a way back for all of them."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Makes as many buttons as a group needs of which every rate is tuned."""
        self._session = session
        self._buttons = HiddenButtons(gui, 2 * N_RATES + 1, self._press)

    def lock(self, i: int, is_locked: bool) -> str:
        """Return what locks rate `i` of the selected group, or lets it move again."""
        if is_locked:
            return self._sign(i, CLOSED, "Locked: let it move again")
        return span(self._sign(i, OPEN, "Lock: only loading a set moves it then"), "dim")

    def reset(self, i: int, against: str) -> str:
        """Return what sets rate `i` of the selected group back to a set."""
        return self._sign(N_RATES + i, BACK, f"Back to {against}")

    def reset_group(self, against: str) -> str:
        """Return what sets all rates of the selected group back to a set."""
        return self._sign(2 * N_RATES, BACK, f"Group back to {against}")

    def _sign(self, button: int, picture: str, meaning: str) -> str:
        """A picture that presses a button."""
        return self._buttons.label(button, f'<span title="{escape(meaning)}">{picture}</span>')

    def _press(self, button: int) -> None:
        name = self._session.state.group
        action, i = divmod(button, N_RATES)
        fields = self._session.vehicle.mount_group(name).fields
        if action == 2:
            self._session.do(ResetGroups((name,)))
        elif i < len(fields):  # another group may have been selected between the click and here
            self._session.do((ToggleLock, ResetRate)[action](name, fields[i]))
