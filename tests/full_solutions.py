"""Whole answers in one piece, beside which what modeviz solves by parts is held."""

import numpy as np

from modeviz.dynamics.modes import solve_modes, vibrating_roots
from modeviz.dynamics.receptance import receptance_lines
from modeviz.ride.wheels import wheel_amplitudes, wheel_directions


def complex_modes(system):
    """The damped roots λ (n_modes,) of a whole system, and their shapes (n_dofs, n_modes)."""
    modes = solve_modes(system)
    phi = modes.shapes
    K = np.diag(modes.omega_n_squared) + 1j * (phi.T @ system.structural_damping @ phi)
    roots, q = vibrating_roots(phi.T @ system.damping @ phi, K)
    return roots, phi @ q


def receptances(system, frequency_hz, rows):
    """PᵀZ⁻¹P along the rows P at all frequencies, (n_freqs, n_rows, n_rows)."""
    return np.array(list(receptance_lines(system, frequency_hz, rows)))


def response_psd(frequency_response, input_psd):
    """The spectra of outputs with each other, S_ij = E[X_i X_j*]: H S Hᴴ, (n_freqs, n, n)."""
    H = frequency_response
    return H @ input_psd @ H.conj().transpose(0, 2, 1)


def wheel_forces(system, loads, frequency_hz):
    """Generalised peak forces of wheel loads, a column for each, (n_freqs, n_dofs, n_loads)."""
    return wheel_directions(system).T @ wheel_amplitudes(system.vehicle, loads, frequency_hz)
