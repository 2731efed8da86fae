"""What is looked at and how, and whoever owns that."""

import threading
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

from modeviz.viewer.inspection.subject import Subject

Coloring = Literal["bodies", "displacement"]


@dataclass(frozen=True, eq=False)
class Content:
    """What there is to look at."""

    name: str
    """Of the folder or the files."""
    subjects: tuple[Subject, ...]
    missing: tuple[str, ...] = ()
    """What cannot be computed yet and what it takes, a sentence each."""


@dataclass(frozen=True, eq=False)
class State:
    """What is looked at, and how."""

    content: Content
    subject: str = ""
    """Name of the one that moves; "" if there is none."""
    mode: int = 0
    """Its mode, from 0."""
    coloring: Coloring = "displacement"
    outlines: bool = True
    attachments: bool = True
    alone: bool = False
    """Whether only what moves is drawn."""

    @property
    def moving(self) -> Subject | None:
        """The subject that moves."""
        return next((s for s in self.content.subjects if s.name == self.subject), None)


def first_state(content: Content) -> State:
    """Return the state that a page opens with: the first subject that has modes, in its first."""
    with_modes = [s for s in content.subjects if s.modes] or list(content.subjects)
    if not with_modes:
        return State(content)
    return State(content, with_modes[0].name, with_modes[0].first_shown)


class Inspection:
    """The one owner of the state of a page of bodies."""

    def __init__(self, content: Content, show: Callable[[State], None]) -> None:
        """Begins to look at something.

        Args:
            content: what there is.
            show: called with every new state, one at a time.
        """
        self._lock = threading.RLock()  # pages ask in several threads
        self._show = show
        self.state: State = first_state(content)

    def change(self, **values: Any) -> None:
        """Gives fields of the state other values, and shows it."""
        with self._lock:
            self.state = replace(self.state, **values)
            self._show(self.state)

    def look_at(self, subject: str) -> None:
        """Shows another subject in its first mode that is worth it."""
        with self._lock:
            found = next((s for s in self.state.content.subjects if s.name == subject), None)
            if found is not None:
                self.change(subject=subject, mode=found.first_shown)

    def show_mode(self, mode: int) -> None:
        """Shows a mode of what moves, from 0; one that it does not have is not shown."""
        with self._lock:
            moving = self.state.moving
            if moving is not None and 0 <= mode < len(moving.modes):
                self.change(mode=mode)

    def step(self, by: int) -> None:
        """Shows a mode further down the list."""
        with self._lock:
            moving = self.state.moving
            if moving is not None and moving.modes:
                self.change(mode=(self.state.mode + by) % len(moving.modes))

    def replace_content(self, content: Content, subject: str) -> None:
        """Shows something else, and of that one subject."""
        with self._lock:
            found = first_state(content)
            self.state = replace(self.state, content=content, subject=found.subject, mode=found.mode)
            self.look_at(subject)
            self._show(self.state)
