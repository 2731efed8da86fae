"""Left column: how the vehicle is looked at."""

from collections.abc import Callable, Mapping
from typing import Any, get_args

import viser

from modeviz.shapes.stand_in import drawn_mesh
from modeviz.text.wording import sentence_case
from modeviz.vehicle.bodies import Body
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.page.binding import Binding, Read, Write, show_all
from modeviz.viewer.panels.state_link import add_link_button
from modeviz.viewer.scene.cameras import add_view_buttons
from modeviz.viewer.session.commands.looks import ChangeLook, ShowBody, ShowClassicError, ShowGhost
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import Coloring
from modeviz.viewer.session.view import CameraPose

COLORINGS = {sentence_case(name): name for name in get_args(Coloring)}
GHOSTS = {"None": "none", "At rest": "rest", "Compared set": "compared"}


class ViewPanel:
    """Camera presets, colours, outlines, which bodies are drawn, the error of the classic method."""

    def __init__(
        self,
        gui: viser.GuiApi,
        session: Session,
        look: Callable[[viser.ClientHandle, str], None],
        link: Callable[[CameraPose], str],
    ) -> None:
        """Builds the controls.

        Args:
            gui: where.
            session: what the choices change.
            look: turns a page's camera to one of `stage.VIEWS`.
            link: gives the link to what is shown.
        """
        self._gui, self._session = gui, session
        add_view_buttons(gui, look)
        add_link_button(gui, link)
        self._bindings = [
            self._choice(
                "Colours",
                COLORINGS,
                lambda state: state.look.coloring,
                lambda coloring: session.do(ChangeLook(coloring=coloring)),
                "What the colours of the bodies mean",
            ),
            self._choice(
                "Outlines",
                GHOSTS,
                lambda state: state.look.ghost,
                lambda ghost: session.do(ShowGhost(ghost)),
                "Drawn beside the bodies: the vehicle at rest, or moving as with the set of rates that "
                "all is compared with",
            ),
            self._switch(
                "See through",
                lambda state: state.look.see_through,
                lambda on: session.do(ChangeLook(see_through=on)),
                "Shows what is behind sheet metal in its own colours",
            ),
            self._switch(
                "Follow",
                lambda state: state.look.follow,
                lambda on: session.do(ChangeLook(follow=on)),
                "The camera looks at the selected mounts",
            ),
            self._switch(
                "Classic error",
                lambda state: state.classic,
                lambda on: session.do(ShowClassicError(on)),
                "How far the paper's equation, on the original modes alone, is off; said at the foot",
            ),
        ]
        self._folder = gui.add_folder("Bodies", expand_by_default=False)
        self._bodies: dict[str, tuple[viser.GuiCheckboxHandle, Binding]] = {}
        self._hold(session.vehicle)

    def show(self) -> None:
        """Brings the controls after the newest state."""
        self._hold(self._session.vehicle)
        show_all([*self._bindings, *(binding for _, binding in self._bodies.values())])

    def _hold(self, vehicle: Vehicle) -> None:
        """Has a checkbox for each body of a vehicle that is drawn."""
        drawn = {body.name: body for body in vehicle.bodies if drawn_mesh(body)}
        for name in self._bodies.keys() - drawn.keys():
            box, _ = self._bodies.pop(name)
            box.remove()
        with self._folder:
            self._bodies |= {n: self._body(body) for n, body in drawn.items() if n not in self._bodies}

    def _choice(
        self,
        label: str,
        choices: Mapping[str, Any],
        read: Read,
        write: Write,
        hint: str,
    ) -> Binding:
        """A dropdown for one field of the state, whose values are `choices` by what they are called."""
        words = {value: word for word, value in choices.items()}
        value = read(self._session.state)
        return Binding(
            self._gui.add_dropdown(label, tuple(choices), initial_value=words[value], hint=hint),
            self._session,
            lambda state: words[read(state)],
            lambda word: write(choices[word]),
        )

    def _switch(self, label: str, read: Read, write: Write, hint: str) -> Binding:
        """A checkbox for one field of the state."""
        box = self._gui.add_checkbox(label, read(self._session.state), hint=hint)
        return Binding(box, self._session, read, write)

    def _body(self, body: Body) -> tuple[viser.GuiCheckboxHandle, Binding]:
        """A checkbox for whether a body is drawn."""
        box = self._gui.add_checkbox(sentence_case(body.label), True, hint=f"Draws the {body.label}")
        return box, Binding(
            box,
            self._session,
            lambda state: body.name not in state.look.hidden,
            lambda drawn: self._session.do(ShowBody(body.name, drawn)),
        )
