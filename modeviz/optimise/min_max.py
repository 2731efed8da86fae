"""The largest of several things as what is to become small."""

from abc import ABC, abstractmethod
from typing import Self

from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


class MinMax(ABC):
    """A goal that is the largest of its parts: where that changes hands its derivatives jump."""

    @abstractmethod
    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""

    @abstractmethod
    def exact_value(self, rates: Rates) -> float:
        """Return the value from the equations of motion; raises as `Objective.exact_response`."""

    @abstractmethod
    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        """Return the parts, (n_parts,), and their derivatives to rates, (n_parts, n_rates)."""

    @abstractmethod
    def of_vehicle(self, vehicle: Vehicle) -> Self:
        """Return the same goal of the vehicle with mounts elsewhere or more of them."""

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """Return the largest part, and its derivatives, (n_rates,)."""
        parts, gradients = self.parts_and_gradients(rates)
        largest = parts.argmax()
        return float(parts[largest]), gradients[largest]
