"""How much of a motion or of a force gets through mounts.

Across a mount it is the acceleration of the carrying end over that of the carried one, at the mount's
elastic centre; from a body to what carries it, the force passed on over the force applied (S. S. Rao,
"Mechanical Vibrations", 6th ed., section 9.10: displacement and force transmissibility). Where what
carries shakes what is carried, as a road does a cab, the inverse of the first says how well it is
isolated.
"""

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.mounting.forces import N_MOTIONS, Forces
from modeviz.mounting.levels import InputSpectra
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import GROUND, Connection
from modeviz.vehicle.rigid import rigid_motions


def end_motions(forces: Forces, x: Complexes, connection: int) -> tuple[Complexes, Complexes]:
    """How the first and the second end of a connection move, both (n_freqs, 3, n_inputs), m.

    Along the vehicle's axes at the elastic centre; the ground as far as the load moves it there.

    Args:
        forces: under the load.
        x: (n_freqs, n_dofs, n_inputs), how all bodies move.
        connection: its number.
    """
    its = forces.connections[connection]
    first, second = (_end_rows(forces.system, its, end) @ x for end in (0, 1))
    if its.bodies[1] == GROUND:
        ground = forces.ground[:, N_MOTIONS * connection : N_MOTIONS * connection + 3]
        second = np.einsum("ij,fik->fjk", its.axes, ground)
    return first, second


def _end_rows(system: System, connection: Connection, end: int) -> Floats:
    """Rows (3, n_dofs) of an end's motion at the elastic centre; zeros of the ground."""
    body, place = connection.bodies[end], connection.points[end]
    if body == GROUND:
        return np.zeros((3, system.n_dofs))
    return (rigid_motions(connection.center - place) @ system.motion(body, place))[:3]


def acceleration_ratio(
    first: Complexes, second: Complexes, spectra: InputSpectra
) -> tuple[Floats, Floats]:
    """The second's acceleration over the first's, (n_freqs, 3), and that of RMS over all lines, (3,).

    √(S_22 / S_11); zero where the first does not move.
    """
    omega = (2 * np.pi * spectra.frequency_hz) ** 4
    of_each = [(spectra.psd(x), spectra.total(x, x, omega)) for x in (first, second)]
    (at_first, all_first), (at_second, all_second) = of_each
    return _root_ratio(at_second, at_first), _root_ratio(all_second, all_first)


def force_ratio(forces: Forces, body: str, applied: float) -> Floats:
    """What connections pass on of a harmonic force on a body, over that force, (n_freqs,).

    The vector sum of the forces that they put on everything else, √(Σ |F|²) over x, y and z.

    Args:
        forces: under the load.
        body: which it acts on.
        applied: its peak, N.
    """
    passed = np.zeros((len(forces.frequency_hz), 3), complex)
    for i, connection in enumerate(forces.connections):
        if body in connection.bodies:
            sign = 1 if connection.bodies[0] == body else -1
            own = slice(N_MOTIONS * i, N_MOTIONS * i + 3)
            passed += sign * forces.in_vehicle_axes[:, own, 0]
    return np.linalg.norm(passed, axis=1) / (applied or np.inf)


def _root_ratio(above: Floats, below: Floats) -> Floats:
    positive = np.maximum(above, 0.0)
    return np.sqrt(np.divide(positive, below, out=np.zeros_like(positive), where=below > 0))
