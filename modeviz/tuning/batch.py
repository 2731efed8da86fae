"""Many sets of rates at once: scatter and sweeps."""

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.basis import natural_frequencies
from modeviz.dynamics.reanalysis import check_stiffness
from modeviz.ride.psd import acceleration_psd, rms
from modeviz.ride.rating import mean_personal_rating as rating_of
from modeviz.ride.roads import road_spectrum, track_amplitudes
from modeviz.tuning.preparation import Prepared
from modeviz.tuning.results import AXIS, Conditions
from modeviz.vehicle.arrays import Complexes, Floats

MEMORY = 256 * 2**20
"""Bytes that the results of a chunk may take."""


@dataclass(frozen=True, eq=False)
class Batch:
    """What some of many sets of rates do."""

    start: int
    """The number of the first set, from zero."""
    frequency_hz: Floats
    """(n_sets, n_modes): natural frequencies, as many as the vehicle's own rates have in the band."""
    psd: Floats
    """(n_sets, n_freqs, n_points, 3): acceleration x, y, z of each response point, g²/Hz."""

    rms: Floats
    """(n_sets, n_points, 3), g."""
    mean_personal_rating: Floats
    """(n_sets,), at the first point."""


def solve_many(
    prepared: Prepared, mount_stiffness: Complexes, conditions: Conditions, memory: int = MEMORY
) -> Iterator[Batch]:
    """Natural frequencies and ride of many sets of rates, a chunk after the other.

    Args:
        prepared: see `prepare`.
        mount_stiffness: (n_sets, n_springs), complex rates of every mount spring, N/m, as
            `prepared.mount_stiffness` gives of a set of rates; springs of a group may differ.
        conditions: road and speed.
        memory: bytes that the results of a chunk may take; beside them one set is solved at a time.

    Raises:
        VehicleError: a road that the vehicle does not have.
        SolveError: a rate that is negative or not finite, or an undamped resonance on a frequency.
    """
    check_stiffness(mount_stiffness)
    f = prepared.frequency_hz
    spectrum = road_spectrum(prepared.vehicle.road(conditions.road), f, conditions.speed)
    amplitudes = track_amplitudes(prepared.vehicle, f, conditions.speed)
    driven = prepared.receptances.driven(amplitudes, prepared.tyre_inputs)
    n_outputs = driven.outputs.shape[2]
    chunk = max(1, memory // (8 * len(f) * max(n_outputs, 1)))
    for start in range(0, len(mount_stiffness), chunk):
        sets = mount_stiffness[start : start + chunk]
        psd = np.stack([acceleration_psd(f, driven.response(k), spectrum) for k in sets])
        by_point = psd.reshape(len(sets), len(f), -1, 3)
        roots = np.stack([rms(f, p) for p in by_point])
        combined = np.hypot(roots[:, 0, AXIS["lateral"]], roots[:, 0, AXIS["vertical"]])
        frequencies = np.stack([natural_frequencies(prepared.basis, k) for k in sets])
        yield Batch(
            start, frequencies, by_point, roots, np.array([rating_of(float(a)) for a in combined])
        )
