"""Every load of a vehicle as forces along directions that do not depend on it.

A motion z of the ground under a connection of dynamic stiffness k (1 + jg) + jωc is the force of the
connection stretched by it. Where that connection is a mount, the force changes with the mount's rates;
its stretch does not contain the ground's motion, so what the mount feels is the stretch less z. Where
the connection is rigid, what it holds moves by z.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import System, all_coefficients, is_rigid
from modeviz.dynamics.inputs import directions
from modeviz.dynamics.mount_rates import by_motion, constant_damping, rows_of_springs
from modeviz.dynamics.spring_law import spring_law
from modeviz.errors import VehicleError
from modeviz.ride.roads import (
    held,
    interpolated_power,
    patch_motion,
    road_spectrum,
    track_amplitudes,
    tyre_directions,
)
from modeviz.ride.wheels import wheel_amplitudes, wheel_directions
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS, Connection
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.loads import (
    BaseMotion,
    Force,
    HarmonicLoad,
    RandomLoad,
    Road,
    Spectrum,
    WheelLoad,
    spectrum_of,
)
from modeviz.vehicle.vehicle import Vehicle

Load = RandomLoad | HarmonicLoad

FOLLOWS = 1e-3
"""Of a unit motion of the ground: as far as the rigid modes of a body may be off."""


@dataclass(frozen=True, eq=False)
class Excitation:
    """Forces and motions of the ground that inputs give a vehicle, per unit of each."""

    forces: Complexes
    """(n_freqs, n_directions, n_inputs), N along each of `input_directions`; m, where that is a motion
    given to a rigid joint."""
    ground: Complexes
    """(n_freqs, n_springs, n_inputs), m: how far the ground end of each mount spring moves along it."""


def input_directions(system: System) -> Floats:
    """Rows (n_directions, n_dofs + n_rigid) along which loads act.

    `tyre_directions` and `wheel_directions`, then one for each force, then along and about x, y, z
    where each engine shakes its body, then the three local axes of each connection whose ground end
    some base motion moves; those in which it is rigid are motions given to it.

    Raises:
        VehicleError: a base motion does not move all rigid connections that hold one motion.
    """
    vehicle = system.vehicle
    forces = [f.direction @ system.motion(f.body, f.position)[None, :3] for f in vehicle.forces]
    engines = [system.motion(e.body, e.position) for e in vehicle.engines]
    moved = [_moved_directions(system, c) for c in _moved(vehicle)]
    for motion in vehicle.base_motions:
        _check_led(system, motion)
    wheels = tyre_directions(system), wheel_directions(system)
    return directions(system, *wheels, *forces, *engines, *moved)


def excitation(
    vehicle: Vehicle,
    load: Load,
    frequency_hz: Floats,
    speed: float,
    mount_stiffness: Complexes,
) -> Excitation:
    """The inputs of a load.

    A road has two, the displacements of its tracks; every other random load has one, of which its
    spectrum is; a harmonic load has one, of its own amplitude.

    Args:
        vehicle: whose tyres and connections.
        load: one of its loads.
        frequency_hz: (n_freqs,).
        speed: on a road, m/s.
        mount_stiffness: (n_springs,) or (n_freqs, n_springs), complex rates of the mounts, N/m, at
            which the forces hold.
    """
    f = np.asarray(frequency_hz, float)
    slots = _Slots(vehicle)
    n_inputs = 2 if isinstance(load, Road) else 1
    forces = np.zeros((len(f), slots.n_directions, n_inputs), complex)
    ground = np.zeros((len(f), mount_stiffness.shape[-1], n_inputs), complex)
    match load:
        case Road():
            forces[:, slots.tyres] = track_amplitudes(vehicle, f, speed)
        case WheelLoad():
            forces[:, slots.wheels] = wheel_amplitudes(vehicle, [load], f)
        case Force():
            forces[:, slots.forces[load.name]] = _peak(load)
        case EngineOrder():
            forces[:, slots.engines[load.engine], 0] = load.at(f)
        case BaseMotion():
            motions = ground_motions(vehicle, load, f, speed)
            z = _dynamic_stiffness(vehicle, f, mount_stiffness)
            rows = rows_of_springs(vehicle)
            for i, connection in enumerate(vehicle.all_connections):
                if connection.name in motions:
                    along = motions[connection.name][:, :, 0]
                    forces[:, slots.moved[connection.name], 0] = z[:, i] * along
                    own = np.flatnonzero((rows >= 6 * i) & (rows < 6 * i + 3))
                    ground[:, own, 0] = along[:, rows[own] - 6 * i]
    return Excitation(forces, ground)


def ground_motions(
    vehicle: Vehicle, load: Load, frequency_hz: Floats, speed: float
) -> dict[str, Complexes]:
    """How far a load moves the ground ends of connections along their local axes, per unit of input.

    A road moves those of tyres, a base motion those that it names; no other load moves the ground.

    Args:
        vehicle: whose connections.
        load: one of its loads.
        frequency_hz: (n_freqs,).
        speed: on a road, m/s.

    Returns:
        (n_freqs, 3, n_inputs), m, by the name of the connection.
    """
    if isinstance(load, Road):
        return {t.name: patch_motion(vehicle, t, frequency_hz, speed) for t in vehicle.tyres}
    if not isinstance(load, BaseMotion):
        return {}
    displacement = (_peak(load) * _displacement(load, frequency_hz)).astype(complex)
    return {
        c.name: np.outer(displacement, c.axes @ load.direction)[:, :, None]
        for c in vehicle.moved_connections(load)
    }


def together(excitations: Sequence[Excitation]) -> Excitation:
    """The inputs of several loads, one load after the other."""
    return Excitation(
        np.concatenate([e.forces for e in excitations], axis=2),
        np.concatenate([e.ground for e in excitations], axis=2),
    )


def generalised_forces(system: System, load: Load, frequency_hz: Floats, speed: float) -> Complexes:
    """Forces and given motions per unit of each input, (n_freqs, n_dofs + n_rigid, n_inputs).

    Forces on its coordinates, then motions given to its rigid joints. Arguments as of `excitation`.
    """
    stiffness = spring_law(system.vehicle).stiffness(system.mount_stiffness, frequency_hz)
    inputs = excitation(system.vehicle, load, frequency_hz, speed, stiffness)
    return input_directions(system).T @ inputs.forces


def input_spectrum(load: Load, frequency_hz: Floats, speed: float) -> Complexes:
    """The one-sided spectrum of a load's inputs, (n_freqs, n_inputs, n_inputs).

    Of a harmonic load, whose inputs have its amplitude, it is one.

    Raises:
        ModevizError: its table does not reach that far.
    """
    if isinstance(load, Road):
        return road_spectrum(load, frequency_hz, speed)
    spectrum = spectrum_of(load)
    power = np.ones(len(frequency_hz))
    if spectrum:
        power = interpolated_power(load.name, spectrum, frequency_hz)
    return power.reshape(-1, 1, 1).astype(complex)


def known_part(load: Load, frequency_hz: Floats, speed: float) -> slice:
    """The slice of some frequencies, (n_freqs,), at which the spectrum of a load is known.

    Raises:
        ModevizError: none of them.
    """
    table = table_hz(load, speed)
    if not table.size:
        return slice(0, len(frequency_hz))
    what = f"road {load.name!r}" if isinstance(load, Road) else repr(load.name)
    return held(what, table, frequency_hz)


def acting_lines(load: Load, frequency_hz: Floats) -> Floats:
    """Those of some frequencies at which a load acts: an order of an engine only where that can run."""
    return frequency_hz[load.acts(frequency_hz)] if isinstance(load, EngineOrder) else frequency_hz


def table_hz(load: Load, speed: float) -> Floats:
    """The frequencies at which the spectrum of a load is given, Hz, rising; none of a harmonic load."""
    if isinstance(load, Road):
        return load.frequency_hz * (speed / load.speed)
    spectrum = spectrum_of(load)
    return spectrum.frequency_hz if spectrum else np.zeros(0)


class _Slots:
    """The places in `input_directions` of each load's own."""

    def __init__(self, vehicle: Vehicle) -> None:
        n = 3 * len(vehicle.tyres)
        self.tyres, self.wheels = slice(0, n), slice(n, 2 * n)
        self.forces = {force.name: 2 * n + i for i, force in enumerate(vehicle.forces)}
        first = 2 * n + len(vehicle.forces)
        starts = {engine.name: first + 6 * i for i, engine in enumerate(vehicle.engines)}
        self.engines = {name: slice(at, at + 6) for name, at in starts.items()}
        start = first + 6 * len(vehicle.engines)
        moved = _moved(vehicle)
        self.moved = {c.name: slice(start + 3 * i, start + 3 * i + 3) for i, c in enumerate(moved)}
        self.n_directions = start + 3 * len(moved)


