"""The largest of several things as what is to become small."""

from abc import ABC, abstractmethod
from dataclasses import dataclass

import numpy as np

from modeviz.tuning.objective import Criterion, Objective
from modeviz.tuning.sensitivity import spring_shares
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import Rates


class MinMax(ABC):
    """A goal that is the largest of its parts: where that changes hands its derivatives jump."""

    @abstractmethod
    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""

    @abstractmethod
    def exact_value(self, rates: Rates) -> float:
        """The same from the equations of motion; raises as `Objective.exact_response`."""

    @abstractmethod
    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        """All of which it is the largest, (n_parts,), and derivatives to rates, (n_parts, n_rates)."""

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """That, and the derivatives of the largest, (n_rates,)."""
        parts, gradients = self.parts_and_gradients(rates)
        largest = parts.argmax()
        return float(parts[largest]), gradients[largest]


@dataclass(frozen=True, eq=False)
class Largest(Criterion):
    """The largest w (a - target)² of each case, and of all."""

    def values(self, response: Complexes) -> Floats:
        squares = [term.squares(self.power(term, response)) for term in self.terms]
        return np.stack([own.max(axis=(-2, -1)) for own in squares], axis=-1)

    def join(self, values: Floats) -> Floats:
        return values.max(axis=-1)


@dataclass(frozen=True, eq=False)
class Peak(Objective, MinMax):
    """max w (a - target)² over load cases, frequencies, response points and directions."""

    @property
    def criterion(self) -> Criterion:
        return Largest(self.driven.frequency_hz, self.terms)

    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        return self.squares(self.prepared.mount_stiffness(rates), spring_shares(self.prepared, rates))

    def of_springs(self, stiffness: Complexes, shares: Complexes) -> tuple[float, Floats]:
        squares, gradients = self.squares(stiffness, shares)
        largest = squares.argmax()
        return float(squares[largest]), gradients[largest]
