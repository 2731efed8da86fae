"""A mount optimisation of the small cabin: A's rates are free within limits, B keeps its ratios."""

from dataclasses import replace

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.optimise.search import Search, prepare_search
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, Performance, Problem

BOUNDS = MountRates(1e5, 1e5, 1e5), MountRates(2e6, 2e6, 2e6)

PROBLEM = Problem(
    "cabin",
    groups=(
        DesignGroup("A", bounds=BOUNDS, ratio_limits=(0.25, 0.8)),
        DesignGroup("B", bounds=BOUNDS, fixed_ratios=True),
    ),
    performance=(
        Performance(np.linspace(6, 14, 9), roads=("flat",)),
        Performance(np.array([9.0, 11, 13]), wheel_loads=("front left radial force",), weight=2.0),
    ),
    reference="soft",
)


def cabin_search(**changes) -> Search:
    """The search for a problem that differs so from `PROBLEM`."""
    vehicle = mounted_cabin()
    return prepare_search(vehicle, replace(PROBLEM, **changes), vehicle.rates, vehicle.speed)
