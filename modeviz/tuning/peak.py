"""The largest performance variable as what is to become small: a min-max problem."""

from dataclasses import dataclass

from modeviz.tuning.objective import Objective
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Rates


@dataclass(frozen=True, eq=False)
class Peak:
    """max w (a - target)² over load cases, frequencies, response points and directions."""

    objective: Objective
    """Whose sum it would be."""

    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return float(self.objective.criterion.largest(self.objective.response(rates)).max())

    def exact_value(self, rates: Rates) -> float:
        """The same from the equations of motion; raises as `Objective.exact_response`."""
        return float(self.objective.criterion.largest(self.objective.exact_response(rates)).max())

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """That, and the derivatives of the largest, (n_rates,): where it changes hands, these jump."""
        squares, gradients = self.squares_and_gradients(rates)
        largest = squares.argmax()
        return float(squares[largest]), gradients[largest]

    def squares_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        """All of which it is the largest, see `Objective.squares_and_gradients`."""
        return self.objective.squares_and_gradients(rates)
