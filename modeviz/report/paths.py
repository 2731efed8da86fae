"""Paths to a response as a table for a terminal and as plain values."""

from dataclasses import dataclass

import numpy as np

from modeviz.analysis.forces import LoadedForces
from modeviz.mounting.paths import By, Paths
from modeviz.report.forces import band
from modeviz.report.records import Record, rates_record
from modeviz.report.tables import table
from modeviz.ride.participation import peak_lines
from modeviz.text.wording import number
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import ResponsePoint

N_PEAKS = 3
"""How many of a response's highest peaks have a column."""

SUMMED: tuple[By, ...] = ("mount", "body", "group")
"""How shares are added up in plain values."""

LEAST_SHOWN = 0.005
"""Share of a response, below which a path is not listed."""


@dataclass(frozen=True, eq=False)
class PointPaths:
    """The paths to one response of a vehicle under a load."""

    found: LoadedForces
    point: ResponsePoint
    direction: str
    """One of `DIRECTIONS`."""
    paths: Paths

    @property
    def acceleration(self) -> Complexes:
        """Of each path per unit of input, (n_freqs, n_paths, n_inputs), g."""
        omega = 2 * np.pi * self.paths.frequency_hz[:, None, None]
        return -(omega**2) * self.paths.parts / STANDARD_GRAVITY

    @property
    def level(self) -> Floats:
        """Of the response, (n_freqs,): acceleration PSD, g²/Hz, or peak acceleration, g."""
        power = self.found.spectra.psd(self.acceleration.sum(axis=1, keepdims=True))[:, 0]
        return power if self.found.is_random else np.sqrt(power)

    def highest(self) -> list[int]:
        """The numbers of the lines of the highest peaks, rising; the highest line if there is none."""
        level = self.level
        power = level if self.found.is_random else level**2
        peaks = peak_lines(power) or [int(np.argmax(power))]
        return sorted(sorted(peaks, key=lambda i: -level[i])[:N_PEAKS])


def paths_record(paths: PointPaths) -> Record:
    """The paths to a response.

    `{"vehicle", "rates": see rates_record, "load", "is_random", "speed_m_per_s", "point", "direction",
    "body", "frequency_hz": [...], "response": [...], "paths": [{"connection", "group", "body",
    "direction", "share": [...], "alone": [...], "overall_share", "phasor": {"amplitude_g": [...],
    "phase_deg": [...]} or null}], "by_mount", "by_body", "by_group": {name: overall share}}`.

    The response is in g²/Hz, under a harmonic load the peak in g. Shares add up to one at each
    frequency; `alone` is the root of a path's own power over the response's. Phasors are those of a
    harmonic load.
    """
    found, its = paths.found, paths.paths
    shares, alone = its.shares(found.spectra), its.alone(found.spectra)
    overall = its.total_shares(found.spectra)
    phasors = None if found.is_random else paths.acceleration[:, :, 0]
    return {
        "vehicle": found.vehicle.name,
        "rates": rates_record(found.vehicle),
        "load": found.load.name,
        "is_random": found.is_random,
        "speed_m_per_s": found.speed,
        "point": paths.point.name,
        "direction": paths.direction,
        "body": paths.point.body,
        "frequency_hz": its.frequency_hz.tolist(),
        "response": paths.level.tolist(),
        "paths": [
            {
                "connection": path.connection,
                "group": path.group,
                "body": path.body,
                "direction": path.direction,
                "share": shares[:, i].tolist(),
                "alone": alone[:, i].tolist(),
                "overall_share": float(overall[i]),
                "phasor": None if phasors is None else _phasor(phasors[:, i]),
            }
            for i, path in enumerate(its.paths)
        ],
        **{f"by_{by}": overall_shares(paths, by) for by in SUMMED},
    }


def _phasor(acceleration: Complexes) -> Record:
    phase = np.degrees(np.angle(acceleration))
    return {"amplitude_g": np.abs(acceleration).tolist(), "phase_deg": phase.tolist()}


def overall_shares(paths: PointPaths, by: By) -> dict[str, float]:
    """The share of each path in the mean square over all lines, by what it is called."""
    together = paths.paths.together(by)
    shares = together.total_shares(paths.found.spectra)
    return {path.called(by): float(s) for path, s in zip(together.paths, shares, strict=True)}


def paths_table(paths: PointPaths, by: By) -> str:
    """The share of each path in the response, the largest first, over all and at the highest peaks.

    Under a harmonic load at these alone, with amplitude and phase.
    """
    together = paths.paths.together(by)
    columns = _columns(paths, together)
    names = [path.called(by) for path in together.paths]
    first = next(iter(columns.values()))[0]
    order = [i for i in np.argsort(-np.abs(first)) if _is_worth_listing(columns, i)]
    rows = [[names[i], *(words[i] for _, words in columns.values())] for i in order]
    heading = f"{paths.direction} acceleration at {paths.point.name}, {paths.found.load.name}"
    told = f"{heading}: shares, {band(paths.found)}"
    return table([told, *columns], [*rows, ["all", *(_whole(s) for s, _ in columns.values())]])


def _columns(paths: PointPaths, together: Paths) -> dict[str, tuple[Floats, list[str]]]:
    """Shares (n_paths,) and how each is written, by the heading of a column."""
    spectra = paths.found.spectra
    shares, columns = together.shares(spectra), {}
    if paths.found.is_random and len(together.frequency_hz) > 1:
        overall = together.total_shares(spectra)
        columns["over all"] = overall, [_percent(share) for share in overall]
    phasors = PointPaths(paths.found, paths.point, paths.direction, together).acceleration[:, :, 0]
    for line in paths.highest():
        words = [_percent(share) for share in shares[line]]
        if not paths.found.is_random:
            words = [f"{w} {_polar(p)}" for w, p in zip(words, phasors[line], strict=True)]
        columns[f"{together.frequency_hz[line]:.2f} Hz"] = shares[line], words
    return columns


def _is_worth_listing(columns: dict[str, tuple[Floats, list[str]]], i: int) -> bool:
    return any(abs(shares[i]) >= LEAST_SHOWN for shares, _ in columns.values())


def _percent(share: float) -> str:
    return f"{number(100 * share, 1)} %"


def _whole(shares: Floats) -> str:
    return _percent(float(shares.sum()))


def _polar(acceleration: complex) -> str:
    degrees = number(float(np.degrees(np.angle(acceleration))), 0)
    return f"({1000 * abs(acceleration):.3g} mg, {degrees}°)"
