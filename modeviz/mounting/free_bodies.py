"""Bodies cut free of all that joins them: their dynamic stiffness, and how they move under forces."""

import numpy as np

from modeviz.dynamics.assembly import System, modal_coefficients
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.bodies import FlexibleBody


def free_stiffness(system: System, body: str, frequency_hz: Floats) -> Complexes:
    """Z of a body by itself in its own coordinates, (n_freqs, n, n), with the masses added to it.

    K (1 + jg) + jωC - ω²M; a rigid body has only its mass.
    """
    omega = 2 * np.pi * np.asarray(frequency_hz)[:, None, None]
    own, its = system.dofs[body], system.vehicle.body(body)
    inertia = -(omega**2) * system.mass[own, own]
    if not isinstance(its, FlexibleBody):
        return inertia.astype(complex)
    damping, stiffness, structural = map(np.diag, modal_coefficients(its))
    return inertia + stiffness + 1j * structural + 1j * omega * damping


def free_response(system: System, body: str, frequency_hz: Floats, forces: Array) -> Complexes:
    """Z⁻¹F: how a body that nothing holds moves under forces on its coordinates.

    Args:
        system: which the body is part of.
        body: its name.
        frequency_hz: (n_freqs,), above zero.
        forces: (n_freqs, n, n_columns) or (n, n_columns).

    Returns:
        (n_freqs, n, n_columns).
    """
    Z = free_stiffness(system, body, frequency_hz)
    diagonal = np.einsum("fii->fi", Z)
    if np.count_nonzero(Z) == np.count_nonzero(diagonal):
        return forces / diagonal[:, :, None]
    return np.linalg.solve(Z, np.broadcast_to(forces, (len(Z), *forces.shape[-2:])))


def body_motions(system: System, frequency_hz: Floats, on_bodies: Complexes) -> Complexes:
    """How all bodies move under what acts on them from without, (n_freqs, n_dofs, n_inputs).

    Args:
        system: whose bodies.
        frequency_hz: (n_freqs,).
        on_bodies: (n_freqs, n_dofs, n_inputs), see `Forces.on_bodies`.
    """
    x = np.empty_like(on_bodies)
    for body, own in system.dofs.items():
        x[:, own] = free_response(system, body, frequency_hz, on_bodies[:, own])
    return x
