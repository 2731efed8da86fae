"""Bodies: what has mass. Flexible ones carry modes, rigid ones an inertia."""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, get_args

import numpy as np

from modeviz.errors import VehicleError, check_unique, unknown
from modeviz.vehicle.arrays import Floats, frozen, frozen_places
from modeviz.vehicle.inertia import impossible
from modeviz.vehicle.rigid import rigid_motions
from modeviz.vehicle.rigid_fit import RigidFit, fit_rigid

Role = Literal["cabin", "frame", "bed", "powertrain", "unsprung", "linkage", "absorber", "other"]
"""What a body is in the vehicle; modes are named from it.

cabin: where people sit and what is rigidly joined to it. frame: the structure everything hangs on.
bed: the load carrier. powertrain: engine and transmission. unsprung: moves with the wheels.
linkage: light parts between the others. absorber: a mass on a spring that is there for a mode of what
it sits on. other: nothing of these.
"""

LIGHT_ROLES: tuple[Role, ...] = ("linkage", "absorber")
"""Those of bodies that go along with others, and hold none."""


FURTHEST_VERTEX = 1e5
"""m: from the origin; no vehicle is as large, and a page draws with fewer digits."""


@dataclass(frozen=True, eq=False)
class Material:
    """The look of a surface."""

    color: tuple[int, int, int]
    """sRGB, 0 to 255."""
    opacity: float = 1.0
    roughness: float = 0.45
    metallic: float = 0.2

    def __post_init__(self) -> None:
        if len(self.color) != 3 or not all(0 <= c <= 255 for c in self.color):
            raise VehicleError(f"color: found {self.color}, expected three numbers from 0 to 255")
        for name in ("opacity", "roughness", "metallic"):
            if not 0 <= getattr(self, name) <= 1:
                raise VehicleError(f"{name}: found {getattr(self, name)}, expected 0 to 1")


@dataclass(frozen=True, eq=False)
class MeshPart:
    """A triangulated surface of one material, in vehicle coordinates."""

    name: str
    vertices: Floats
    """(n_vertices, 3), m."""
    faces: np.ndarray
    """(n_faces, 3), indices of vertices."""
    material: Material

    def __post_init__(self) -> None:
        frozen(self, "vertices", self.vertices, (None, 3))
        frozen(self, "faces", self.faces, (None, 3), np.int32)
        if not self.faces.size:
            raise VehicleError(f"mesh part {self.name!r}: has no faces")
        if not 0 <= self.faces.min() <= self.faces.max() < len(self.vertices):
            raise VehicleError(f"mesh part {self.name!r}: a face names a vertex that does not exist")
        furthest = np.abs(self.vertices).max()
        if furthest > FURTHEST_VERTEX:
            raise VehicleError(
                f"mesh part {self.name!r}: found a vertex {furthest:.3g} m from the origin, "
                f"expected at most {FURTHEST_VERTEX:g} m; meshes are in metres"
            )


Mesh = tuple[MeshPart, ...]
"""The display mesh of a body, a part for each material."""


@dataclass(frozen=True, eq=False)
class Attachment:
    """A named point of a flexible body, where connections, masses and response points hang.

    Its motion may be one node's, carried there rigidly, or a mean over several.
    """

    name: str
    position: Floats
    """(3,), m."""
    shapes: Floats
    """(6, n_modes): its motion x, y, z, rx, ry, rz in each mode."""

    def __post_init__(self) -> None:
        frozen_places(self, "position", self.position, (3,))
        frozen(self, "shapes", self.shapes, (6, None))


