"""What there is to show moving besides undamped modes: damped ones, and operating shapes.

Each is a shape in the vehicle's coordinates, (n_dofs,), complex: motion goes as Re(shape e^{jωt}).
"""

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.damped import DampedMode, damped_mode
from modeviz.dynamics.response import direct_shape
from modeviz.errors import SolveError
from modeviz.ride.operating import operating_shape
from modeviz.ride.roads import road_spectrum, track_forces
from modeviz.ride.wheels import wheel_forces
from modeviz.tuning.results import AXIS, ModalResults, Results
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
    """How the vehicle moves on its road at one frequency, as seen from a response point.

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
    road, speed = system.vehicle.road(results.conditions.road), results.conditions.speed
    outputs = results.prepared.outputs
    H = direct_shape(system, frequency_hz, track_forces(system, f, speed)[0], outputs)
    reference = outputs[3 * point + AXIS[direction]]
    return operating_shape(H, road_spectrum(road, f, speed)[0], reference)


def wheel_shape(results: Results, load: str, frequency_hz: float) -> Complexes:
    """How the vehicle moves under one wheel load at one frequency, the wheel's revolutions per second.

    Args:
        results: with its rates.
        load: name of one of the vehicle's wheel loads.
        frequency_hz: within the band of the results.

    Returns:
        (n_dofs,), peak, m, at the load's own amplitude; its phase is to the load's.

    Raises:
        VehicleError: no wheel load has that name.
        SolveError: the frequency is out of the band, or an undamped resonance lies there.
    """
    system = _system(results, frequency_hz)
    loads = [system.vehicle.wheel_load(load)]
    forces = wheel_forces(system, loads, np.array([frequency_hz]))[0]
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
