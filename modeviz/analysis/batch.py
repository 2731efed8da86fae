"""Many sets of rates at once: scatter and sweeps."""

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from modeviz.analysis.preparation import Prepared
from modeviz.analysis.results import AXIS, Conditions, RoadExcitation, drive, solve_spectra
from modeviz.compute.cancel import CancelToken
from modeviz.compute.runner import Runner
from modeviz.dynamics.band import natural_frequencies
from modeviz.dynamics.resonances import resonances_at
from modeviz.errors import SolveError
from modeviz.ride.psd import acceleration_psd, rms
from modeviz.ride.rating import mean_personal_rating
from modeviz.vehicle.arrays import Complexes, Floats

MEMORY = 256 * 2**20
"""Bytes that results may take at a time."""

SENT = 100
"""The most sets that are sent away at a time."""


@dataclass(frozen=True, eq=False)
class Batch:
    """What some of many sets of rates do."""

    start: int
    """The number of the first set, from zero."""
    frequency_hz: Floats
    """(n_sets, n_modes): natural frequencies, as many as the vehicle's own rates have in the band."""
    psd: Floats
    """(n_sets, n_freqs, n_points, 3): acceleration x, y, z of each response point, g²/Hz, at the lines
    of the band, which all sets share."""
    rms: Floats
    """(n_sets, n_points, 3), g: with the lines that each set's own modes want, so that they hold."""

    @cached_property
    def mean_personal_rating(self) -> Floats:
        """(n_sets,), at the first point."""
        driver = self.rms[:, 0]
        combined = np.hypot(driver[:, AXIS["lateral"]], driver[:, AXIS["vertical"]])
        return np.array([mean_personal_rating(float(a)) for a in combined])


def solve_many(
    prepared: Prepared,
    mount_stiffness: Complexes,
    conditions: Conditions,
    memory: int = MEMORY,
    runner: Runner | None = None,
) -> Iterator[Batch]:
    """Natural frequencies and ride of many sets of rates, a chunk after the other.

    Args:
        prepared: see `prepare`.
        mount_stiffness: (n_sets, n_springs), complex rates of every mount spring, N/m, as
            `prepared.mount_stiffness` gives of a set of rates; springs of a group may differ.
        conditions: road and speed.
        memory: bytes that a chunk and the one before it, which the caller still has, may take together;
            a chunk has one set at least. Beside them one set is solved at a time.
        runner: where chunks are solved, of at most `SENT` sets each, a few of them ahead of the caller;
            None: here, one set after the other.

    Raises:
        VehicleError: a road that the vehicle does not have.
        SolveError: rates of another shape, or a set, which it names, with a rate that is negative or
            not finite or with an undamped resonance on a frequency.
    """
    _check_stiffness(mount_stiffness, len(prepared.receptances.mount_stiffness))
    on_road = drive(prepared, conditions)
    n_values = prepared.basis.n_below + 3 * len(prepared.vehicle.response_points) * (
        len(on_road.frequency_hz) + 1
    )
    n_at_once = max(1, memory // (2 * 8 * n_values))
    if runner is not None:
        n_at_once = min(n_at_once, SENT)
    starts = range(0, len(mount_stiffness), n_at_once)
    chunks = [(start, mount_stiffness[start : start + n_at_once]) for start in starts]
    if runner is None:
        return (_solve(on_road, chunk) for chunk in chunks)
    return runner.map(_solve, on_road, chunks, CancelToken())


def _solve(on_road: RoadExcitation, chunk: tuple[int, Complexes]) -> Batch:
    """The results of some sets, of which the first has a number."""
    start, sets = chunk
    prepared, f = on_road.prepared, on_road.frequency_hz
    band = 0.0, prepared.vehicle.highest_frequency
    shape = (len(prepared.vehicle.response_points), 3)
    frequency_hz = np.empty((len(sets), prepared.basis.n_below))
    psd = np.empty((len(sets), len(f), *shape))
    roots = np.empty((len(sets), *shape))
    spectrum = on_road.spectrum_at(f)
    for i, stiffness in enumerate(sets):
        try:
            frequency_hz[i] = natural_frequencies(prepared.basis, stiffness)
            lines, _, around = solve_spectra(
                on_road, stiffness, resonances_at(prepared.basis, stiffness)
            )
            response = on_road.receptances.response(stiffness)
        except SolveError as error:
            raise SolveError(f"set {start + i + 1}: {error}") from None
        psd[i] = acceleration_psd(f, response, spectrum).reshape(psd.shape[1:])
        roots[i] = rms(lines, around, band)
    return Batch(start, frequency_hz, psd, roots)


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
