"""Results of scattered mounts as plain values for JSON and as text tables."""

import numpy as np

from modeviz.analysis.results import AXIS
from modeviz.report.optimum import objective_words, tolerance_words
from modeviz.report.records import Record
from modeviz.report.tables import table
from modeviz.scatter.driving import Scattered
from modeviz.scatter.monte_carlo import Scatter, rating_of
from modeviz.text.wording import MINUS, percent_change, significant
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS

PERCENT = (5, 50, 95)


def scatter_record(told: Scattered) -> Record:
    """The result of scattered mounts as plain values for JSON.

    `{"road", "speed_m_per_s", "point", "samples", "seed", "tolerance": {"rates", "loss_factor"},
    "goal", "quantities": {NAME: {"nominal", "mean", "p5", "p50", "p95"}}, "psd": {"frequency_hz",
    DIRECTION: {"p5": [...g²/Hz], "p50", "p95"}}, "worst_corner": {"goal", "mounts": [{"mount",
    "hardness", "loss_factor"}]}, "contributions": [{"mount", "hardness", "loss_factor"}], "rest",
    "psd_error", "goal_error"}`; the names are rms_lateral_g, rms_vertical_g, mean_personal_rating and
    goal; a corner has 1 at the upper and -1 at the lower end of a tolerance; contributions are parts of
    the goal's variance, null of too few samples; errors are how far PSDs and goal are off,
    relative and at worst, of the vehicles that were also solved at all frequencies.
    """
    result = told.scatter
    return {
        "road": told.conditions.road,
        "speed_m_per_s": told.conditions.speed,
        "point": result.points[0],
        "samples": len(result.goal),
        "seed": told.seed,
        "tolerance": dict(vars(result.parts.tolerance)),
        "goal": objective_words(told.problem),
        "quantities": {
            name: {"nominal": nominal, "mean": float(values.mean()), **_percentiles(values)}
            for name, (nominal, values) in _quantities(result).items()
        },
        "psd": {"frequency_hz": result.frequency_hz.tolist(), **_bands(result)},
        "worst_corner": {"goal": told.worst.goal, "mounts": _by_mount(told, told.worst.deviations)},
        "contributions": _by_mount(told, told.spread.shares) if told.spread else None,
        "rest": told.spread.rest if told.spread else None,
        "psd_error": result.psd_error,
        "goal_error": result.goal_error,
    }


def scatter_table(told: Scattered) -> str:
    """Ride and goal with their percentiles, and of each mount what it does to the goal."""
    result, tolerance = told.scatter, told.scatter.parts.tolerance
    rows = [
        [name.replace("_", " "), *map(_significant, (nominal, values.mean()))]
        + [_significant(v) for v in _percentiles(values).values()]
        for name, (nominal, values) in _quantities(result).items()
    ]
    head = f"{len(result.goal)} vehicles on {told.conditions.road}, {tolerance_words(tolerance)}"
    worse = percent_change(told.worst.goal, result.nominal_goal)
    return "\n\n".join(
        [
            head,
            table([result.points[0], "as drawn", "mean", "5 %", "50 %", "95 %"], rows),
            f"goal: {objective_words(told.problem)}\n"
            f"worst corner of the tolerances: {significant(told.worst.goal)}, {worse}",
            _mounts_table(told),
        ]
    )


def _quantities(result: Scatter) -> dict[str, tuple[float, Floats]]:
    """Each quantity at the first point: its value with parts as drawn, and those of the samples."""
    rms = {
        f"rms_{d}_g": (float(result.nominal_rms[0, AXIS[d]]), result.rms[:, 0, AXIS[d]])
        for d in RIDE_DIRECTIONS
    }
    rating = float(rating_of(result.nominal_rms)[0]), result.mean_personal_rating
    return {**rms, "mean_personal_rating": rating, "goal": (result.nominal_goal, result.goal)}


def _percentiles(values: Floats) -> dict[str, float]:
    found = np.percentile(values, PERCENT)
    return {f"p{p}": float(value) for p, value in zip(PERCENT, found, strict=True)}


def _bands(result: Scatter) -> Record:
    bands = result.psd_percentiles(PERCENT)[:, :, 0]
    return {
        d: {f"p{p}": band[:, AXIS[d]].tolist() for p, band in zip(PERCENT, bands, strict=True)}
        for d in RIDE_DIRECTIONS
    }


def _by_mount(told: Scattered, of_deviations: Floats) -> list[Record]:
    """A value of the hardness and one of the loss factor of every mount."""
    pairs = zip(told.scatter.parts.names, *np.split(of_deviations, 2), strict=True)
    return [{"mount": n, "hardness": float(k), "loss_factor": float(g)} for n, k, g in pairs]


def _mounts_table(told: Scattered) -> str:
    """At which end of its tolerance a mount is at worst, and its part of the spread."""
    worst = _by_mount(told, told.worst.deviations)
    rows = [
        [str(w["mount"]), _end(w["hardness"], "hard", "soft"), _end(w["loss_factor"], "more", "less")]
        for w in worst
    ]
    header = ["mount", "at worst", "loss at worst"]
    if told.spread is None:
        return f"{table(header, rows)}\n\ntoo few samples to tell which mounts make the spread"
    for row, share in zip(rows, _by_mount(told, told.spread.shares), strict=True):
        row += [f"{100 * share[key]:.1f} %" for key in ("hardness", "loss_factor")]
    rows.append(["several together", "", "", f"{100 * told.spread.rest:.1f} %", ""])
    return table([*header, "hardness, of the spread", "loss, of the spread"], rows)


def _end(value: float, upper: str, lower: str) -> str:
    return upper if value > 0 else lower


def _significant(value: float) -> str:
    """A number to four digits."""
    return significant(value) if value >= 0 else MINUS + significant(-value)
