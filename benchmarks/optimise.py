"""What it takes to find better rates for the paper's problem, with every rate free."""

import time
from dataclasses import replace

import numpy as np

from benchmarks.report import OptimiseFigures
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.optimise.descent import descend
from modeviz.optimise.run import BUDGET, optimise
from modeviz.optimise.search import prepare_search
from modeviz.optimise.starts import start_points


def optimise_figures(n_starts: int) -> OptimiseFigures:
    """Times after the preparation, from the original rates and from many starts.

    Args:
        n_starts: how many.
    """
    vehicle = read_vehicle(builtin_vehicle())
    problem = vehicle.problems[0]
    free = tuple(replace(group, fixed_ratios=False) for group in problem.groups)
    search = prepare_search(vehicle, replace(problem, groups=free), vehicle.rates, vehicle.speed)
    begin = time.perf_counter()
    one = descend(search, np.zeros(search.space.n_variables), BUDGET)
    one_start_s = time.perf_counter() - begin
    begin = time.perf_counter()
    best = optimise(search, start_points(search, {}, n_starts))
    starts_s = time.perf_counter() - begin
    assert one.converged
    assert best.converged
    return OptimiseFigures(
        variables=search.space.n_variables,
        one_start_s=one_start_s,
        starts=n_starts,
        starts_s=starts_s,
        evaluations=best.evaluations,
        found=best.value,
    )
