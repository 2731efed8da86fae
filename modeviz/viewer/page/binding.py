"""Hears a widget and changes the part of the state that it shows; brings the widget after the state.

Whatever changes the state (another page, undo, a loaded set), `show` brings the widget after it. A
value that the page itself sent is not sent back while it moves.
"""

import threading
from collections.abc import Callable, Sequence
from functools import partial
from typing import Any, Generic, Protocol, TypeVar

import viser

from modeviz.errors import ModevizError
from modeviz.viewer.page.server import tell_mistake
from modeviz.viewer.page.widgets.alerts import refuse
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.session.state import State

Read = Callable[[State], Any]
Write = Callable[[Any], None]

S = TypeVar("S", covariant=True)


class HasState(Protocol[S]):
    """Whoever owns a state."""

    @property
    def state(self) -> S:
        """The newest one."""
        ...


class Binding(Generic[S]):
    """One widget bound to one value of a state."""

    def __init__(
        self,
        widget: viser.GuiInputHandle[Any],
        owner: HasState[S],
        read: Callable[[S], Any],
        write: Write,
        write_back: WriteBack | None = None,
        typed: bool = False,
    ) -> None:
        """Binds a widget that has been built with the present value.

        Args:
            widget: a slider, number, checkbox, dropdown or text.
            owner: of the state it shows.
            read: the widget's value of a state; the same value again for what the widget wrote.
            write: changes the state as a value of the widget asks; raises ModevizError to refuse one,
                which is told to the page that sent it.
            write_back: of a slider, whose last value a page may lose.
            typed: whether values are typed, so that only the last of them is meant; with `write_back`.
        """
        self._widget, self._owner, self._read, self._write = widget, owner, read, write
        self._known, self._options = widget.value, self._choices()
        self._write_back, self._typed = write_back, typed
        self._lock = threading.Lock()  # never held while the state is changed, which may show all
        self._n_taken = 0
        """How many values are being taken now."""
        widget.on_update(self._changed)

    def _changed(self, event: viser.GuiEvent) -> None:
        if event.client is None:  # set from here
            return
        if self._write_back and self._typed:
            self._write_back.touch(event.target, partial(self._take_later, event.client))
            return
        self._take(event.client)
        if self._write_back:
            self._write_back.touch(event.target)

    def _take_later(self, client: viser.ClientHandle) -> None:
        """Does so in a thread of nobody, who would not tell of our mistake."""
        try:
            self._take(client)
        except Exception as error:
            tell_mistake(client, error)

    def _take(self, client: viser.ClientHandle) -> None:
        """Changes the state as the widget asks, and gives it the value that came of it."""
        with self._lock:
            asked = self._widget.value
            self._n_taken += 1
        try:
            self._write(asked)
        except ModevizError as refusal:
            refuse(client, str(refusal), is_passing=True)
        finally:  # also of our mistake
            with self._lock:
                self._n_taken -= 1
                self._known = self._read(self._owner.state)
                if self._known != asked:  # else a newer value that is on its way here would be lost
                    self._widget.value = self._known

    def show(self) -> None:
        """Puts the newest state's value on the page, if the widget has another.

        What a page has just chosen, and `_take` has not seen yet, stays; what it sees just now, it
        shows.
        """
        with self._lock:
            if self._n_taken:
                return
            value, options = self._read(self._owner.state), self._choices()
            # of a dropdown whose options change viser itself chooses another
            shown = self._known if options == self._options else self._widget.value
            self._options = options
            if value != shown:
                self._known = value
                self._widget.value = value

    def _choices(self) -> tuple[str, ...]:
        """The options of a dropdown."""
        widget = self._widget
        return tuple(widget.options) if isinstance(widget, viser.GuiDropdownHandle) else ()


def show_all(bindings: Sequence[Binding[Any]]) -> None:
    """Brings widgets after the newest state."""
    for binding in bindings:
        binding.show()
