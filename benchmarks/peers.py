"""The others: each takes the work and returns a call that does it after a change of mount rates.

What does not depend on the rates is done before, and not timed. A library that is not installed raises
ImportError.
"""

import os
from collections.abc import Callable, Mapping

import numpy as np
import scipy.linalg

from benchmarks.work import Work
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import modal_response
from modeviz.vehicle.arrays import Complexes

Answer = Callable[[], Complexes]
"""Gives H, (n_freqs, n_outputs, n_inputs)."""

N_MODES = 100
"""Vehicle modes where they are superposed; on the truck they reach 120 Hz."""

SDYNPY_BLOCK = 20
"""Frequencies at once: sdynpy holds the inverse of every matrix."""


def modeviz(work: Work) -> Answer:
    """Structural modification on the receptances of the base vehicle."""
    return lambda: work.receptances.response(work.mount_stiffness)


def numpy_direct(work: Work) -> Answer:
    """`numpy.linalg.solve` of the full complex system at every frequency."""
    return lambda: solve_directly(work)


def solve_directly(work: Work, lines: slice = slice(None)) -> Complexes:
    """H at some of the frequencies, solving the full complex system at each."""
    M, C, K = work.system.mass, work.system.damping, work.stiffness_matrix
    omega = 2 * np.pi * work.frequency_hz[lines]
    q = [
        np.linalg.solve(K - w**2 * M + 1j * w * C, F)
        for w, F in zip(omega, work.forces[lines], strict=True)
    ]
    return np.matmul(work.outputs, np.array(q))


def numpy_modal(work: Work) -> Answer:
    """Modal superposition: eigenproblem, then the modes solved together for their full damping."""

    def answer() -> Complexes:
        modes = solve_modes(work.system, N_MODES)
        return modal_response(work.system, modes, work.frequency_hz, work.forces, work.outputs)

    return answer


def pyyeti_full(work: Work) -> Answer:
    """`pyyeti.ode.SolveUnc` on the full system: complex eigensolution in state space."""
    from pyyeti.ode import SolveUnc  # type: ignore[reportMissingImports]

    def answer() -> Complexes:
        solver = SolveUnc(work.system.mass, work.system.damping, work.stiffness_matrix, rb=[])
        q = [solver.fsolve(F.T, work.frequency_hz).d for F in np.moveaxis(work.forces, 2, 0)]
        return np.matmul(work.outputs, np.array(q)).transpose(2, 1, 0)

    return answer


def pyyeti_modal(work: Work) -> Answer:
    """The same after a change to as many vehicle modes as `numpy_modal` has."""
    from pyyeti.ode import SolveUnc  # type: ignore[reportMissingImports]

    def answer() -> Complexes:
        system = work.system
        omega_squared, phi = scipy.linalg.eigh(
            system.stiffness, system.mass, subset_by_index=[0, N_MODES - 1]
        )
        K = np.diag(omega_squared) + 1j * (phi.T @ system.structural_damping @ phi)
        solver = SolveUnc(None, phi.T @ system.damping @ phi, K, rb=[])
        forces = np.moveaxis(phi.T @ work.forces, 2, 0)
        q = [solver.fsolve(F.T, work.frequency_hz).d for F in forces]
        return np.matmul(work.outputs @ phi, np.array(q)).transpose(2, 1, 0)

    return answer


def pyfbs(work: Work) -> Answer:
    """LM-FBS as pyFBS's documentation writes it, with the pseudo-inverse of the whole interface.

    pyFBS has no function for it: Y = Y - Y B_fᵀ pinv(B_u Y B_fᵀ) B_u Y. Substructure A is the base
    vehicle, B the springs that are added to it.
    """
    base = work.receptances
    n_springs, n_outputs = base.outputs.shape[1:]
    n_inputs = base.inputs.shape[2]
    A = np.block([[base.springs, base.inputs], [base.outputs.transpose(0, 2, 1), base.direct]])
    ends = np.eye(n_springs)
    B_u = np.hstack([ends, np.zeros((n_springs, n_outputs)), -ends])
    B_f = np.hstack([ends, np.zeros((n_springs, n_inputs)), -ends])
    uncoupled = np.zeros((len(A), B_u.shape[1], B_f.shape[1]), complex)
    uncoupled[:, :-n_springs, :-n_springs] = A
    asked = slice(n_springs, -n_springs)

    def answer() -> Complexes:
        Y = uncoupled.copy()
        Y[:, -n_springs:, -n_springs:] = np.diag(1 / (work.mount_stiffness - base.mount_stiffness))
        interface = B_u @ Y @ B_f.T
        Y -= Y @ B_f.T @ np.linalg.pinv(interface) @ B_u @ Y
        return Y[:, asked, asked]

    return answer


def substructuring(work: Work) -> Answer:
    """The same for the responses that are asked for alone, with the inverse: FBS at its best."""
    base = work.receptances
    springs = np.arange(len(work.mount_stiffness))

    def answer() -> Complexes:
        interface = base.springs.copy()
        interface[:, springs, springs] += 1 / (work.mount_stiffness - base.mount_stiffness)
        return base.direct - base.outputs.transpose(0, 2, 1) @ (np.linalg.inv(interface) @ base.inputs)

    return answer


def sdynpy(work: Work) -> Answer:
    """`sdynpy.System.frequency_response`, the inverse of the full matrix at every frequency."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")  # sdynpy starts Qt, which may have no screen
    from sdynpy import System, coordinate_array  # type: ignore[reportMissingImports]

    n_outputs = len(work.outputs)
    rows = np.vstack([work.outputs, work.input_rows])
    points = coordinate_array(np.arange(len(rows)) + 1, 1)
    outputs, inputs = np.split(points, [n_outputs])
    n_blocks = -(-len(work.frequency_hz) // SDYNPY_BLOCK)

    def answer() -> Complexes:
        system = System(points, work.system.mass, work.stiffness_matrix, work.system.damping, rows)
        blocks = [
            system.frequency_response(f, outputs, inputs).ordinate
            for f in np.array_split(work.frequency_hz, n_blocks)
        ]
        return np.moveaxis(np.concatenate(blocks, axis=2), 2, 0) @ work.amplitudes

    return answer


METHODS: Mapping[str, Callable[[Work], Answer]] = {
    "modeviz": modeviz,
    "numpy direct": numpy_direct,
    f"numpy, {N_MODES} modes": numpy_modal,
    "pyyeti SolveUnc": pyyeti_full,
    f"pyyeti SolveUnc, {N_MODES} modes": pyyeti_modal,
    "FBS as in pyFBS": pyfbs,
    "FBS, inverse": substructuring,
    "sdynpy": sdynpy,
}
