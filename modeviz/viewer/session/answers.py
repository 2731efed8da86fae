"""The answer to a state: everything that is drawn, solved and followed from one state to the next."""

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.analysis.exact_check import Check, ClassicError, classic_error
from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.mode_tracking import Pair, follow, pair_modes, same_mode
from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions, Results, RoadExcitation, drive, solve_on
from modeviz.analysis.sensitivity import Sensitivity
from modeviz.analysis.wheel_results import WheelResults, solve_wheels
from modeviz.dynamics.component_trust import ComponentTrust
from modeviz.dynamics.naming import ModeName
from modeviz.dynamics.tracking import Track
from modeviz.errors import ModevizError, SolveError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.movement import Movement, ShownMode, asks, movement
from modeviz.viewer.session.state import State, Variant, rate_sets

FREE_HZ = 0.5
"""Below, something moves freely."""

SAME_MAC = 0.9
"""Of the shape shown last with so much of it a mode is shown on, until details are drawn again."""

DETAILS_EVERY = 0.1
"""s between two looks at tables while rates move; curves, figures and shape follow every move."""


@dataclass(frozen=True, eq=False)
class Rest:
    """What is found out about an answer while nothing changes."""

    now: Results
    sensitivity: Sensitivity | None = None
    """What ten percent of each rate do, once that is known."""
    check: Check | None = None
    """How far `now` is from the exact answer, as far as that is known."""
    components: tuple[ComponentTrust, ...] = ()
    """How far the bodies are believed, once that is known."""
    problem: str = ""
    """Why no more will be known, if so."""

    @property
    def is_complete(self) -> bool:
        """Whether there is no more to find out."""
        return bool(self.problem) or (self.check is not None and self.check.is_complete)


@dataclass(frozen=True, eq=False)
class Solved:
    """The answer to a state."""

    state: State
    """What was asked for, but compared with a set that has an answer."""
    missing: str
    """The set that was to be compared with, if it has none; else ""."""
    named: Mapping[str, Results]
    """With every set of rates that has a name and an answer, on the same road."""
    unsolved: Mapping[str, str]
    """Why the other sets have no answer, by name."""
    now: Results
    track: Track
    """Where the modes of `base` went."""
    pairs: tuple[Pair, ...]
    """The modes of `base` and of `now`, as they are compared."""
    mode: int
    """The shown mode, an index of `now.modes`."""
    same: int | None
    """The mode of `base` that it is compared with; None if there is none."""
    name: ModeName
    """What it is called, or was when what is for reading was drawn last."""
    shape: Floats
    """Of the shown mode, (n_dofs,), in phase with the one shown before."""
    movement: Movement
    """What moves: that mode, or whatever else was asked for."""
    wheels: Mapping[str, WheelResults]
    """While a wheel load is chosen: the response to all of them with the sets that are drawn, by name,
    and with the present rates under ""."""
    seconds: float
    """What the solve took."""
    rest: Rest
    """What is known by now beyond the answer."""
    classic_error: ClassicError | None
    """How far the classic method is off, if that is asked for."""
    is_detailed: bool
    """Whether what is for reading is to be drawn too; else `track` and `pairs` are of the last such
    answer."""

    @property
    def base(self) -> Results:
        """With the set of rates that all is compared with."""
        return self.named[self.state.against]

    @cached_property
    def strain(self) -> Mapping[str, float]:
        """Of the shown mode: each flexible body's and connection group's share of the strain energy."""
        return self.now.strain_shares(self.shape)


