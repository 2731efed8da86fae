"""Sag and static forces beside an answer: with the present rates, and with those compared with."""

from dataclasses import dataclass

from modeviz.dynamics.assembly import System
from modeviz.errors import ModevizError, SolveError
from modeviz.mounting.static_system import PreparedStatics, prepare_statics
from modeviz.mounting.statics import StaticCase, Statics, solve_statics
from modeviz.vehicle.mount_rates import Rates


@dataclass(frozen=True, eq=False)
class StaticAnswer:
    """A vehicle in its load cases, or why there is no answer."""

    statics: Statics | None
    problem: str = ""
    """A sentence; "" if there is an answer."""

    def case(self, name: str) -> StaticCase:
        """Return a load case by its name.

        Raises:
            VehicleError: there is none of that name.
            SolveError: it has no answer, and why.
        """
        if self.statics is None:
            raise SolveError(self.problem)
        return self.statics.case(name)


@dataclass(frozen=True, eq=False)
class SolvedStatics:
    """The load cases of an answer."""

    now: StaticAnswer
    base: StaticAnswer
    """With the set of rates that all is compared with."""


class StaticSolver:
    """Solves the load cases of a vehicle."""

    def __init__(self, system: System) -> None:
        """Makes the vehicle ready, or remembers why it cannot be."""
        self._prepared: PreparedStatics | ModevizError
        try:
            self._prepared = prepare_statics(system)
        except ModevizError as error:
            self._prepared = error
        self._last: dict[str, tuple[Rates, StaticAnswer]] = {}

    def solve(self, now: Rates, base: Rates) -> SolvedStatics:
        """Return the load cases with the present rates and with those compared with."""
        return SolvedStatics(self._solved("now", now), self._solved("base", base))

    def _solved(self, whose: str, rates: Rates) -> StaticAnswer:
        """The answer with some rates, which may be those of the last one."""
        if whose not in self._last or self._last[whose][0] != rates:
            self._last[whose] = rates, self._answer(rates)
        return self._last[whose][1]

    def _answer(self, rates: Rates) -> StaticAnswer:
        if isinstance(self._prepared, ModevizError):
            return StaticAnswer(None, str(self._prepared))
        try:
            return StaticAnswer(solve_statics(self._prepared, rates))
        except ModevizError as error:
            return StaticAnswer(None, str(error))
