"""Which modes make the force of a mount."""

import numpy as np

from modeviz.analysis.mount_forces import force_weights
from modeviz.analysis.results import Results
from modeviz.ride.excitation import Load, excitation, input_spectrum
from modeviz.vehicle.arrays import Floats


def force_participation(
    results: Results,
    load: Load,
    frequency_hz: Floats,
    mount: int,
    motion: str,
    in_vehicle_axes: bool = False,
) -> Floats:
    """The parts of modes in a mount's force, (n_freqs, n_parts), see `Results.participation`.

    Args:
        results: with its rates.
        load: what shakes.
        frequency_hz: (n_freqs,).
        mount: its number.
        motion: one of `MOTIONS`.
        in_vehicle_axes: whether along or about the vehicle's axes, else the mount's own.
    """
    system, speed = results.prepared.system, results.conditions.speed
    law, stiffness = results.prepared.basis.law, results.prepared.mount_stiffness(results.rates)
    there = law.stiffness(stiffness, frequency_hz)
    S = input_spectrum(load, frequency_hz, speed)
    ground = excitation(system.vehicle, load, frequency_hz, speed, there).ground
    parts = []
    every = np.broadcast_to(there, ground.shape[:2])
    for i, f in enumerate(frequency_hz):
        weights = force_weights(system, every[i], f, mount, motion, in_vehicle_axes)
        row, given = weights @ system.mount_motions, -(weights @ ground[i])[None]
        parts.append(results.participation(row, load, frequency_hz[i : i + 1], S[i : i + 1], given)[0])
    return np.array(parts)
