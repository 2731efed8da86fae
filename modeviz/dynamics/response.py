"""Forced response: displacement per unit of harmonic input."""

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import Modes
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats


def direct_response(
    system: System, frequency_hz: Floats, forces: Complexes, outputs: Floats
) -> Complexes:
    """H (n_freqs, n_outputs, n_inputs), solving the full system at every frequency.

    H = R (-ω²M + jωC + jK_g + K)⁻¹ F

    Args:
        system: what vibrates.
        frequency_hz: (n_freqs,).
        forces: F, (n_freqs, n_dofs, n_inputs), generalised forces per unit of input.
        outputs: R, (n_outputs, n_dofs), rows that read the answer.

    Raises:
        SolveError: an undamped resonance lies exactly on a frequency.
    """
    K = system.stiffness + 1j * system.structural_damping
    H = np.empty((len(frequency_hz), len(outputs), forces.shape[2]), complex)
    for i, omega in enumerate(2 * np.pi * np.asarray(frequency_hz)):
        Z = K - omega**2 * system.mass + 1j * omega * system.damping
        H[i] = outputs @ _solve(Z, forces[i], frequency_hz[i])
    return H


def modal_response(
    system: System, modes: Modes, frequency_hz: Floats, forces: Complexes, outputs: Floats
) -> Complexes:
    """The same in modal coordinates, keeping the damping that couples them.

    Exact when `modes` are all of the system's; otherwise what the modes left out would add
    statically is missing. Arguments and errors as `direct_response`.
    """
    q = modal_coordinates(system, modes, frequency_hz, forces)
    return (outputs @ modes.shapes) @ q


def modal_coordinates(
    system: System, modes: Modes, frequency_hz: Floats, forces: Complexes
) -> Complexes:
    """How much of each mode is in the response: q, (n_freqs, n_modes, n_inputs)."""
    phi = modes.shapes
    C = phi.T @ system.damping @ phi
    K = np.diag(modes.omega_n_squared) + 1j * (phi.T @ system.structural_damping @ phi)
    identity = np.eye(phi.shape[1])
    modal_forces = phi.T @ forces
    q = np.empty(modal_forces.shape, complex)
    for i, omega in enumerate(2 * np.pi * np.asarray(frequency_hz)):
        q[i] = _solve(K - omega**2 * identity + 1j * omega * C, modal_forces[i], frequency_hz[i])
    return q


def _solve(Z: Complexes, F: Complexes, frequency_hz: float) -> Complexes:
    try:
        return np.linalg.solve(Z, F)
    except np.linalg.LinAlgError:
        raise SolveError(
            f"an undamped resonance lies exactly at {frequency_hz} Hz: give it damping or shift "
            "the frequency"
        ) from None
