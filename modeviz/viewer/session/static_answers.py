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
    """Solves the load cases of a vehicle as it is now, or as it is where it is compared with."""

    def __init__(self) -> None:
        """Solves nothing."""
        self._system: System | None = None
        self._prepared: PreparedStatics | ModevizError
        self._last: tuple[Rates, StaticAnswer] | None = None

    def solve(self, system: System, rates: Rates) -> StaticAnswer:
        """Return the load cases with some rates.

        Args:
            system: of the vehicle with its own; it is made ready when it is another one.
            rates: of the groups that differ from the vehicle's own.
        """
        if system is not self._system:
            self._system, self._prepared, self._last = system, _prepared(system), None
        if self._last is None or self._last[0] != rates:
            self._last = rates, _answer(self._prepared, rates)
        return self._last[1]


def _prepared(system: System) -> PreparedStatics | ModevizError:
    """What is made ready, or why it cannot be."""
    try:
        return prepare_statics(system)
    except ModevizError as error:
        return error


def _answer(prepared: PreparedStatics | ModevizError, rates: Rates) -> StaticAnswer:
    if isinstance(prepared, ModevizError):
        return StaticAnswer(None, str(prepared))
    try:
        return StaticAnswer(solve_statics(prepared, rates))
    except ModevizError as error:
        return StaticAnswer(None, str(error))
