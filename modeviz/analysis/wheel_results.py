"""The response of a vehicle to its wheel loads and other harmonic loads."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.driven import driven
from modeviz.analysis.preparation import Prepared
from modeviz.dynamics.resonances import resonances_at
from modeviz.ride.excitation import acting_lines
from modeviz.ride.integration import line_distances
from modeviz.ride.psd import harmonic_acceleration
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.loads import HarmonicLoad
from modeviz.vehicle.mount_rates import Rates


@dataclass(frozen=True, eq=False)
class WheelResults:
    """Harmonic response to each of a vehicle's wheel and other harmonic loads."""

    frequency_hz: Floats
    """(n_freqs,)."""
    acceleration_g: Floats
    """(n_freqs, n_loads, n_points, 3): peak x, y, z, g."""
    is_graded: bool = False
    """Whether lines lie closer where modes are sharp; else each counts alike."""

    def mean(self, band: tuple[float, float]) -> Floats:
        """Mean over a band, ends included, (n_loads, n_points, 3), g."""
        f = self.frequency_hz
        inside = (f > band[0] - 1e-6) & (f < band[1] + 1e-6)
        weights = inside * line_distances(f) if self.is_graded else 1.0 * inside
        return np.tensordot(weights, self.acceleration_g, 1) / weights.sum()


def solve_wheels(prepared: Prepared, rates: Rates) -> WheelResults:
    """The response to every harmonic load of the vehicle; arguments and errors as `solve`."""
    return _solve(prepared, rates, prepared.vehicle.harmonic_loads)


def solve_harmonic(prepared: Prepared, rates: Rates, load: HarmonicLoad) -> WheelResults:
    """The response to one harmonic load, or to an order of an engine where that can run."""
    return _solve(prepared, rates, (load,))


def _solve(prepared: Prepared, rates: Rates, loads: Sequence[HarmonicLoad]) -> WheelResults:
    """The response to loads at lines at which all of them act."""
    n_points = len(prepared.vehicle.response_points)
    if not loads:
        f = prepared.frequency_hz
        return WheelResults(f, np.zeros((len(f), 0, n_points, 3)))
    stiffness = prepared.mount_stiffness(rates)
    under = driven(prepared, loads, prepared.vehicle.speed)
    f = under.lines(resonances_at(prepared.basis, stiffness))
    for load in loads:
        f = acting_lines(load, f)
    g = harmonic_acceleration(f, under.response(stiffness, f)).transpose(0, 2, 1)
    g = g.reshape(len(f), len(loads), n_points, 3)
    return WheelResults(f, g, prepared.is_graded)
