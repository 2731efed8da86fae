"""Right column: a body on its mounts, how pure its modes are, and its axes and centres."""

from collections.abc import Mapping
from typing import Any, get_args

import viser

from modeviz.report.rigid import listed_modes
from modeviz.text.wording import sentence_case, told_apart
from modeviz.vehicle.absorbers import carrying_bodies
from modeviz.vehicle.decoupling import Axes
from modeviz.viewer.page.binding import Binding, Read, Write, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import HiddenButtons, block
from modeviz.viewer.panels.rigid.axes import axes_content
from modeviz.viewer.panels.rigid.heat_map import heat_map, verdicts
from modeviz.viewer.panels.rigid.targets import TargetsEditor
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.commands.looks import LookAtRigid, ShowMode
from modeviz.viewer.session.rigid_look import Crank, Support
from modeviz.viewer.session.session import Session

N_ROWS = 40
AXES: dict[str, Axes] = {sentence_case(axes): axes for axes in get_args(Axes)}
CRANKS: dict[str, Crank] = {
    "Its own": "own",
    "Fore-aft, x": "x",
    "Lateral, y": "y",
    "Vertical, z": "z",
}
SUPPORTS: dict[str, Support] = {"Other ends still": "held", "As mounted": "mounted"}


class RigidPanel:
    """Chooses a body and axes; a heat map of its energy, verdicts, axes and centres, and targets."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds the controls; `show` fills the tables."""
        self._gui, self._session = gui, session
        self._modes: list[int] = []
        self._last: Solved | None = None
        self._bindings = [
            self._choice(
                "Body",
                told_apart(carrying_bodies(session.vehicle)),
                lambda state: state.rigid.body,
                lambda body: session.do(LookAtRigid(body=body)),
                "The body whose motion is told, of a flexible one that of its rigid part",
            ),
            self._choice(
                "Axes",
                AXES,
                lambda state: state.rigid.axes,
                lambda axes: session.do(LookAtRigid(axes=axes)),
                "Along which energy is told: the vehicle's, those of the body's inertia, or the "
                "vehicle's turned so that one lies along the crank, or the torque",
            ),
            self._choice(
                "Torque about",
                CRANKS,
                lambda state: state.rigid.crank,
                lambda crank: session.do(LookAtRigid(crank=crank)),
                "The direction of the torque: its own is the crank that the body says, or else of x "
                "and y the one about which its moment of inertia is smaller; or another axis",
            ),
        ]
        self._buttons = HiddenButtons(gui, N_ROWS, self._select)
        self._energy = gui.add_html("")
        box = gui.add_checkbox(
            "Draw axes",
            session.state.rigid.drawn,
            hint="Draws torque roll axis, elastic torque axis, elastic centre and focus in the scene",
        )
        self._bindings += [
            Binding(
                box,
                session,
                lambda state: state.rigid.drawn,
                lambda drawn: session.do(LookAtRigid(drawn=drawn)),
            ),
            self._choice(
                "Drawn",
                SUPPORTS,
                lambda state: state.rigid.support,
                lambda support: session.do(LookAtRigid(support=support)),
                "Which elastic axes: with the other ends of the mounts held still, or on all that is "
                "elastic, down to the ground",
            ),
        ]
        self._axes = gui.add_html("")
        self._targets = TargetsEditor(gui, session)

    def show(self, solved: Solved) -> None:
        """Draws the tables of an answer."""
        show_all(self._bindings)
        self._last, self._modes = solved, listed_modes(solved.purity)[:N_ROWS]
        content = heat_map(solved, self._modes, self._buttons) + verdicts(solved.purity)
        assign(self._energy, content=block(content))
        assign(self._axes, content=block(axes_content(solved)))
        self._targets.show()

    def _select(self, i: int) -> None:
        if self._last is not None and i < len(self._modes):  # else a shorter list came in between
            now = self._last.now
            self._session.do(ShowMode(now.names[self._modes[i]].name, now.rates))

    def _choice(
        self, label: str, choices: Mapping[str, Any], read: Read, write: Write, hint: str
    ) -> Binding:
        """A dropdown for one field of the state, whose values are `choices` by what they are called."""
        words = {value: word for word, value in choices.items()}
        first = words[read(self._session.state)]
        return Binding(
            self._gui.add_dropdown(label, tuple(choices), initial_value=first, hint=hint),
            self._session,
            lambda state: words[read(state)],
            lambda word: write(choices[word]),
        )
