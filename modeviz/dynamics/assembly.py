"""The matrices of a vehicle, those of the paper's equation 10.

    (-ω² M + jω C + jK_g + K) q = F

q are the modal coordinates of the flexible bodies and the six coordinates of the rigid ones. A
connection adds Rᵀ k R, where R are the rows that give the relative motion of its two bodies at its
elastic centre.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import cached_property, lru_cache

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.held_springs import held_rows
from modeviz.dynamics.mount_rates import mount_stiffness, rows_of_springs
from modeviz.dynamics.rigid_joints import RigidJoints, rigid_joints
from modeviz.dynamics.spring_law import spring_law
from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.connections import GROUND, MOTIONS, Connection
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class System:
    """A vehicle's matrices in its generalised coordinates, (n_dofs, n_dofs) each."""

    vehicle: Vehicle
    dofs: Mapping[str, slice]
    """Which coordinates are whose, by the body's name."""
    mass: Floats
    damping: Floats
    """Viscous: modal damping, dampers and tyres."""
    stiffness: Floats
    structural_damping: Floats
    """K_g: the imaginary part of the complex stiffness."""
    connection_motions: Floats
    """Rows (6 n_connections, n_dofs): how each of `vehicle.all_connections` is stretched and turned
    along its local axes, see `relative_motion`."""
    mount_stiffness: Complexes
    """(n_springs,), N/m, N m/rad and N s/m: the complex rates of mount springs that the matrices have;
    where these depend on frequency, those at the reference, see `at`."""
    rigid_joints: RigidJoints | None = None
    """What is held without a spring; None without a rigid joint."""
    mode_dampers: Floats = field(default_factory=lambda: np.zeros((0, 0)))
    """Rows (n_damped, n_dofs) along which dampers of single modes act, see `mode_damping`."""
    mode_damping: Floats = field(default_factory=lambda: np.zeros(0))
    """(n_damped,), 1/s: what they damp with; `damping` has it already."""

    @property
    def n_dofs(self) -> int:
        return len(self.mass)

    @cached_property
    def rigid_motions(self) -> tuple[tuple[str, str], ...]:
        """The connection and the motion, of `MOTIONS`, of each relative motion that is held."""
        every = self.vehicle.all_connections
        return tuple((c.name, m) for c in every for m in MOTIONS if m in c.rigid)

    @property
    def held_motions(self) -> Floats:
        """Rows (n_rigid, n_dofs), see `relative_motion`: those of `rigid_motions`."""
        return self.connection_motions[is_rigid(self.vehicle)]

    @property
    def n_bytes(self) -> int:
        """The memory that the matrices take."""
        return sum(a.nbytes for a in vars(self).values() if isinstance(a, np.ndarray))

    @cached_property
    def dof_names(self) -> tuple[str, ...]:
        """One name for each coordinate: "cab mode 7", "front end residual 3", "engine rx"."""
        return tuple(
            f"{body.name} {name}" for body in self.vehicle.bodies for name in _coordinate_names(body)
        )

    def momentum(self, shapes: Floats) -> Floats:
        """M φ, (n_dofs, n_modes): body by body, for mass couples no two of them."""
        own = self.dofs.values()
        return np.concatenate([self.mass[dofs, dofs] @ shapes[dofs] for dofs in own])

    def motion(self, body: str, position: Floats) -> Floats:
        """Rows (6, n_dofs) that give x, y, z, rx, ry, rz of a point of a body.

        A point of a flexible body moves rigidly with the nearest attachment.
        """
        rows = np.zeros((6, self.n_dofs))
        rows[:, self.dofs[body]] = _local_motion(self.vehicle.body(body), position)
        return rows

    def relative_motion(self, connection: Connection) -> Floats:
        """Rows (6, n_dofs): the first body's motion less the second's, along the local axes.

        Both are taken at the elastic centre, to which rigid arms carry the motion of the ends.
        """
        rows = np.zeros((6, self.n_dofs))
        for sign, body, end in zip((1, -1), connection.bodies, connection.points, strict=True):
            if body != GROUND:
                rows += sign * rigid_motions(connection.center - end) @ self.motion(body, end)
        return np.kron(np.eye(2), connection.axes) @ rows

    @cached_property
    def connection_stiffness(self) -> Floats:
        """Real stiffness of each row of `connection_motions`, (6 n_connections,), N/m and N m/rad."""
        k = [(c.stiffness, c.rotational_stiffness) for c in self.vehicle.all_connections]
        return np.array(k).reshape(-1)

    @cached_property
    def mount_motions(self) -> Floats:
        """Rows (n_springs, n_dofs): how every mount spring is stretched; see `mount_stiffness`."""
        return self.connection_motions[rows_of_springs(self.vehicle)]

    def condensed(self, matrix: Array) -> Array:
        """TᵀAT, (n_free, n_free): a matrix for the motions that rigid joints leave."""
        T = self._freedom
        return matrix if T is None else T.T @ matrix @ T

    @cached_property
    def condensed_equations(self) -> tuple[Floats, Floats, Complexes]:
        """M, C and K + jK_g for the motions that rigid joints leave, (n_free, n_free) each."""
        K = self.stiffness + 1j * self.structural_damping
        return self.condensed(self.mass), self.condensed(self.damping), self.condensed(K)

    def condensed_rows(self, rows: Array) -> Array:
        """R T, (n_rows, n_free): rows that read the motions that rigid joints leave."""
        return rows if self._freedom is None else rows @ self._freedom

    def condensed_shapes(self, shapes: Array) -> Array:
        """Shapes that keep the rigid joints, by the motions these leave: y, (n_free, n_shapes)."""
        T = self._freedom
        return shapes if T is None else T.T @ self.mass @ shapes

    def expanded(self, shapes: Array) -> Array:
        """T y, (n_dofs, n_shapes): what motions that rigid joints leave are in all coordinates."""
        return shapes if self._freedom is None else self._freedom @ shapes

    @property
    def _freedom(self) -> Floats | None:
        return self.rigid_joints and self.rigid_joints.freedom

    def with_rates(self, rates: Rates) -> "System":
        """The system of the same vehicle with other mount rates, K + RᵀΔkR.

        Raises:
            VehicleError: a group that does not exist.
        """
        return self.with_mounts(self.vehicle.with_rates(rates))

    def with_mounts(self, vehicle: Vehicle) -> "System":
        """The system of the same vehicle with mounts of other rates."""
        change = mount_stiffness(vehicle) - self.mount_stiffness
        return replace(self.with_springs(change), vehicle=vehicle)

    def at(self, frequency_hz: float) -> "System":
        """The system with the rates that its mounts have at one frequency."""
        law = spring_law(self.vehicle)
        if law.is_constant:
            return self
        springs = law.springs(self.mount_stiffness)
        return self.with_springs(law.stiffness(springs, np.array([frequency_hz]))[0] - springs)

    def with_constant_rates(self) -> "System":
        """The same system at one frequency, but with mounts that keep their rates at all others."""
        groups = tuple(replace(group, dynamic=None) for group in self.vehicle.mount_groups)
        return replace(self, vehicle=replace(self.vehicle, mount_groups=groups))

    def with_springs(self, change: Complexes) -> "System":
        """The system with mount springs that differ from what the vehicle says.

        Args:
            change: (n_springs,), of complex rates, N/m.
        """
        R, law = self.mount_motions, spring_law(self.vehicle)
        springs = law.springs(change)
        damping = self.damping
        if law.has_dampers:
            damping = damping + (R.T * law.dampers(change)) @ R
        return replace(
            self,
            damping=damping,
            stiffness=self.stiffness + (R.T * springs.real) @ R,
            structural_damping=self.structural_damping + (R.T * springs.imag) @ R,
            mount_stiffness=self.mount_stiffness + change,
        )


