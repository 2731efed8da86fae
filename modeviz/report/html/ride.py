"""The report's sections on the road; one that has nothing to say is empty."""

from html import escape

from modeviz.analysis.results import Results
from modeviz.report.comparison import Comparison
from modeviz.report.coverage import band_text, coverage_note
from modeviz.report.html.sides import by_direction, chart, compared
from modeviz.ride.psd import power_decibels
from modeviz.text.markup import note, section, table
from modeviz.text.wording import number, signed
from modeviz.vehicle.mount_rates import DIRECTIONS


def spectra(comparison: Comparison) -> str:
    """Acceleration spectra at the driver's point, as the paper's figures 14 and 15."""
    rides = comparison.rides
    if rides is None:
        return ""
    point = comparison.vehicle.response_points[0].name
    charts = (_spectrum(comparison, rides, direction) for direction in DIRECTIONS)
    return section(f"Acceleration at {escape(point)}", *charts)


def _spectrum(comparison: Comparison, rides: tuple[Results, Results], direction: str) -> str:
    levels = [power_decibels(r.response(0, direction)) for r in rides]
    peaks = [r.peak_lines(0, direction) for r in rides]
    heading = f"{direction.capitalize()} acceleration PSD"
    return chart(comparison, [r.frequency_hz for r in rides], levels, peaks, heading, "dB re 1 g²/Hz")


def levels(comparison: Comparison) -> str:
    """RMS at every point and the rating of the driver's."""
    rides = comparison.rides
    if rides is None:
        return ""
    points = [p.name for p in comparison.vehicle.response_points]
    ratings = [r.rating for r in rides]
    rows = [
        ["A, lateral and vertical RMS combined", "g", *compared([r.combined_g for r in ratings], 4)],
        [
            "Mean personal rating, 10.9 − 80 A",
            "of 10",
            *(number(r.mean_personal_rating, 2) for r in ratings),
            signed(ratings[1].mean_personal_rating - ratings[0].mean_personal_rating, 2),
        ],
        *(
            [f"ISO 2631-1 weighted, {name}", "m/s²", *compared(values, 3)]
            for name, values in zip(
                ("fore-aft (Wd)", "lateral (Wd)", "vertical (Wk)"),
                zip(*(r.weighted_rms for r in ratings), strict=True),
                strict=True,
            )
        ),
        ["ISO 2631-1 total", "m/s²", *compared([r.weighted_total for r in ratings], 3)],
    ]
    remarks = {r.note for r in ratings if r.note}
    return section(
        "Ride",
        f"<h3>RMS acceleration, {band_text(rides[0])}, g</h3>",
        by_direction(comparison, points, *(r.rms for r in rides), decimals=4),
        f"<h3>Rating at {escape(points[0])}</h3>",
        table(["", "Unit", *map(escape, comparison.names), "Change"], rows),
        *(note(f"The mean personal rating is {escape(remark)}.") for remark in sorted(remarks)),
        *(note(f"{escape(about)}.") for about in filter(None, [coverage_note(rides[0])])),
    )
