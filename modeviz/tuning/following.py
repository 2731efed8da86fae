"""Where the modes of an accepted set of rates go when rates move."""

from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.band import Method, band_modes
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.tracking import Track, follow, start_track
from modeviz.tuning.preparation import PreparedModes
from modeviz.tuning.results import ModalResults, solve_modal
from modeviz.vehicle.arrays import Complexes
from modeviz.vehicle.connections import Rates

FOLLOWED_HZ = 25.0
"""Modes below are followed in steps as small as their shapes need; above, mounts do little."""


@dataclass(frozen=True, eq=False)
class Followed:
    """The modes with the vehicle's own rates, those with other rates, and where the former went."""

    base: ModalResults
    now: ModalResults
    track: Track
    """From the modes of `base` to those of `now`."""


def solve_followed(prepared: PreparedModes, rates: Rates, method: Method = "enriched") -> Followed:
    """The modes with other mount rates, and how they came from those with the vehicle's own.

    Arguments and errors as `tuning.results.solve_modal`.
    """
    base, now = (solve_modal(prepared, r, method) for r in ({}, rates))
    return Followed(base, now, follow_rates(accept(base), base, now))


def accept(results: ModalResults) -> Track:
    """A track that starts at the modes of these rates."""
    f = results.modes.frequency_hz
    return start_track(results.prepared.system, results.modes, int((f < FOLLOWED_HZ).sum()))


def follow_rates(track: Track, before: ModalResults, now: ModalResults) -> Track:
    """The track led on from the rates of `before`, where it is, to those of `now`.

    Between them every rate goes in equal ratios, or in equal steps where one of both is zero; what
    damps it does the same.
    """
    prepared = now.prepared
    start, end = (prepared.mount_stiffness(r.rates) for r in (before, now))

    def between(part: float) -> Modes:
        return band_modes(prepared.basis, _part_way(start, end, part)).modes

    return follow(track, now.modes, between)


def _part_way(start: Complexes, end: Complexes, part: float) -> Complexes:
    """Rates between two sets, real and imaginary parts each on their own way."""
    a, b = start.view(np.float64), end.view(np.float64)
    both = (a != 0) & (b != 0)
    ratio = np.where(both, b / np.where(both, a, 1.0), 1.0)
    return np.where(both, a * ratio**part, a + part * (b - a)).view(np.complex128)
