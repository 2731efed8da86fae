"""The report's section on mounts whose rates depend on frequency; empty where there are none."""

from html import escape

import numpy as np

from modeviz.analysis.results import AXIS
from modeviz.analysis.rubber import (
    RubberCurve,
    about_rubber,
    dynamic_groups,
    measured_points,
    rubber_curve,
)
from modeviz.report.charts import BASE, NOW, Curve, line_chart
from modeviz.report.comparison import Comparison
from modeviz.text.axes import Axis, round_top
from modeviz.text.markup import note, section, title
from modeviz.units import factor
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DIRECTIONS

N_LINES = 200
SIZE = (900, 220)
VARIES = 1e-9
"""Of a rate: what changes less over the band does not depend on frequency."""


def rubber(comparison: Comparison) -> str:
    """Return dynamic stiffness and loss angle with both sets, along directions in which they vary."""
    groups = dynamic_groups(comparison.vehicle)
    if not groups:
        return ""
    parts = [part for group in groups for part in _group(comparison, group)]
    return section(
        "Rubber over frequency",
        note(
            "Dynamic stiffness and loss angle of a mount along its own axes, as modes and responses "
            "take them. Both scale with the rates; points are lines of its table, on the first set."
        ),
        *parts,
    )


def _group(comparison: Comparison, group: MountGroup) -> list[str]:
    base, now = comparison.base, comparison.now
    points = measured_points(base.prepared, base.rates, group.name)
    high = comparison.vehicle.highest_frequency
    measured = np.zeros(0) if points is None else points.frequency_hz
    f = np.union1d(np.linspace(0, high, N_LINES + 1)[1:], measured[(measured > 0) & (measured <= high)])
    curves = [rubber_curve(r.prepared, r.rates, group.name, f) for r in (base, now)]
    varying = [d for d in DIRECTIONS if _varies(curves[0], AXIS[d])] or [DIRECTIONS[0]]
    at = np.flatnonzero(np.isin(f, measured))
    figures = [_figures(comparison, group, d, curves, at) for d in varying]
    return [f"<h3>{title(group.title)}</h3>", note(escape(about_rubber(group))), *figures]


def _varies(curve: RubberCurve, axis: int) -> bool:
    rates = curve.rates[:, axis]
    return bool(np.ptp(np.abs(rates / rates[0])) > VARIES or np.ptp(np.angle(rates)) > VARIES)


def _figures(
    comparison: Comparison,
    group: MountGroup,
    direction: str,
    curves: list[RubberCurve],
    at: np.ndarray,
) -> str:
    """The two charts of one direction, with points at some of the frequencies."""
    axis, per_mm = AXIS[direction], factor("N/mm", "stiffness")
    charts = (
        ("Dynamic stiffness, N/mm", [curve.stiffness[:, axis] / per_mm for curve in curves]),
        ("Loss angle, °", [np.degrees(curve.loss_angle[:, axis]) for curve in curves]),
    )
    x = Axis("Frequency, Hz", 0, comparison.vehicle.highest_frequency)
    found = []
    for what, values in charts:
        base, now = (
            Curve(name, curve.frequency_hz, y, color, width, points=points)
            for name, curve, y, color, width, points in zip(
                comparison.names, curves, values, (BASE, NOW), (1.6, 2.2), (at, ()), strict=True
            )
        )
        y = Axis(what, 0, round_top(1.05 * max(value.max() for value in values)))
        heading = f"{group.name}, {direction}: {what}"
        svg = line_chart([base, now], x, y, heading, *SIZE)
        found.append(f"<figure>{svg}<figcaption>{escape(heading)}</figcaption></figure>")
    return "".join(found)
