"""Participation of modes in a response: the job of the paper's MPN program."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.modes import Modes
from modeviz.ride.psd import power_decibels
from modeviz.vehicle.arrays import Complexes, Floats

NEGLIGIBLE = 0.005
"""Of the largest participation: less reads 0.00."""

PROMINENCE_DB = 1.0
"""How far a peak must stand above the dip that parts it from a higher one."""


@dataclass(frozen=True)
class Contributor:
    """A mode's part in a response."""

    mode: int
    """Its index, from zero; those above the band follow those of the band, and last comes the rest."""
    ratio: float
    """Of its participation to the largest one."""


@dataclass(frozen=True)
class Peak:
    """A peak of a response and the modes that make it, the largest first."""

    frequency_hz: float
    level: float
    """Of the response there: g²/Hz of a PSD, g of a harmonic response."""
    contributors: tuple[Contributor, ...]


def participation(output_shapes: Floats, modal_coordinates: Complexes, input_psd: Complexes) -> Floats:
    """The root of each mode's own contribution to the PSD of an output, (n_freqs, n_modes).

    p_r = |φ_or| √(q_r S_ff q_rᴴ): what the output's PSD would be with this mode alone. Modes interfere,
    so the squares do not add up to the PSD. For a harmonic load, take its one column of `q` and an
    `input_psd` of one: p_r = |φ_or q_r|.

    Args:
        output_shapes: φ_o, (n_modes,), the modes at the output.
        modal_coordinates: q per unit of each input, (n_freqs, n_modes, n_inputs).
        input_psd: S_ff, (n_freqs, n_inputs, n_inputs).
    """
    q = modal_coordinates
    own = ((q @ input_psd) * q.conj()).sum(axis=2).real
    return np.abs(output_shapes) * np.sqrt(np.maximum(own, 0.0))


def participation_above(
    modes: Modes,
    n_single: int,
    output_shapes: Floats,
    modal_forces: Complexes,
    given: Complexes,
    frequency_hz: Floats,
    input_psd: Complexes,
) -> Floats:
    """Participation of modes that damping leaves single, and of the rest, (n_freqs, n_single + 1).

    Args:
        modes: rising.
        n_single: how many stand for themselves; the others count together.
        output_shapes: φ_o, (n_modes,).
        modal_forces: φᵀF, (n_freqs, n_modes, n_inputs).
        given: what the output moves without any mode, (n_freqs, n_inputs): it is part of the rest.
        frequency_hz: (n_freqs,).
        input_psd: S_ff, (n_freqs, n_inputs, n_inputs).
    """
    omega, omega_n = 2 * np.pi * np.asarray(frequency_hz)[:, None], 2 * np.pi * modes.frequency_hz
    Z = omega_n**2 - omega**2 + 2j * modes.damping_ratio * omega_n * omega
    moved = output_shapes[:, None] * modal_forces / Z[:, :, None]
    rest = moved[:, n_single:].sum(axis=1) + given
    parts = np.concatenate([moved[:, :n_single], rest[:, None]], axis=1)
    return participation(np.ones(n_single + 1), parts, input_psd)


def contributors(participations: Floats, count: int) -> tuple[Contributor, ...]:
    """The `count` largest of the modes' participations (n_modes,), the largest first.

    Of the others none that is `NEGLIGIBLE` beside it.
    """
    largest, *others = np.argsort(participations)[::-1][:count]
    reference = participations[largest] or 1.0
    named = [largest, *(r for r in others if participations[r] >= NEGLIGIBLE * reference)]
    return tuple(Contributor(int(r), float(participations[r] / reference)) for r in named)


def peaks(
    frequency_hz: Floats, level: Floats, participations: Floats, count: int = 2
) -> tuple[Peak, ...]:
    """Peaks with the `count` largest contributors to each.

    Args:
        frequency_hz: (n_peaks,), see `peak_lines`.
        level: (n_peaks,), of the response there.
        participations: (n_peaks, n_modes), see `participation`.
        count: how many modes to name.
    """
    return tuple(
        Peak(float(f), float(height), contributors(parts, count))
        for f, height, parts in zip(frequency_hz, level, participations, strict=True)
    )


def peak_lines(psd: Floats) -> list[int]:
    """The peaks of a response (n_freqs,), rising, `PROMINENCE_DB` above the dips beside them."""
    # scipy.signal finds them too, but importing it costs half of a program's start.
    level = power_decibels(psd)
    before, here, after = level[:-2], level[1:-1], level[2:]
    maxima = np.flatnonzero((before < here) & (here >= after)) + 1
    return maxima[_prominence(level, maxima) >= PROMINENCE_DB].tolist()


def _prominence(level: Floats, maxima: NDArray[np.intp]) -> Floats:
    """The height of each maximum above the higher of the dips to its sides, up to higher ground."""
    lines = np.arange(len(level))
    top, height = maxima[:, None], level[maxima][:, None]
    higher = level > height
    start = np.where(higher & (lines < top), lines, 0).max(axis=1, initial=0)[:, None]
    end = np.where(higher & (lines > top), lines, len(level)).min(axis=1, initial=len(level))[:, None]
    before = np.where((lines >= start) & (lines < top), level, np.inf).min(axis=1, initial=np.inf)
    after = np.where((lines >= top) & (lines < end), level, np.inf).min(axis=1, initial=np.inf)
    return level[maxima] - np.maximum(before, after)
