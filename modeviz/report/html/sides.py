"""Both sets of rates side by side: accelerations as charts and tables."""

from collections.abc import Sequence
from html import escape
from math import isnan

from modeviz.analysis.results import AXIS
from modeviz.report.charts import BASE, NOW, Curve, line_chart
from modeviz.report.comparison import Comparison
from modeviz.text.axes import Axis, decibel_axis, shown_hz
from modeviz.text.markup import NONE, change, table, title
from modeviz.text.wording import number
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import DIRECTIONS


def chart(
    comparison: Comparison,
    frequency_hz: Sequence[Floats],
    levels: Sequence[Floats],
    peaks: Sequence[Sequence[int]],
    heading: str,
    unit: str,
) -> str:
    """A figure of two curves whose peaks are marked.

    Args:
        comparison: whose sets of rates they are.
        frequency_hz: (n_freqs,) of each set.
        levels: (n_freqs,) of each set, dB.
        peaks: the lines of each set's peaks.
        heading: what is drawn, as HTML.
        unit: of the levels.
    """
    low, high = shown_hz(comparison.vehicle.highest_frequency)
    styles = zip(comparison.names, frequency_hz, levels, (BASE, NOW), (1.6, 2.2), peaks, strict=True)
    curves = [Curve(*style) for style in styles]
    shown = [c.y[(c.x >= low) & (c.x <= high)] for c in curves]
    y = decibel_axis(unit, [level for level in shown if len(level)] or list(levels))
    svg = line_chart(curves, Axis("Frequency, Hz", low, high), y, heading, 900, 270)
    return f"<figure>{svg}<figcaption>{escape(heading)}; peaks in Hz</figcaption></figure>"


def by_direction(
    comparison: Comparison,
    names: Sequence[str],
    base: Floats,
    now: Floats,
    decimals: int,
    common: float | None = None,
) -> str:
    """A table of accelerations.

    Args:
        comparison: whose sets of rates they are.
        names: of the rows.
        base: (n_rows, 3): x, y, z with the first set.
        now: with the second.
        decimals: of the accelerations.
        common: if given, changes are also told in percent of this.
    """

    def cells(before: float, after: float) -> list[str]:
        found = compared((before, after), decimals)
        return found if common is None else [*found, change(common + after - before, common)]

    rows = [
        [title(name), *(c for d in DIRECTIONS for c in cells(base[i, AXIS[d]], now[i, AXIS[d]]))]
        for i, name in enumerate(names)
    ]
    columns = [*map(escape, comparison.names), "Change", *([] if common is None else ["of largest"])]
    groups = [("", 1), *((direction.capitalize(), len(columns)) for direction in DIRECTIONS)]
    return table(["", *columns * len(DIRECTIONS)], rows, groups)


def compared(values: Sequence[float], decimals: int) -> list[str]:
    """Base, now and the change, of what had better be less; no base where that is no number."""
    base, now = values
    if isnan(base):
        return [NONE, number(now, decimals), NONE]
    return [number(base, decimals), number(now, decimals), change(now, base)]