def _moved(vehicle: Vehicle) -> list[Connection]:
    """The connections whose ground ends some base motion moves."""
    names = {c.name for motion in vehicle.base_motions for c in vehicle.moved_connections(motion)}
    return [c for c in vehicle.all_connections if c.name in names]


def _moved_directions(system: System, connection: Connection) -> Floats:
    """The local axes of a connection as directions, (3, n_dofs + n_rigid)."""
    rows = directions(system, system.relative_motion(connection)[:3])
    for row, motion in zip(rows, MOTIONS, strict=False):
        if motion in connection.rigid:
            row[:] = 0.0
            row[system.n_dofs + system.rigid_motions.index((connection.name, motion))] = 1.0
    return rows


def _check_led(system: System, motion: BaseMotion) -> None:
    """Raises VehicleError unless the rigid connections can all follow a base motion."""
    wanted = {
        (c.name, m): along
        for c in system.vehicle.moved_connections(motion)
        for m, along in zip(MOTIONS[:3], c.axes @ motion.direction, strict=True)
    }
    a = np.array([wanted.get(held, 0.0) for held in system.rigid_motions])
    if not system.rigid_joints or not a.any():
        return
    error = np.abs(system.held_motions @ system.rigid_joints.led @ a - a)
    if error.max() > FOLLOWS:
        name, held = system.rigid_motions[int(error.argmax())]
        raise VehicleError(
            f"base motion {motion.name!r}: {name!r} holds what others move along or about its {held}; "
            "expected all rigid connections to the ground that hold the same to be moved alike"
        )


