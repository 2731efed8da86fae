"""What a search for better mount rates found."""

import math
from dataclasses import dataclass
from html import escape

import numpy as np

from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.optimise.active_limits import RELAXED, ActiveConstraint
from modeviz.optimise.run import Optimum
from modeviz.optimise.search import Search
from modeviz.report.charts import NOW, Curve, line_chart
from modeviz.report.optimum import (
    objective_words,
    optimum_doubts,
    optimum_record,
    optimum_table,
    solved_from_scratch,
)
from modeviz.report.places import place_rows
from modeviz.report.records import Record
from modeviz.study.displayed import Displayed
from modeviz.study.notebook import block, charts, figure, paragraphs, rates_table
from modeviz.text.axes import Axis
from modeviz.text.markup import table
from modeviz.text.wording import percent_change, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.placement import Placement
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False, repr=False)
class OptimiseResult(Displayed):
    """The best mount rates and places that were found, what they are worth and how the search ended.

    found = study.optimise("paper", starts=20)
    found.value / found.original
    study.rates.use(found.rates)
    """

    problem: Problem
    search: Search
    """What was sought, the last time."""
    optimum: Optimum
    """As the functions of `optimise` give it."""

    @property
    def history(self) -> Floats:
        """(n, 2): after how many evaluations a better design was found, and its objective."""
        return np.array(self.optimum.history, np.float64).reshape(-1, 2)

    @property
    def rates(self) -> dict[str, MountRates]:
        """Of every mount group, N/m."""
        return dict(self.optimum.rates)

    @property
    def placements(self) -> dict[str, Placement]:
        """Where mounts are, by group, of those that were moved or turned."""
        return dict(self.optimum.placements)

    @property
    def vehicle(self) -> Vehicle:
        """The vehicle with these rates and places; `write_vehicle` makes a folder of it."""
        return self.search.space.built(self.optimum.x)

    @property
    def value(self) -> float:
        """The objective of the design; smaller is better."""
        return self.optimum.value

    @property
    def original(self) -> float:
        """The objective of the vehicle's own rates."""
        return self.objective({})

    @property
    def converged(self) -> bool:
        """Whether the search came to its end."""
        return self.optimum.converged

    @property
    def reason(self) -> str:
        """Why it ended: "converged", "cancelled", "out of budget", or the solver's own word."""
        return self.optimum.reason

    @property
    def evaluations(self) -> int:
        """How many designs were evaluated, besides those that chose where to start."""
        return self.optimum.evaluations

    @property
    def limits(self) -> tuple[ActiveConstraint, ...]:
        """The limits that the design sits on, and what it would gain without them."""
        return self.optimum.active

    @property
    def exact_difference(self) -> float:
        """How far the full model as given is from the objective found, a part of it; NaN if unknown."""
        return self.optimum.verification.difference

    @property
    def truncation(self) -> TruncationGap | None:
        """How much too high frequencies are at these rates, since bodies lack residual compliance.

        None if none lacks it.
        """
        return self.optimum.verification.gap

    def objective(self, rates: Rates) -> float:
        """Return the objective of any rates, mounts being where they were given.

        Args:
            rates: of the groups that differ from the vehicle's own.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: it cannot be solved with these rates.
        """
        return self.search.goal.value(rates)

    def table(self) -> str:
        """Return rates and objective, why it ended, and the limits that the design sits on."""
        return optimum_table(self.problem, self.search, self.optimum)

    def to_dict(self) -> Record:
        """Return what `modeviz optimise --json` prints, see `report.optimum.optimum_record`."""
        return optimum_record(self.problem, self.search, self.optimum)

    def _repr_html_(self) -> str:
        vehicle = self.search.space.vehicle
        groups = [group.group for group in self.problem.groups]
        change = percent_change(self.value, self.original)
        about = (
            f"Objective, {objective_words(self.problem)}: {significant(self.value)}, {change} from the "
            f"original's {significant(self.original)}"
        )
        return block(
            f"{vehicle.name}: problem {self.problem.name}",
            paragraphs(about, f"{self.reason} after {self.evaluations} evaluations{self._exactness}"),
            paragraphs(*optimum_doubts(self.search, self.optimum)),
            rates_table(vehicle, groups, {"original": vehicle.rates, "found": self.rates}),
            self._places_table(),
            self._limits_table(),
            self._chart(),
        )

    @property
    def _exactness(self) -> str:
        difference = self.exact_difference
        if not math.isfinite(difference):
            return ""
        return f"; {solved_from_scratch('objective', difference)}"

    def _limits_table(self) -> str:
        if not self.limits:
            return ""
        header = ["Limits it sits on", f"{100 * RELAXED:.0f} % wider would gain about"]
        rows = [[escape(limit.name), f"{100 * limit.gain:.1f} %"] for limit in self.limits]
        return table(header, rows)

    def _places_table(self) -> str:
        space = self.search.space
        rows = place_rows(space, space.places.base, self.placements)
        header = ["Places", "before", "found"]
        return table(header, [[escape(name), *cells] for name, *cells in rows]) if rows else ""

    def _chart(self) -> str:
        """Return the chart of how the best objective fell; nothing where it did not."""
        if len(self.history) < 2:
            return ""
        evaluations, values = self.history.T
        steps = np.repeat(evaluations, 2)[1:], np.repeat(values, 2)[:-1]
        top = float(values.max())
        last = max(float(self.evaluations), float(evaluations[-1]), float(evaluations[0]) + 1)
        svg = line_chart(
            [Curve("", *steps, NOW)],
            Axis("Evaluations", 0.0, last),
            Axis("Objective", 0.0, 1.05 * top or 1.0),
            "The best objective found",
            440,
            210,
        )
        return charts([figure(svg, "The best objective found")])
