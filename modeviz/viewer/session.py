"""A tuning session: what was asked for, what was solved for it, and nothing of the screen."""

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Literal

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.naming import ModeName
from modeviz.dynamics.roles import unit_of_role
from modeviz.dynamics.tracking import STEP_MAC, Track
from modeviz.tuning.check import Check, ClassicError, check_exactly, classic_error
from modeviz.tuning.following import accept, follow_rates
from modeviz.tuning.preparation import Prepared, prepare
from modeviz.tuning.results import Conditions, Drive, Results, drive, solve_on
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.worker import Worker

FREE_HZ = 0.5
"""Below, something moves freely."""

REST = 0.3
"""s without a change after which an answer is checked: longer than the pauses within a drag."""

DETAILS_EVERY = 0.1
"""s between two looks at tables while rates move; curves, figures and shape follow every move."""

TELL_EVERY = 0.5
"""s between two words on how far a check is."""

Coloring = Literal["bodies", "displacement"]


@dataclass(frozen=True)
class State:
    """All that can be asked of a session."""

    rates: Rates
    conditions: Conditions
    mode: str
    """The name of the shown mode: it is followed by what moves, wherever that goes."""
    group: str
    """The selected mount group, or none: ""."""
    coloring: Coloring = "bodies"
    see_through: bool = True
    ghost: bool = True
    classic: bool = False
    """Whether the error of the classic method is shown beside."""


