"""Compares the built-in pickup with the paper's tables and prints it as Markdown.

    python assets/compare_with_paper.py

The numbers are those of A. E. Duncan, "Application of modal modeling and mount system optimization to
light duty truck ride analysis", Tables 1, 5 and 6; most of them were fitted, see assets/pickup.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import AXIS, Conditions, Results, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.ride.participation import Peak
from modeviz.ride.psd import rms
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import Road
from modeviz.vehicle.vehicle import Vehicle

FREQUENCIES = {
    "roll": 1.5,
    "front bounce": 1.6,
    "rear bounce": 2.1,
    "pitch": 3.4,
    "front tramp": 11.6,
    "front hop": 11.9,
    "rear tramp": 12.7,
    "rear hop": 10.0,
    "first torsion": 8.2,
    "first beaming": 8.9,
    "cab yaw": 11.7,
    "engine pitch": 12.5,
    "engine pitch and cab bounce": 14.3,
    "engine roll": 13.3,
}
"""Table 1, analysis, Hz."""

CAB_YAW_OPTIMISED = 9.8
"""Hz, after figure 15."""

ACCELERATION_FALL = 0.033
"""g: how much A falls on road 1."""

POINTS = ("seat track left", "toe panel left")
DIRECTIONS = ("lateral", "vertical")
LOADS = ("front radial force", "rear radial force", "front lateral force", "rear lateral force")
WHEEL_ACCELERATIONS = np.array(
    [
        [[[4.3, 3.2], [8.0, 6.4]], [[11.2, 5.8], [4.5, 3.0]],
         [[11.1, 9.7], [9.0, 7.9]], [[11.1, 7.2], [3.8, 3.4]]],
        [[[3.3, 3.5], [6.5, 5.8]], [[3.7, 6.0], [2.3, 1.6]],
         [[11.5, 7.7], [4.9, 4.2]], [[3.9, 8.0], [1.9, 1.5]]],
    ]
)  # fmt: skip
"""Tables 5 and 6, 0.001 g, mean 11 to 16 Hz: (points, loads, directions, original or optimised)."""

PARTICIPATION = {
    ("road 1", "vertical"): [
        (8.6, "first torsion", "first beaming", 0.69),
        (11.4, "first torsion", "first beaming", 0.46),
    ],
    ("road 1", "lateral"): [
        (8.6, "front tramp", "first torsion", 0.76),
        (13.0, "cab yaw", "rear tramp", 0.79),
    ],
    ("road 2", "vertical"): [
        (7.2, "front bounce", "first beaming", 0.88),
        (9.0, "first beaming", "first torsion", 0.59),
        (11.6, "first torsion", "front bounce", 0.74),
    ],
    ("road 2", "lateral"): [
        (9.0, "front tramp", "cab yaw", 0.60),
        (12.6, "cab yaw", "rear tramp", 0.77),
    ],
}
"""Tables 2 and 3: Hz of a response peak, its largest contributor, the next one and their ratio."""

PAPER_ROWS = [row for rows in PARTICIPATION.values() for row in rows]

WHEEL_HZ = np.arange(220, 321) / 20
LATERAL_BAND = (11.0, 17.0)


@dataclass(frozen=True, eq=False)
class Comparison:
    """Our numbers beside the paper's, with the original and the optimised rates."""

    original: Results
    optimised: Results
    wheel_accelerations: Floats
    """As `WHEEL_ACCELERATIONS`."""

    def frequency(self, name: str) -> float:
        """Natural frequency of a named mode with the original rates, Hz."""
        return _frequency(self.original, name)

    @property
    def frequency_errors(self) -> Floats:
        """(n_modes,), relative, in the order of `FREQUENCIES`."""
        return np.array([self.frequency(name) / f - 1 for name, f in FREQUENCIES.items()])

    @property
    def cab_yaw_optimised(self) -> float:
        """Hz."""
        return _frequency(self.optimised, "cab yaw")

    @property
    def acceleration_fall(self) -> float:
        """g: how much A falls on road 1."""
        before, after = (r.rating.combined_g for r in (self.original, self.optimised))
        return before - after

    @property
    def lateral_change(self) -> float:
        """Relative change of the seat's lateral RMS in `LATERAL_BAND` on road 1."""
        before, after = (
            rms(r.frequency_hz, r.response(0, "lateral"), LATERAL_BAND)
            for r in (self.original, self.optimised)
        )
        return float(after / before - 1)

    @cached_property
    def contributors(self) -> tuple[Mapping[str, float], ...]:
        """For each of `PAPER_ROWS` the modes at the paper's frequency, the largest first.

        What each has of the largest one's participation.
        """
        prepared = self.original.prepared
        rows = []
        for (road, direction), peaks in PARTICIPATION.items():
            results = solve(prepared, {}, Conditions(road, prepared.vehicle.speed))
            lines = [int(np.abs(results.frequency_hz - f).argmin()) for f, *_ in peaks]
            for peak in results.peaks(0, direction, len(results.names), lines):
                rows.append(_by_name(results, peak))
        return tuple(rows)

    @property
    def right_contributors(self) -> int:
        """How many of the 18 modes that Tables 2 and 3 name are in their place, first or second.

        At the paper's frequencies; a second one counts only behind the first one that it belongs to.
        """
        right = 0
        for ours, (_, *paper, _) in zip(self.contributors, PAPER_ROWS, strict=True):
            same = [a == b for a, b in zip(ours, paper, strict=False)]
            right += same[0] + all(same)
        return right

    @property
    def right_signs(self) -> int:
        """In how many of the 16 entries of Tables 5 and 6 the change has the paper's sign."""
        ours, paper = (np.sign(np.diff(t)) for t in (self.wheel_accelerations, WHEEL_ACCELERATIONS))
        return int((ours == paper).sum())