def _dynamic_stiffness(vehicle: Vehicle, frequency_hz: Floats, mount_stiffness: Complexes) -> Complexes:
    """Complex k (1 + jg) + jωc of connections along their axes, (n_freqs, n_connections, 3), N/m.

    Mounts have the rates given. One along an axis in which it is rigid, for there the motion itself is
    what it does.
    """
    k, _, g = all_coefficients(vehicle)
    omega = 2 * np.pi * frequency_hz[:, None]
    z = k * (1 + 1j * g) + 1j * omega * constant_damping(vehicle)
    of_mounts = by_motion(vehicle, np.atleast_2d(mount_stiffness))
    n = of_mounts.shape[1]
    z[:, :n] += of_mounts - (k * (1 + 1j * g))[:n]
    z[:, is_rigid(vehicle)] = 1.0
    return z.reshape(len(z), -1, 6)[:, :, :3]


def _peak(load: Force | BaseMotion) -> float:
    """The amplitude of a harmonic load; one, where a spectrum has it."""
    return 1.0 if isinstance(load.amplitude, Spectrum) else load.amplitude


def _displacement(motion: BaseMotion, frequency_hz: Floats) -> Floats:
    """Displacement of the ground per unit of what the amplitude is of, (n_freqs,)."""
    if motion.quantity == "displacement":
        return np.ones(len(frequency_hz))
    return -1 / (2 * np.pi * frequency_hz) ** 2
