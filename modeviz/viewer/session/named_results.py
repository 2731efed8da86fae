"""The results with every set of rates that has a name, kept as long as they hold."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from modeviz.analysis.results import Conditions, Results, RoadExcitation
from modeviz.errors import ModevizError, SolveError
from modeviz.vehicle.alterations import Alterations
from modeviz.viewer.session.design import NamedSet
from modeviz.viewer.session.shared import Shared
from modeviz.viewer.session.state import State


@dataclass(frozen=True, eq=False)
class Named:
    """The results with all sets, on the same road."""

    results: Mapping[str, Results]
    """With every set that has an answer, by name."""
    unsolved: Mapping[str, str]
    """Why the others have none."""

    def answerable(self, state: State) -> State:
        """Return a state without sets that have no answer; the first that has one takes their place."""
        against = state.against if state.against in self.results else next(iter(self.results))
        overlaid = state.charts.overlaid & self.results.keys()
        return replace(state, against=against, charts=replace(state.charts, overlaid=overlaid))


class NamedResults:
    """Solves with the sets of a state, and only with those that are new."""

    def __init__(self, shared: Shared) -> None:
        """Solves nothing.

        Args:
            shared: with the vehicle at its own rates: what is kept for long shares their receptances.
        """
        self._shared = shared
        self._drives: list[RoadExcitation] = []
        self._named = Named({}, {})
        self._solved_for: tuple[Mapping[str, NamedSet], Conditions] | None = None

    def solve(self, sets: Mapping[str, NamedSet], conditions: Conditions) -> Named:
        """Return the results with all sets that have a name.

        Raises:
            SolveError: none has an answer.
        """
        wanted = (sets, conditions)
        if self._solved_for != wanted:
            self._named, self._solved_for = self._solve(sets, conditions), wanted
        return self._named

    def _solve(self, sets: Mapping[str, NamedSet], conditions: Conditions) -> Named:
        results, unsolved, driven = {}, {}, []
        for name, each in sets.items():
            try:
                excitation = self._drive(each.alterations, conditions)
                driven.append(excitation)
                kept = self._kept(name, excitation, each)
                results[name] = kept or self._shared.beginnings.solve(excitation, each.rates)
            except ModevizError as error:
                unsolved[name] = str(error)
        self._drives = driven
        if not results:
            raise SolveError("; ".join(f"{name}: {why}" for name, why in unsolved.items()))
        return Named(results, unsolved)

    def _kept(self, name: str, excitation: RoadExcitation, wanted: NamedSet) -> Results | None:
        """The results under a name if they still hold."""
        kept = self._named.results.get(name)
        if kept is None or kept.prepared is not excitation.prepared or kept.rates != wanted.rates:
            return None
        return kept if kept.conditions == excitation.conditions else None

    def _drive(self, alterations: Alterations, conditions: Conditions) -> RoadExcitation:
        """The vehicle on the road, which may have been there."""
        prepared = self._shared.preparations.get(alterations)
        known = (d for d in self._drives if d.prepared is prepared and d.conditions == conditions)
        return next(known, None) or self._shared.beginnings.drive(prepared, alterations, conditions)
