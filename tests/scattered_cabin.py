"""The mounted cabin with a goal, ready to have its mounts scattered."""

from dataclasses import replace

import numpy as np
from mounted_cabin import mounted_cabin

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions, drive
from modeviz.dynamics.reanalysis import Receptances
from modeviz.optimise.objective import LoadCase, Objective, prepare_objective
from modeviz.optimise.peak import PeakGoal
from modeviz.scatter.tolerance import Parts, Tolerance, scattered_parts
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import ResponsePoint

FLAT = Conditions("flat", 20.0)


def prepared_cabin() -> Prepared:
    """At 80 frequencies, with a second response point."""
    vehicle = mounted_cabin()
    rear = ResponsePoint("rear", "cab", np.array([2.2, 0.4, 0.9]))
    points = (*vehicle.response_points, rear)
    return prepare(replace(vehicle, response_points=points), np.linspace(0.5, 40, 80))


def cabin_receptances(frequency_hz: Floats) -> Receptances:
    """On its road."""
    return drive(prepare(mounted_cabin(), frequency_hz), FLAT).receptances


def drawn_and_sampled(parts: Parts, n_samples: int) -> Complexes:
    """The mount springs of parts as drawn, and of some that scatter."""
    drawn = np.zeros(parts.n_deviations)
    return parts.stiffness(np.vstack([drawn, parts.samples(n_samples, 0)]))


def cabin_parts() -> Parts:
    """Within the usual tolerance."""
    return scattered_parts(prepare(mounted_cabin(), np.array([1.0])), {}, Tolerance())


def cabin_objective(prepare_kind=prepare_objective) -> Objective | PeakGoal:
    """On a road at three frequencies and under a wheel load at another."""
    vehicle = mounted_cabin()
    (load,) = vehicle.wheel_loads
    cases = [LoadCase(FLAT, (6.0, 8.0, 12.0)), LoadCase(load, (11.0,), weight=1e-3)]
    return prepare_kind(vehicle, cases)


def worst_error(few, receptances: Receptances, stiffness: Complexes) -> float:
    """How far its responses are from those of receptances, a part of the largest of each line."""
    expected = receptances.responses(stiffness)
    off = np.abs(few.responses(stiffness) - expected).max(axis=(0, 2, 3))
    return (off / np.abs(expected).max(axis=(0, 2, 3))).max()
