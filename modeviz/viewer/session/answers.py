"""The answer to a state: everything that is drawn, solved and followed from one state to the next."""

import threading
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cached_property

from modeviz.analysis.exact_check import ClassicError, classic_error
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import Results, RoadExcitation, drive
from modeviz.analysis.rigid import BodyAxes, body_axes, body_purity
from modeviz.analysis.wheel_results import WheelResults
from modeviz.errors import ModevizError
from modeviz.mounting.purity import Purity
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.cursor import CursorForces
from modeviz.viewer.session.design import named_sets
from modeviz.viewer.session.findings import Findings
from modeviz.viewer.session.followed_mode import FollowedMode, ModeFollower
from modeviz.viewer.session.movement import Movement, asks, movement
from modeviz.viewer.session.named_results import Named, NamedResults
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State
from modeviz.viewer.session.static_answers import SolvedStatics, StaticSolver
from modeviz.viewer.session.wheel_responses import WheelResponses


@dataclass(frozen=True, eq=False)
class Solved:
    """The answer to a state."""

    state: State
    """What was asked for, but compared with a set that has an answer."""
    missing: str
    """The set that was to be compared with, if it has none; else ""."""
    named: Named
    """With every set of rates that has a name, on the same road."""
    now: Results
    followed: FollowedMode
    """The mode that is shown, and where all modes of `base` went."""
    movement: Movement
    """What moves: that mode, or whatever else was asked for."""
    wheels: Mapping[str, WheelResults]
    """While a wheel load is chosen: the response to all of them with the sets that are drawn, by name,
    and with the present rates under ""."""
    static: SolvedStatics
    """The load cases; of the last rates with which what is for reading was drawn, or sag is."""
    seconds: float
    """What the solve took."""
    classic_error: ClassicError | None
    """How far the classic method is off, if that is asked for."""
    findings: Findings
    """What is known by now beyond the answer."""
    cursor: CursorForces
    """Solves all forces where the cursor is."""

    @property
    def base(self) -> Results:
        """With the set of rates that all is compared with."""
        return self.named.results[self.state.against]

    @property
    def is_detailed(self) -> bool:
        """Whether what is for reading is to be drawn too."""
        return self.followed.is_detailed

    @cached_property
    def strain(self) -> Mapping[str, float]:
        """Each flexible body's and connection group's share of the shown mode's strain energy."""
        return self.now.strain_shares_of_mode(self.followed.mode)

    @cached_property
    def purity(self) -> Purity:
        """How pure the modes of the body are that is looked at on its mounts."""
        look, number = self.state.rigid, self._rigid_number
        return body_purity(self.now, number, look.axes, self.state.design.decoupling, look.direction)

    @cached_property
    def rigid_axes(self) -> BodyAxes:
        """Axes and centres of the body that is looked at on its mounts."""
        return body_axes(self.now, self._rigid_number, self.state.rigid.direction)

    @property
    def _rigid_number(self) -> int:
        names = [body.name for body in self.now.prepared.vehicle.bodies]
        return names.index(self.state.rigid.body)

    @cached_property
    def dissipated(self) -> Mapping[str, float]:
        """Each flexible body's and connection group's share of what the shown mode loses."""
        return self.now.dissipated_shares(self.followed.mode)


