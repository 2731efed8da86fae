"""A mount group on the page: its rates, and its details while it is selected."""

from html import escape

import viser

from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import RATE_FIELDS, Rates
from modeviz.viewer.page.binding import show_all
from modeviz.viewer.page.handles import assign
from modeviz.viewer.page.html import HiddenButtons
from modeviz.viewer.page.write_back import WriteBack
from modeviz.viewer.panels.mounts.details import Details
from modeviz.viewer.panels.mounts.effects import Effects, in_a_sentence
from modeviz.viewer.panels.mounts.rows import RateRow
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.session import Session


class GroupFolder:
    """The controls of one mount group."""

    def __init__(
        self, gui: viser.GuiApi, session: Session, group: MountGroup, buttons: HiddenButtons
    ) -> None:
        """Builds them; arguments as of `Details`."""
        self._group, write_back = group, WriteBack()
        self._folder = gui.add_folder(group.title)
        with self._folder:
            # The style sheet and the script know the folder by this.
            gui.add_html(f'<div class="mv-rates" data-group="{escape(group.name)}"></div>')
            self._rows = {
                field: RateRow(gui, session, group, field, write_back) for field in RATE_FIELDS
            }
            self._details = Details(gui, session, group, buttons)
        of_rows = [binding for row in self._rows.values() for binding in row.bindings]
        self._bindings = [*of_rows, *self._details.bindings]

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
        share = f"{100 * solved.strain[name]:.0f} % of strain energy"
        assign(self._folder, label=f"{self._group.title}  ·  {share}")
        for field, row in self._rows.items():
            effect = effects.get((name, field))
            row.show(state, compared, "" if effect is None else in_a_sentence(effect, mode))
        self._details.show(state, compared, effects, mode, is_old)
