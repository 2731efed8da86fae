"""The report's section on running engines; empty where there are none, or nothing to look at."""

from collections.abc import Iterator, Sequence
from html import escape

import numpy as np

from modeviz.analysis.engine_results import EngineResults, solve_engine
from modeviz.analysis.mount_forces import figures_of
from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import AXIS
from modeviz.report.charts import BASE, NOW, Curve, line_chart
from modeviz.report.comparison import Comparison
from modeviz.report.html.sides import by_direction
from modeviz.ride.psd import amplitude_decibels
from modeviz.text.axes import Axis, decibel_axis
from modeviz.text.markup import note, section, title
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.engine import Engine
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS

DRIVER = 0
"""The response point whose run-up is drawn."""

PER_MINUTE = 60


def engines(comparison: Comparison) -> str:
    """Return what each order of each engine does at idle, and what all do over its speed."""
    vehicle, prepared = comparison.vehicle, [r.prepared for r in (comparison.base, comparison.now)]
    ready = [each for each in prepared if isinstance(each, Prepared)]
    is_seen = vehicle.response_points or vehicle.mounts
    if not (vehicle.engines and is_seen and len(ready) == len(prepared)):
        return ""
    parts = [part for engine in vehicle.engines for part in _engine(comparison, ready, engine)]
    return section(
        "Running engines",
        note(
            "Peak acceleration under each order at idle, 0.001 g; RMS over time of all orders there, "
            "and the largest over all speeds; forces of mounts likewise, N, along their own axes z "
            "(vertical), y (lateral) and x (fore-aft). Orders beyond the vehicle’s band are left out."
        ),
        *parts,
    )


def _engine(comparison: Comparison, prepared: Sequence[Prepared], engine: Engine) -> Iterator[str]:
    """A table for each point, the run-up at the first, and the forces of mounts."""
    results = comparison.base, comparison.now
    sets = [solve_engine(p, r.rates, engine) for p, r in zip(prepared, results, strict=True)]
    vehicle = comparison.vehicle
    heading = title(f"{engine.name}, idle at {PER_MINUTE * engine.idle_hz:.4g} rpm")
    names = [
        *(f"Order {order.order:g}" for order in engine.orders),
        "RMS at idle",
        "Largest RMS",
    ]
    base, now = map(_rows, sets)
    in_band = [*sets[0].in_band[sets[0].idle], True, True]
    shown = [name for name, is_inside in zip(names, in_band, strict=True) if is_inside]
    for i, point in enumerate(vehicle.response_points):
        tables = by_direction(comparison, shown, base[in_band, i], now[in_band, i], 2)
        yield f"<h3>{heading}: {title(point.name)}</h3>{tables}"
    if vehicle.response_points and len(sets[0].speed_hz) > 1:
        yield from (_run_up(comparison, sets, direction) for direction in RIDE_DIRECTIONS)
    for what, forces in (
        ("forces of mounts, RMS at idle", [run.force_rms[run.idle] for run in sets]),
        ("forces of mounts, largest RMS", [run.force_rms.max(axis=0) for run in sets]),
    ):
        if vehicle.mounts:
            mounts, (before, after) = [mount.name for mount in vehicle.mounts], forces
            before = figures_of(vehicle.mounts, sets[0].vehicle, before)
            told = by_direction(comparison, mounts, before[:, :3], after[:, :3], 2)
            yield f"<h3>{heading}: {what}, N</h3>{told}"


def _rows(results: EngineResults) -> Floats:
    """(n_orders + 2, n_points, 3), 0.001 g."""
    at_idle = results.acceleration_g[results.idle]
    rms = [results.rms[results.idle], results.rms.max(axis=0)]
    return 1000 * np.concatenate([at_idle, rms])


def _run_up(comparison: Comparison, sets: list[EngineResults], direction: str) -> str:
    """The RMS of all orders over speed at the driver's point with both sets."""
    point, engine = comparison.vehicle.response_points[DRIVER].name, sets[0].engine.name
    rpm = PER_MINUTE * sets[0].speed_hz
    levels = [amplitude_decibels(run.rms[:, DRIVER, AXIS[direction]]) for run in sets]
    styles = zip(comparison.names, levels, (BASE, NOW), (1.6, 2.2), strict=True)
    curves = [Curve(name, rpm, level, color, width) for name, level, color, width in styles]
    x = Axis("Speed, rpm", float(rpm[0]), float(rpm[-1]))
    heading = f"{direction.capitalize()} acceleration at {point} while {engine} runs up, all orders"
    svg = line_chart(curves, x, decibel_axis("dB re 1 g, RMS", levels), heading, 900, 220)
    return f"<figure>{svg}<figcaption>{escape(heading)}</figcaption></figure>"
