"""The road: its two-track spectrum, how tyres pass it on, and profiles in time."""

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.errors import ModevizError
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import Tyre
from modeviz.vehicle.loads import Road, Spectrum
from modeviz.vehicle.vehicle import Vehicle

LEFT, RIGHT = 0, 1
"""The tracks, where they are inputs: left is y < 0."""

SLACK = 1e-9
"""Relative: how far beyond the end of a road's table, which rounding moves, a frequency may be."""

NO_POWER = np.finfo(np.float64).tiny
"""m²/Hz: stands for zero where a logarithm is taken."""


def track_forces(system: System, frequency_hz: Floats, speed: float) -> Complexes:
    """Generalised forces per unit displacement of the left and the right track.

    Args:
        system: what the tyres belong to.
        frequency_hz: (n_freqs,).
        speed: V, m/s.

    Returns:
        (n_freqs, n_dofs, 2), N/m; to be used with `road_spectrum` at the same speed.
    """
    return tyre_directions(system).T @ track_amplitudes(system.vehicle, frequency_hz, speed)


def tyre_directions(system: System) -> Floats:
    """Rows (3 n_tyres, n_dofs): how every tyre is stretched along its local axes."""
    rows = [system.relative_motion(tyre)[:3] for tyre in system.vehicle.tyres]
    return np.vstack([np.zeros((0, system.n_dofs)), *rows])


def track_amplitudes(vehicle: Vehicle, frequency_hz: Floats, speed: float) -> Complexes:
    """Force along each of `tyre_directions` per unit displacement of the left and the right track.

    (k (1 + jg) + jωc) ẑ e^{-jωτ}: the ground end of a tyre rises with the road and the tyre's springs
    and dampers push the wheel. A tyre whose patch is L behind the frontmost meets the same road
    τ = L / V later.

    Args:
        vehicle: whose tyres.
        frequency_hz: (n_freqs,).
        speed: V, m/s.

    Returns:
        (n_freqs, 3 n_tyres, 2), N/m.
    """
    omega = 2 * np.pi * np.asarray(frequency_hz)[:, None]
    tyres = vehicle.tyres
    amplitudes = np.zeros((len(omega), len(tyres), 3, 2), complex)
    for i, tyre in enumerate(tyres):
        push = tyre.stiffness * (1 + 1j * tyre.loss_factor) + 1j * omega * tyre.damping
        amplitudes[:, i] = push[:, :, None] * patch_motion(vehicle, tyre, frequency_hz, speed)
    return amplitudes.reshape(len(omega), 3 * len(tyres), 2)


def patch_motion(vehicle: Vehicle, tyre: Tyre, frequency_hz: Floats, speed: float) -> Complexes:
    """How far the road moves a tyre's ground end along its local axes, (n_freqs, 3, 2).

    ẑ e^{-jωτ} per unit displacement of the left and the right track; arguments as `track_amplitudes`.
    """
    omega = 2 * np.pi * np.asarray(frequency_hz)[:, None]
    up = tyre.axes[:, 2] * np.exp(-1j * omega * lag(tyre, vehicle.tyres, speed))
    return (up[:, :, None] * np.array(track_shares(tyre))).astype(complex)


def track_shares(tyre: Tyre) -> tuple[float, float]:
    """The shares of the left and of the right track in the motion of a tyre's patch, adding up to one.

    That of its side, left where y < 0; between the tracks the mean of both.
    """
    return {"left": (1.0, 0.0), "right": (0.0, 1.0), "both": (0.5, 0.5)}[tyre.side]


def lag(tyre: Tyre, tyres: tuple[Tyre, ...], speed: float) -> float:
    """The time, s, by which a tyre meets the road later than the frontmost of `tyres`."""
    front = min(t.points[1, 0] for t in tyres)
    return (tyre.points[1, 0] - front) / speed


def road_spectrum(road: Road, frequency_hz: Floats, speed: float) -> Complexes:
    """One-sided displacement spectra of a road met at `speed`, (n_freqs, 2, 2), m²/Hz.

    S(f; V) = S(f V₀/V; V₀) V₀/V. Between the values of the road's table each track's power is a power
    law and the complex coherence is linear in log f, so that every matrix stays Hermitian and
    positive semidefinite.

    Raises:
        ModevizError: the table does not reach that far. A road is not extrapolated: beyond its
            table nothing is known, and displacement turns into acceleration by ω⁴.
    """
    at_table_speed = np.asarray(frequency_hz) * road.speed / speed
    low, high = road.frequency_hz[[0, -1]]
    slack = SLACK * high
    if at_table_speed.size and not (
        low - slack <= at_table_speed.min() and at_table_speed.max() <= high + slack
    ):
        scale = speed / road.speed
        raise ModevizError(
            f"road {road.name!r}: found {np.min(frequency_hz):g} to {np.max(frequency_hz):g} Hz at "
            f"{speed:g} m/s, expected frequencies from {low * scale:g} to {high * scale:g} Hz, which "
            "its table holds at that speed"
        )
    return _interpolate(road, at_table_speed) * road.speed / speed


def interpolated_power(what: str, spectrum: Spectrum, frequency_hz: Floats) -> Floats:
    """A PSD between the values of its table, (n_freqs,), where it is a power law.

    Raises:
        ModevizError: the table does not reach that far.
    """
    f, known = np.asarray(frequency_hz), spectrum.frequency_hz
    slack = SLACK * known[-1]
    if f.size and not (known[0] - slack <= f.min() and f.max() <= known[-1] + slack):
        raise ModevizError(
            f"{what}: found {f.min():g} to {f.max():g} Hz, expected frequencies from {known[0]:g} to "
            f"{known[-1]:g} Hz, which its table holds"
        )
    power = np.maximum(spectrum.power, NO_POWER)
    return np.exp(np.interp(np.log(f), np.log(known), np.log(power)))


def held(what: str, table_hz: Floats, frequency_hz: Floats) -> slice:
    """The slice of some frequencies that a table holds.

    Raises:
        ModevizError: none of them.
    """
    low, high = table_hz[[0, -1]]
    slack = SLACK * high
    start, stop = np.searchsorted(frequency_hz, (low - slack, high + slack)).tolist()
    if stop - start < 2:
        raise ModevizError(
            f"{what}: its table holds {low:g} to {high:g} Hz, expected some of {frequency_hz[0]:g} to "
            f"{frequency_hz[-1]:g} Hz"
        )
    return slice(start, stop)


def _interpolate(road: Road, frequency_hz: Floats) -> Complexes:
    """The table's spectra at frequencies within it."""
    power = np.maximum(np.diagonal(road.spectrum, axis1=1, axis2=2).real, NO_POWER)
    amplitude = np.sqrt(power)
    coherence = road.spectrum[:, 0, 1] / (amplitude[:, 0] * amplitude[:, 1])
    at, known = np.log(frequency_hz), np.log(road.frequency_hz)
    left, right = (np.exp(np.interp(at, known, np.log(a))) for a in amplitude.T)
    cross = left * right * np.interp(at, known, coherence)
    return np.stack([left**2, cross, cross.conj(), right**2], axis=-1).reshape(-1, 2, 2)
