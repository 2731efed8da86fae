"""The report's section on unbalance and tyre force variation; empty where there are no such loads."""

from html import escape

import numpy as np

from modeviz.analysis.results import AXIS
from modeviz.analysis.wheel_peaks import wheel_peak_lines
from modeviz.report.comparison import Comparison
from modeviz.report.html.sides import by_direction, chart
from modeviz.report.tables import wheel_band
from modeviz.ride.psd import amplitude_decibels
from modeviz.text.markup import note, section, title
from modeviz.text.wording import number, within_sentence
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import WheelLoad
from modeviz.vehicle.mount_rates import DIRECTIONS, RIDE_DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle

DRIVER = 0
"""The response point that is drawn."""


def wheels(comparison: Comparison) -> str:
    """Harmonic responses, as the paper's figures 17 and 18, and means as its Tables 5 and 6."""
    if comparison.wheels is None:
        return ""
    vehicle = comparison.vehicle
    low, high = wheel_band(vehicle)
    base, now = (1000 * w.mean((low, high)) for w in comparison.wheels)
    loads = [load.name for load in vehicle.harmonic_loads]
    tables = (
        f"<h3>{title(point.name)}</h3>"
        + by_direction(comparison, loads, base[:, i], now[:, i], 2, common=float(base.max()))
        for i, point in enumerate(vehicle.response_points)
    )
    return section(
        "Unbalance and tyre force variation",
        *(_harmonic(comparison, direction) for direction in RIDE_DIRECTIONS),
        note(
            f"Mean peak acceleration from {low:g} to {high:g} Hz, 0.001 g. A change is relative to the "
            f"mean itself and, so that changes compare, to {_largest(comparison, base)}."
        ),
        *tables,
    )


def _harmonic(comparison: Comparison, direction: str) -> str:
    """The driver's acceleration under one load, both sets in one chart."""
    assert comparison.wheels is not None
    vehicle, axis = comparison.vehicle, AXIS[direction]
    load = _drawn_load(vehicle)
    levels = [amplitude_decibels(w.acceleration_g[:, load, DRIVER, axis]) for w in comparison.wheels]
    peaks = [wheel_peak_lines(w, load, DRIVER, direction) for w in comparison.wheels]
    point, name = vehicle.response_points[DRIVER].name, vehicle.harmonic_loads[load].name
    heading = f"{direction.capitalize()} acceleration at {point} under {name}"
    return chart(
        comparison,
        [w.frequency_hz for w in comparison.wheels],
        levels,
        peaks,
        heading,
        "dB re 1 g, peak",
    )


def _drawn_load(vehicle: Vehicle) -> int:
    """The radial force of the rear wheel on the driver's side, or the load that is most like it."""
    centers = {tyre.name: tyre.wheel_center for tyre in vehicle.tyres}
    side = vehicle.response_points[DRIVER].position[1]

    def likeness(number: int) -> tuple[bool, bool, float]:
        load = vehicle.harmonic_loads[number]
        if not isinstance(load, WheelLoad):
            return False, False, 0.0
        x, y, _ = centers[load.tyre]
        return load.kind == "radial force", y * side > 0, x

    return max(range(len(vehicle.harmonic_loads)), key=likeness)


def _largest(comparison: Comparison, base: Floats) -> str:
    """Words for the value that all changes are also relative to; `base` is (n_loads, n_points, 3)."""
    vehicle = comparison.vehicle
    load, point, axis = np.unravel_index(base.argmax(), base.shape)
    direction = next(d for d in DIRECTIONS if AXIS[d] == axis)
    where = f"{vehicle.response_points[point].name}, {direction}, {vehicle.harmonic_loads[load].name}"
    return (
        f"the largest mean of {escape(comparison.names[0])}, {number(float(base.max()), 2)} "
        f"({escape(within_sentence(where))})"
    )
