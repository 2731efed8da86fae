"""The force that passes through every connection under a load, along and about its local axes.

    F = z (R x - g),  z = k (1 + jg) + jωc

R x is how far the first body moves more than the second, g how far the ground moves under the second.
F is what the first body puts on the connection and this on the second, which carries it; each body has
minus RᵀF of it. In a rigid connection R x = g, and F is what holds that. The ground's motion is a gap
that the connection has to close, and F what closes it: by reciprocity the receptance between that gap
and whatever acts, see `dynamics.receptance`. So slow motions, in which all follows the ground and z is
stretched by the small difference of both, lose no digits.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.assembly import System, all_coefficients, is_rigid
from modeviz.dynamics.inputs import directions, opened
from modeviz.dynamics.mount_rates import mount_stiffness
from modeviz.dynamics.receptance import receptance_lines
from modeviz.dynamics.spring_law import connection_law
from modeviz.ride.excitation import (
    Load,
    excitation,
    ground_motions,
    input_directions,
)
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS, Connection
from modeviz.vehicle.loads import BaseMotion, Road

N_MOTIONS = len(MOTIONS)


@dataclass(frozen=True, eq=False)
class Forces:
    """What every connection of a vehicle passes on, per unit of each input of a load."""

    system: System
    """With the mount rates."""
    frequency_hz: Floats
    """(n_freqs,)."""
    force: Complexes
    """(n_freqs, 6 n_connections, n_inputs), N and N m, on the second body along the local axes."""
    ground: Complexes
    """(n_freqs, 6 n_connections, n_inputs), m: g."""
    mode_damping: Complexes
    """(n_freqs, n_damped, n_inputs): what damps single modes of the vehicle, see `System`."""
    loads: Complexes
    """(n_freqs, n_dofs, n_inputs): the load as far as it acts on the bodies themselves."""

    @property
    def connections(self) -> tuple[Connection, ...]:
        """With their rates, in the order of the forces: mounts first."""
        return self.system.vehicle.all_connections

    @property
    def omega(self) -> Floats:
        """(n_freqs,), rad/s."""
        return 2 * np.pi * self.frequency_hz

    @cached_property
    def stretch(self) -> Complexes:
        """(n_freqs, 6 n_connections, n_inputs), m and rad: F/z; zero where a connection has no rate."""
        z = connection_rates(self.system, self.omega)[:, :, None]
        return np.divide(self.force, z, out=np.zeros_like(self.force), where=z != 0)

    @cached_property
    def in_vehicle_axes(self) -> Complexes:
        """`force` along and about the vehicle's axes x, y, z, (n_freqs, 6 n_connections, n_inputs)."""
        turn = [np.kron(np.eye(2), c.axes) for c in self.connections]
        by_connection = self.force.reshape(len(self.force), len(turn), N_MOTIONS, -1)
        turned = np.einsum("cij,fcik->fcjk", np.array(turn).reshape(-1, 6, 6), by_connection)
        return turned.reshape(self.force.shape)

    @cached_property
    def acting(self) -> NDArray[np.bool_]:
        """(6 n_connections,): the motions in which a connection has a rate or is rigid."""
        return acting_motions(self.system)

    @cached_property
    def on_bodies(self) -> Complexes:
        """(n_freqs, n_dofs, n_inputs): all that acts on the bodies' coordinates from without."""
        system = self.system
        pull = system.connection_motions.T @ self.force
        if len(system.mode_damping):
            pull = pull + system.mode_dampers.T @ self.mode_damping
        return self.loads - pull


def solve_forces(
    system: System,
    load: Load,
    frequency_hz: Floats,
    speed: float,
    progress: Callable[[float], None] | None = None,
) -> Forces:
    """The forces under a load, exact for the system.

    Where several rigid connections hold one motion, they share its force as if they were alike.

    Args:
        system: with the mount rates.
        load: one of its vehicle's loads.
        frequency_hz: (n_freqs,), rising, above zero.
        speed: on a road, m/s.
        progress: told the fraction that is done.

    Raises:
        VehicleError: as `input_directions`.
        SolveError: as `receptance_lines`.
    """
    f, ground = np.asarray(frequency_hz, float), ground_rows(system, load, frequency_hz, speed)
    acting = acting_motions(system)
    pushed, amplitudes = pushes(system, load, f, speed)
    rows = directions(system, opened(system)[acting], system.mode_dampers, pushed)
    n_acting, n_damped = np.count_nonzero(acting), len(system.mode_damping)
    n_read = n_acting + n_damped
    found = np.empty((len(f), n_read, ground.shape[2]), complex)
    for i, G in enumerate(receptance_lines(system, f, rows, progress)):
        found[i] = G[:n_read, :n_acting] @ ground[i, acting] + G[:n_read, n_read:] @ amplitudes[i]
    force = np.zeros_like(ground)
    force[:, acting] = found[:, :n_acting]
    damping = 2j * np.pi * f[:, None, None] * system.mode_damping[:, None]
    return Forces(
        system,
        f,
        force,
        ground,
        damping * found[:, n_acting:],
        (amplitudes.swapaxes(1, 2) @ pushed).swapaxes(1, 2),
    )


def pushes(system: System, load: Load, frequency_hz: Floats, speed: float) -> tuple[Floats, Complexes]:
    """Directions (n, n_dofs) in which a load pushes bodies, and how much, (n_freqs, n, n_inputs).

    A load that moves the ground does not.
    """
    n_inputs = 2 if isinstance(load, Road) else 1
    if isinstance(load, Road | BaseMotion):
        return np.zeros((0, system.n_dofs)), np.zeros((len(frequency_hz), 0, n_inputs), complex)
    rates = mount_stiffness(system.vehicle)
    amplitudes = excitation(system.vehicle, load, frequency_hz, speed, rates).forces
    used = amplitudes.any(axis=(0, 2))
    return input_directions(system)[used, : system.n_dofs], amplitudes[:, used]


def connection_rates(system: System, omega: Floats) -> Complexes:
    """Z = k (1 + jg) + jωc of every connection, (n_freqs, 6 n_connections); zero where it is rigid."""
    k, c, g = all_coefficients(system.vehicle)
    stiffness = connection_law(system.vehicle).stiffness(k * (1 + 1j * g), omega / (2 * np.pi))
    return stiffness + 1j * omega[:, None] * c


def acting_motions(system: System) -> NDArray[np.bool_]:
    """(6 n_connections,): the motions in which a connection has a rate or is rigid."""
    k, c, _ = all_coefficients(system.vehicle)
    return (k > 0) | (c > 0) | is_rigid(system.vehicle)


def ground_rows(system: System, load: Load, frequency_hz: Floats, speed: float) -> Complexes:
    """How far the ground moves under each connection, (n_freqs, 6 n_connections, n_inputs), m."""
    connections = system.vehicle.all_connections
    n_inputs = 2 if isinstance(load, Road) else 1
    ground = np.zeros((len(frequency_hz), N_MOTIONS * len(connections), n_inputs), complex)
    motions = ground_motions(system.vehicle, load, frequency_hz, speed)
    for i, connection in enumerate(connections):
        if connection.name in motions:
            ground[:, N_MOTIONS * i : N_MOTIONS * i + 3] = motions[connection.name]
    return ground
