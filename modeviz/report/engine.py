"""What an engine does to a vehicle at idle and at its other speeds, as text and as plain values."""

import numpy as np

from modeviz.analysis.engine_results import EngineResults
from modeviz.analysis.results import AXIS
from modeviz.errors import listed
from modeviz.report.records import Record, rates_record
from modeviz.report.tables import table
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.vehicle import Vehicle

MOST_SPEEDS = 16
"""Lines of the table of speeds."""

PER_MINUTE = 60

ALONG = MOTIONS[:3]
"""The motions in which forces of mounts are told."""


def engine_record(vehicle: Vehicle, results: EngineResults) -> Record:
    """The accelerations and forces of mounts under an engine's orders.

    `{"vehicle", "rates": see rates_record, "engine", "idle_rpm", "speeds_rpm": [...], "orders":
    [{"order", "responses": [{"point", "direction", "acceleration_g": [...peak at each speed, null
    beyond the band]}], "forces": [{"mount", "motion": "x", "force_n": likewise, along its own axis}]}],
    "rms": [{"point", "direction", "acceleration_g": [...at each speed, of all orders]}], "force_rms":
    [{"mount", "motion", "force_n": likewise}]}`.

    Args:
        vehicle: with the mount rates.
        results: of one of its engines.
    """
    places = [
        (i, axis, {"point": point.name, "direction": direction})
        for i, point in enumerate(vehicle.response_points)
        for direction, axis in AXIS.items()
    ]
    mounts = [
        (i, axis, {"mount": mount.name, "motion": motion})
        for i, mount in enumerate(vehicle.mounts)
        for axis, motion in enumerate(ALONG)
    ]
    return {
        "vehicle": vehicle.name,
        "rates": rates_record(vehicle),
        "engine": results.engine.name,
        "idle_rpm": PER_MINUTE * results.engine.idle_hz,
        "speeds_rpm": (PER_MINUTE * results.speed_hz).tolist(),
        "orders": [
            {
                "order": order.order,
                "responses": [
                    {**place, "acceleration_g": _values(results.acceleration_g[:, number, i, axis])}
                    for i, axis, place in places
                ],
                "forces": [
                    {**place, "force_n": _values(np.abs(results.force[:, number, i, axis]))}
                    for i, axis, place in mounts
                ],
            }
            for number, order in enumerate(results.engine.orders)
        ],
        "rms": [
            {**place, "acceleration_g": results.rms[:, i, axis].tolist()} for i, axis, place in places
        ],
        "force_rms": [
            {**place, "force_n": results.force_rms[:, i, axis].tolist()} for i, axis, place in mounts
        ],
    }


def _values(peaks: np.ndarray) -> list[float | None]:
    return [None if np.isnan(value) else float(value) for value in peaks]


def engine_table(vehicle: Vehicle, results: EngineResults) -> str:
    """The orders at idle and the RMS of all over speed at points, then forces of mounts.

    Arguments as of `engine_record`.
    """
    parts = []
    if vehicle.response_points:
        parts.append(_idle_table(vehicle, results))
        if len(results.speed_hz) > 1:
            parts.append(_speed_table(vehicle, results))
    if vehicle.mounts:
        header = [f"RMS of all orders, N, along its own axes, {_idle(results)}", *force_columns()]
        parts.append(table(header, force_rows(results)))
    return "\n\n".join([*parts, *_beyond(vehicle, results)])


def _idle(results: EngineResults) -> str:
    return f"at {PER_MINUTE * results.speed_hz[results.idle]:.4g} rpm"


def _idle_table(vehicle: Vehicle, results: EngineResults) -> str:
    what = f"{results.engine.name} {_idle(results)}: peak, 0.001 g"
    return table([what, "Hz", *_places(vehicle)], order_rows(results))


def force_columns() -> list[str]:
    """The header of `force_rows` but for its first column."""
    return [*ALONG, *(f"largest {motion}" for motion in ALONG)]


def force_rows(results: EngineResults) -> list[list[str]]:
    """The RMS of the force of each mount under all orders at idle, and its largest at any speed, N."""
    rms = results.force_rms[..., : len(ALONG)]
    both = np.hstack([rms[results.idle], rms.max(axis=0)])
    return [
        [mount.name, *(f"{value:.2f}" for value in row)]
        for mount, row in zip(results.vehicle.mounts, both.tolist(), strict=True)
    ]


def order_rows(results: EngineResults) -> list[list[str]]:
    """Each order at idle, its frequency and peaks, 0.001 g, and the RMS of all."""
    at = results.idle
    rows = [
        [
            f"order {order.order:g}",
            f"{order.order * results.speed_hz[at]:.4g}",
            *_cells(results.acceleration_g[at, number]),
        ]
        for number, order in enumerate(results.engine.orders)
    ]
    return [*rows, ["RMS of all", "", *_cells(results.rms[at])]]


def _speed_table(vehicle: Vehicle, results: EngineResults) -> str:
    return table(["rpm: RMS of all orders, 0.001 g", *_places(vehicle)], speed_rows(results))


def speed_rows(results: EngineResults) -> list[list[str]]:
    """The RMS of all orders, 0.001 g, at idle and some `MOST_SPEEDS` of the speeds."""
    n = len(results.speed_hz)
    shown = sorted({*range(0, n, -(-n // MOST_SPEEDS)), results.idle, n - 1})
    return [[f"{PER_MINUTE * results.speed_hz[i]:.4g}", *_cells(results.rms[i])] for i in shown]


def _places(vehicle: Vehicle) -> list[str]:
    return [f"{point.name} {direction}" for point in vehicle.response_points for direction in AXIS]


def _beyond(vehicle: Vehicle, results: EngineResults) -> list[str]:
    """A sentence on orders that leave the band, if some do."""
    is_beyond = ~results.in_band.all(axis=0)
    names = [f"{results.engine.orders[i].order:g}" for i in np.flatnonzero(is_beyond)]
    if not names:
        return []
    return [
        f"Order {listed(names)}: left out at speeds at which it is beyond the vehicle's band, which "
        f"ends at {vehicle.highest_frequency:g} Hz (highest_frequency in vehicle.toml)."
    ]


def _cells(peaks: np.ndarray) -> list[str]:
    """0.001 g of each point along `AXIS`; a dash beyond the band."""
    along = 1000 * peaks[:, list(AXIS.values())].ravel()
    return ["-" if np.isnan(value) else f"{value:.2f}" for value in along]
