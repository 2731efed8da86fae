"""The whole of the mounts: their units, and a folder for each group."""

import viser

from modeviz.analysis.sensitivity import Sensitivity
from modeviz.report.rate_fields import fields_of_groups, quantity
from modeviz.units import QuantityName
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.panels.mounts.absorber_form import AbsorberForm
from modeviz.viewer.panels.mounts.effects import Effects, effects
from modeviz.viewer.panels.mounts.folder import GroupFolder
from modeviz.viewer.panels.mounts.signs import Signs
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import ChooseUnit
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import compared_rates

UNITS: dict[QuantityName, tuple[str, tuple[str, ...], str]] = {
    "stiffness": ("Rates in", ("N/mm", "N/cm"), "The unit of all mount rates"),
    "rotational_stiffness": (
        "About axes in",
        ("N m/rad", "N m/deg"),
        "The unit of all rates about the axes of mounts",
    ),
    "damping": ("Damping in", ("N s/m", "N s/mm"), "The unit of the rates of all dampers"),
}
"""Of each quantity what its choice is called, what there is to choose, and its hint."""


class MountsPanel:
    """The sliders and boxes of all mount rates."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls of all mount groups."""
        self._session = session
        self._effects: Effects = {}
        self._drawn: Sensitivity | None = None
        """That of which the effects are shown."""
        self._gui = gui
        self._units = {of: self._add_unit(gui, of) for of in UNITS}
        self._signs = Signs(gui, session)
        self._part = gui.add_folder(None)
        self._folders: dict[str, GroupFolder] = {}
        self._hold(session.vehicle)
        self._form = AbsorberForm(gui, session)

    def show(self, solved: Solved) -> None:
        """Brings controls after the state, and what is for reading after an answer."""
        self._hold(solved.now.prepared.vehicle)
        show_all([binding for _, binding in self._units.values()])
        for folder in self._folders.values():
            folder.follow()
        if solved.is_detailed:
            self._show_details(solved)

    def show_effects(self, solved: Solved) -> None:
        """Shows what rates do, if that is known since the answer was drawn."""
        if solved.findings.sensitivity is not self._drawn:
            self._show_details(solved)

    def _hold(self, vehicle: Vehicle) -> None:
        """Has a folder for each mount group of a vehicle, and the units of their rates."""
        groups = {group.name: group for group in vehicle.mount_groups}
        for name in self._folders.keys() - groups.keys():
            self._folders.pop(name).remove()
        with self._part:
            self._folders |= {
                name: GroupFolder(self._gui, self._session, group, self._signs)
                for name, group in groups.items()
                if name not in self._folders
            }
        for name, group in groups.items():
            self._folders[name].hold(group)
        tuned = {quantity(field) for field in fields_of_groups(groups.values())}
        for of, (unit, _) in self._units.items():
            assign(unit, visible=of in tuned)

    def _show_details(self, solved: Solved) -> None:
        self._drawn = sensitivity = solved.findings.sensitivity
        if sensitivity is not None:
            self._effects = effects(self._session.vehicle, sensitivity, solved.followed.mode)
        elif solved.findings.problem:
            self._effects = {}
        compared = compared_rates(self._session.vehicle, solved.state)
        for folder in self._folders.values():
            folder.show(solved, compared, self._effects, is_old=sensitivity is None)
        self._form.show(solved)

    def _add_unit(
        self, gui: viser.GuiApi, of: QuantityName
    ) -> tuple[viser.GuiDropdownHandle[str], Binding]:
        session, (label, units, hint) = self._session, UNITS[of]
        unit = gui.add_dropdown(label, units, initial_value=session.state.units[of], hint=hint)
        return unit, Binding(
            unit, session, lambda s: s.units[of], lambda to: session.do(ChooseUnit(of, to))
        )
