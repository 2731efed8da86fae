"""The whole truck as one finite-element model, to hold its reduction against.

Every node keeps its six degrees of freedom; bodies, connections and masses are those of the vehicle.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from modeviz.fem.attachments import AttachmentPoint
from modeviz.fem.free import lowest_modes
from modeviz.fem.matrices import Matrices, assemble
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.connections import GROUND, Connection
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.vehicle import Vehicle
from pickup.parameters import Parameters
from pickup.vehicle import attachments, components


@dataclass(frozen=True, eq=False)
class FullModel:
    """Sparse matrices of a vehicle whose flexible bodies are not reduced."""

    dofs: Mapping[str, slice]
    """Which degrees of freedom are whose, by the body's name; six a node or rigid body."""
    mass: sp.csc_array
    stiffness: sp.csc_array


@dataclass(frozen=True, eq=False)
class FullModes:
    """Undamped modes of a full model."""

    frequency_hz: Floats
    """(n_modes,)."""
    shapes: Floats
    """(n_dofs, n_modes), mass-normalised."""


def full_vehicle_modes(model: FullModel, n_modes: int) -> FullModes:
    """The lowest modes of the full model, by shift-invert Lanczos."""
    omega_n_squared, phi = lowest_modes(model.mass, model.stiffness, n_modes)
    return FullModes(np.sqrt(np.maximum(omega_n_squared, 0.0)) / (2 * np.pi), phi)


def full_model(vehicle: Vehicle, p: Parameters) -> FullModel:
    """The matrices of the truck with the rates the vehicle has.

    Args:
        vehicle: the pickup, for its rigid bodies, connections and masses.
        p: what it was built from, for its meshes.
    """
    builder = _Builder(vehicle, p)
    M, K = builder.free_bodies()
    for connection in vehicle.all_connections:
        rows = builder.relative_motion(connection)
        k = np.concatenate([connection.stiffness, connection.rotational_stiffness])
        K = K + rows.T @ sp.diags_array(k) @ rows
    for added in vehicle.added_masses:
        rows = builder.motion(added.body, added.name, added.position)[:3]
        M = M + added.mass * rows.T @ rows
    return FullModel(builder.dofs, _symmetric(M), _symmetric(K))


class _Builder:
    """Numbers the degrees of freedom and says how places move with them."""

    def __init__(self, vehicle: Vehicle, p: Parameters) -> None:
        self._vehicle = vehicle
        joints, masses = vehicle.all_connections, vehicle.added_masses
        self._meshes: dict[str, Matrices] = {}
        self._places: dict[str, dict[str, AttachmentPoint]] = {}
        for part in components(p):
            matrices = assemble(part.structure.mesh)
            self._meshes[part.name] = matrices.scaled(part.stiffness_factor, part.mass_factor)
            places = attachments(part.name, part.structure, joints, masses, ())
            self._places[part.name] = {place.name: place for place in places}
        sizes = [m.n_dofs if (m := self._meshes.get(b.name)) else 6 for b in vehicle.bodies]
        ends = np.cumsum([0, *sizes])
        self.dofs = {b.name: slice(ends[i], ends[i + 1]) for i, b in enumerate(vehicle.bodies)}
        self._n_dofs = int(ends[-1])

    def free_bodies(self) -> tuple[sp.csr_array, sp.csr_array]:
        """Mass and stiffness of the bodies without what joins them."""
        masses, stiffnesses = [], []
        for body in self._vehicle.bodies:
            if isinstance(body, RigidBody):
                masses.append(np.kron([[1, 0], [0, 0]], body.mass * np.eye(3)))
                masses[-1][3:, 3:] = body.inertia
                stiffnesses.append(np.zeros((6, 6)))
            else:
                masses.append(self._meshes[body.name].mass)
                stiffnesses.append(self._meshes[body.name].stiffness)
        return sp.csr_array(sp.block_diag(masses)), sp.csr_array(sp.block_diag(stiffnesses))

    def relative_motion(self, connection: Connection) -> sp.csr_array:
        """Rows (6, n_dofs): how the bodies move apart at the elastic centre, along the local axes."""
        rows = sp.csr_array((6, self._n_dofs))
        for sign, body, end in zip((1, -1), connection.bodies, connection.points, strict=True):
            if body != GROUND:
                arm = sp.csr_array(rigid_motions(connection.center - end))
                rows = rows + sign * arm @ self.motion(body, connection.name, end)
        return sp.csr_array(np.kron(np.eye(2), connection.axes)) @ rows

    def motion(self, body: str, name: str, position: Floats) -> sp.csr_array:
        """Rows (6, n_dofs): how a named place of a body moves."""
        owner = self._vehicle.body(body)
        if isinstance(owner, RigidBody):
            local = sp.csr_array(rigid_motions(position - owner.center_of_gravity))
        else:
            local = self._places[body][name].motion(self._meshes[body].nodes)
        own = self.dofs[body]
        before, after = sp.csr_array((6, own.start)), sp.csr_array((6, self._n_dofs - own.stop))
        return sp.csr_array(sp.hstack([before, local, after]))


def _symmetric(A: sp.csr_array) -> sp.csc_array:
    return ((A + A.T) / 2).tocsc()