class Answers:
    """Answers one state after the other, in one thread; `rebase` may be called in another."""

    def __init__(self, shared: Shared, vehicle: Vehicle) -> None:
        """Nothing is solved before `prepare`.

        Args:
            shared: with the vehicle as in its file.
            vehicle: with the parts that it has besides.
        """
        self._shared, self._preparations = shared, shared.preparations
        self._lock = threading.Lock()
        self._alterations: Alterations | None = None
        self.vehicle: Vehicle = vehicle
        """Altered as in the newest answer; before the first, with its parts alone."""
        self.prepared: Prepared
        """That vehicle made ready, once `prepare` has."""
        self._drive: RoadExcitation
        """Near the rates of the last rest."""
        self._near: State | None = None
        """That of the last rest, of the same vehicle."""
        self._named = NamedResults(shared)
        self._follower: ModeFollower | None = None
        self._wheels = WheelResponses()
        self._static = {"now": StaticSolver(), "base": StaticSolver()}
        self._cursor = CursorForces()
        self._last: Solved | None = None

    def prepare(self, state: State, progress: Callable[[float], None] | None = None) -> None:
        """Prepares the vehicle as it is altered, and solves with all sets that have a name.

        It is another vehicle then, so that nothing is kept of answers to others, but
        those with sets that have a name: their vehicle is as it was.

        Args:
            state: the first one, or the first with other alterations.
            progress: told the fraction of the preparation that is done.

        Raises:
            ModevizError: there is no answer on that road at that speed.
        """
        alterations = state.design.alterations
        prepared = self._preparations.get(alterations, progress)
        excitation = self._shared.beginnings.drive(prepared, alterations, state.conditions)
        with self._lock:
            self.vehicle, self._alterations = prepared.vehicle, alterations
            self.prepared, self._drive, self._near = prepared, excitation, None
        self._follower = ModeFollower(self.prepared, self._follower)
        self._wheels, self._cursor, self._last = WheelResponses(), CursorForces(), None
        self._solve_named(state)

    def afresh(self) -> "Answers":
        """Return others that have only what is prepared: something failed or hangs in these."""
        with self._lock:
            others = Answers(self._shared.copied(), self.vehicle)
            others.prepared, others._drive = self.prepared, self._drive
        return others

    def is_ready(self, alterations: Alterations) -> bool:
        """Return whether the vehicle is prepared with some alterations."""
        return self._preparations.has(alterations)

    @property
    def original(self) -> Vehicle:
        """Without alterations."""
        return self._preparations.vehicle

    def rebase(self, state: State) -> None:
        """Makes answers close to a state cheap.

        Raises:
            ModevizError: as `Prepared.near`; all is as it was.
        """
        with self._lock:
            prepared, last = self.prepared, self._near
        if last and asks_for_the_same(last, state):
            return
        near = self._shared.beginnings.near(prepared, state.design.rates)
        excitation = drive(near, state.conditions)
        with self._lock:
            if self.prepared is prepared:
                self._drive, self._near = excitation, state

    def answer(
        self,
        asked: State,
        findings: Callable[[Results], Findings],
        progress: Callable[[float], None] | None = None,
    ) -> Solved:
        """Solves a state, or only shows it differently.

        Args:
            asked: what is asked for.
            findings: gives what is known beyond an answer.
            progress: told the fraction of a preparation that is done; what it raises ends that.

        Raises:
            ModevizError: there is no answer.
        """
        begin = time.perf_counter()
        if asked.design.alterations != self._alterations:
            self.prepare(asked, progress)
        named = self._solve_named(asked)
        state = named.answerable(asked)
        now, base = self._solve(state), named.results[state.against]
        assert self._follower is not None
        is_hurried = self._shared.precedence.is_contended
        followed = self._follower.follow(state, base, now, is_hurried)
        seconds = self._seconds(now, begin)
        static = self._in_load_cases(state, followed)
        self._last = Solved(
            state=state,
            missing="" if asked.against == state.against else asked.against,
            named=named,
            now=now,
            followed=followed,
            movement=self._movement(state, followed, static),
            wheels=self._wheels.solve(state, named.results, now),
            static=static,
            seconds=seconds,
            classic_error=classic_error(now) if state.classic else None,
            findings=findings(now),
            cursor=self._cursor,
        )
        return self._last

    def _solve_named(self, state: State) -> Named:
        """The results with all sets that have a name, each with mounts where it has them."""
        sets = named_sets(self.vehicle, state.design)
        named = self._named.solve(sets, state.conditions)
        self._preparations.keep(
            [state.design.alterations, *(each.alterations for each in sets.values())]
        )
        return named

    def _solve(self, state: State) -> Results:
        """The results with the rates of a state, which may be those of the last."""
        if self._last and asks_for_the_same(self._last.state, state):
            return self._last.now
        excitation = self._drive  # `rebase` may put another in its place
        if excitation.conditions != state.conditions:
            self._drive = excitation = drive(excitation.prepared, state.conditions)
        return self._shared.beginnings.solve(excitation, state.design.rates)

    def _in_load_cases(self, state: State, followed: FollowedMode) -> SolvedStatics:
        """Return the load cases, which nobody sees while rates move but for the sag that is drawn."""
        if self._last and not followed.is_detailed and state.motion.kind != "sag":
            return self._last.static
        compared = named_sets(self.vehicle, state.design)[state.against]
        return SolvedStatics(
            self._static["now"].solve(self.prepared.system, followed.now.rates),
            self._static["base"].solve(
                self._preparations.get(compared.alterations).system, compared.rates
            ),
        )

    def _movement(self, state: State, followed: FollowedMode, static: SolvedStatics) -> Movement:
        """Return the motion that is asked for; if that cannot be, the one before, and why."""
        last = self._last
        if last is None:
            return movement(state, followed, static)
        if followed.is_as(last.followed) and asks(last.state) == asks(state):
            return last.movement
        try:
            return movement(state, followed, static)
        except ModevizError as error:
            return replace(last.movement, problem=str(error))

    def _seconds(self, now: Results, begin: float) -> float:
        """Return the time of the solve that began then, or of the one before if it still holds."""
        last = self._last
        return last.seconds if last and last.now is now else time.perf_counter() - begin


def asks_for_the_same(one: State, other: State) -> bool:
    """Whether two states have the same answer and differ at most in what is shown of it."""
    return (
        one.design.rates == other.design.rates
        and one.design.alterations == other.design.alterations
        and one.conditions == other.conditions
    )