def compare(vehicle: Vehicle | None = None) -> Comparison:
    """Solves a vehicle, the built-in one if none is given, with both sets of rates."""
    vehicle = vehicle or read_vehicle(builtin_vehicle())
    at_wheels = prepare(vehicle, WHEEL_HZ)
    both = {}, vehicle.rate_sets["optimised"]
    before, after = (_wheel_accelerations(at_wheels, rates) for rates in both)
    return _on_roads(prepare(vehicle), np.stack([before, after], axis=-1))


def on_other_roads(comparison: Comparison, roads: tuple[Road, ...]) -> Comparison:
    """The same vehicle on roads of the same names."""
    prepared = comparison.original.prepared
    vehicle = replace(prepared.vehicle, roads=roads)
    system = replace(prepared.system, vehicle=vehicle)
    return _on_roads(replace(prepared, system=system), comparison.wheel_accelerations)


def _on_roads(prepared: Prepared, wheel_accelerations: Floats) -> Comparison:
    vehicle = prepared.vehicle
    road_1 = Conditions("road 1", vehicle.speed)
    before, after = (solve(prepared, r, road_1) for r in ({}, vehicle.rate_sets["optimised"]))
    return Comparison(before, after, wheel_accelerations)


def _frequency(results: Results, name: str) -> float:
    mode = results.mode_index(name)
    if mode is None:
        raise ValueError(f"no mode is called {name!r}")
    return float(results.modes.frequency_hz[mode])


def _wheel_accelerations(prepared: Prepared, rates) -> Floats:
    """(points, loads, directions), 0.001 g, of the left wheels' force variations."""
    vehicle = prepared.vehicle
    means = 1000 * solve_wheels(prepared, rates).mean((WHEEL_HZ[0], WHEEL_HZ[-1]))
    loads = [w.name for w in vehicle.wheel_loads]
    points = [p.name for p in vehicle.response_points]
    rows = [loads.index(name.replace(" ", " left ", 1)) for name in LOADS]
    columns = [points.index(name) for name in POINTS]
    axes = [AXIS[d] for d in DIRECTIONS]
    return means[np.ix_(rows, columns, axes)].transpose(1, 0, 2)


def markdown(comparison: Comparison) -> str:
    """The tables for the README: what was fitted, then what was not."""
    return "\n\n".join("\n".join(table(comparison)) for table in (_fitted, _wheels, _participation))


def _fitted(comparison: Comparison) -> list[str]:
    rows = [
        (f"{name.capitalize()} (Table 1)", "Hz", paper, comparison.frequency(name))
        for name, paper in FREQUENCIES.items()
    ]
    rows += [
        ("Cab yaw, optimised rates", "Hz", CAB_YAW_OPTIMISED, comparison.cab_yaw_optimised),
        ("Road 1: fall of A", "0.001 g", 1000 * ACCELERATION_FALL, 1000 * comparison.acceleration_fall),
    ]
    return [
        "| Quantity | Unit | Paper | Ours | Difference |",
        "|---|---|---:|---:|---:|",
        *(f"| {n} | {u} | {p:.2f} | {o:.2f} | {_percent(o / p - 1)} |" for n, u, p, o in rows),
    ]


def _percent(difference: float) -> str:
    return f"{round(100 * difference, 1) + 0.0:+.1f} %"


def _wheels(comparison: Comparison) -> list[str]:
    points = [point.removesuffix(" left") for point in POINTS]
    header = [f"{point}, {direction}" for point in points for direction in DIRECTIONS]
    lines = [f"| Tables 5 and 6, 0.001 g | {' | '.join(header)} |", "|---" * 5 + "|"]
    for i, load in enumerate(LOADS):
        cells = [
            "{:.1f} → {:.1f} ({:.1f} → {:.1f})".format(
                *comparison.wheel_accelerations[p, i, d], *WHEEL_ACCELERATIONS[p, i, d]
            )
            for p in range(len(POINTS))
            for d in range(len(DIRECTIONS))
        ]
        lines.append(f"| {load} | {' | '.join(cells)} |")
    return lines


def _participation(comparison: Comparison) -> list[str]:
    lines = [
        "| Tables 2 and 3 | Paper: peak and its modes | Ours, at that frequency | Ours, nearest peak |",
        "|---|---|---|---|",
    ]
    prepared, rows = comparison.original.prepared, iter(comparison.contributors)
    for (road, direction), peaks in PARTICIPATION.items():
        results = solve(prepared, {}, Conditions(road, prepared.vehicle.speed))
        found = results.peaks(0, direction, 2)
        for f, first, second, ratio in peaks:
            peak = min(found, key=lambda peak, f=f: abs(peak.frequency_hz - f))
            near = _by_name(results, peak)
            cells = (
                f"{road}, {direction}",
                f"{f:.1f} Hz: {first}, {second} {ratio:.2f}",
                _largest(next(rows)),
                f"{peak.frequency_hz:.1f} Hz: {_largest(near)}",
            )
            lines.append(f"| {' | '.join(cells)} |")
    return lines


def _by_name(results: Results, peak: Peak) -> dict[str, float]:
    """The ratios of the band's modes in a peak."""
    names = results.names
    return {names[c.mode].name: c.ratio for c in peak.contributors if c.mode < len(names)}


def _largest(contributors: Mapping[str, float]) -> str:
    (first, _), (second, ratio) = list(contributors.items())[:2]
    return f"{first}, {second} {ratio:.2f}"


if __name__ == "__main__":
    print(markdown(compare()))
