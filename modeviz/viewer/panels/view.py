"""Left column: how the vehicle is looked at."""

from collections.abc import Callable, Mapping
from typing import Any, get_args

import viser

from modeviz.text.wording import sentence_case
from modeviz.vehicle.bodies import Body
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import Coloring

VIEWS = ("Iso", "Side", "Front", "Top", "Under")
COLORINGS = {sentence_case(name): name for name in get_args(Coloring)}
GHOSTS = {"None": "none", "At rest": "rest", "Compared set": "compared"}


class ViewPanel:
    """Camera presets, colours, outlines, which bodies are drawn, the error of the classic method."""

    def __init__(
        self, gui: viser.GuiApi, session: Session, look: Callable[[viser.ClientHandle, str], None]
    ) -> None:
        """Builds the controls.

        Args:
            gui: where.
            session: what the choices change.
            look: turns a page's camera to one of `VIEWS`.
        """
        self._gui, self._session = gui, session
        views = gui.add_button_group("View", VIEWS, hint="Where to look from")

        @views.on_click
        def _(event: viser.GuiEvent) -> None:
            if event.client is not None:
                look(event.client, views.value)

        self._bindings = [
            self._choice(
                "Colours",
                COLORINGS,
                "coloring",
                lambda coloring: session.change(coloring=coloring),
                "What the colours of the bodies mean",
            ),
            self._choice(
                "Outlines",
                GHOSTS,
                "ghost",
                lambda ghost: session.update(lambda state: state.with_ghost(ghost)),
                "Drawn beside the bodies: the vehicle at rest, or moving as with the set of rates that "
                "all is compared with",
            ),
            self._switch(
                "See through", "see_through", "Shows what is behind sheet metal in its own colours"
            ),
            self._switch("Follow", "follow", "The camera looks at the selected mounts"),
            self._switch(
                "Classic error",
                "classic",
                "How far the paper's equation, on the original modes alone, is off; said at the foot",
            ),
        ]
        drawn = [body for body in session.vehicle.bodies if body.mesh]
        with gui.add_folder("Bodies", expand_by_default=False):
            self._bindings += [self._body(body) for body in drawn]

    def show(self) -> None:
        """Brings the controls after the newest state."""
        show_all(self._bindings)

    def _choice(
        self,
        label: str,
        choices: Mapping[str, Any],
        field: str,
        write: Callable[[Any], None],
        hint: str,
    ) -> Binding:
        """A dropdown for one field of the state, whose values are `choices` by what they are called."""
        words = {value: word for word, value in choices.items()}
        value = getattr(self._session.state, field)
        return Binding(
            self._gui.add_dropdown(label, tuple(choices), initial_value=words[value], hint=hint),
            self._session,
            lambda state: words[getattr(state, field)],
            lambda word: write(choices[word]),
        )

    def _switch(self, label: str, field: str, hint: str) -> Binding:
        """A checkbox for one field of the state."""
        return Binding(
            self._gui.add_checkbox(label, getattr(self._session.state, field), hint=hint),
            self._session,
            lambda state: getattr(state, field),
            lambda value: self._session.change(**{field: value}),
        )

    def _body(self, body: Body) -> Binding:
        """A checkbox for whether a body is drawn."""
        return Binding(
            self._gui.add_checkbox(sentence_case(body.label), True, hint=f"Draws the {body.label}"),
            self._session,
            lambda state: body.name not in state.hidden,
            lambda drawn: self._session.show_body(body.name, drawn),
        )
