"""Compares the built-in pickup with the paper's tables and prints it as Markdown.

    python assets/compare_with_paper.py

The numbers are those of A. E. Duncan, "Application of modal modeling and mount system optimization to
light duty truck ride analysis", Tables 1, 5 and 6; most of them were fitted, see assets/pickup.
"""

from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import System, assemble
from modeviz.ride.psd import rms
from modeviz.tuning.results import AXIS, Conditions, Results, solve, solve_wheels
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.files import builtin_vehicle, read_vehicle
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
"""Tables 5 and 6, 1000 g, mean 11 to 16 Hz: (points, loads, directions, original or optimised)."""

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
    def lateral_change(self) -> float:
        """Relative change of the seat's lateral RMS in `LATERAL_BAND` on road 1."""
        before, after = (
            rms(r.frequency_hz, r.response(0, "lateral"), LATERAL_BAND)
            for r in (self.original, self.optimised)
        )
        return float(after / before - 1)

    @property
    def right_signs(self) -> int:
        """In how many of the 16 entries of Tables 5 and 6 the change has the paper's sign."""
        ours, paper = (np.sign(np.diff(t)) for t in (self.wheel_accelerations, WHEEL_ACCELERATIONS))
        return int((ours == paper).sum())


def compare(vehicle: Vehicle | None = None) -> Comparison:
    """Solves a vehicle, the built-in one if none is given, with both sets of rates."""
    vehicle = vehicle or read_vehicle(builtin_vehicle())
    system = assemble(vehicle)
    road_1 = Conditions("road 1", vehicle.speed)
    optimised = vehicle.rate_sets["optimised"]
    before, after = (_wheel_accelerations(system, rates) for rates in ({}, optimised))
    return Comparison(
        solve(system, {}, road_1), solve(system, optimised, road_1), np.stack([before, after], axis=-1)
    )


def _frequency(results: Results, name: str) -> float:
    mode = results.mode_index(name)
    if mode is None:
        raise ValueError(f"no mode is called {name!r}")
    return float(results.modes.frequency_hz[mode])


def _wheel_accelerations(system: System, rates) -> Floats:
    """(points, loads, directions), 1000 g, of the left wheels' force variations."""
    vehicle = system.vehicle
    means = 1000 * solve_wheels(system, rates, WHEEL_HZ).mean((WHEEL_HZ[0], WHEEL_HZ[-1]))
    loads = [w.name for w in vehicle.wheel_loads]
    points = [p.name for p in vehicle.response_points]
    rows = [loads.index(name.replace(" ", " left ", 1)) for name in LOADS]
    columns = [points.index(name) for name in POINTS]
    axes = [AXIS[d] for d in DIRECTIONS]
    return means[np.ix_(rows, columns, axes)].transpose(1, 0, 2)


def markdown(comparison: Comparison) -> str:
    """The tables for the README."""
    lines = ["| Mode (Table 1) | Paper, Hz | Ours, Hz | Difference |", "|---|---:|---:|---:|"]
    for name, paper in FREQUENCIES.items():
        ours = comparison.frequency(name)
        lines.append(
            f"| {name.capitalize()} | {paper:.1f} | {ours:.2f} | {100 * (ours / paper - 1):+.1f} % |"
        )
    ours = comparison.cab_yaw_optimised
    lines.append(f"| Cab yaw, optimised rates | 9.8 | {ours:.2f} | {100 * (ours / 9.8 - 1):+.1f} % |")
    errors = comparison.frequency_errors
    before, after = (r.rating for r in (comparison.original, comparison.optimised))
    lines += [
        "",
        f"Table 1: rms {100 * np.sqrt(np.mean(errors**2)):.2f} %, "
        f"largest {100 * np.abs(errors).max():.2f} %. "
        f"Seat lateral RMS 11-17 Hz on road 1: {100 * comparison.lateral_change:+.0f} %. "
        f"A: {before.combined_g:.4f} to {after.combined_g:.4f} g, "
        f"MPR {before.mean_personal_rating:.2f} to {after.mean_personal_rating:.2f}. "
        f"Signs of Tables 5 and 6: {comparison.right_signs} of 16.",
        "",
        "| 1000 g, original to optimised | "
        + " | ".join(f"{p.removesuffix(' left')} {d}" for p in POINTS for d in DIRECTIONS)
        + " |",
        "|---|" + "---|" * 4,
    ]
    for i, load in enumerate(LOADS):
        cells = [
            "{:.1f} → {:.1f} (paper {:.1f} → {:.1f})".format(
                *comparison.wheel_accelerations[p, i, d], *WHEEL_ACCELERATIONS[p, i, d]
            )
            for p in range(2)
            for d in range(2)
        ]
        lines.append(f"| {load} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


if __name__ == "__main__":
    print(markdown(compare()))
