"""What a report says of accelerations; a section that has nothing to say is empty."""

from collections.abc import Sequence
from html import escape

from modeviz.export.axes import Axis, decibel_axis
from modeviz.export.charts import BASE, NOW, Curve, line_chart
from modeviz.export.markup import change, note, section, table, title
from modeviz.export.tables import WHEEL_BAND
from modeviz.export.wording import number, signed
from modeviz.ride.psd import power_decibels
from modeviz.tuning.comparison import Comparison
from modeviz.tuning.results import AXIS, Results
from modeviz.vehicle.arrays import Floats

SHOWN_HZ = (1.0, 25.0)
"""What is drawn, and whose peaks are listed."""

DIRECTIONS = ("lateral", "vertical", "fore-aft")
"""In the order of the paper's figures."""


def spectra(comparison: Comparison) -> str:
    """Acceleration spectra at the driver's point, both sets in each chart."""
    rides = comparison.rides
    if rides is None:
        return ""
    point = comparison.vehicle.response_points[0].name
    charts = "".join(_spectrum(comparison.names, rides, direction) for direction in DIRECTIONS)
    return section(f"Acceleration at {escape(point)}", charts)


def _spectrum(names: tuple[str, str], rides: tuple[Results, Results], direction: str) -> str:
    f = rides[0].frequency_hz
    shown = (f >= SHOWN_HZ[0]) & (f <= SHOWN_HZ[1])
    levels = [power_decibels(r.response(0, direction)) for r in rides]
    styles = zip(names, rides, levels, (BASE, NOW), (1.6, 2.2), strict=True)
    curves = [
        Curve(name, f, level, color, thickness, r.peak_lines(0, direction))
        for name, r, level, color, thickness in styles
    ]
    y = decibel_axis("dB re 1 g²/Hz", [level[shown] for level in levels])
    heading = f"{direction.capitalize()} acceleration PSD"
    chart = line_chart(curves, Axis("Frequency, Hz", *SHOWN_HZ), y, heading, 900, 270)
    return f"<figure>{chart}<figcaption>{heading}; peaks in Hz</figcaption></figure>"


def levels(comparison: Comparison) -> str:
    """RMS at every point and the rating of the driver's."""
    rides = comparison.rides
    if rides is None:
        return ""
    points = [p.name for p in comparison.vehicle.response_points]
    ratings = [r.rating for r in rides]
    rows = [
        ["A, lateral and vertical RMS combined", "g", *_compared([r.combined_g for r in ratings], 4)],
        [
            "Mean personal rating, 10.9 − 80 A",
            "of 10",
            *(number(r.mean_personal_rating, 2) for r in ratings),
            signed(ratings[1].mean_personal_rating - ratings[0].mean_personal_rating, 2),
        ],
        *(
            [f"ISO 2631-1 weighted, {name}", "m/s²", *_compared(values, 3)]
            for name, values in zip(
                ("fore-aft (Wd)", "lateral (Wd)", "vertical (Wk)"),
                zip(*(r.weighted_rms for r in ratings), strict=True),
                strict=True,
            )
        ),
        ["ISO 2631-1 total", "m/s²", *_compared([r.weighted_total for r in ratings], 3)],
    ]
    remarks = {r.note for r in ratings if r.note}
    return section(
        "Ride",
        "<h3>RMS acceleration, 0 to 40 Hz, g</h3>",
        _by_direction(comparison, points, *(r.rms for r in rides), decimals=4),
        f"<h3>Rating at {escape(points[0])}</h3>",
        table(["", "Unit", *map(escape, comparison.names), "Change"], rows),
        *(note(f"The mean personal rating is {escape(remark)}.") for remark in sorted(remarks)),
    )


def wheels(comparison: Comparison) -> str:
    """Mean accelerations under each wheel load, as the paper's Tables 5 and 6."""
    if comparison.wheels is None:
        return ""
    vehicle = comparison.vehicle
    loads = [load.name for load in vehicle.wheel_loads]
    means = [1000 * w.mean(WHEEL_BAND) for w in comparison.wheels]
    tables = (
        f"<h3>{title(point.name)}</h3>"
        + _by_direction(comparison, loads, *(mean[:, i] for mean in means), decimals=2)
        for i, point in enumerate(vehicle.response_points)
    )
    low, high = WHEEL_BAND
    return section(
        "Unbalance and tyre force variation",
        note(f"Mean peak acceleration from {low:g} to {high:g} Hz, 0.001 g."),
        *tables,
    )


def _by_direction(
    comparison: Comparison, names: Sequence[str], base: Floats, now: Floats, decimals: int
) -> str:
    """A table of accelerations (n_rows, 3): x, y, z with both sets of rates."""
    rows = [
        [title(name)]
        + [
            cell
            for direction in DIRECTIONS
            for cell in _compared((base[i, AXIS[direction]], now[i, AXIS[direction]]), decimals)
        ]
        for i, name in enumerate(names)
    ]
    groups = [("", 1), *((direction.capitalize(), 3) for direction in DIRECTIONS)]
    header = ["", *[*map(escape, comparison.names), "Change"] * len(DIRECTIONS)]
    return table(header, rows, groups)


def _compared(values: Sequence[float], decimals: int) -> list[str]:
    """Base, now and the change, of what had better be less."""
    base, now = values
    return [number(base, decimals), number(now, decimals), change(now, base)]
