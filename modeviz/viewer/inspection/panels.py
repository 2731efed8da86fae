"""The panels of the page of bodies: which of them moves and in which mode, how it is looked at."""

import math
from collections.abc import Callable, Sequence
from html import escape
from typing import get_args

import viser

from modeviz.text.wording import sentence_case
from modeviz.viewer.inspection.state import Coloring, Inspection, State
from modeviz.viewer.inspection.subject import ListedMode, Subject
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import (
    HiddenButtons,
    block,
    heading,
    hinted,
    named,
    row,
    span,
    table,
)
from modeviz.viewer.scene.cameras import add_view_buttons

N_ROWS = 40
"""Modes that are listed at once, the chosen one among them."""

COLORINGS = {sentence_case(name): name for name in get_args(Coloring)}
NOTHING = "Nothing to look at yet."


class ModesPanel:
    """The bodies, and the modes of the one that moves, whose rows show their mode when clicked."""

    def __init__(self, gui: viser.GuiApi, inspection: Inspection) -> None:
        """Builds the list; `show` fills it."""
        self._inspection = inspection
        self._first = 0
        self._subject: viser.GuiDropdownHandle[str] = gui.add_dropdown(
            "Body", [""], hint="Which of the bodies moves"
        )
        self._subject.on_update(self._choose)
        self._pages = gui.add_button_group("List", ("◀", "▶"), hint="Other modes than those listed")
        self._pages.on_click(lambda _: inspection.step(N_ROWS if self._pages.value == "▶" else -N_ROWS))
        self._buttons = HiddenButtons(gui, N_ROWS, lambda i: inspection.show_mode(self._first + i))
        self._content = gui.add_html("")

    def _choose(self, event: viser.GuiEvent) -> None:
        if event.client is not None:
            self._inspection.look_at(self._subject.value)

    def show(self, state: State) -> None:
        """Lists the modes of what moves in a state."""
        names = tuple(subject.name for subject in state.content.subjects)
        if names and tuple(self._subject.options) != names:
            self._subject.options = names
        moving = state.moving
        assign(self._subject, visible=len(names) > 1)
        assign(self._pages, visible=moving is not None and len(moving.modes) > N_ROWS)
        if moving is None:
            assign(self._content, content=block(span(NOTHING, "dim")))
            return
        if self._subject.value != moving.name:
            self._subject.value = moving.name
        self._first = N_ROWS * (state.mode // N_ROWS)
        about = "".join(f'<div class="dim">{escape(sentence)}</div>' for sentence in moving.about)
        assign(
            self._content, content=block(heading(named(moving.name)), about, self._table(state, moving))
        )

    def _table(self, state: State, moving: Subject) -> str:
        has_mass = any(math.isfinite(mode.modal_mass) for mode in moving.modes)
        listed = moving.modes[self._first : self._first + N_ROWS]
        if not listed:
            return ""
        rows = [
            row(self._cells(i, mode, has_mass), chosen=self._first + i == state.mode)
            for i, mode in enumerate(listed)
        ]
        header = (
            hinted("Mode", "Click a mode to see it move"),
            hinted("Hz", "Natural frequency"),
            hinted("ζ %", "Damping, percent of critical"),
            *([hinted("modal mass", "In the units of the file")] if has_mass else []),
        )
        return table(header, rows, "modes")

    def _cells(self, i: int, mode: ListedMode, has_mass: bool) -> list[str]:
        name = sentence_case(f"{mode.kind} {self._first + i + 1}")
        return [
            self._buttons.label(i, named(name)),
            _known(mode.frequency_hz, "{:.2f}"),
            _known(100 * mode.damping_ratio, "{:.1f}"),
            *([_known(mode.modal_mass, "{:.4g}")] if has_mass else []),
        ]


class LookPanel:
    """Camera presets, colours, outlines, attachments, and which bodies are drawn."""

    def __init__(
        self, gui: viser.GuiApi, inspection: Inspection, look: Callable[[viser.ClientHandle, str], None]
    ) -> None:
        """Builds the controls.

        Args:
            gui: where.
            inspection: what the choices change.
            look: turns a page's camera to one of `stage.VIEWS`.
        """
        add_view_buttons(gui, look)
        state = inspection.state
        words = {value: word for word, value in COLORINGS.items()}
        self._bindings = [
            Binding(
                gui.add_dropdown(
                    "Colours",
                    tuple(COLORINGS),
                    initial_value=words[state.coloring],
                    hint="What the colours mean",
                ),
                inspection,
                lambda state: words[state.coloring],
                lambda word: inspection.change(coloring=COLORINGS[word]),
            ),
            Binding(
                gui.add_checkbox("Outlines", state.outlines, hint="The moving body at rest"),
                inspection,
                lambda state: state.outlines,
                lambda on: inspection.change(outlines=on),
            ),
            Binding(
                gui.add_checkbox("Attachments", state.attachments, hint="Where others hold on"),
                inspection,
                lambda state: state.attachments,
                lambda on: inspection.change(attachments=on),
            ),
            Binding(
                gui.add_checkbox("Others", True, hint="The bodies that do not move, at rest"),
                inspection,
                lambda state: not state.alone,
                lambda on: inspection.change(alone=not on),
            ),
        ]

    def show(self) -> None:
        """Brings the controls after the newest state."""
        show_all(self._bindings)


class MissingPanel:
    """What cannot be computed yet, and what it takes."""

    def __init__(self, gui: viser.GuiApi) -> None:
        """Makes room."""
        self._content = gui.add_html("")

    def show(self, missing: Sequence[str]) -> None:
        """Lists it."""
        lines = "".join(f'<div class="note">{escape(sentence)}</div>' for sentence in missing)
        assign(self._content, content=block(heading("Next"), lines) if missing else "")


def _known(value: float, form: str) -> str:
    return form.format(value) if math.isfinite(value) else span("–", "dim")
