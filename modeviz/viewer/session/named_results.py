"""The results with every set of rates that has a name, kept as long as they hold."""

from collections.abc import Mapping
from dataclasses import dataclass, replace

from modeviz.analysis.results import Conditions, Results, RoadExcitation, drive, solve_on
from modeviz.errors import SolveError
from modeviz.viewer.session.design import Variant, rate_sets
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

    def __init__(self, home: RoadExcitation) -> None:
        """Solves nothing.

        Args:
            home: at the vehicle's own rates: what is kept for long shares its receptances.
        """
        self._drive = home
        self._named = Named({}, {})
        self._solved_for: tuple[Mapping[str, Variant], Conditions] | None = None

    def solve(self, state: State) -> Named:
        """Return the results with all sets of a state.

        Raises:
            SolveError: none has an answer.
        """
        wanted = (state.design.variants, state.conditions)
        if self._solved_for != wanted:
            self._named, self._solved_for = self._solve(state), wanted
        return self._named

    def _solve(self, state: State) -> Named:
        prepared = self._drive.prepared
        if self._drive.conditions != state.conditions:
            self._drive = drive(prepared, state.conditions)
        results, unsolved = {}, {}
        for name, rates in rate_sets(prepared.vehicle, state.design).items():
            kept = self._named.results.get(name)
            holds = kept and kept.conditions == state.conditions and kept.rates == rates
            try:
                results[name] = kept if kept and holds else solve_on(self._drive, rates)
            except SolveError as error:
                unsolved[name] = str(error)
        if not results:
            raise SolveError("; ".join(f"{name}: {why}" for name, why in unsolved.items()))
        return Named(results, unsolved)
