"""Where the energy of a mode is: the job of the paper's ENERGY program."""

from collections.abc import Mapping

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody

FREE_HZ = 1e-3
"""Below this a mode strains nothing; its energy is rounding."""


def kinetic_energy(system: System, shapes: Floats) -> Mapping[str, Floats]:
    """Each body's share of a mode's kinetic energy, (n_modes,) by body; they sum to one.

    T_b = φ_bᵀ (Mφ)_b / φᵀMφ, added masses counted with the body that carries them.
    """
    products = shapes * (system.mass @ shapes)
    total = products.sum(axis=0)
    return {body: products[dofs].sum(axis=0) / total for body, dofs in system.dofs.items()}


def strain_energy(system: System, shapes: Floats) -> Mapping[str, Floats]:
    """Each flexible body's and each connection group's share, (n_modes,) by name; they sum to one.

    A body has its modal stiffness, a connection k δ² of its relative motion δ. A group that bears a
    body's name is added to the body. A mode that moves freely has no shares: zeros.
    """
    energy = {
        body.name: body.omega_n_squared @ shapes[system.dofs[body.name]] ** 2
        for body in system.vehicle.bodies
        if isinstance(body, FlexibleBody)
    }
    for connection in system.vehicle.all_connections:
        k = np.concatenate([connection.stiffness, connection.rotational_stiffness])
        stretch = k @ (system.relative_motion(connection) @ shapes) ** 2
        energy[connection.group] = energy.get(connection.group, 0.0) + stretch
    total = sum(energy.values(), np.zeros(shapes.shape[1]))
    modal_mass = np.einsum("ij,ij->j", shapes, system.mass @ shapes)
    strained = total > (2 * np.pi * FREE_HZ) ** 2 * modal_mass
    return {
        name: np.where(strained, e, 0.0) / np.where(strained, total, 1.0) for name, e in energy.items()
    }
