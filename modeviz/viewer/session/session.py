"""A tuning session: what is asked for, its history, and when it is answered. Nothing of the screen."""

import threading
import time
from collections.abc import Callable, Hashable
from dataclasses import replace
from typing import Any

from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Results
from modeviz.analysis.sensitivity import sensitivity
from modeviz.errors import ModevizError
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import DETAILS_EVERY, Answers, Rest, Solved, asks_for_the_same
from modeviz.viewer.session.history import MERGE_WITHIN, History
from modeviz.viewer.session.state import ORIGINAL, State, free_name, known_sets, next_name, rate_sets
from modeviz.viewer.session.worker import Worker

REST = 0.3
"""s without a change after which an answer is checked: longer than the pauses within a drag."""

TELL_EVERY = 0.5
"""s between two words on how far a check is."""


class Session:
    """Keeps the newest state and answers it, and checks what it answered when nothing changes.

    `show` is called in one thread, never twice at once.
    """

    def __init__(
        self,
        vehicle: Vehicle,
        state: State,
        show: Callable[[Solved], None],
        fail: Callable[[Exception], None],
        tell: Callable[[Solved], None] | None = None,
    ) -> None:
        """Nothing is solved before `start`.

        Args:
            vehicle: with the rates that are called the original ones.
            state: what to show first.
            show: draws an answer.
            fail: tells what went wrong; the last good answer stays.
            tell: told how far the check of an answer is that is drawn already; None: as `show`.
        """
        self.vehicle = vehicle
        self._show, self._tell = show, tell or show
        self._is_to_be_drawn = True
        self._lock = threading.Lock()
        self._history = History(state)
        self._answers = Answers(vehicle)
        self._is_prepared = self._is_closed = False
        self._last: Solved | None = None
        self._rest: Rest | None = None
        self._worker: Worker[State] = Worker(self._answer, fail)
        self._checker: Worker[Solved] = Worker(self._settle, fail)

    @property
    def state(self) -> State:
        return self._history.value

    @property
    def prepared(self) -> Prepared:
        """The vehicle made ready; there is none before `start`."""
        return self._answers.prepared

    @property
    def can_undo(self) -> bool:
        return self._history.can_undo

    @property
    def can_redo(self) -> bool:
        return self._history.can_redo

    def start(self, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, solves with its named sets of rates and asks for the first answer.

        Args:
            progress: told the fraction of the preparation that is done.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        self._answers.prepare(self.state, progress)
        with self._lock:
            self._is_prepared = True
            self._worker.submit(self.state)

    def change(self, kind: Hashable = None, **fields: Any) -> None:
        """Asks for a state that differs in some fields; returns at once.

        Args:
            kind: of a change that comes in many small steps, which are to be undone together.
            **fields: of `State`, with values that do not depend on it; else `update` is right.
        """
        self.update(lambda state: replace(state, **fields), kind)

    def update(
        self,
        change: Callable[[State], State],
        kind: Hashable = None,
        within: float = MERGE_WITHIN,
    ) -> None:
        """Asks for what `change` makes of the newest state, so that no other change is lost.

        Args:
            change: gives a changed state; called while nobody else changes it.
            kind: as of `change`.
            within: s, how closely changes of that kind have to follow to be undone together.
        """
        with self._lock:
            self._history.put(change(self.state), kind, within)
            self._submit()

    def set_rates(self, rates: Rates) -> None:
        """Asks for other rates in the groups that are named; locked ones stay."""
        self.update(lambda state: state.with_rates(rates))

    def set_rate(self, group: str, direction: str, rate: float) -> None:
        """Asks for another rate, N/m, in a field of `MountRates`, and selects its group."""
        kind = ("rate", group, direction)
        self.update(lambda state: state.with_rate(group, direction, rate), kind)

    def show_mode(self, name: str, rates: Rates | None = None, group: str | None = None) -> None:
        """Asks for another mode, to see it if something else moves, and for a mount group if given.

        Args:
            name: what it is called.
            rates: with which it is called so; the present ones if None.
            group: to be selected.
        """
        self.update(lambda state: state.with_mode(name, rates or state.rates, group))

    def show_body(self, name: str, drawn: bool) -> None:
        """Asks to draw a body, or not to."""

        def shown(state: State) -> State:
            hidden = state.hidden - {name} if drawn else state.hidden | {name}
            return replace(state, hidden=hidden)

        self.update(shown)

    def show_again(self) -> None:
        """Asks for the present state once more: something else is to be drawn with it."""
        with self._lock:
            self._submit()

    def undo(self) -> None:
        """Goes back to the state before the last change."""
        self._go(self._history.undo)

    def redo(self) -> None:
        """Takes the last undoing back."""
        self._go(self._history.redo)

    def pin(self, name: str) -> None:
        """Gives a name to the present rates and keeps them; a known set's stays its own.

        A pinned set of that name is replaced.
        """
        if name in known_sets(self.vehicle):
            return
        self.update(lambda state: state.with_variant(name, state.rates))

    def add(self, name: str, rates: Rates) -> str:
        """Pins other rates, and replaces no set that there is.

        Args:
            name: what to call them; where another set is called so, the first free of "name 2" ...
            rates: of the groups that differ from the vehicle's own.

        Returns:
            What they are called.

        Raises:
            VehicleError: a group that the vehicle does not have.
        """
        every = self.vehicle.all_rates(rates)
        chosen = name

        def added(state: State) -> State:
            nonlocal chosen
            sets = rate_sets(self.vehicle, state)
            if sets.get(name) == every:
                return state
            chosen = free_name(name, sets)
            return state.with_variant(chosen, every)

        self.update(added)
        return chosen

    def unpin(self, name: str) -> None:
        """Forgets a pinned set."""

        def forgotten(state: State) -> State:
            left = {n: variant for n, variant in state.variants.items() if n != name}
            against = state.against if state.against != name else ORIGINAL
            return replace(state, variants=left, against=against, overlaid=state.overlaid - {name})

        if name in self.state.variants:
            self.update(forgotten)

    def load(self, name: str) -> None:
        """Takes over the rates of a set, locked ones too; as the other methods, one that there is."""

        def loaded(state: State) -> State:
            rates = rate_sets(self.vehicle, state).get(name)
            return state if rates is None else replace(state, rates=dict(rates))

        self.update(loaded)

    def compare_with(self, name: str) -> None:
        """Compares all with another set."""

        def compared(state: State) -> State:
            known = name in rate_sets(self.vehicle, state)
            return replace(state, against=name) if known else state

        self.update(compared)

    def overlay(self, name: str, drawn: bool) -> None:
        """Draws a set in the charts too, or no longer."""

        def overlaid(state: State) -> State:
            known = name in rate_sets(self.vehicle, state)
            names = state.overlaid | {name} if known and drawn else state.overlaid - {name}
            return replace(state, overlaid=names)

        self.update(overlaid)

    def rename(self, name: str, new: str) -> None:
        """Calls a pinned set something else, unless another set is called so."""

        def renamed(state: State) -> State:
            if name not in state.variants or new in rate_sets(self.vehicle, state):
                return state
            variants = {new if n == name else n: variant for n, variant in state.variants.items()}
            overlaid = frozenset(new if n == name else n for n in state.overlaid)
            against = new if state.against == name else state.against
            return replace(state, variants=variants, overlaid=overlaid, against=against)

        self.update(renamed)

    def swap(self) -> None:
        """Changes places: the set compared with becomes the present one, and the other way round.

        Rates that have no name are pinned, so that there is a way back.
        """

        def swapped(state: State) -> State:
            sets = rate_sets(self.vehicle, state)
            own = next((n for n, rates in sets.items() if rates == state.rates), None)
            if own is None:
                own = next_name(state)
                state = state.with_variant(own, state.rates)
            return replace(state, rates=dict(sets[state.against]), against=own)

        self.update(swapped)

    def wait(self, timeout: float) -> bool:
        """Waits until the newest state is answered in detail; whether that came within `timeout` s."""
        end = time.perf_counter() + timeout
        while self._worker.wait(end - time.perf_counter()):
            last = self._last
            if last is None or last.is_detailed or not asks_for_the_same(last.state, self.state):
                return True
            time.sleep(DETAILS_EVERY / 10)
        return False

    def wait_checked(self, timeout: float) -> bool:
        """Waits until the newest answer is checked; whether that came within `timeout` seconds."""
        return self.wait(timeout) and self._checker.wait(timeout) and self._worker.wait(timeout)

    def close(self) -> None:
        """Ends the session's threads."""
        self._is_closed = True
        self._worker.close()
        self._checker.close()

    def _go(self, step: Callable[[], bool]) -> None:
        with self._lock:
            if step():
                self._submit()

    def _submit(self) -> None:
        """Has the newest state answered, once the vehicle is prepared."""
        self._is_to_be_drawn = True
        if self._is_prepared:
            self._worker.submit(self.state)

    def _answer(self, state: State) -> None:
        with self._lock:
            is_to_be_drawn, self._is_to_be_drawn = self._is_to_be_drawn, False
        solved = self._answers.answer(state, self._rest)
        self._last = solved
        (self._show if is_to_be_drawn else self._tell)(solved)
        with self._lock:
            if self._rest is None or self._rest.now is not solved.now:
                self._rest = solved.rest
            is_complete = self._rest.is_complete
        if not is_complete:
            self._checker.submit(solved)

    def _settle(self, solved: Solved) -> None:
        """Once nothing changes: shows details, makes the next drag cheap, checks bit by bit."""
        if not self._rests(solved, DETAILS_EVERY) or self._knows_all_of(solved.now):
            return
        if not solved.is_detailed:
            self._show_again(solved.now)
        if not self._rests(solved, REST):
            return
        try:
            self._find_out(solved)
        except ModevizError as error:
            self._show_again(solved.now, problem=str(error))

    def _find_out(self, solved: Solved) -> None:
        """Shows what its rates do and how exact an answer is, as long as it is current."""
        near = self._answers.rebase(solved.state)
        self._show_again(solved.now, sensitivity=sensitivity(near, solved.now))
        self._learn(solved.now, components=solved.now.prepared.components)
        told = 0.0
        for check in check_exactly(solved.now):
            if not self._is_current(solved):
                return
            if check.is_complete or time.perf_counter() - told > TELL_EVERY:
                told = time.perf_counter()
                self._learn(solved.now, check=check)

    def _knows_all_of(self, now: Results) -> bool:
        rest = self._rest
        return rest is not None and rest.now is now and rest.is_complete

    def _is_current(self, solved: Solved) -> bool:
        """Whether an answer is still to what is asked for."""
        return not self._is_closed and asks_for_the_same(self.state, solved.state)

    def _show_again(self, now: Results, **found: Any) -> None:
        """Has an answer shown again in detail, with what is now known of it."""
        with self._lock:
            self._is_to_be_drawn = True
        self._learn(now, **found)

    def _learn(self, now: Results, **found: Any) -> None:
        """Has it told what is now known of an answer."""
        with self._lock:
            if self._rest is not None and self._rest.now is now:
                self._rest = replace(self._rest, **found)
                self._worker.submit(self.state)

    def _rests(self, solved: Solved, seconds: float) -> bool:
        """Waits; whether nothing else was asked for meanwhile."""
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            if not self._is_current(solved):
                return False
            time.sleep(seconds / 10)
        return True
