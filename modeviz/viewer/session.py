"""A tuning session: what was asked for, what was solved for it, and nothing of the screen."""

import threading
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.roles import unit_of_role
from modeviz.tuning.results import Conditions, Results, solve
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.worker import Worker

FREE_HZ = 0.5
"""Below, something moves freely."""

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


@dataclass(frozen=True, eq=False)
class Solved:
    """The answer to a state."""

    state: State
    base: Results
    """With the vehicle's own rates, on the same road."""
    now: Results
    mode: int
    """The shown mode, an index of `now.modes`."""
    shape: Floats
    """Of the shown mode, (n_dofs,), in phase with the one shown before."""
    seconds: float
    """What the solve took."""


class Session:
    """Keeps the newest state and answers it; `show` is called in one thread, never twice at once."""

    def __init__(
        self,
        vehicle: Vehicle,
        state: State,
        show: Callable[[Solved], None],
        fail: Callable[[Exception], None],
    ) -> None:
        """Assembles the vehicle once; nothing is solved before `start`.

        Args:
            vehicle: with the rates that all is compared with.
            state: what to show first.
            show: draws an answer.
            fail: tells what went wrong; the last good answer stays.
        """
        self.vehicle = vehicle
        self._system = assemble(vehicle)
        self._show = show
        self._lock = threading.Lock()
        self._state = state
        self._base: Results | None = None
        self._last: Solved | None = None
        self._worker: Worker[State] = Worker(self._answer, fail)

    @property
    def state(self) -> State:
        return self._state

    def start(self) -> None:
        """Solves with the vehicle's own rates and asks for the first answer.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        self._solve_base(self._state.conditions)
        self._worker.submit(self._state)

    def change(self, **fields: Any) -> None:
        """Asks for a state that differs in some fields; returns at once."""
        with self._lock:
            self._state = replace(self._state, **fields)
            self._worker.submit(self._state)

    def set_rates(self, rates: Rates) -> None:
        """Asks for other rates in the groups that are named."""
        with self._lock:
            self._state = replace(self._state, rates={**self._state.rates, **rates})
            self._worker.submit(self._state)

    def set_rate(self, group: str, direction: str, rate: float) -> None:
        """Asks for another rate, N/m, in a field of `MountRates`, and selects its group."""
        with self._lock:
            changed = replace(self._state.rates[group], **{direction: rate})
            rates = {**self._state.rates, group: changed}
            self._state = replace(self._state, rates=rates, group=group)
            self._worker.submit(self._state)

    def wait(self, timeout: float) -> bool:
        """Waits until the newest state is answered; whether that came within `timeout` seconds."""
        return self._worker.wait(timeout)

    def close(self) -> None:
        """Ends the session's thread."""
        self._worker.close()

    def _answer(self, state: State) -> None:
        begin = time.perf_counter()
        base = self._solve_base(state.conditions)
        now, seconds = self._solve_now(state, base, begin)
        mode = self._follow(now, state.mode)
        shape = self._in_phase(now, now.modes.shapes[:, mode])
        self._last = Solved(state, base, now, mode, shape, seconds)
        self._show(self._last)

    def _solve_base(self, conditions: Conditions) -> Results:
        if self._base is None or self._base.conditions != conditions:
            self._base = solve(self._system, {}, conditions)
        return self._base

    def _solve_now(self, state: State, base: Results, begin: float) -> tuple[Results, float]:
        """The answer for the state's rates, solved only if they or the road are new."""
        if state.rates == self.vehicle.rates:
            return base, time.perf_counter() - begin
        last = self._last
        if last and (last.state.rates, last.state.conditions) == (state.rates, state.conditions):
            return last.now, last.seconds
        now = solve(self._system, state.rates, state.conditions)
        return now, time.perf_counter() - begin

    def _follow(self, now: Results, name: str) -> int:
        """The mode of that name, else the one most like the last shown, at first the slowest."""
        named = now.mode_index(name)
        if named is not None:
            return named
        if self._last is None:
            return min(int(np.searchsorted(now.modes.frequency_hz, FREE_HZ)), len(now.names) - 1)
        likeness = now.modes.shapes.T @ now.system.mass @ self._last.shape
        return int(np.abs(likeness).argmax())

    def _in_phase(self, now: Results, shape: Floats) -> Floats:
        """The shape, turned so that it does not jump by half a cycle from the one before."""
        turned = self._last is not None and self._last.shape @ now.system.mass @ shape < 0
        return -shape if turned else shape


def first_state(vehicle: Vehicle, rates: Rates, conditions: Conditions) -> State:
    """What a session opens with: the rates given and the yaw of the cabin on its mounts."""
    group = vehicle.mount_groups[0].name if vehicle.mount_groups else ""
    cabin = unit_of_role(vehicle, "cabin")
    return State(dict(rates), conditions, f"{cabin.word} yaw" if cabin else "", group)
