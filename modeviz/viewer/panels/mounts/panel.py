"""The whole of the mounts: their unit, and a folder for each group."""

import viser

from modeviz.vehicle.mount_rates import RATE_FIELDS
from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.html import HiddenButtons
from modeviz.viewer.panels.mounts.details import LOCK, N_BUTTONS, RESET
from modeviz.viewer.panels.mounts.effects import Effects, effects
from modeviz.viewer.panels.mounts.folder import GroupFolder
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.decisions import ResetGroups, ResetRate, ToggleLock
from modeviz.viewer.session.commands.looks import ChooseUnit
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import compared_rates

UNITS = ("N/mm", "N/cm")


class MountsPanel:
    """The sliders and boxes of all mount rates."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls of all mount groups."""
        self._session = session
        self._effects: Effects = {}
        self._unit = self._add_unit(gui)
        buttons = HiddenButtons(gui, N_BUTTONS, self._press)
        groups = session.vehicle.mount_groups
        self._folders = [GroupFolder(gui, session, group, buttons) for group in groups]

    def show(self, solved: Solved) -> None:
        """Brings controls after the state, and what is for reading after an answer."""
        self._unit.show()
        for folder in self._folders:
            folder.follow()
        if solved.is_detailed:
            self._show_details(solved)

    def _show_details(self, solved: Solved) -> None:
        sensitivity = solved.findings.sensitivity
        if sensitivity is not None:
            self._effects = effects(self._session.vehicle, sensitivity, solved.followed.mode)
        elif solved.findings.problem:
            self._effects = {}
        compared = compared_rates(self._session.vehicle, solved.state)
        for folder in self._folders:
            folder.show(solved, compared, self._effects, is_old=sensitivity is None)

    def _add_unit(self, gui: viser.GuiApi) -> Binding:
        session = self._session
        unit = gui.add_dropdown(
            "Rates in", UNITS, initial_value=session.state.unit, hint="The unit of all mount rates"
        )
        return Binding(unit, session, lambda s: s.unit, lambda value: session.do(ChooseUnit(value)))

    def _press(self, button: int) -> None:
        """Does what a sign in the table of the selected group says."""
        group = self._session.state.group
        if button in LOCK:
            self._session.do(ToggleLock(group, RATE_FIELDS[button - LOCK.start]))
        elif button in RESET:
            self._session.do(ResetRate(group, RATE_FIELDS[button - RESET.start]))
        else:
            self._session.do(ResetGroups((group,)))
