"""Shares of a mode's energy in bodies and connections: the job of the paper's ENERGY program."""

from collections.abc import Mapping

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ
from modeviz.dynamics.mount_rates import by_motion
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody


def kinetic_energy(system: System, shapes: Floats) -> Mapping[str, Floats]:
    """Each body's share of a mode's kinetic energy, (n_modes,) by body; they sum to one.

    T_b = φ_bᴴ (Mφ)_b / φᴴMφ, added masses counted with the body that carries them. A complex shape
    has the mean of its cycle.
    """
    starts = [dofs.start for dofs in system.dofs.values()]
    energy = np.add.reduceat((np.conj(shapes) * system.momentum(shapes)).real, starts)
    return dict(zip(system.dofs, energy / energy.sum(axis=0), strict=True))


def strain_energy(
    system: System, shapes: Floats, mount_stiffness: Floats | None = None
) -> Mapping[str, Floats]:
    """Each flexible body's and each connection group's share, (n_modes,) by name; they sum to one.

    A body has its modal stiffness, a connection k δ² of its relative motion δ. A mode that moves freely
    has no shares: zeros.

    Args:
        system: what vibrates.
        shapes: mass-normalised, (n_dofs, n_modes).
        mount_stiffness: real rates of every mount spring, (n_springs, n_modes or 1), in place of its
            own.
    """
    bodies = [body for body in system.vehicle.bodies if isinstance(body, FlexibleBody)]
    groups, stretch = _group_energy(system, shapes, mount_stiffness)
    energy = np.array(
        [body.omega_n_squared @ np.abs(shapes[system.dofs[body.name]]) ** 2 for body in bodies]
        + [*stretch]
    ).reshape(-1, shapes.shape[1])
    total = energy.sum(axis=0)
    free = total < (2 * np.pi * RESOLVED_HZ) ** 2
    shares = np.where(free, 0.0, energy) / np.where(free, 1.0, total)
    return dict(zip([*(body.name for body in bodies), *groups], shares, strict=True))


def _group_energy(
    system: System, shapes: Floats, mount_stiffness: Floats | None
) -> tuple[list[str], Floats]:
    """The connection groups and twice the strain energy of each, (n_groups, n_modes), J."""
    k = np.repeat(system.connection_stiffness[:, None], shapes.shape[1], axis=1)
    if mount_stiffness is not None:
        of_mounts = by_motion(system.vehicle, mount_stiffness.T)
        k[: of_mounts.shape[1]] = of_mounts.T
    stretch = k * np.abs(system.connection_motions @ shapes) ** 2
    by_connection = stretch.reshape(-1, 6, shapes.shape[1]).sum(axis=1)
    group_of = [connection.group for connection in system.vehicle.all_connections]
    number = {group: i for i, group in enumerate(dict.fromkeys(group_of))}
    energy = np.zeros((len(number), shapes.shape[1]))
    np.add.at(energy, np.array([number[g] for g in group_of], int), by_connection)
    return list(number), energy