def assemble(vehicle: Vehicle) -> System:
    """The system matrices of a vehicle with the mount rates it has.

    Raises:
        VehicleError: rigid connections leave nothing that moves.
    """
    dofs = _number(vehicle)
    n_dofs = max(s.stop for s in dofs.values())
    M, C, K, K_g = np.zeros((4, n_dofs, n_dofs))
    for body in vehicle.bodies:
        own = dofs[body.name], dofs[body.name]
        M[own], C[own], K[own], K_g[own] = _body_matrices(body)
    bare = System(vehicle, dofs, M, C, K, K_g, np.zeros((0, n_dofs)), mount_stiffness(vehicle))
    for added in vehicle.added_masses:
        R = bare.motion(added.body, added.position)[:3]
        M += added.mass * R.T @ R
    if not vehicle.all_connections:
        return bare
    R = np.vstack([bare.relative_motion(c) for c in vehicle.all_connections])
    R[held_rows(vehicle, R)] = 0.0
    k, c, g = all_coefficients(vehicle)
    held = is_rigid(vehicle)
    joints = rigid_joints(M, R[held]) if held.any() else None
    if joints and not joints.freedom.size:
        raise VehicleError(
            "the rigid connections hold everything, expected a vehicle in which something can move"
        )
    return System(
        vehicle,
        dofs,
        mass=M,
        damping=C + (R.T * c) @ R,
        stiffness=K + (R.T * k) @ R,
        structural_damping=K_g + (R.T * (g * k)) @ R,
        connection_motions=R,
        mount_stiffness=bare.mount_stiffness,
        rigid_joints=joints,
    )


