"""Which modes make the response to a wheel load."""

from collections.abc import Sequence

import numpy as np

from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.wheel_results import WheelResults
from modeviz.ride.participation import Peak, peak_lines, peaks


def wheel_peak_lines(wheels: WheelResults, load: int, point: int, direction: str) -> list[int]:
    """Return where a response to a wheel load has its peaks, numbers of frequencies."""
    return peak_lines(np.square(wheels.acceleration_g[:, load, point, AXIS[direction]]))


def wheel_peaks(
    results: Results,
    wheels: WheelResults,
    load: int,
    point: int,
    direction: str,
    count: int = 3,
    lines: Sequence[int] | None = None,
) -> tuple[Peak, ...]:
    """Peaks of the response to a wheel load with the `count` modes that make most of each.

    Args:
        results: the modes with the same rates.
        wheels: the responses.
        load: number of the vehicle's harmonic load.
        point: number of the response point.
        direction: one of `DIRECTIONS`.
        count: how many modes to name.
        lines: which peaks, all of `wheel_peak_lines` if None.
    """
    found = wheel_peak_lines(wheels, load, point, direction) if lines is None else lines
    at = np.asarray(found, int)
    f, shaken = wheels.frequency_hz[at], results.prepared.vehicle.harmonic_loads[load]
    one = np.ones((len(at), 1, 1), complex)
    row = results.prepared.outputs[3 * point + AXIS[direction]]
    parts = results.participation(row, shaken, f, one)
    return peaks(f, wheels.acceleration_g[at, load, point, AXIS[direction]], parts, count)
