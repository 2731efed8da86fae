"""Designs between two goals."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from modeviz.optimise.pareto import Front
from modeviz.optimise.trade_off import TradeOff
from modeviz.report.charts import NOW, Curve, line_chart
from modeviz.report.front import front_record, front_table
from modeviz.report.records import Record
from modeviz.study.displayed import Displayed
from modeviz.study.notebook import block, charts, figure, paragraphs
from modeviz.text.axes import Axis
from modeviz.text.markup import table, title
from modeviz.text.wording import percent_change, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False, repr=False)
class FrontResult(Displayed):
    """Designs on which neither of two goals can fall unless the other rises.

    front = study.front("lateral against vertical")
    front.values                      # (n_designs, 2)
    study.rates.use(front[3])
    """

    problem: Problem
    trade_off: TradeOff
    """What was sought."""
    front: Front
    """As the functions of `optimise` give it."""

    @property
    def names(self) -> tuple[str, str]:
        """Of both goals."""
        return self.front.names

    @property
    def values(self) -> Floats:
        """(n_designs, 2): both goals of each design, the best in the first goal first."""
        return np.array([design.values for design in self.front.designs]).reshape(-1, 2)

    @property
    def original(self) -> tuple[float, float]:
        """Both goals of the vehicle's own rates."""
        first, second = (search.goal.value({}) for search in self.trade_off.searches)
        return first, second

    @property
    def converged(self) -> bool:
        """Whether every search came to its end."""
        return self.front.converged

    @property
    def reason(self) -> str:
        """Why it ended: "converged", "cancelled" or "out of budget"."""
        return self.front.reason

    def __len__(self) -> int:
        return len(self.front.designs)

    def __iter__(self) -> Iterator[dict[str, MountRates]]:
        return (self[i] for i in range(len(self)))

    def __getitem__(self, number: int) -> dict[str, MountRates]:
        """Return the rates of a design, of every mount group, by its place from zero."""
        return dict(self.front.designs[number].rates)

    def vehicle(self, number: int) -> Vehicle:
        """Return the vehicle with the rates and places of a design, by its place from zero."""
        return self.trade_off.searches[0].space.built(self.front.designs[number].x)

    def placements(self, number: int) -> dict[str, Placement]:
        """Return where mounts of a design are, by group, of those that were moved or turned."""
        return dict(self.front.designs[number].placements)

    def table(self) -> str:
        """Return both goals of each design, its rates, and why the search ended."""
        return front_table(self.problem, self.trade_off, self.front)

    def to_dict(self) -> Record:
        """Return what `modeviz optimise --front --json` prints, see `report.front.front_record`."""
        return front_record(self.problem, self.trade_off, self.front)

    def _repr_html_(self) -> str:
        rows = [
            [
                f"Design {number}",
                *(
                    cell
                    for value, base in zip(values, self.original, strict=True)
                    for cell in (significant(value), percent_change(value, base))
                ),
            ]
            for number, values in enumerate(self.values.tolist(), 1)
        ]
        original = ["Original", *(c for value in self.original for c in (significant(value), ""))]
        header = ["", *(cell for name in self.names for cell in (title(name), ""))]
        return block(
            f"{self.problem.name}: {' against '.join(self.names)}",
            paragraphs(f"{self.reason} after {self.front.evaluations} evaluations"),
            table(header, [original, *rows]),
            self._chart(),
        )

    def _chart(self) -> str:
        if len(self) < 2:
            return ""
        x, y = self.values.T
        svg = line_chart(
            [Curve("", x, y, NOW)],
            Axis(self.names[0].capitalize(), *_room(x)),
            Axis(self.names[1].capitalize(), *_room(y)),
            "The front",
            440,
            260,
        )
        return charts([figure(svg, "The front: designs between both goals")])


def _room(values: Floats) -> tuple[float, float]:
    """The ends of an axis that holds values."""
    low, high = float(values.min()), float(values.max())
    margin = 0.05 * (high - low) or 0.05 * abs(high) or 1.0
    return low - margin, high + margin
