"""What the optimiser is to make small: the paper's weighted sum of squared accelerations."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.ride.psd import acceleration_psd
from modeviz.ride.roads import road_spectrum, track_amplitudes
from modeviz.ride.wheels import wheel_amplitudes
from modeviz.tuning.preparation import Prepared, prepare
from modeviz.tuning.results import AXIS, Conditions
from modeviz.tuning.sensitivity import psd_gradient, spring_shares
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import Rates
from modeviz.vehicle.loads import WheelLoad
from modeviz.vehicle.vehicle import Vehicle

ROAD_HZ = tuple(np.arange(18, 43) / 3)
"""The paper's frequencies on a road: 6 to 14 Hz in steps of 1/3 Hz."""

WHEEL_HZ = (11.0, 13.25, 15.75)
"""The paper's frequencies for wheel loads."""

DIRECTIONS = ("lateral", "vertical")


@dataclass(frozen=True, eq=False)
class LoadCase:
    """A load whose accelerations at some frequencies are to be small."""

    load: Conditions | WheelLoad
    frequency_hz: Sequence[float]
    weight: float = 1.0
    """Of every acceleration squared."""


@dataclass(frozen=True, eq=False)
class Objective:
    """F = Σ w a² over load cases, frequencies, response points, and lateral and vertical.

    a is the peak acceleration, g, under a wheel load and the root of the PSD, g/√Hz, on a road (Duncan,
    "Optimization": all targets zero, all weights one, so that the two units add up as they are).
    """

    prepared: Prepared
    """At the frequencies of all cases together."""
    cases: tuple[LoadCase, ...]

    def value(self, rates: Rates) -> float:
        """F at rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return self.value_and_gradient(rates)[0]

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """F and ∂F/∂k, (n_variables,) in the order of `rate_variables`; raises as `solve`."""
        prepared = self.prepared
        amplitudes = _amplitudes(prepared, self.cases)
        driven = prepared.receptances.driven(np.concatenate(amplitudes, axis=2))
        H, a, b = driven.response_gradient(prepared.mount_stiffness(rates))
        shares = spring_shares(prepared.vehicle)
        outputs = np.concatenate([np.arange(AXIS[d], H.shape[1], 3) for d in DIRECTIONS])
        value, gradient = 0.0, np.zeros(shares.shape[1])
        start = 0
        for case, inputs in zip(self.cases, amplitudes, strict=True):
            lines = np.searchsorted(prepared.frequency_hz, np.subtract(case.frequency_hz, SAME_HZ))
            loads = slice(start, start := start + inputs.shape[2])
            f, h = prepared.frequency_hz[lines], H[lines][:, outputs, loads]
            S = _spectrum(prepared.vehicle, case.load, f)
            value += case.weight * acceleration_psd(f, h, S).sum()
            change = psd_gradient(f, h, a[lines][:, :, outputs], b[lines][:, :, loads], S, shares)
            gradient += case.weight * change.sum(axis=(0, 1))
        return float(value), gradient


SAME_HZ = 1e-9
"""Frequencies this close are the same."""


def prepare_objective(vehicle: Vehicle, cases: Sequence[LoadCase]) -> Objective:
    """The objective of some load cases; raises as `prepare`."""
    every = np.sort(np.concatenate([np.asarray(c.frequency_hz, float) for c in cases]))
    distinct = np.concatenate([every[:1], every[1:][np.diff(every) > SAME_HZ]])
    return Objective(prepare(vehicle, distinct), tuple(cases))


def paper_cases(vehicle: Vehicle) -> tuple[LoadCase, ...]:
    """The paper's load cases: the first road at the vehicle's speed, and every wheel load."""
    road = Conditions(vehicle.roads[0].name, vehicle.speed)
    return (
        LoadCase(road, ROAD_HZ),
        *(LoadCase(load, WHEEL_HZ) for load in vehicle.wheel_loads),
    )


def _amplitudes(prepared: Prepared, cases: Sequence[LoadCase]) -> list[Complexes]:
    """Of each case: its inputs, (n_freqs, all input directions, 2 tracks or 1 load)."""
    vehicle, f = prepared.vehicle, prepared.frequency_hz
    n_tyres = 3 * len(vehicle.tyres)
    amplitudes = []
    for case in cases:
        if isinstance(case.load, WheelLoad):
            own, before, after = wheel_amplitudes(vehicle, [case.load], f), n_tyres, 0
        else:
            own, before, after = track_amplitudes(vehicle, f, case.load.speed), 0, n_tyres
        amplitudes.append(np.pad(own, ((0, 0), (before, after), (0, 0))))
    return amplitudes


def _spectrum(vehicle: Vehicle, load: Conditions | WheelLoad, frequency_hz: Floats) -> Complexes:
    """The spectrum of a case's inputs: of a road, or one of a harmonic load."""
    if isinstance(load, WheelLoad):
        return np.ones((len(frequency_hz), 1, 1), complex)
    return road_spectrum(vehicle.road(load.road), frequency_hz, load.speed)
