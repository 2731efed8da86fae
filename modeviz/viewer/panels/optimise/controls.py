"""Widgets bound to the plan of a session."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from html import escape
from typing import Any, TypeVar

import viser

from modeviz.errors import VehicleError
from modeviz.viewer.page.binding import Binding, show_all
from modeviz.viewer.page.widgets.handles import assign
from modeviz.viewer.page.widgets.html import HiddenButtons, block, span
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.panels.mounts.rows import DECIMALS
from modeviz.viewer.session.commands.decisions import ChangePlan
from modeviz.viewer.session.planning.plan import Plan
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import State

Handle = TypeVar("Handle", bound=viser.GuiInputHandle)
Read = Callable[[State, Plan], Any]
Write = Callable[[Any], None]


class PlanControls:
    """Builds widgets, each for a value of the state and its plan, and brings them after it."""

    def __init__(self, gui: viser.GuiApi, session: Session) -> None:
        """Builds nothing.

        Args:
            gui: where.
            session: whose state has a plan.
        """
        self._gui, self._session = gui, session
        self._write_back = WriteBack()
        self._bindings: list[Binding] = []

    def show(self) -> None:
        """Brings all of them after the state."""
        show_all(self._bindings)

    def change(self, change: Callable[[State, Plan], Plan]) -> None:
        """Changes the plan."""
        self._session.do(ChangePlan(change))

    def put(self, **fields: Any) -> None:
        """Changes fields of the plan."""
        self.change(lambda _, plan: replace(plan, **fields))

    def choose(
        self, label: str, words: Mapping[str, Any], read: Read, write: Write, hint: str
    ) -> viser.GuiDropdownHandle[Any]:
        """A dropdown of values by what they are called."""
        called = {value: word for word, value in words.items()}
        first = called[self._now(read)]
        dropdown = self._gui.add_dropdown(label, tuple(words), initial_value=first, hint=hint)
        self.bind(dropdown, lambda s, p: called.get(read(s, p), first), lambda word: write(words[word]))
        return dropdown

    def check(self, label: str, read: Read, write: Write, hint: str) -> viser.GuiInputHandle[Any]:
        """A checkbox."""
        return self.bind(self._gui.add_checkbox(label, self._now(read), hint=hint), read, write)

    def number(
        self, label: str, limits: tuple[float, float | None], read: Read, write: Write, hint: str
    ) -> viser.GuiInputHandle[Any]:
        """A box for a number, a whole one if its limits are."""
        low, high = limits
        box = self._gui.add_number(label, self._now(read), min=low, max=high, step=1, hint=hint)
        if isinstance(low, float):
            assign(box, precision=DECIMALS)
        return self.bind(box, read, write, typed=True)

    def pair(self, label: str, read: Read, write: Write, hint: str) -> viser.GuiVector2Handle:
        """Two boxes in a row, for the least and the most."""
        boxes = self._gui.add_vector2(label, self._now(read), min=(0.0, 0.0), step=1.0, hint=hint)
        assign(boxes, precision=DECIMALS)
        return self.bind(boxes, read, write, typed=True)

    def text(self, label: str, read: Read, write: Write, hint: str) -> viser.GuiInputHandle[Any]:
        """A box for a text."""
        return self.bind(self._gui.add_text(label, self._now(read), hint=hint), read, write, typed=True)

    def bind(self, widget: Handle, read: Read, write: Write, typed: bool = False) -> Handle:
        """Binds a widget to a value."""

        def read_state(state: State) -> Any:
            return read(state, state.design.plan) if state.design.plan else widget.value

        write_back = self._write_back if typed else None
        self._bindings.append(Binding(widget, self._session, read_state, write, write_back, typed))
        return widget

    def _now(self, read: Read) -> Any:
        state = self._session.state
        assert state.design.plan is not None
        return read(state, state.design.plan)


class Pills:
    """A row of words that are clicked, each pressed or not."""

    def __init__(
        self, gui: viser.GuiApi, label: str, words: Sequence[str], press: Callable[[int], None]
    ) -> None:
        """Builds them.

        Args:
            gui: where.
            label: what they are.
            words: on the pills.
            press: told the number of the one clicked.
        """
        self._label, self._words = label, words
        self._buttons = HiddenButtons(gui, len(words), press)
        self._text = gui.add_html("")

    def name(self, words: Sequence[str]) -> None:
        """Gives them other words, of as many pills as there are."""
        self._words = words
        self._buttons.reach(len(words))

    def show(self, pressed: Sequence[bool | None], hints: Sequence[str]) -> None:
        """Draws them, pressed or not, with what they mean; those are left out that are neither."""
        pills = []
        for i, (word, on, hint) in enumerate(zip(self._words, pressed, hints, strict=True)):
            if on is None:
                continue
            text = f'<span title="{escape(hint)}">{escape(word)}</span>'
            state = " on" if on else ""
            pills.append(f'<div class="pill{state}">{self._buttons.label(i, text)}</div>')
        line = f'<span class="dim">{self._label}</span>{"".join(pills)}'
        assign(self._text, content=block(f'<div class="pills">{line}</div>'))


def may_change_hint(may_change: bool) -> str:
    """Return a hint on what a click does to a rate or a group of them."""
    return "may change; click to hold" if may_change else "held; click to free"


def complaint(make: Callable[[], object]) -> str:
    """Page text on why something cannot be made; nothing if it can."""
    try:
        make()
    except VehicleError as error:
        return block(span(escape(str(error)), "bad"))
    return ""