class Answers:
    """Answers one state after the other, in one thread; `rebase` may be called in another."""

    def __init__(self, vehicle: Vehicle) -> None:
        """Nothing is solved before `prepare`."""
        self._vehicle = vehicle
        self.prepared: Prepared
        """The vehicle made ready, once `prepare` has."""
        self._drive: RoadExcitation
        """Near the rates of the last rest."""
        self._home: RoadExcitation
        """At the vehicle's own rates: what is kept for long shares its receptances."""
        self._named: dict[str, Results] = {}
        self._unsolved: dict[str, str] = {}
        self._named_for: tuple[Mapping[str, Variant], Conditions] | None = None
        self._wheels: dict[str, tuple[Results, WheelResults]] = {}
        self._last: Solved | None = None
        self._chosen_by: tuple[str, Rates] | None = None
        self._chosen: tuple[ModalResults, int]
        """The mode that was chosen to be shown, where it is called so."""
        self._detailed_at = -np.inf

    def prepare(self, state: State, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle, and solves with all sets of rates that have a name.

        Args:
            state: the first one.
            progress: told the fraction of the preparation that is done.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        self.prepared = prepare(self._vehicle, progress=progress)
        self._drive = self._home = drive(self.prepared, state.conditions)
        self._solve_named(state)

    def rebase(self, state: State) -> Prepared:
        """Makes answers close to a state cheap; gives the vehicle prepared there."""
        near = self.prepared.near(state.rates)
        self._drive = drive(near, state.conditions)
        return near

    def answer(self, state: State, rest: Rest | None) -> Solved:
        """Solves a state, or only shows it differently.

        Args:
            state: what is asked for.
            rest: what is known beyond the last answer.

        Raises:
            ModevizError: there is no answer.
        """
        begin = time.perf_counter()
        named, last = self._solve_named(state), self._last
        asked, state = state, _answerable(state, named)
        base = named[state.against]
        if last and asks_for_the_same(last.state, state):
            now, mode = last.now, None
        else:
            now = solve_on(self._drive_on(state.conditions), state.rates)
            mode = self._recognised(now, state, begin)
            self._detailed_at = begin if mode is None else self._detailed_at
        is_detailed = mode is None or last is None
        if mode is None or last is None:
            mode, track = self._follow(now, state), follow(base, now)
            name, pairs = now.names[mode], pair_modes(base, now, track)
            same = next(pair.before for pair in pairs if pair.after == mode)
        else:
            name, track, pairs, same = last.name, last.track, last.pairs, last.same
        shape = self._in_phase(now.modes.shapes[:, mode])
        wheels = self._solve_wheels(state, named, now)
        moving = self._move(state, ShownMode(now, mode, name, shape, base, same))
        is_known = rest is not None and rest.now is now
        self._last = Solved(
            state=state,
            missing="" if asked.against in named else asked.against,
            named=named,
            unsolved=self._unsolved,
            now=now,
            track=track,
            pairs=pairs,
            mode=mode,
            same=same,
            name=name,
            shape=shape,
            movement=moving,
            wheels=wheels,
            seconds=last.seconds if last and last.now is now else time.perf_counter() - begin,
            rest=rest if rest is not None and is_known else Rest(now),
            classic_error=classic_error(now) if state.classic else None,
            is_detailed=is_detailed,
        )
        return self._last

    def _solve_named(self, state: State) -> dict[str, Results]:
        """The results with every set that has a name and an answer, those kept that still hold.

        Raises:
            SolveError: none has an answer.
        """
        wanted = (state.variants, state.conditions)
        if self._named_for == wanted:
            return self._named
        kept = {
            name: results
            for name, results in self._named.items()
            if results.conditions == state.conditions
        }
        if self._home.conditions != state.conditions:
            self._home = drive(self.prepared, state.conditions)
        sets = rate_sets(self._vehicle, state)
        named, unsolved = {}, {}
        for name, rates in sets.items():
            try:
                is_known = name in kept and kept[name].rates == rates
                named[name] = kept[name] if is_known else solve_on(self._home, rates)
            except SolveError as error:
                unsolved[name] = str(error)
        if not named:
            raise SolveError("; ".join(f"{name}: {why}" for name, why in unsolved.items()))
        self._named, self._unsolved, self._named_for = named, unsolved, wanted
        return named

    def _solve_wheels(
        self, state: State, named: Mapping[str, Results], now: Results
    ) -> dict[str, WheelResults]:
        """The responses to wheel loads that are drawn, if any are; what did not change is kept."""
        if not state.load:
            return {}
        wanted = {name: named[name] for name in (state.against, *sorted(state.overlaid))} | {"": now}
        self._wheels = {
            name: (
                results,
                self._kept_wheels(name, results) or solve_wheels(results.prepared, results.rates),
            )
            for name, results in wanted.items()
        }
        return {name: found for name, (_, found) in self._wheels.items()}

    def _kept_wheels(self, name: str, results: Results) -> WheelResults | None:
        """The response found before, if it is still to these results."""
        before, found = self._wheels.get(name, (None, None))
        return found if before is results else None

    def _drive_on(self, conditions: Conditions) -> RoadExcitation:
        found = self._drive  # `rebase` may put another in its place
        if found.conditions != conditions:
            self._drive = found = drive(found.prepared, conditions)
        return found

    def _recognised(self, now: Results, state: State, begin: float) -> int | None:
        """The mode that clearly is the one shown last, while details need not be drawn; else None."""
        last = self._last
        is_due = begin - self._detailed_at >= DETAILS_EVERY
        if last is None or is_due or _shows_something_else(last.state, state):
            return None
        likeness = (now.modes.shapes.T @ now.prepared.system.mass @ last.shape) ** 2
        mode = int(likeness.argmax())
        return mode if likeness[mode] > SAME_MAC else None

    def _follow(self, now: Results, state: State) -> int:
        """The mode that the chosen one is compared with, else the one with most of its shape.

        Whatever was shown between: the same rates show the same mode.
        """
        chosen, mode = self._choice(now, state)
        same = same_mode(chosen, mode, now)
        return follow(chosen, now).split(mode)[0][0] if same is None else same

    def _choice(self, now: Results, state: State) -> tuple[ModalResults, int]:
        """The mode that a state asks for, where it has its name; the slowest if it has it nowhere."""
        wanted = state.mode, state.mode_rates
        if self._chosen_by != wanted:
            self._chosen_by, self._chosen = wanted, self._named_mode(now, state)
        return self._chosen

    def _named_mode(self, now: Results, state: State) -> tuple[ModalResults, int]:
        for results in (self._results_with(state.mode_rates, now), now):
            mode = results.mode_index(state.mode)
            if mode is not None:
                return results, mode
        f = now.modes.frequency_hz
        return now, min(int(np.searchsorted(f, FREE_HZ)), len(f) - 1)

    def _results_with(self, rates: Rates, now: Results) -> ModalResults:
        """The modes with other rates, or the present ones if those have none."""
        try:
            known = self.prepared.all_rates(rates) == now.rates
            return now if known else solve_modal(self.prepared, rates)
        except SolveError:
            return now

    def _move(self, state: State, shown: ShownMode) -> Movement:
        """What moves; if that cannot be, what moved before, and why."""
        last = self._last
        if last is None:
            return movement(state, shown)
        followed = shown.now, shown.index, shown.base, shown.same
        if followed == (last.now, last.mode, last.base, last.same) and asks(last.state) == asks(state):
            return last.movement
        try:
            return movement(state, shown)
        except ModevizError as error:
            return replace(last.movement, problem=str(error))

    def _in_phase(self, shape: Floats) -> Floats:
        """The shape, turned so that it does not jump by half a cycle from the one before."""
        mass = self.prepared.system.mass
        turned = self._last is not None and self._last.shape @ mass @ shape < 0
        return -shape if turned else shape


def _answerable(state: State, named: Mapping[str, Results]) -> State:
    """A state without those sets that have no answer; the first that has one takes their place."""
    against = state.against if state.against in named else next(iter(named))
    return replace(state, against=against, overlaid=state.overlaid & named.keys())


def asks_for_the_same(one: State, other: State) -> bool:
    """Whether two states have the same answer and differ at most in what is shown of it."""
    return one.rates == other.rates and one.conditions == other.conditions


def _shows_something_else(before: State, now: State) -> bool:
    """Whether more than rates changed, so that all has to be drawn."""
    return any(
        getattr(before, field) != getattr(now, field)
        for field in ("mode", "mode_rates", "against", "motion")
    )
