"""Forced response: displacement per unit of harmonic input."""

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.inputs import forces_on_rest, led
from modeviz.dynamics.modes import Modes
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats

DIRECT_ACCURACY = 1e-6
"""What the direct solve promises: 1e11 N/m beside a spring of 1e3 N/m costs it eight digits."""


def direct_response(
    system: System, frequency_hz: Floats, forces: Complexes, outputs: Floats
) -> Complexes:
    """H (n_freqs, n_outputs, n_inputs), solving the full system at every frequency.

    H = R (-ω²M + jωC + jK_g + K)⁻¹ F

    Args:
        system: what vibrates.
        frequency_hz: (n_freqs,), rising, above zero.
        forces: F, (n_freqs, n_dofs, n_inputs), generalised forces per unit of input, or
            wider by motions given to rigid joints, see `actions`.
        outputs: R, (n_outputs, n_dofs), rows that read the answer.

    Raises:
        SolveError: the frequencies are not such, one lies on an undamped resonance, or rounding of
            the stiffest spring drowns the answer.
    """
    check_frequencies(frequency_hz)
    H = np.empty((len(frequency_hz), len(outputs), forces.shape[2]), complex)
    for i, f in enumerate(frequency_hz):
        H[i] = outputs @ direct_shape(system, f, forces[i], outputs)
    return H


def direct_shape(system: System, frequency_hz: float, forces: Complexes, outputs: Floats) -> Complexes:
    """The displacement of every coordinate at one frequency, (n_dofs, n_inputs).

    Mounts have the rates that they have there.

    Args:
        system: what vibrates.
        frequency_hz: above zero.
        forces: (n_dofs, n_inputs), generalised forces per unit of input, or wider likewise.
        outputs: rows (n_outputs, n_dofs) along which, as along the forces, it must be accurate.

    Raises:
        SolveError: as `direct_response`.
    """
    system, omega = system.at(frequency_hz), 2 * np.pi * frequency_hz
    M, C, K = system.condensed_equations
    Z = K - omega**2 * M + 1j * omega * C
    on_rest = forces_on_rest(system, frequency_hz, forces)
    directions = system.condensed_rows(np.vstack([on_rest.T, outputs], dtype=complex)).T
    x = _solve(Z, directions, frequency_hz)
    parts = np.abs(K) + omega**2 * np.abs(M)
    check_accuracy(parts, x, directions.T @ x, frequency_hz, DIRECT_ACCURACY)
    return led(system, forces) + system.expanded(x[:, : forces.shape[1]])


def check_frequencies(frequency_hz: Floats) -> None:
    """Checks that responses can be solved at these frequencies, hertz.

    Raises:
        SolveError: they are not a row of finite values above zero, each larger than the last.
    """
    f = np.asarray(frequency_hz, float)
    if f.ndim != 1 or not f.size:
        raise SolveError(f"frequency_hz: found shape {f.shape}, expected one row of values")
    wrong = ~(np.isfinite(f) & (f > 0))
    if wrong.any():
        place = int(wrong.argmax())
        raise SolveError(
            f"frequency_hz: found {f[place]:g} Hz at place {place + 1}, expected a finite value above 0"
        )
    if (np.diff(f) <= 0).any():
        place = int((np.diff(f) <= 0).argmax())
        found = "twice" if f[place] == f[place + 1] else f"before {f[place + 1]:g} Hz"
        raise SolveError(f"frequency_hz: found {f[place]:g} Hz {found}, expected rising values")


def modal_response(
    system: System, modes: Modes, frequency_hz: Floats, forces: Complexes, outputs: Floats
) -> Complexes:
    """The response in modal coordinates, keeping the damping that couples them.

    Exact when `modes` are all of the system's; otherwise what the modes left out would add
    statically is missing. Arguments as `direct_response`.

    Raises:
        SolveError: an undamped resonance lies exactly on a frequency.
    """
    phi = modes.shapes
    q = modal_coordinates(
        modes.omega_n_squared,
        phi.T @ system.damping @ phi,
        phi.T @ system.structural_damping @ phi,
        frequency_hz,
        phi.T @ forces_on_rest(system, frequency_hz, forces),
    )
    return outputs @ led(system, forces) + (outputs @ phi) @ q


def modal_coordinates(
    omega_n_squared: Floats,
    damping: Floats,
    structural_damping: Floats,
    frequency_hz: Floats,
    modal_forces: Complexes,
) -> Complexes:
    """Modal coordinates of a response: q, (n_freqs, n_modes, n_inputs).

    (Ω² - ω²I + jωφᵀCφ + jφᵀK_gφ) q = φᵀF

    Args:
        omega_n_squared: (n_modes,).
        damping: φᵀCφ, (n_modes, n_modes).
        structural_damping: φᵀK_gφ, (n_modes, n_modes).
        frequency_hz: (n_freqs,).
        modal_forces: φᵀF, (n_freqs, n_modes, n_inputs).
    """
    K = np.diag(omega_n_squared) + 1j * structural_damping
    identity = np.eye(len(K))
    q = np.empty(modal_forces.shape, complex)
    for i, omega in enumerate(2 * np.pi * np.asarray(frequency_hz)):
        Z = K - omega**2 * identity + 1j * omega * damping
        q[i] = _solve(Z, modal_forces[i], frequency_hz[i])
    return q


def check_accuracy(
    parts: Floats, x: Complexes, G: Complexes, frequency_hz: float, accuracy: float
) -> None:
    """Checks that rounding left G = PᵀZ⁻¹P accurate.

    Summing up Z and solving Z x = P change Z by about ε times the size of its parts and so G by
    xᵀδZ x, in whatever units (N. J. Higham, "Accuracy and Stability of Numerical Algorithms", 2nd ed.,
    ch. 7 and 9). Near an undamped resonance that grows as G².

    Args:
        parts: (n, n), what |Z| would be had no parts cancelled, as |K| + ω²|M|.
        x: Z⁻¹P, (n, n_directions).
        G: (n_directions, n_directions).
        frequency_hz: where, to say so.
        accuracy: wanted, relative to the best known receptance in each direction.

    Raises:
        SolveError: in some direction there is none that accurate.
    """
    size = np.abs(x)
    error = np.sqrt(np.finfo(float).eps * np.einsum("ij,ij->j", size, parts @ size))
    if not (np.outer(error, error) <= accuracy * np.abs(G)).any(axis=1).all():
        raise drowned(frequency_hz)


def drowned(frequency_hz: float) -> SolveError:
    """Says at which frequency rounding drowns the response, why, and what to do."""
    return SolveError(
        f"no accurate response at {frequency_hz} Hz: an undamped resonance lies there (give it damping "
        "or shift the frequency) or a spring is too stiff beside the others (soften it, make it rigid)"
    )


def _solve(Z: Complexes, F: Complexes, frequency_hz: float) -> Complexes:
    try:
        return np.linalg.solve(Z, F)
    except np.linalg.LinAlgError:
        raise drowned(frequency_hz) from None
