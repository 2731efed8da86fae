"""What each mount rate does to frequencies and accelerations: analytic derivatives."""

from dataclasses import dataclass

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.preparation import Prepared, PreparedModes
from modeviz.analysis.results import Conditions, Results, drive
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.dynamics.resonances import resonances_at
from modeviz.ride.psd import averaged_acceleration_psd, mean_square, rms
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class RateVariable:
    """One rate that is tuned: a direction of a mount group, the same for all of its mounts."""

    group: str
    direction: str
    """One of `RATE_FIELDS`."""


def rate_variables(vehicle: Vehicle) -> tuple[RateVariable, ...]:
    """Every tuned rate of every mount group: of the first in the order of `RATE_FIELDS`, and so on."""
    return tuple(RateVariable(g.name, name) for g in vehicle.mount_groups for name in g.fields)


def spring_shares(prepared: PreparedModes, rates: Rates) -> Complexes:
    """∂(spring rate)/∂(rate), (n_springs, n_variables), complex; raises as `MountSprings.stiffness`."""
    return prepared.springs.shares(rates)


def frequency_sensitivity(results: ModalResults) -> Floats:
    """∂f/∂k of each mode for each of `rate_variables`, (n_modes, n_variables), Hz per SI unit of each.

    ∂(ω²)/∂k = φᵀRᵀRφ over the springs with that rate (R. L. Fox and M. P. Kapoor, "Rates of change of
    eigenvalues and eigenvectors", AIAA Journal 6(12), 1968). Zero for a mode that moves freely; of
    modes with the same frequency only the mean has a derivative. Where rates depend on frequency the
    mode follows its own: that over 1 - φᵀ ∂K/∂ω² φ.
    """
    prepared, f = results.prepared, results.modes.frequency_hz
    stretch = prepared.system.mount_motions @ results.modes.shapes
    shares, ratios = spring_shares(prepared, results.rates), prepared.basis.law.ratios(f)
    squares = np.einsum("sm,msv->mv", stretch**2, (ratios[:, :, None] * shares).real)
    squares /= results.band.dispersion[:, None]
    f = f[:, None]
    return np.divide(squares, 8 * np.pi**2 * f, out=np.zeros_like(squares), where=f > RESOLVED_HZ)


def damper_sensitivity(results: ModalResults) -> Floats:
    """∂ζ/∂c of each mode for each of `rate_variables`, (n_modes, n_variables), m/(N s).

    ζ = φᵀCφ / 2ω, so that of a damper is (Rφ)² / 2ω, however much there is of it. Zero of stiffness,
    and for a mode that moves freely.
    """
    prepared, f = results.prepared, results.modes.frequency_hz
    stretch = prepared.system.mount_motions @ results.modes.shapes
    dampers = prepared.basis.law.dampers(spring_shares(prepared, results.rates).T).T
    f = f[:, None]
    squares = stretch.T**2 @ dampers
    return np.divide(squares, 4 * np.pi * f, out=np.zeros_like(squares), where=f > RESOLVED_HZ)


@dataclass(frozen=True, eq=False)
class RideSensitivity:
    """How accelerations on a road change with each of `rate_variables`."""

    frequency_hz: Floats
    """(n_freqs,): the lines at these rates, see `Results`."""
    psd: Floats
    """(n_freqs, n_points, 3, n_variables), g²/Hz per SI unit of each."""
    rms: Floats
    """(n_points, 3, n_variables), g likewise."""


def ride_sensitivity(prepared: Prepared, rates: Rates, conditions: Conditions) -> RideSensitivity:
    """The derivatives of a ride; arguments and errors as `analysis.results.solve`."""
    stiffness = prepared.mount_stiffness(rates)
    on_road, band = drive(prepared, conditions), (0.0, prepared.vehicle.highest_frequency)
    f = on_road.lines(resonances_at(prepared.basis, stiffness))
    at, around = on_road.spectrum_at(f), on_road.spectrum_around(f)
    response, shares = on_road.response_gradient(stiffness, f), spring_shares(prepared, rates)
    change = psd_gradient(f, *response, at, shares)
    root = rms(f, averaged_acceleration_psd(f, response[0], around), band)[:, None]
    square_change = mean_square(f, psd_gradient(f, *response, around, shares), band)
    rms_change = np.divide(square_change, 2 * root, out=np.zeros_like(square_change), where=root > 0)
    shape = (len(prepared.vehicle.response_points), 3, change.shape[2])
    return RideSensitivity(f, change.reshape(len(f), *shape), rms_change.reshape(shape))


