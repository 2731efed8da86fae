"""What is asked for in a session: its newest state, what led there, and by whom."""

import threading
from collections.abc import Callable, Sequence

from modeviz.vehicle.placement import check_placements
from modeviz.viewer.session.author import Author, NotOnesOwnError
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.design import Design
from modeviz.viewer.session.history import Accepted, History, Moment, Step
from modeviz.viewer.session.parts import Parts
from modeviz.viewer.session.state import State


class Asked:
    """Accepts changes, each in the thread that makes it, and tells who watches."""

    def __init__(
        self,
        state: State,
        parts: Parts,
        acting: Callable[[], Author],
        past: Sequence[Step],
        future: Sequence[Step],
    ) -> None:
        """Starts with a state.

        Args:
            state: the first one.
            parts: of its vehicle.
            acting: says who asks for what is done, in the thread in which it is.
            past: what can be undone, the next one last.
            future: what can be redone, the next one last.
        """
        self._parts, self._acting = parts, acting
        self._lock = threading.Lock()
        self._history = History(state, self._settled, past, future)
        self._watchers: list[Callable[[Accepted], None]] = []
        self.is_refused: bool = False
        """Whether what was asked for last was taken back, as it could not be answered."""

    @property
    def state(self) -> State:
        """The newest one."""
        return self._history.state

    @property
    def moment(self) -> Moment:
        """The newest state with what led there."""
        with self._lock:
            return self._history.moment

    @property
    def can_undo(self) -> bool:
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        return self._history.can_redo

    def watch(self, watcher: Callable[[Accepted], None]) -> None:
        """Has somebody told of all that is accepted from now on, before anything else is."""
        with self._lock:
            self._watchers.append(watcher)

    def do(self, command: Command) -> None:
        """Goes on to what a command makes of the newest state.

        Raises:
            VehicleError: it asks for what the vehicle does not have.
        """
        with self._lock:
            self.is_refused = False
            before = self.state
            state = command.apply(before, self._parts.of(before))
            if state.design.alterations != before.design.alterations:
                vehicle = self._parts.of(state)
                check_placements(vehicle, state.design.alterations.placements)
                state = state.with_known_parts(before.design, vehicle)
            self._tell(self._history.put(state, command.step, command.within, self._acting()))

    def undo(self, insists: bool) -> bool:
        """Goes back over the last change; whether there was one. See `Session.undo`."""
        with self._lock:
            return self._go(self._history.undone_next, self._history.undo, insists)

    def redo(self, insists: bool) -> bool:
        """Takes the last undoing back; whether there was one."""
        with self._lock:
            return self._go(self._history.redone_next, self._history.redo, insists)

    def take_back(self, state: State, good: Moment | None) -> bool:
        """Goes on as if a state had not been asked for, unless something else is by now.

        Args:
            state: what could not be answered.
            good: the last moment that was; None: the last change is undone.

        Returns:
            Whether it went back.
        """
        with self._lock:
            self.is_refused = self.state is state and self._go_back(good)
            return self.is_refused

    def _go_back(self, good: Moment | None) -> bool:
        if good is None:
            undone = self._history.undo()
            accepted = (undone,) if undone else ()
        else:
            accepted = self._history.put_back(good) if good.state is not self.state else ()
        self._tell(*accepted)
        return bool(accepted)

    def _go(self, change: Step | None, step: Callable[[], Accepted | None], insists: bool) -> bool:
        """Goes over a change, if there is one and it is one's own; whether it did."""
        acting = self._acting()
        is_own = change is None or change.author == acting
        if change is not None and not is_own and not (insists and acting.is_owner):
            raise NotOnesOwnError(change.author, acting)
        self.is_refused = False
        accepted = step()
        if accepted:
            self._tell(accepted)
        return accepted is not None

    def _tell(self, *accepted: Accepted) -> None:
        for each in accepted:
            for watcher in self._watchers:
                watcher(each)

    def _settled(self, before: Design, state: State) -> State:
        return state.with_known_parts(before, self._parts.of(state))
