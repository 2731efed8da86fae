"""A mount group on the page: its rates, and its details while it is selected."""

from html import escape

import viser

from modeviz.report.rate_fields import sections
from modeviz.vehicle.absorber_names import mass_name
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import block, span
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.mounts.absorber_form import AbsorberDetails, GivenAbsorber
from modeviz.viewer.panels.mounts.details import Details
from modeviz.viewer.panels.mounts.effects import Effects, in_a_sentence
from modeviz.viewer.panels.mounts.rows import RateRow
from modeviz.viewer.panels.mounts.signs import Signs
from modeviz.viewer.scene.mount_looks import has_springs
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.session import Session


class GroupFolder:
    """The controls of one mount group."""

    def __init__(self, gui: viser.GuiApi, session: Session, group: MountGroup, signs: Signs) -> None:
        """Builds them; arguments as of `Details`."""
        self._group = group
        self._folder = gui.add_folder(group.title)
        with self._folder:
            # The style sheet and the script know the folder by this.
            gui.add_html(f'<div class="mv-rates" data-group="{escape(group.name)}"></div>')
            self._rows = self._add_rows(gui, session)
            self._details = Details(gui, session, group, signs)
            self._absorber = self._add_absorber(gui, session)
        of_rows = [binding for row in self._rows.values() for binding in row.bindings]
        of_absorber = self._absorber.bindings if self._absorber else ()
        self._bindings = [*of_rows, *self._details.bindings, *of_absorber]

    def _add_rows(self, gui: viser.GuiApi, session: Session) -> dict[str, RateRow]:
        """A row for each rate that is tuned; those about axes and those of dampers under a heading."""
        rows, write_back = {}, WriteBack()
        for kind, fields in sections(self._group.fields):
            if kind:
                gui.add_html(block(span(kind, "dim")))
            rows |= {f: RateRow(gui, session, self._group, f, write_back) for f in fields}
        return rows

    def _add_absorber(
        self, gui: viser.GuiApi, session: Session
    ) -> AbsorberDetails | GivenAbsorber | None:
        """What there is of an absorber, if the group is its spring."""
        if session.state.design.alterations.absorber(self._group.name) is not None:
            return AbsorberDetails(gui, session, self._group)
        return GivenAbsorber(gui) if _mass_on(session.vehicle, self._group) else None

    def hold(self, group: MountGroup) -> None:
        """Has the bounds of a group of its name and fields, if they are others."""
        if group.bounds != self._group.bounds:
            self._group = group
            for row in self._rows.values():
                row.hold(group)

    def remove(self) -> None:
        """Takes the folder out of the page."""
        self._folder.remove()

    def follow(self) -> None:
        """Brings the controls after the newest state."""
        show_all(self._bindings)

    def show(self, solved: Solved, compared: Rates, effects: Effects, is_old: bool) -> None:
        """Draws what is for reading.

        Args:
            solved: the answer.
            compared: the rates compared with.
            effects: of all rates, or of none as yet.
            is_old: whether the effects are those of rates that were.
        """
        name, state, mode = self._group.name, solved.state, solved.followed.name.spoken
        assign(self._folder, label=f"{self._group.title}  ·  {self._share(solved)}")
        for field, row in self._rows.items():
            effect = effects.get((name, field))
            row.show(state, compared, "" if effect is None else in_a_sentence(effect, mode))
        self._details.show(state, compared, effects, mode, is_old)
        if self._absorber and (mass := _mass_on(solved.now.prepared.vehicle, self._group)):
            self._absorber.show(mass, state.design.rates[name])

    def _share(self, solved: Solved) -> str:
        """Its part in the energy of the shown mode: of what springs hold or, without, dampers take."""
        name, mode = self._group.name, solved.followed.mode
        if any(map(has_springs, self._group.with_rates(solved.now.rates[name]).mounts)):
            return f"{100 * solved.strain[name]:.0f} % of strain energy"
        return f"{100 * solved.now.dissipated_shares(mode)[name]:.0f} % of lost energy"


def _mass_on(vehicle: Vehicle, group: MountGroup) -> float | None:
    """The mass of the absorber whose spring a group is, kg; None if it is of none."""
    name = mass_name(group.name)
    found = (b for b in vehicle.bodies if b.name == name and b.role == "absorber")
    return next((body.mass for body in found if isinstance(body, RigidBody)), None)
