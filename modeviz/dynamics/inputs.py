"""The inputs of a system: forces on its coordinates and, after them, motions given to its rigid joints.

    R x = a,  Z x = F + Rᵀλ  ⇒  x = U a + T y,  TᵀZT y = Tᵀ(F - Z U a)

F are n_dofs forces and a are n_rigid relative motions R x, see `RigidJoints`: zero but where the ground
end of a joint moves.
"""

import numpy as np

from modeviz.dynamics.assembly import System, is_rigid
from modeviz.vehicle.arrays import Array, Complexes, Floats


def directions(system: System, *rows: Floats) -> Floats:
    """Rows (n_rows, n_dofs + n_rigid) along which something acts, some blocks one after another.

    Rows (n_rows, n_dofs) give nothing to rigid joints; where some are wider, as of `opened`, all are.
    """
    least = system.n_dofs + len(system.rigid_motions)
    width = max(least, *(r.shape[1] for r in rows))
    return np.vstack([np.pad(r, ((0, 0), (0, width - r.shape[1]))) for r in rows])


def opened(system: System) -> Floats:
    """Rows (6 n_connections, n_dofs + n_rigid + 6 n_connections) that open a gap in each connection.

    What is opened by a metre closes by itself as far as the connection is stiff: where it is rigid that
    is the motion given to it, where it has a rate R x - F/z = 1, and where it has none nothing happens.
    What a `dynamics.receptance` of such a row reads is the force F, which the first body puts on the
    connection.
    """
    n, n_rigid = len(system.connection_motions), len(system.rigid_motions)
    rows = np.zeros((n, system.n_dofs + n_rigid + n))
    held = is_rigid(system.vehicle)
    rows[np.arange(n), system.n_dofs + n_rigid + np.arange(n)] = ~held
    rows[np.flatnonzero(held), system.n_dofs + np.arange(n_rigid)] = 1
    return rows


def led(system: System, actions: Array) -> Array:
    """U a, (..., n_dofs, n_inputs): the motion that rigid joints are given.

    Args:
        system: what vibrates.
        actions: (..., n_dofs, n_inputs) or (..., n_dofs + n_rigid, n_inputs).
    """
    given = actions[..., system.n_dofs :, :]
    if system.rigid_joints is None or not given.any():
        return np.zeros_like(actions[..., : system.n_dofs, :])
    return system.rigid_joints.led @ given


def forces_on_rest(system: System, frequency_hz: float | Floats, actions: Complexes) -> Complexes:
    """Inputs turned into forces on the motions that rigid joints leave, (..., n_dofs, n_inputs).

    F - (K + jK_g + jωC) U a: mass does not pull, for TᵀMU = 0.

    Args:
        system: what vibrates.
        frequency_hz: a number or (n_freqs,).
        actions: as of `led`.
    """
    forces, moved = actions[..., : system.n_dofs, :], led(system, actions)
    if not moved.any():
        return forces
    omega = 2 * np.pi * np.asarray(frequency_hz)[..., None, None]
    K = system.stiffness + 1j * system.structural_damping
    return forces - K @ moved - 1j * omega * (system.damping @ moved)
