"""The responses to wheel loads that are drawn, kept as long as they hold."""

from collections.abc import Mapping

from modeviz.analysis.results import Results
from modeviz.analysis.wheel_results import WheelResults, solve_wheels
from modeviz.viewer.session.state import State

NOW = ""
"""In place of a set's name: the present rates."""


class WheelResponses:
    """Solves for the sets of rates that are drawn, and only for those that are new."""

    def __init__(self) -> None:
        """Solves nothing."""
        self._kept: dict[str, tuple[Results, WheelResults]] = {}

    def solve(
        self, state: State, named: Mapping[str, Results], now: Results
    ) -> dict[str, WheelResults]:
        """Return the responses by name of the set, with the present rates under `NOW`.

        Nothing while the road is drawn.

        Args:
            state: what is asked for.
            named: with every set of rates that has a name.
            now: with the present rates.
        """
        if not state.charts.load:
            return {}
        drawn = {name: named[name] for name in (state.against, *sorted(state.charts.overlaid))}
        self._kept = {n: (r, self._response(n, r)) for n, r in {**drawn, NOW: now}.items()}
        return {name: response for name, (_, response) in self._kept.items()}

    def _response(self, name: str, results: Results) -> WheelResults:
        """The response kept, if it is still to these results, or a new one."""
        before, kept = self._kept.get(name, (None, None))
        if kept is not None and before is results:
            return kept
        return solve_wheels(results.prepared, results.rates)
