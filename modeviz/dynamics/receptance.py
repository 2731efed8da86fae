"""Displacement per unit force between chosen directions of a vehicle, at many frequencies.

    G(ω) = P Z(ω)⁻¹ Pᵀ,  Z = K + jK_g + jωC - ω²M

Dual assembly: each body stands alone in mass-normalised modal coordinates, where its dynamic stiffness
Z_b = ω_n² (1 + jg) - ω² + jωc is diagonal, and what joins the bodies enters by its forces λ. Most
coordinates e are eliminated; some, u, are kept with the forces:

    [ Z_u              R_uᵀ             ] [u]   [       P_uᵀ       ]
    [ R_u   -(1/z + R_e Z_e⁻¹ R_eᵀ)     ] [λ] = [ -R_e Z_e⁻¹ P_eᵀ  ]

z = k (1 + jg) + jωc for a connection, -ω²m for an added mass, 1/z = 0 for a rigid joint (D. de Klerk,
D. J. Rixen, S. N. Voormeeren, "General framework for dynamic substructuring", AIAA Journal 46(5),
2008). A gap that a joint has to close, as a motion given to a rigid one, adds itself to the right side
of the joint's line; by reciprocity what a force there gives is the joint's own force.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain

import numpy as np

from modeviz.compute.threads import in_turn, thread_pool
from modeviz.dynamics.assembly import System, all_coefficients, modal_coefficients
from modeviz.dynamics.inputs import directions
from modeviz.dynamics.response import check_accuracy, check_frequencies, drowned
from modeviz.dynamics.spring_law import SpringLaw, connection_law
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.bodies import Body, FlexibleBody

AT_ONCE = 8
"""Lines that a thread solves before it is given others."""

SOFT = 1e-4
"""A coordinate is kept where by itself it is softer than this part of the stiffness its joints give
it, as a rigid one at low frequency: eliminated, it would cost as many digits."""

RIGID = 1e-30
"""m/N: what yields less does not yield."""

ACCURACY = 1e-9
"""What is promised of receptances, relative to the largest of their row; less is an error."""


def receptance_lines(
    system: System,
    frequency_hz: Floats,
    rows: Floats,
    progress: Callable[[float], None] | None = None,
) -> Iterator[Complexes]:
    """G (n_rows, n_rows) at each frequency in turn: displacement along each row per force along each.

    Of a row that is a motion given to rigid joints, the unit is that motion, and their force is read.

    Memory: for each thread a few complex matrices of the size of all joined directions, kept
    coordinates and rows together, whatever the number of modes and frequencies.

    Args:
        system: what vibrates.
        frequency_hz: (n_freqs,), rising, above zero.
        rows: P, (n_rows, n_dofs), or wider by the motions that rigid joints are given and then by gaps
            of all connections, see `opened`.
        progress: told the fraction that is done, up to one.

    Raises:
        SolveError: the frequencies are not such, or one lies on an undamped resonance.
    """
    check_frequencies(frequency_hz)
    parts = _disassemble(system, rows)
    stretches = np.split(frequency_hz, range(AT_ONCE, len(frequency_hz), AT_ONCE))
    with thread_pool() as pool:
        found = in_turn(pool, parts.receptances, stretches)
        for i, G in enumerate(chain.from_iterable(found)):
            yield G
            if progress:
                progress((i + 1) / len(frequency_hz))


def receptances_along(system: System, rows: Floats) -> Callable[[Complexes, Complexes], Complexes]:
    """A function of complex frequencies (n,), Hz, and directions v, (n, n_rows): vᵀGv, (n,).

    Args:
        system: what vibrates.
        rows: P, (n_rows, n_dofs), as of `receptance_lines`.
    """
    parts = _disassemble(system, rows)

    def one(frequency_hz: complex, v: Complexes) -> complex:
        try:
            return complex(v @ parts.solution(frequency_hz)[2] @ v)
        except SolveError:
            return complex(np.inf, 0)

    def along(frequency_hz: Complexes, directions: Complexes) -> Complexes:
        with thread_pool() as pool:
            return np.array(list(pool.map(one, frequency_hz, directions)), complex)

    return along


@dataclass(frozen=True, eq=False)
class _Joints:
    """All that joins bodies or is carried by them: springs and dampers, added masses, rigid joints."""

    stiffness: Complexes
    damping: Floats
    mass: Floats
    """(n_joints,) each."""
    law: SpringLaw
    """How the stiffness of these depends on frequency."""
    n_rigid: int
    """How many more there are, the last, that do not yield."""

    def compliance(self, omega: complex) -> Complexes:
        """1/z, (n_joints + n_rigid,)."""
        stiffness = self.law.stiffness(self.stiffness, np.array([omega / (2 * np.pi)]))[0]
        z = stiffness + 1j * omega * self.damping - omega**2 * self.mass
        return np.concatenate([1 / z, np.zeros(self.n_rigid, complex)])


@dataclass(frozen=True, eq=False)
class _Disassembled:
    """Bodies by themselves, in mass-normalised coordinates, and what joins them.

    Directions are those of the joints, then the rows asked for.
    """

    joints: _Joints
    omega_n_squared: Floats
    damping: Floats
    structural_damping: Floats
    """(n_dofs,) each."""
    motions: Floats
    """(n_directions, n_dofs)."""
    given: Floats
    """(n_rows, n_joints + n_rigid): what gap each row opens in joints, a motion given to rigid ones."""
    moved: tuple[tuple[slice, Floats, tuple[np.ndarray, ...]], ...]
    """The coordinates of each body, the motions of the directions that they move, and where a square
    matrix of all directions has those of these."""
    squares: Floats
    """(n_joints + n_rigid, n_dofs), of the motions of joints."""
    behind: Floats
    """(n_joints + n_rigid,), what the elastic modes behind a joint yield, m/N."""

    def receptances(self, frequency_hz: Floats) -> list[Complexes]:
        """G at each of some frequencies, as accurate as promised."""
        return [self._receptance(f) for f in frequency_hz]

    def _receptance(self, frequency_hz: float) -> Complexes:
        S, X, G = self.solution(frequency_hz)
        parts = np.abs(S)
        np.fill_diagonal(parts, 1)
        check_accuracy(parts, X, G, frequency_hz, ACCURACY)
        return G

    def solution(self, frequency_hz: complex) -> tuple[Complexes, Complexes, Complexes]:
        """The matrix bordered by the rows, scaled, its solution, and condensed to the rows: G."""
        matrix, scale = self._bordered(2 * np.pi * frequency_hz)
        n = len(scale)
        matrix[:n] *= scale[:, None]
        matrix[:, :n] *= scale
        S, B = matrix[:n, :n], matrix[:n, n:]
        try:
            X = np.linalg.solve(S, B)
        except np.linalg.LinAlgError:
            raise drowned(abs(frequency_hz)) from None
        return S, X, B.T @ X - matrix[n:, n:]

    def _bordered(self, omega: complex) -> tuple[Complexes, Floats]:
        """The matrix of u, λ and rows, and what scales the parts of its diagonal to one for u and λ."""
        compliance = self.joints.compliance(omega)
        Z = self.omega_n_squared - omega**2 + 1j * (omega * self.damping + self.structural_damping)
        squares = self.squares
        kept = np.abs(Z) < SOFT * (self.omega_n_squared + self._held_by(compliance))
        per_force = np.divide(1, Z, out=np.zeros_like(Z), where=~kept)
        n_kept = np.count_nonzero(kept)
        matrix = np.zeros((n_kept + len(self.motions),) * 2, complex)
        matrix[:n_kept, :n_kept] = np.diag(Z[kept])
        matrix[n_kept:, :n_kept] = self.motions[:, kept]
        matrix[:n_kept, n_kept:] = self.motions[:, kept].T
        matrix[n_kept:, n_kept:] = -self._flexibility(per_force)
        first_row = len(matrix) - len(self.given)
        opened = slice(first_row - self.given.shape[1], first_row)
        matrix[first_row:, opened] += self.given
        matrix[opened, first_row:] += self.given.T
        joints = np.arange(n_kept, n_kept + len(compliance))
        matrix[joints, joints] -= compliance
        own_parts = self.omega_n_squared + omega**2
        joint_parts = np.abs(compliance) + squares @ (own_parts * np.abs(per_force) ** 2)
        rigid = compliance == 0
        joint_parts[rigid] += squares[np.ix_(rigid, kept)] @ (1 / own_parts[kept])
        return matrix, 1 / np.sqrt(np.concatenate([own_parts[kept], joint_parts]))

    def _held_by(self, compliance: Complexes) -> Floats:
        """The stiffness with which joints hold each coordinate, (n_dofs,), rad²/s².

        A rigid joint holds as the elastic modes behind it do, and without any there is no limit.
        """
        yielding = np.where(compliance == 0, self.behind, np.abs(compliance))
        return (1 / np.maximum(yielding, RIGID)) @ self.squares

    def _flexibility(self, per_force: Complexes) -> Complexes:
        """R_e Z_e⁻¹ R_eᵀ, (n_directions, n_directions), from the diagonal of Z_e⁻¹."""
        A = np.zeros((len(self.motions), len(self.motions)), complex)
        for own, Q, places in self.moved:
            d = per_force[own]
            A[places] += (Q * d.real) @ Q.T + 1j * ((Q * d.imag) @ Q.T)
        return A


def _disassemble(system: System, rows: Floats) -> _Disassembled:
    bodies = system.vehicle.bodies
    joined, joints = _joints(system)
    n_dofs, n_rigid = system.n_dofs, len(system.rigid_motions)
    rows, given, gaps = np.split(directions(system, rows), [n_dofs, n_dofs + n_rigid], axis=1)
    motions = np.vstack([joined, rows])
    for body in bodies:
        own = system.dofs[body.name]
        motions[:, own] = motions[:, own] @ _normalising(body)
    damping, omega_n_squared, structural = np.hstack([_modal_coefficients(b) for b in bodies])
    moved = []
    for own in system.dofs.values():
        directions_moved = np.flatnonzero(motions[:, own].any(axis=1))
        places = np.ix_(directions_moved, directions_moved)
        moved.append((own, motions[directions_moved, own], places))
    squares = motions[: len(joined)] ** 2
    is_elastic = omega_n_squared > 0
    elastic = np.divide(1, omega_n_squared, out=np.zeros_like(omega_n_squared), where=is_elastic)
    return _Disassembled(
        joints,
        omega_n_squared,
        damping,
        structural,
        motions,
        np.hstack([_in_joints(system, gaps, len(joined) - joints.n_rigid), _in_held(system, given)]),
        tuple(moved),
        squares,
        squares @ elastic,
    )


def _in_joints(system: System, gaps: Floats, n_joints: int) -> Floats:
    """Gaps of connections as those of the joints that yield, (n_rows, n_joints); they are the first."""
    yielding = np.zeros((len(gaps), n_joints))
    if gaps.shape[1]:
        k, c, _ = all_coefficients(system.vehicle)
        own = gaps[:, (k > 0) | (c > 0)]
        yielding[:, : own.shape[1]] = own
    return yielding


def _in_held(system: System, given: Floats) -> Floats:
    """Motions given to rigid connections as those of what these hold, (n_rows, n_held)."""
    return given @ system.rigid_joints.shares.T if system.rigid_joints else given[:, :0]


def _joints(system: System) -> tuple[Floats, _Joints]:
    """Directions (n_joints, n_dofs) that are joined, and by what. Without a rate there is no joint."""
    vehicle = system.vehicle
    k, c, g = all_coefficients(vehicle)
    joined = (k > 0) | (c > 0)
    carried = [system.motion(a.body, a.position)[:3] for a in vehicle.added_masses]
    mass = np.repeat([a.mass for a in vehicle.added_masses], 3)
    none = np.zeros(len(mass))
    dampers = [system.mode_dampers] if system.mode_damping.size else []
    damped = np.zeros(len(system.mode_damping))
    held = system.rigid_joints.held if system.rigid_joints else np.zeros((0, system.n_dofs))
    joints = _Joints(
        stiffness=np.r_[(k * (1 + 1j * g))[joined], none, damped],
        damping=np.r_[c[joined], none, system.mode_damping],
        mass=np.r_[np.zeros(np.count_nonzero(joined)), mass, damped],
        law=connection_law(vehicle).of(joined).followed_by(len(mass) + len(damped)),
        n_rigid=len(held),
    )
    return np.vstack([system.connection_motions[joined], *carried, *dampers, held]), joints


def _normalising(body: Body) -> Floats:
    """T, (n, n): a body's coordinates are T times mass-normalised ones, TᵀMT = I."""
    if isinstance(body, FlexibleBody):
        return np.eye(body.n_modes)
    T = np.zeros((6, 6))
    T[:3, :3] = np.eye(3) / np.sqrt(body.mass)
    T[3:, 3:] = np.linalg.inv(np.linalg.cholesky(body.inertia)).T
    return T


def _modal_coefficients(body: Body) -> Floats:
    """`modal_coefficients` of each mass-normalised coordinate, (3, n)."""
    return np.array(modal_coefficients(body)) if isinstance(body, FlexibleBody) else np.zeros((3, 6))
