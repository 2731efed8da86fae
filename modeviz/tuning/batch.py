"""Many sets of rates at once: scatter and sweeps."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.dynamics.band import natural_frequencies
from modeviz.errors import SolveError
from modeviz.ride.psd import acceleration_psd, rms
from modeviz.ride.rating import mean_personal_rating
from modeviz.tuning.preparation import Prepared
from modeviz.tuning.results import AXIS, Conditions, drive
from modeviz.vehicle.arrays import Complexes, Floats

MEMORY = 256 * 2**20
"""Bytes that results may take at a time."""


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

    @cached_property
    def mean_personal_rating(self) -> Floats:
        """(n_sets,), at the first point."""
        driver = self.rms[:, 0]
        combined = np.hypot(driver[:, AXIS["lateral"]], driver[:, AXIS["vertical"]])
        return np.array([mean_personal_rating(float(a)) for a in combined])


def solve_many(
    prepared: Prepared, mount_stiffness: Complexes, conditions: Conditions, memory: int = MEMORY
) -> Iterator[Batch]:
    """Natural frequencies and ride of many sets of rates, a chunk after the other.

    Args:
        prepared: see `prepare`.
        mount_stiffness: (n_sets, n_springs), complex rates of every mount spring, N/m, as
            `prepared.mount_stiffness` gives of a set of rates; springs of a group may differ.
        conditions: road and speed.
        memory: bytes that a chunk and the one before it, which the caller still has, may take together;
            a chunk has one set at least. Beside them one set is solved at a time.

    Raises:
        VehicleError: a road that the vehicle does not have.
        SolveError: rates of another shape, or a set, which it names, with a rate that is negative or
            not finite or with an undamped resonance on a frequency.
    """
    _check_stiffness(mount_stiffness, len(prepared.receptances.mount_stiffness))
    f = prepared.frequency_hz
    on_road = drive(prepared, conditions)
    shape = (len(prepared.vehicle.response_points), 3)
    n_bytes = 8 * (prepared.basis.n_below + (len(f) + 1) * np.prod(shape, dtype=int))
    n_at_once = max(1, memory // (2 * n_bytes))
    for start in range(0, len(mount_stiffness), n_at_once):
        sets = mount_stiffness[start : start + n_at_once]
        frequency_hz = np.empty((len(sets), prepared.basis.n_below))
        psd = np.empty((len(sets), len(f), *shape))
        roots = np.empty((len(sets), *shape))
        for i, stiffness in enumerate(sets):
            try:
                frequency_hz[i] = natural_frequencies(prepared.basis, stiffness)
                response = on_road.receptances.response(stiffness)
            except SolveError as error:
                raise SolveError(f"set {start + i + 1}: {error}") from None
            psd[i] = acceleration_psd(f, response, on_road.spectrum).reshape(psd.shape[1:])
            roots[i] = rms(f, psd[i])
        yield Batch(start, frequency_hz, psd, roots)


def _check_stiffness(stiffness: Complexes, n_springs: int) -> None:
    """Checks that these are complex rates that springs can have."""
    if stiffness.ndim != 2 or stiffness.shape[1] != n_springs:
        raise SolveError(
            f"mount_stiffness: found shape {stiffness.shape}, expected (n_sets, {n_springs})"
        )
    wrong = np.argwhere(~np.isfinite(stiffness) | (stiffness.real < 0))
    if len(wrong):
        place, spring = wrong[0]
        raise SolveError(
            f"set {place + 1}, mount spring {spring + 1}: found a rate of "
            f"{stiffness[place, spring].real:g} N/m, expected a finite one, zero or more"
        )