def psd_gradient(
    frequency_hz: Floats,
    response: Complexes,
    to_outputs: Complexes,
    to_inputs: Complexes,
    input_psd: Complexes,
    shares: Complexes,
) -> Floats:
    """Derivatives of acceleration PSDs, (n_freqs, n_outputs, n_variables), g²/Hz per SI unit of each.

    S = h S_ff hᴴ and ∂h/∂k_s = -a_s b_s, so ∂S/∂k = -2 Re Σ (1 + jg) a_s b_s S_ff hᴴ over its springs.

    Args:
        frequency_hz: (n_freqs,).
        response: H, (n_freqs, n_outputs, n_inputs).
        to_outputs: a, (n_freqs, n_springs, n_outputs), see `Receptances.response_gradient`.
        to_inputs: b, (n_freqs, n_springs, n_inputs).
        input_psd: S_ff, (n_freqs, n_inputs, n_inputs).
        shares: (n_springs, n_variables), see `spring_shares`.
    """
    by_spring = _by_spring(frequency_hz, response, to_outputs, to_inputs, input_psd)
    return (by_spring.transpose(0, 2, 1) @ shares).real


def psd_sum_gradient(
    frequency_hz: Floats,
    response: Complexes,
    to_outputs: Complexes,
    to_inputs: Complexes,
    input_psd: Complexes,
    shares: Complexes,
    weights: Floats,
) -> Floats:
    """The derivatives of a sum of PSDs, (n_variables,), sooner than of each.

    Args:
        frequency_hz: as of `psd_gradient`, as are all but the last.
        response: likewise.
        to_outputs: likewise.
        to_inputs: likewise.
        input_psd: likewise.
        shares: likewise.
        weights: of each in the sum, (n_freqs, n_outputs).
    """
    by_spring = _by_spring(frequency_hz, response, to_outputs, to_inputs, input_psd)
    return (np.einsum("fso,fo->s", by_spring, weights) @ shares).real


def _by_spring(
    frequency_hz: Floats,
    response: Complexes,
    to_outputs: Complexes,
    to_inputs: Complexes,
    input_psd: Complexes,
) -> Complexes:
    """-2 ω⁴ a b S_ff hᴴ/g², (n_freqs, n_springs, n_outputs), arguments as of `psd_gradient`."""
    omega = 2 * np.pi * np.asarray(frequency_hz)[:, None, None]
    driven = to_inputs @ (input_psd @ response.conj().transpose(0, 2, 1))
    return to_outputs * driven * (-2 * omega**4 / STANDARD_GRAVITY**2)


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """k ∂/∂k for each of `rate_variables`: to first order, what +100 % of a rate do."""

    frequency_hz: Floats
    """Of the natural frequencies, (n_modes, n_variables), Hz."""
    damping_ratio: Floats
    """What dampers do to the modes' damping ratios, (n_modes, n_variables); zero of stiffness."""
    rms: Floats
    """Of the accelerations relative to themselves, (n_points, 3, n_variables)."""


def sensitivity(prepared: Prepared, results: Results) -> Sensitivity:
    """Return what a small part of each rate does to frequencies and ride.

    Args:
        prepared: `results.prepared`, or the same `near` the rates of the results, which is faster.
        results: at whose rates, on whose road.

    Raises:
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    variables = rate_variables(prepared.vehicle)
    k = np.array([getattr(results.rates[v.group], v.direction) for v in variables])
    rms_change = ride_sensitivity(prepared, results.rates, results.conditions).rms
    relative = np.divide(
        rms_change, results.rms[..., None], out=np.zeros_like(rms_change), where=rms_change != 0
    )
    to_frequency, to_damping = frequency_sensitivity(results), damper_sensitivity(results)
    return Sensitivity(k * to_frequency, k * to_damping, k * relative)