def is_rigid(vehicle: Vehicle) -> NDArray[np.bool_]:
    """A mask of the relative motions of all connections that are held, (6 n_connections,)."""
    return np.array([m in c.rigid for c in vehicle.all_connections for m in MOTIONS], bool)


def _number(vehicle: Vehicle) -> dict[str, slice]:
    counts = [b.n_modes if isinstance(b, FlexibleBody) else len(MOTIONS) for b in vehicle.bodies]
    ends = np.cumsum([0, *counts])
    return {b.name: slice(ends[i], ends[i + 1]) for i, b in enumerate(vehicle.bodies)}


def _coordinate_names(body: Body) -> list[str]:
    if not isinstance(body, FlexibleBody):
        return list(MOTIONS)
    return [f"mode {i + 1}" for i in range(body.n_normal)] + [
        f"residual {i + 1}" for i in range(body.n_residuals)
    ]


def _body_matrices(body: Body) -> tuple[Floats, Floats, Floats, Floats]:
    """Mass, damping, stiffness and structural damping of one body on its own."""
    if isinstance(body, FlexibleBody):
        damping, stiffness, structural = map(np.diag, modal_coefficients(body))
        return np.eye(body.n_modes), damping, stiffness, structural
    M = np.zeros((6, 6))
    M[:3, :3] = body.mass * np.eye(3)
    M[3:, 3:] = body.inertia
    none = np.zeros((6, 6))
    return M, none, none, none


def modal_coefficients(body: FlexibleBody) -> tuple[Floats, Floats, Floats]:
    """Damping 2ζω_n, stiffness ω_n² and structural damping gω_n² of each mode, (n_modes,) each."""
    squares = body.omega_n_squared
    return 2 * body.damping_ratios * np.sqrt(squares), squares, body.loss_factor * squares


def _local_motion(body: Body, position: Floats) -> Floats:
    """Rows (6, n) that give the motion of a point in the body's own coordinates."""
    if isinstance(body, FlexibleBody):
        attachment = body.nearest_attachment(position)
        return rigid_motions(position - attachment.position) @ attachment.shapes
    return rigid_motions(position - body.center_of_gravity)


def connection_coefficients(connection: Connection) -> tuple[Floats, Floats, Floats]:
    """Stiffness, damping and loss factor of the six relative motions, (6,) each."""
    k = np.concatenate([connection.stiffness, connection.rotational_stiffness])
    c = np.concatenate([connection.damping, connection.rotational_damping])
    return k, c, np.full(6, connection.loss_factor)


@lru_cache(maxsize=8)
def all_coefficients(vehicle: Vehicle) -> Floats:
    """The same of `vehicle.all_connections`, (3, 6 n_connections); kept for who asks again."""
    every = (np.array(connection_coefficients(c)) for c in vehicle.all_connections)
    coefficients = np.hstack([np.zeros((3, 0)), *every])
    coefficients.flags.writeable = False
    return coefficients