@dataclass(frozen=True, eq=False)
class FlexibleBody:
    """A free-free elastic body in mass-normalised modal coordinates.

    The columns of every shape array are, in this order: 6 rigid modes (5 of a rod, which has no inertia
    about itself), the elastic normal modes, and residual vectors, which are made orthogonal in mass and
    stiffness and used like more modes. The modal mass is one, the modal stiffness `omega_n_squared`.
    """

    name: str
    role: Role
    label: str
    """What a person calls it, "front end"."""
    omega_n_squared: Floats
    """(n_modes,), rad²/s²; zero for the rigid modes."""
    n_residuals: int
    """How many of the last columns are residual vectors."""
    damping_ratio: float | tuple[float, ...]
    """Viscous, fractions of critical: one for all modes, or those of the elastic ones in turn.

    The last of these holds for all modes above it too."""
    attachments: tuple[Attachment, ...]
    nodes: Floats
    """(n_nodes, 3), m: the points that carry the mesh."""
    shapes: np.ndarray
    """(n_nodes, 6, n_modes), single precision: translations and rotations of the nodes."""
    mesh: Mesh = ()
    loss_factor: float = 0.0
    """Structural damping: the stiffness is K (1 + j loss_factor)."""
    stated_mass: float | None = None
    """kg, if it is known otherwise than from the modes."""
    crank_axis: Floats | None = None
    """(3,): a unit vector along its crank, if it has one and says so."""

    N_RIGID = 6
    """How many rigid modes a body has that is no rod."""

    def __post_init__(self) -> None:
        _check_role(self.role)
        _check_crank(self)
        check_unique(f"body {self.name!r}: mesh part", (part.name for part in self.mesh))
        check_unique(f"body {self.name!r}: attachment", (a.name for a in self.attachments))
        frozen(self, "omega_n_squared", self.omega_n_squared, (None,))
        frozen_places(self, "nodes", self.nodes, (None, 3))
        frozen(self, "shapes", self.shapes, (len(self.nodes), 6, self.n_modes), np.float32)
        self._check_frequencies()
        self._check_damping()
        for attachment in self.attachments:
            if attachment.shapes.shape[1] != self.n_modes:
                raise VehicleError(
                    f"body {self.name!r}: attachment {attachment.name!r} has "
                    f"{attachment.shapes.shape[1]} modes, the body has {self.n_modes}"
                )

        if np.linalg.matrix_rank(self.rigid_fit.coordinates[:, :3]) < 3:
            raise VehicleError(
                f"body {self.name!r}: its rigid modes move neither attachments nor nodes along all of "
                "x, y and z, so it cannot be told how heavy it is; give it the shapes of some places"
            )

    def _check_frequencies(self) -> None:
        elastic = self.omega_n_squared[self.n_rigid :]
        if not self.N_RIGID - 1 <= self.n_rigid <= self.N_RIGID or (elastic <= 0).any():
            raise VehicleError(
                f"body {self.name!r}: omega_n_squared: expected six zeros, then positive values (five "
                "of a rod, which has no inertia about itself)"
            )
        if not 0 <= self.n_residuals <= len(elastic):
            raise VehicleError(
                f"body {self.name!r}: n_residuals: found {self.n_residuals} with {self.n_modes} modes, "
                f"expected 0 to {len(elastic)} ({self.n_rigid} modes are rigid)"
            )

    def _check_damping(self) -> None:
        ratios = np.atleast_1d(self.damping_ratio)
        if not ratios.size or not ((ratios >= 0) & (ratios < 1)).all():
            raise VehicleError(
                f"body {self.name!r}: damping_ratio: found {self.damping_ratio}, expected a fraction "
                "of critical from 0 to below 1, or one for each elastic mode"
            )
        if not (np.isfinite(self.loss_factor) and self.loss_factor >= 0):
            raise VehicleError(
                f"body {self.name!r}: loss_factor: found {self.loss_factor}, expected zero or more"
            )

    @property
    def n_modes(self) -> int:
        """The number of its modes, rigid ones and residual vectors among them."""
        return len(self.omega_n_squared)

    @property
    def n_rigid(self) -> int:
        """The number of its rigid modes: the zeros that `omega_n_squared` begins with."""
        return int((np.cumsum(self.omega_n_squared != 0) == 0).sum())

    @property
    def n_normal(self) -> int:
        """The number of its normal modes, rigid or elastic, without residual vectors."""
        return self.n_modes - self.n_residuals

    @property
    def damping_ratios(self) -> Floats:
        """The damping ratio of every mode, (n_modes,), zero of the rigid ones."""
        ratios = np.atleast_1d(self.damping_ratio)
        number = np.minimum(np.arange(self.n_modes - self.n_rigid), len(ratios) - 1)
        return np.concatenate([np.zeros(self.n_rigid), ratios[number]])

    @cached_property
    def rigid_fit(self) -> RigidFit:
        """The rigid motions closest to its rigid modes."""
        shapes = np.array([a.shapes for a in self.attachments]).reshape(-1, 6, self.n_modes)
        n = self.n_rigid
        return fit_rigid(
            self._positions, shapes[:, :, :n], self.nodes, self.shapes[:, :, :n].astype(float)
        )

    @property
    def mass(self) -> float:
        """kg, as its rigid modes say."""
        return float(np.trace(self.rigid_fit.mass[:3, :3]) / 3)

    @property
    def center_of_gravity(self) -> Floats:
        """(3,), m, as its rigid modes say."""
        return self.rigid_fit.center_of_gravity

    @property
    def natural_frequency_hz(self) -> Floats:
        """(n_modes,)."""
        return np.sqrt(self.omega_n_squared) / (2 * np.pi)

    def attachment(self, name: str) -> Attachment:
        """The attachment of that name.

        Raises:
            VehicleError: there is none, with the names there are.
        """
        for attachment in self.attachments:
            if attachment.name == name:
                return attachment
        names = (a.name for a in self.attachments)
        raise VehicleError(f"body {self.name!r}: " + unknown("attachment", name, names))

    def nearest_attachment(self, position: Floats) -> Attachment:
        """The attachment closest to a place.

        Raises:
            VehicleError: the body has none.
        """
        if not self.attachments:
            raise VehicleError(
                f"body {self.name!r} has no attachment, so nothing can be connected to it"
            )
        return self.attachments[int(np.linalg.norm(self._positions - position, axis=1).argmin())]

    @cached_property
    def _positions(self) -> Floats:
        """Where its attachments are, (n_attachments, 3), m."""
        return np.array([a.position for a in self.attachments]).reshape(-1, 3)

    def truncated(self, n_modes: int, residual_vectors: bool = False) -> "FlexibleBody":
        """The body in its lowest `n_modes` normal modes, rigid ones included.

        Args:
            n_modes: from the rigid ones up to the number of normal modes.
            residual_vectors: whether to keep them too.

        Raises:
            VehicleError: `n_modes` is out of that range.
        """
        n_normal = self.n_normal
        if not self.n_rigid <= n_modes <= n_normal:
            raise VehicleError(
                f"body {self.name!r}: modes to keep: found {n_modes}, "
                f"expected {self.n_rigid} to {n_normal}"
            )
        kept = np.r_[0:n_modes, n_normal : self.n_modes] if residual_vectors else np.arange(n_modes)
        return replace(
            self,
            omega_n_squared=self.omega_n_squared[kept],
            n_residuals=self.n_residuals if residual_vectors else 0,
            attachments=tuple(replace(a, shapes=a.shapes[:, kept]) for a in self.attachments),
            shapes=self.shapes[:, :, kept],
        )

    def residual_compliance(self, attachment: str, position: Floats | None = None) -> Floats:
        """The flexibility that the truncated modes would add at a point, (3, 3) in m/N.

        R = Σ φ φᵀ / ω² over the residual vectors: exact at zero frequency in the directions that have
        a residual vector (A. E. Duncan, after McClelland's residual compliance).

        Args:
            attachment: its name.
            position: (3,), of a point that a rigid arm holds to the attachment; if not given, its own.
        """
        if not self.n_residuals:
            return np.zeros((3, 3))
        at = self.attachment(attachment)
        arm = 0 * at.position if position is None else position - at.position
        phi = (rigid_motions(arm) @ at.shapes)[:3, -self.n_residuals :]
        return (phi / self.omega_n_squared[-self.n_residuals :]) @ phi.T