@dataclass(frozen=True, eq=False)
class Solved:
    """The answer to a state."""

    state: State
    base: Results
    """With the vehicle's own rates, on the same road."""
    now: Results
    track: Track
    """Where the modes of `base` went."""
    mode: int
    """The shown mode, an index of `now.modes`."""
    name: ModeName
    """What it is called, or was when what is for reading was drawn last."""
    shape: Floats
    """Of the shown mode, (n_dofs,), in phase with the one shown before."""
    seconds: float
    """What the solve took."""
    check: Check | None
    """How far `now` is from the exact answer, as far as that is known."""
    classic_error: ClassicError | None
    """How far the classic method is off, if that is asked for."""
    is_detailed: bool
    """Whether what is for reading is to be drawn too; else `track` is that of the last such answer."""

    @cached_property
    def strain(self) -> Mapping[str, float]:
        """Of the shown mode: each flexible body's and connection group's share of the strain energy."""
        return self.now.strain_shares(self.mode)


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
    ) -> None:
        """Nothing is solved before `start`.

        Args:
            vehicle: with the rates that all is compared with.
            state: what to show first.
            show: draws an answer.
            fail: tells what went wrong; the last good answer stays.
        """
        self.vehicle = vehicle
        self._show = show
        self._lock = threading.Lock()
        self._state = state
        self._prepared: Prepared
        self._near: Prepared
        self._drive: Drive
        self._base: Results
        self._is_prepared = self._is_closed = False
        self._last: Solved | None = None
        self._track: Track
        self._tracked: Results
        self._straight: Results | None = None
        self._detailed_at = -np.inf
        self._checked: Results | None = None
        self._check: Check | None = None
        self._worker: Worker[State] = Worker(self._answer, fail)
        self._checker: Worker[Solved] = Worker(self._settle, fail)

    @property
    def state(self) -> State:
        return self._state

    def start(self, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, solves with its own rates and asks for the first answer.

        Args:
            progress: told the fraction of the preparation that is done.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        conditions = self._state.conditions
        self._prepared = self._near = prepare(self.vehicle, progress=progress)
        self._drive = drive(self._near, conditions)
        self._base = self._tracked = solve_on(self._drive, {})
        self._track = accept(self._base)
        with self._lock:
            self._is_prepared = True
            self._worker.submit(self._state)

    def change(self, **fields: Any) -> None:
        """Asks for a state that differs in some fields; returns at once."""
        with self._lock:
            self._submit(replace(self._state, **fields))

    def set_rates(self, rates: Rates) -> None:
        """Asks for other rates in the groups that are named."""
        with self._lock:
            self._submit(replace(self._state, rates={**self._state.rates, **rates}))

    def set_rate(self, group: str, direction: str, rate: float) -> None:
        """Asks for another rate, N/m, in a field of `MountRates`, and selects its group."""
        with self._lock:
            changed = replace(self._state.rates[group], **{direction: rate})
            rates = {**self._state.rates, group: changed}
            self._submit(replace(self._state, rates=rates, group=group))

    def wait(self, timeout: float) -> bool:
        """Waits until the newest state is answered in detail; whether that came within `timeout` s."""
        end = time.perf_counter() + timeout
        while self._worker.wait(end - time.perf_counter()):
            last = self._last
            if last is None or last.is_detailed or not _asks_for_the_same(last.state, self._state):
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

    def _submit(self, state: State) -> None:
        """Keeps a state; it is answered once the vehicle is prepared."""
        self._state = state
        if self._is_prepared:
            self._worker.submit(state)

    def _answer(self, state: State) -> None:
        begin = time.perf_counter()
        base = self._solve_base(state.conditions)
        last = self._last
        if last and _asks_for_the_same(last.state, state):
            now = last.now
            self._straighten_track(base, now)
            mode = None
        else:
            now = solve_on(self._drive_on(state.conditions), state.rates)
            mode = self._recognised(now, state.mode, begin)
            self._detailed_at = begin if mode is None else self._detailed_at
        is_detailed = mode is None
        if is_detailed:
            mode = self._follow(now, state.mode)
            self._lead_track_to(now)
        name = now.names[mode] if is_detailed or last is None else last.name
        shape = self._in_phase(now.modes.shapes[:, mode])
        seconds = last.seconds if last and last.now is now else time.perf_counter() - begin
        check = self._check if self._checked is now else None
        classic = classic_error(now) if state.classic else None
        self._last = Solved(
            state, base, now, self._track, mode, name, shape, seconds, check, classic, is_detailed
        )
        self._show(self._last)
        with self._lock:
            is_unchecked = self._checked is not now
            if is_unchecked:
                self._checked, self._check = now, None
        if is_unchecked:
            self._checker.submit(self._last)

    def _solve_base(self, conditions: Conditions) -> Results:
        if self._base.conditions != conditions:
            self._base = solve_on(self._drive_on(conditions), {})
        return self._base

    def _drive_on(self, conditions: Conditions) -> Drive:
        found = self._drive  # the checker may put another in its place
        if found.conditions != conditions:
            self._drive = found = drive(self._near, conditions)
        return found

    def _lead_track_to(self, now: Results) -> None:
        """Follows the base's modes on from where they were last seen, or anew at the base's rates."""
        if now.rates == self._base.rates:
            self._straighten_track(self._base, now)
        elif now is not self._tracked:
            self._track = follow_rates(self._track, self._tracked, now)
            self._tracked = now

    def _straighten_track(self, base: Results, now: Results) -> None:
        """Follows the base's modes anew on the straight way, so that no detour of a slider counts."""
        if self._straight is not now:
            self._track = follow_rates(accept(base), base, now)
            self._tracked = self._straight = now

    def _settle(self, solved: Solved) -> None:
        """Once nothing changes: shows details, makes the next drag cheap, checks bit by bit."""
        if not self._rests(solved, DETAILS_EVERY):
            return
        if not solved.is_detailed:
            self._show_again(solved.now, None)
        if not self._rests(solved, REST):
            return
        self._near = self._prepared.near(solved.state.rates)
        self._drive = drive(self._near, solved.state.conditions)
        told = 0.0
        for check in check_exactly(solved.now):
            if not self._is_current(solved):
                return
            if check.is_complete or time.perf_counter() - told > TELL_EVERY:
                told = time.perf_counter()
                self._show_again(solved.now, check)

    def _is_current(self, solved: Solved) -> bool:
        """Whether an answer is still to what is asked for."""
        return not self._is_closed and _asks_for_the_same(self._state, solved.state)

    def _show_again(self, now: Results, check: Check | None) -> None:
        """Has an answer shown again in detail, with what is now known of it."""
        with self._lock:
            if self._checked is now:
                self._check = check
                self._worker.submit(self._state)

    def _rests(self, solved: Solved, seconds: float) -> bool:
        """Waits; whether nothing else was asked for meanwhile."""
        end = time.perf_counter() + seconds
        while time.perf_counter() < end:
            if not self._is_current(solved):
                return False
            time.sleep(seconds / 10)
        return True

    def _recognised(self, now: Results, name: str, begin: float) -> int | None:
        """The mode that clearly is the one shown last, while details need not be drawn; else None."""
        last = self._last
        is_due = begin - self._detailed_at >= DETAILS_EVERY
        if last is None or last.state.mode != name or is_due:
            return None
        mode, mac = _most_alike(now, last.shape)
        return mode if mac > STEP_MAC else None

    def _follow(self, now: Results, name: str) -> int:
        """The mode of that name, else the one most like the last shown, at first the slowest."""
        named = now.mode_index(name)
        if named is not None:
            return named
        if self._last is None:
            f = now.modes.frequency_hz
            return min(int(np.searchsorted(f, FREE_HZ)), len(f) - 1)
        return _most_alike(now, self._last.shape)[0]

    def _in_phase(self, shape: Floats) -> Floats:
        """The shape, turned so that it does not jump by half a cycle from the one before."""
        turned = self._last is not None and self._last.shape @ self._system.mass @ shape < 0
        return -shape if turned else shape

    @property
    def _system(self) -> System:
        return self._prepared.system


def _asks_for_the_same(one: State, other: State) -> bool:
    """Whether two states have the same answer and differ at most in what is shown of it."""
    return one.rates == other.rates and one.conditions == other.conditions


def _most_alike(now: Results, shape: Floats) -> tuple[int, float]:
    """The mode whose shape is most like another, and their MAC."""
    likeness = (now.modes.shapes.T @ now.prepared.system.mass @ shape) ** 2
    mode = int(likeness.argmax())
    return mode, float(likeness[mode])


def first_state(vehicle: Vehicle, rates: Rates, conditions: Conditions) -> State:
    """What a session opens with: the rates given and the yaw of the cabin on its mounts."""
    group = vehicle.mount_groups[0].name if vehicle.mount_groups else ""
    cabin = unit_of_role(vehicle, "cabin")
    return State(dict(rates), conditions, f"{cabin.word} yaw" if cabin else "", group)
