"""Where the modes of an accepted set of rates go when rates move."""

import numpy as np

from modeviz.dynamics.basis import band_modes
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.tracking import Track, follow, start_track
from modeviz.tuning.results import ModalResults
from modeviz.vehicle.arrays import Complexes

FOLLOWED_HZ = 25.0
"""Modes below are followed in steps as small as their shapes need; above, mounts do little."""


def accept(results: ModalResults) -> Track:
    """A track that starts at the modes of these rates."""
    f = results.modes.frequency_hz
    return start_track(results.prepared.system, results.modes, int((f < FOLLOWED_HZ).sum()))


def follow_rates(track: Track, before: ModalResults, now: ModalResults) -> Track:
    """The track led on from the rates of `before`, where it is, to those of `now`.

    Between them every rate goes in equal ratios, or in equal steps where one of both is zero.
    """
    prepared = now.prepared
    start, end = (prepared.mount_stiffness(r.rates) for r in (before, now))

    def between(part: float) -> Modes:
        return band_modes(prepared.basis, _part_way(start, end, part)).modes

    return follow(track, now.modes, between)


def _part_way(start: Complexes, end: Complexes, part: float) -> Complexes:
    """Rates between two sets, all of one loss factor."""
    both = (start != 0) & (end != 0)
    ratio = np.where(both, np.abs(end) / np.where(both, np.abs(start), 1.0), 1.0)
    return np.where(both, start * ratio**part, start + part * (end - start))
