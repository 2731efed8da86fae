"""What it takes to drive many vehicles whose mounts scatter."""

import time

from benchmarks.measure import peak_bytes
from benchmarks.report import ScatterFigures
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.objective import Objective
from modeviz.scatter.monte_carlo import scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts


def scatter_figures(n_samples: int, n_freqs: int) -> ScatterFigures:
    """Rides of built-in trucks at the driver's point, and the goals of the paper's problem.

    Args:
        n_samples: how many trucks.
        n_freqs: how many frequencies, spread over the band.
    """
    vehicle = read_vehicle(builtin_vehicle())
    lines = vehicle.frequency_hz
    prepared = prepare(vehicle, lines[:: len(lines) // n_freqs])
    goal = prepare_goal(vehicle, vehicle.problems[0], vehicle.rates, vehicle.speed)
    assert isinstance(goal, Objective)
    road = Conditions(vehicle.roads[0].name, vehicle.speed)
    begin = time.perf_counter()
    result = scatter(prepared, scattered_parts(prepared, {}, Tolerance()), road, goal, n_samples)
    seconds = time.perf_counter() - begin
    return ScatterFigures(
        samples=n_samples, seconds=seconds, peak_mb=peak_bytes() / 1e6, psd_error=result.psd_error
    )
