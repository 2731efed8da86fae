"""The row of buttons that go back: undo, redo and resets."""

from collections.abc import Callable
from functools import partial

import viser

from modeviz.errors import ModevizError
from modeviz.text.wording import sentence_case
from modeviz.vehicle.mount_rates import Rates
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.hotkeys import Hotkeys
from modeviz.viewer.page.widgets.question import ask
from modeviz.viewer.session.author import NotOnesOwnError
from modeviz.viewer.session.commands.decisions import ResetGroups
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State, compared_rates

UNDO, REDO, RESET_GROUP, RESET_ALL = "Undo", "Redo", "Reset group", "Reset all"


class HistoryRow:
    """Undo and redo of one's own changes, and rates back to the set compared with.

    Of somebody else's the owner of the session is asked whether he means to, others are told.
    """

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
        presses: dict[str, Callable[[viser.ClientHandle | None], None]] = {
            UNDO: lambda page: _go(session.undo, page),
            REDO: lambda page: _go(session.redo, page),
            RESET_GROUP: lambda _: session.do(ResetGroups((session.state.group,))),
            RESET_ALL: lambda _: session.do(ResetGroups(tuple(session.state.design.rates))),
        }
        self._buttons.on_click(lambda event: presses[self._buttons.value](event.client))
        hotkeys.add("Undo", "Z", lambda event: presses[UNDO](event.client), "cmd/ctrl")
        hotkeys.add("Redo", "Z", lambda event: presses[REDO](event.client), "cmd/ctrl+shift")

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


def _go(step: Callable[[bool], None], client: viser.ClientHandle | None) -> None:
    """Goes back or forward over one's own change, or asks or tells whose it is."""
    try:
        step(False)
    except NotOnesOwnError as refusal:
        if client is None:
            return
        if refusal.may_insist:
            name = refusal.author.name
            text = f"The change that this goes over is {name}'s."
            ask(client, f"A change of {name}", text, {"Go over it": partial(step, True)})
        else:
            client.add_notification("Not yours", f"{sentence_case(str(refusal))}.", color="orange")
    except ModevizError as error:
        if client is not None:
            refuse(client, str(error))
