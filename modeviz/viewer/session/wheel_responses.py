"""The responses to the harmonic load that is drawn, kept as long as they hold."""

from collections.abc import Mapping

from modeviz.analysis.results import Results
from modeviz.analysis.wheel_results import WheelResults, solve_harmonic
from modeviz.viewer.session.state import State

NOW = ""
"""In place of a set's name: the present rates."""


class WheelResponses:
    """Solves for the sets of rates that are drawn, and only what is new."""

    def __init__(self) -> None:
        """Solves nothing."""
        self._kept: dict[str, tuple[tuple[str, Results], WheelResults]] = {}

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
        asked = {name: (state.charts.load, results) for name, results in {**drawn, NOW: now}.items()}
        self._kept = {name: (each, self._response(name, *each)) for name, each in asked.items()}
        return {name: response for name, (_, response) in self._kept.items()}

    def _response(self, name: str, load: str, results: Results) -> WheelResults:
        """The response kept, if it is still to this load with these results, or a new one."""
        before, kept = self._kept.get(name, (None, None))
        if kept is not None and before == (load, results):
            return kept
        shaking = results.prepared.vehicle.harmonic_load(load)
        return solve_harmonic(results.prepared, results.rates, shaking)
