"""Results as text tables for a terminal."""

from collections.abc import Mapping, Sequence

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.mode_tracking import Followed
from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.wheel_results import WheelResults
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.dynamics.tracking import WEAK_MAC
from modeviz.errors import listed
from modeviz.report.components import believed
from modeviz.report.coverage import band_text, coverage_note
from modeviz.ride.participation import Peak
from modeviz.ride.psd import amplitude_decibels, power_decibels
from modeviz.text.wording import scientific
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle

WHEEL_BAND = (11.0, 16.0)
"""Hz: over which the paper's Tables 5 and 6 take their means."""


def wheel_band(vehicle: Vehicle) -> tuple[float, float]:
    """The paper's band of wheel loads, or all of a vehicle's band that does not hold it, Hz."""
    low, high = vehicle.frequency_step, vehicle.highest_frequency
    return WHEEL_BAND if high >= WHEEL_BAND[1] else (low, high)


def table(header: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Columns lined up, the first to the left and the others to the right."""
    cells = [[" ".join(cell.splitlines()) for cell in row] for row in (header, *rows)]
    widths = [max(len(row[i]) for row in cells) for i in range(len(header))]
    lines = [
        "  ".join(
            [row[0].ljust(widths[0]), *(c.rjust(w) for c, w in zip(row[1:], widths[1:], strict=True))]
        )
        for row in cells
    ]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def modes_table(followed: Followed, below_hz: float) -> str:
    """Name, frequency, damping, what moves and is strained most, and which mode each was.

    A "~" marks a name that fits weakly; percent stand where a shape was in several modes.
    """
    results = followed.now
    rows = [
        [
            f"{i + 1:3d}  {results.names[i].spoken}",
            f"{f:.2f}",
            f"{100 * results.modes.damping_ratio[i]:.1f}",
            largest(results.kinetic_energy, i),
            largest(results.strain_energy, i),
            came_from(followed, i),
        ]
        for i, f in enumerate(results.modes.frequency_hz)
        if f < below_hz
    ]
    header = ["  #  mode", "Hz", "damping %", "moves most", "strained most", "was originally"]
    components = "".join(f"\n  {words}" for words in believed(results))
    return f"{table(header, rows)}\n\n{health(results)}{components}"


def came_from(followed: Followed, mode: int) -> str:
    """Names and frequencies of the modes with the vehicle's own rates that had this one's shape."""
    base, sources = followed.base, followed.track.sources(mode)
    said = [f"{base.names[i].name} {base.modes.frequency_hz[i]:.2f}" for i, _ in sources]
    if not sources or sources[0][1] >= WEAK_MAC:
        return ", ".join(said) or "-"
    return ", ".join(f"{100 * m:.0f} % {was}" for (_, m), was in zip(sources, said, strict=True))


def health(results: ModalResults) -> str:
    """A sentence on whether a mode may be missing, and on how exact those found are."""
    f, trust = results.modes.frequency_hz, results.trust
    missed = f"{trust.n_missed} missed" if trust.n_missed else "none missed"
    worst = float(trust.frequency_error_hz[f > RESOLVED_HZ].max(initial=0.0))
    return (
        f"{len(f)} modes below {results.prepared.basis.top_hz:.4g} Hz, {missed}; "
        f"natural frequencies within {scientific(worst)} Hz of exact for the model as given"
        + "".join(f"; {words}" for words in own_frequencies(results.vehicle))
    )


def own_frequencies(vehicle: Vehicle) -> list[str]:
    """Words on mounts whose rates depend on frequency, if there are some."""
    groups = [group for group in vehicle.mount_groups if group.dynamic]
    if not groups:
        return []
    at = sorted({group.dynamic.reference_hz for group in groups if group.dynamic})
    names = listed(group.name for group in groups)
    return [
        f"rates of {names} depend on frequency and are given at {listed(f'{f:g}' for f in at)} Hz: "
        "each mode has those at its own"
    ]


def psd_table(results: Results) -> str:
    """RMS at every response point, the rating, and the peaks at the first point with their modes."""
    points = results.vehicle.response_points
    rms = table(
        [f"RMS {band_text(results)}, g", *AXIS],
        [
            [point.name, *(f"{results.rms[i, axis]:.4f}" for axis in AXIS.values())]
            for i, point in enumerate(points)
        ],
    )
    peaks = table(
        [f"peaks at {points[0].name}", "Hz", "dB re 1 g²/Hz", "modes in it"],
        [
            [
                direction,
                f"{peak.frequency_hz:.1f}",
                f"{power_decibels(np.array(peak.level)):.1f}",
                _modes_in(results, peak),
            ]
            for direction in RIDE_DIRECTIONS
            for peak in results.peaks(0, direction)
        ],
    )
    parts = [rms, coverage_note(results), _rating(results), peaks]
    return "\n\n".join(filter(None, parts))


def wheels_table(vehicle: Vehicle, results: WheelResults) -> str:
    """Mean peak acceleration at each point for each load, as the paper's Tables 5 and 6.

    In brackets the highest in that band, dB re 1 g.
    """
    low, high = wheel_band(vehicle)
    means = results.mean((low, high)) * 1000
    inside = (results.frequency_hz >= low) & (results.frequency_hz <= high)
    highest = amplitude_decibels(results.acceleration_g[inside].max(axis=0))
    blocks = [
        table(
            [f"{point.name}, {low:g} to {high:g} Hz: mean, 0.001 g (highest, dB re 1 g)", *AXIS],
            [
                [
                    load.name,
                    *(f"{means[i, j, axis]:.2f} ({highest[i, j, axis]:.1f})" for axis in AXIS.values()),
                ]
                for i, load in enumerate(vehicle.harmonic_loads)
            ],
        )
        for j, point in enumerate(vehicle.response_points)
    ]
    return "\n\n".join(blocks)


def _rating(results: Results) -> str:
    rating = results.rating
    x, y, z = rating.weighted_rms
    lines = [
        f"A = {rating.combined_g:.4f} g, MPR = {rating.mean_personal_rating:.2f}"
        + (f" ({rating.note})" if rating.note else ""),
        f"ISO 2631-1 weighted: x {x:.3f}, y {y:.3f}, z {z:.3f}, total {rating.weighted_total:.3f} m/s²",
    ]
    return "\n".join(lines)


def largest(energy: Mapping[str, Floats], mode: int) -> str:
    """Return what has most of a mode's energy, and how much."""
    share, name = max(((share[mode], name) for name, share in energy.items()), default=(0.0, ""))
    return f"{name} {100 * share:.0f} %" if share > 0 else "-"


def _modes_in(results: Results, peak: Peak) -> str:
    return ", ".join(f"{results.part_name(c.mode)} {c.ratio:.2f}" for c in peak.contributors)