@dataclass(frozen=True, eq=False)
class RigidBody:
    """A body that does not deform; its coordinates are x, y, z, rx, ry, rz at its centre of gravity."""

    name: str
    role: Role
    label: str
    mass: float
    """kg."""
    center_of_gravity: Floats
    """(3,), m."""
    inertia: Floats
    """(3, 3) about the centre of gravity, kg m²; products enter as -Ixy."""
    mesh: Mesh = ()
    crank_axis: Floats | None = None
    """(3,): a unit vector along its crank, if it has one and says so."""

    def __post_init__(self) -> None:
        _check_role(self.role)
        _check_crank(self)
        check_unique(f"body {self.name!r}: mesh part", (part.name for part in self.mesh))
        if not (np.isfinite(self.mass) and self.mass > 0):
            raise VehicleError(f"body {self.name!r}: mass: found {self.mass} kg, expected more than 0")
        frozen_places(self, "center_of_gravity", self.center_of_gravity, (3,))
        frozen(self, "inertia", self.inertia, (3, 3))
        if not np.allclose(self.inertia, self.inertia.T) or np.linalg.eigvalsh(self.inertia)[0] <= 0:
            raise VehicleError(
                f"body {self.name!r}: inertia: expected a symmetric matrix with positive principal "
                f"moments, found {self.inertia.tolist()}"
            )
        if reason := impossible(self.inertia):
            raise VehicleError(f"body {self.name!r}: inertia: {reason}, as of no body")


Body = FlexibleBody | RigidBody


@dataclass(frozen=True, eq=False)
class AddedMass:
    """A lumped mass carried by a body: an occupant, a battery, a full tank."""

    name: str
    body: str
    position: Floats
    """(3,), m, its centre; on a flexible body an attachment must be near."""
    mass: float
    """kg."""

    def __post_init__(self) -> None:
        frozen_places(self, "position", self.position, (3,))
        if not (np.isfinite(self.mass) and self.mass > 0):
            raise VehicleError(
                f"added mass {self.name!r}: mass: found {self.mass} kg, expected more than 0"
            )


def _check_role(role: str) -> None:
    if role not in get_args(Role):
        raise VehicleError(unknown("role", role, get_args(Role)))


def _check_crank(body: Body) -> None:
    """Makes the direction of a body's crank a unit vector; raises VehicleError if it has no length."""
    if body.crank_axis is None:
        return
    given = np.asarray(body.crank_axis, float)
    length = float(np.linalg.norm(given))
    if given.shape != (3,) or not 0 < length < np.inf:
        raise VehicleError(
            f"body {body.name!r}: crank_axis: found {given.tolist()}, expected a direction"
        )
    frozen(body, "crank_axis", given / length, (3,))
