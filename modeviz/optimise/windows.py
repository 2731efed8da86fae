"""Frequency windows of modes as constraints c >= 0 of a search, with their derivatives."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.preparation import PreparedModes, prepare_modes
from modeviz.analysis.sensitivity import frequency_sensitivity
from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import FrequencyWindow
from modeviz.vehicle.vehicle import Vehicle

MARGIN = 2e-6
"""How far within a window a search aims, relative to its ends; frequencies are within 4e-7 of exact."""

ALIKE = 0.98
"""Of the motion that a mode is called after, or of its shape: with so much of what the one with most of
it has, another mode has to be in the window too, so that a search does not end where the full model
finds that one."""

SLACK = 1e-6
"""By how much a design may miss that and still counts: a search comes to it from both sides."""


@dataclass(frozen=True, eq=False)
class HeldMode:
    """What tells the mode of a window from others, whatever the rates."""

    motion: str
    """That it is called after with the vehicle's own rates; "" if another is too: then its number says
    nothing with other rates."""
    momentum: Floats
    """M φ with the vehicle's own rates, (n_dofs,)."""

    def found_in(self, results: ModalResults) -> list[int]:
        """The mode that has most of the motion, or of the shape where none has, and those alike."""
        likeness = {i: n.score for i, n in enumerate(results.names) if n.motion == self.motion}
        if not likeness:
            likeness = dict(enumerate(((self.momentum @ results.modes.shapes) ** 2).tolist()))
        best_first = sorted(likeness, key=lambda i: -likeness[i])
        return [i for i in best_first if likeness[i] >= ALIKE * likeness[best_first[0]]]


@dataclass(frozen=True, eq=False)
class Windows:
    """The frequency windows of a problem for a vehicle."""

    prepared: PreparedModes
    windows: tuple[FrequencyWindow, ...]
    held: tuple[HeldMode, ...]
    """The mode of each."""

    @property
    def spoken(self) -> list[str]:
        """What a person calls the end that each of `margins` is to: "cab yaw: at most 10 Hz"."""
        return [f"{window.mode}: {end}" for window in self.windows for end in _ends(window)]

    def margins(self, rates: Rates) -> tuple[Floats, Floats]:
        """Return what is left to every end of every window, and its derivatives.

        Returns:
            (n_limits,), relative to the frequency, below zero where a window is left; and
            (n_limits, n_rates), per N/m, in the order of `rate_variables`.
        """
        results = solve_modal(self.prepared, rates)
        slopes = frequency_sensitivity(results)
        values, gradients = [], []
        for window, held in zip(self.windows, self.held, strict=True):
            modes = held.found_in(results)
            by_mode = [_margins(window, f) for f in results.modes.frequency_hz[modes].tolist()]
            for end in zip(*by_mode, strict=True):
                closest = int(np.argmin([value for value, _ in end]))
                value, slope = end[closest]
                values.append(value)
                gradients.append(slope * slopes[modes[closest]])
        return np.array(values), np.array(gradients).reshape(len(values), slopes.shape[1])

    def of_vehicle(self, vehicle: Vehicle) -> "Windows":
        """Return windows of the same modes where mounts are elsewhere, or there are more of them."""
        return replace(self, prepared=prepare_modes(vehicle))

    def exact_frequencies(self, rates: Rates) -> Floats:
        """Return where the mode of each window is in the full eigenproblem, (n_windows,), Hz."""
        results = solve_modal(self.prepared, rates, "exact")
        return results.modes.frequency_hz[[held.found_in(results)[0] for held in self.held]]


def prepare_windows(prepared: PreparedModes, windows: Sequence[FrequencyWindow]) -> Windows:
    """Windows for a vehicle.

    Raises:
        VehicleError: a mode that the vehicle does not have with its own rates, or an end of a window
            above the band in which modes are known.
    """
    results, top_hz = solve_modal(prepared, {}), prepared.basis.top_hz
    held = []
    for window in windows:
        ends = [f for f in (window.low_hz, window.high_hz) if np.isfinite(f)]
        if max(ends) > top_hz:
            raise VehicleError(
                f"window of {window.mode!r}: found {max(ends):g} Hz, expected {top_hz:g} Hz at most, "
                "up to which modes are known"
            )
        mode = results.mode_index(window.mode)
        if mode is None:
            names = [name.name for name in results.names]
            raise VehicleError("window: " + unknown("mode", window.mode, names))
        held.append(_held_mode(results, mode))
    return Windows(prepared, tuple(windows), tuple(held))


def _held_mode(results: ModalResults, mode: int) -> HeldMode:
    motion = results.names[mode].motion
    is_alone = sum(name.motion == motion for name in results.names) == 1
    return HeldMode(motion if is_alone else "", results.momentum[:, mode])


def _ends(window: FrequencyWindow) -> list[str]:
    low, high = f"{window.low_hz:g} Hz", f"{window.high_hz:g} Hz"
    if not window.is_inside:
        return [f"not {low} to {high}"]
    ends = [f"at least {low}"] if window.low_hz > 0 else []
    return [*ends, f"at most {high}"] if np.isfinite(window.high_hz) else ends


def _margins(window: FrequencyWindow, f: float) -> list[tuple[float, float]]:
    """Return what is left to each end of a window, relative, and its derivative to f, 1/Hz."""
    low, high = window.low_hz, window.high_hz
    if not window.is_inside:
        return [max((f / high - 1 - MARGIN, 1 / high), (1 - f / low - MARGIN, -1 / low))]
    ends = []
    if low > 0:
        ends.append((f / low - 1 - MARGIN, 1 / low))
    if np.isfinite(high):
        ends.append((1 - f / high - MARGIN, -1 / high))
    return ends
