"""The report's section on running engines; empty where there are none, or nobody who feels them."""

import numpy as np

from modeviz.analysis.engine_results import EngineResults, solve_engine
from modeviz.analysis.preparation import Prepared
from modeviz.report.comparison import Comparison
from modeviz.report.html.sides import by_direction
from modeviz.text.markup import note, section, title
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.engine import Engine


def engines(comparison: Comparison) -> str:
    """Return what each order of each engine does at idle, and the most that all do at any speed."""
    prepared, vehicle = comparison.base.prepared, comparison.vehicle
    if not (vehicle.engines and vehicle.response_points and isinstance(prepared, Prepared)):
        return ""
    parts = [part for engine in vehicle.engines for part in _engine(comparison, prepared, engine)]
    return section(
        "Running engines",
        note(
            "Peak acceleration under each order at idle, 0.001 g; RMS over time of all orders there, "
            "and the largest over all speeds. Orders beyond the vehicle’s band are left out."
        ),
        *parts,
    )


def _engine(comparison: Comparison, prepared: Prepared, engine: Engine) -> list[str]:
    sets = [solve_engine(prepared, r.rates, engine) for r in (comparison.base, comparison.now)]
    names = [
        *(f"Order {order.order:g}" for order in engine.orders),
        "RMS at idle",
        "Largest RMS",
    ]
    base, now = map(_rows, sets)
    seen = np.ravel(~np.isnan(base).any(axis=(1, 2)))
    shown = [name for name, is_seen in zip(names, seen, strict=True) if is_seen]
    heading = f"{engine.name}, idle at {60 * engine.idle_hz:.4g} rpm"
    return [
        f"<h3>{title(heading)}: {title(point.name)}</h3>"
        + by_direction(comparison, shown, base[seen, i], now[seen, i], 2)
        for i, point in enumerate(comparison.vehicle.response_points)
    ]


def _rows(results: EngineResults) -> Floats:
    """(n_orders + 2, n_points, 3), 0.001 g."""
    at_idle = results.acceleration_g[results.idle]
    rms = [results.rms[results.idle], results.rms.max(axis=0)]
    return 1000 * np.concatenate([at_idle, rms])
