"""What there is to show moving besides undamped modes: damped ones, and operating shapes.

Each is a shape in the vehicle's coordinates, (n_dofs,), complex: motion goes as Re(shape e^{jωt}).
"""

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.results import AXIS, Results
from modeviz.dynamics.assembly import System
from modeviz.dynamics.damped import DampedMode, damped_mode
from modeviz.dynamics.response import direct_shape
from modeviz.errors import SolveError
from modeviz.ride.excitation import generalised_forces, input_spectrum
from modeviz.ride.operating import operating_shape
from modeviz.vehicle.arrays import Complexes


def complex_mode(results: ModalResults, mode: int) -> DampedMode:
    """A mode of the vehicle with its damping.

    Args:
        results: with its rates.
        mode: the undamped mode it belongs to, its number from zero.

    Raises:
        SolveError: it is damped so strongly that it does not vibrate.
    """
    prepared = results.prepared
    stiffness = prepared.mount_stiffness(results.rates)
    return damped_mode(prepared.basis, stiffness, results.band, results.damped, mode)


def road_shape(results: Results, frequency_hz: float, point: int, direction: str) -> Complexes:
    """Return how the vehicle moves on its road, or under another random load, at one frequency.

    As seen from a response point.

    Solved for all coordinates of the full model; see `operating_shape`.

    Args:
        results: with rates, road and speed.
        frequency_hz: within the band of the results.
        point: number of the response point.
        direction: one of `DIRECTIONS`: there the shape is real, the root of the displacement's PSD.

    Returns:
        (n_dofs,), m/√Hz.

    Raises:
        SolveError: the frequency is out of the band, the point does not move there in that direction,
            or an undamped resonance lies there.
    """
    system, f = _system(results, frequency_hz), np.array([frequency_hz])
    load, speed = results.drive.load, results.conditions.speed
    outputs = results.prepared.outputs
    forces = generalised_forces(system, load, f, speed)[0]
    H = direct_shape(system, frequency_hz, forces, outputs)
    reference = outputs[3 * point + AXIS[direction]]
    return operating_shape(H, input_spectrum(load, f, speed)[0], reference)


def wheel_shape(results: Results, load: str, frequency_hz: float) -> Complexes:
    """Return how the vehicle moves under one harmonic load, at a wheel's revolutions per second.

    Args:
        results: with its rates.
        load: name of one of the vehicle's harmonic loads.
        frequency_hz: within the band of the results.

    Returns:
        (n_dofs,), peak, m, at the load's own amplitude; its phase is to the load's.

    Raises:
        VehicleError: no harmonic load has that name.
        SolveError: the frequency is out of the band, or an undamped resonance lies there.
    """
    system = _system(results, frequency_hz)
    vehicle = system.vehicle
    f = np.array([frequency_hz])
    forces = generalised_forces(system, vehicle.harmonic_load(load), f, vehicle.speed)[0]
    return direct_shape(system, frequency_hz, forces, results.prepared.outputs)[:, 0]


def _system(results: Results, frequency_hz: float) -> System:
    """The vehicle with the rates of the results; raises SolveError out of their band."""
    low, high = results.frequency_hz[[0, -1]]
    if not low <= frequency_hz <= high:
        raise SolveError(
            f"operating shape: found {frequency_hz:g} Hz, expected {low:g} to {high:g} Hz, where "
            "responses are given"
        )
    return results.system
