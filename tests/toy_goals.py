"""Goals that are known by hand."""

from dataclasses import dataclass

import numpy as np
from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin

from modeviz.analysis.sensitivity import rate_variables
from modeviz.optimise.design_space import design_space
from modeviz.optimise.search import Search


@dataclass(frozen=True)
class Logarithmic:
    """f(u) of the logarithms u = ln(k/k₀) of all rates of the cabin, with ∂f/∂u."""

    function: object
    """u to f and ∂f/∂u."""

    def value(self, rates):
        return self.value_and_gradient(rates)[0]

    def exact_value(self, rates):
        return self.value(rates)

    def value_and_gradient(self, rates):
        vehicle = mounted_cabin()
        k, k0 = (
            np.array([getattr(every[v.group], v.direction) for v in rate_variables(vehicle)])
            for every in (vehicle.all_rates(rates), vehicle.rates)
        )
        value, slope = self.function(np.log(k / k0))
        return value, slope / k


def logarithmic_search(function, groups=PROBLEM.groups, windows=None) -> Search:
    """Of the cabin, for f(u) of the logarithms of its rates."""
    return Search(design_space(mounted_cabin(), groups), Logarithmic(function), windows)


def paraboloid(center, offset=1.0):
    """Half the squared distance from a center, and an offset."""

    def function(u):
        step = u - center
        return 0.5 * step @ step + offset, step

    return function


CENTER = np.array([2.0, -3.0, 0.1, 2.0, 2.0, 2.0])
"""Of A vertical, lateral, fore-aft and B's rates, as ln(k/k₀)."""
ROOT = -(1 + np.log(0.25 / 0.375)) / 2
"""A vertical where lateral has to stay above 0.25 of it: what both want, halved between them."""
MINIMUM = np.array([ROOT, ROOT + np.log(0.25 / 0.375), 0.1, np.log(2.5)])
"""By hand: A lateral on its lower ratio limit, fore-aft free, B vertical on its upper bound."""
