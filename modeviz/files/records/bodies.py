"""The tables of `vehicle.toml` that are bodies, in SI."""

from dataclasses import replace
from typing import Annotated, Self

import msgspec
import numpy as np
from msgspec import Meta

from modeviz.errors import Fault, FaultsError, at_key, quoted
from modeviz.files.meshes import DEFAULT_COLOR, read_mesh
from modeviz.files.modal import read_flexible_body
from modeviz.files.records.fields import (
    Direction,
    Inertia,
    Mass,
    Name,
    Position,
    Ratio,
)
from modeviz.files.records.record import Record, tuples, vector_along
from modeviz.files.schema.axes import axes_of
from modeviz.files.schema.quantities import UNITLESS
from modeviz.files.source import Source
from modeviz.units import factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import AddedMass, FlexibleBody, Material, Mesh, RigidBody, Role


class BodyRecord(Record, kw_only=True):
    """The fields that flexible and rigid bodies have in common."""

    name: Name
    role: Role = "other"
    label: str = ""
    """The name, if not given."""
    mesh: str | None = None
    """A file of the folder: .glb, .stl, .obj, .ply, .dae or .step."""
    mesh_unit: str | None = None
    """Of the mesh's coordinates; that which its file says, else m, if not given."""
    mesh_axes: str | None = None
    """Of the mesh, see `axes_of`; if not given those of the vehicle's file, into which a mesh that says
    which axis is up is turned."""
    color: Annotated[tuple[int, int, int], UNITLESS] = DEFAULT_COLOR
    """sRGB, of the mesh parts that have no material."""
    crank_axis: Direction | None = None
    """Along which an engine's crank lies."""

    @property
    def crank(self) -> Floats | None:
        """The direction of its crank, if it is given."""
        return None if self.crank_axis is None else vector_along(self.crank_axis)

    @property
    def spoken(self) -> str:
        """Its label, or else its name, for people."""
        return self.label or self.name

    def read_mesh(self, source: Source) -> Mesh:
        if self.mesh is None:
            return ()
        with at_key("color"):
            Material(self.color)
        with at_key("mesh_unit"):
            length = factor(self.mesh_unit, "length") if self.mesh_unit is not None else None
        with at_key("mesh_axes"):
            turn = axes_of(self.mesh_axes) if self.mesh_axes is not None else None
        with at_key("mesh"):
            mesh = read_mesh(source.path(self.mesh), self.color, length, turn)
            if turn is not None:
                return mesh
            conventions = source.conventions.with_units({"length": "m"})
            return tuple(replace(p, vertices=conventions.positions(p.vertices)) for p in mesh)


class FlexibleBodyRecord(BodyRecord, kw_only=True):
    """[[flexible_body]]."""

    modes: str
    """A file of the folder, .npz."""
    units: dict[str, str] = msgspec.field(default_factory=dict)
    """Length and mass of that file, where they are not the vehicle's."""
    damping_ratio: Annotated[float | tuple[float, ...], UNITLESS]
    """Of all modes, or of the elastic ones in turn; the last holds for all above it too."""
    loss_factor: Ratio = 0.0
    mass: Mass | None = None
    """What it is known to weigh: its modes are held against it."""
    keep_modes: Annotated[int, Meta(ge=FlexibleBody.N_RIGID - 1), UNITLESS] | None = None
    """How many of the lowest normal modes, rigid ones included; all, if not given."""
    residual_vectors: bool = True
    """Whether to keep them."""

    @classmethod
    def of(cls, body: FlexibleBody, modes: str, mesh: str | None) -> Self:
        return cls(
            name=body.name,
            role=body.role,
            label=body.label,
            mesh=mesh,
            modes=modes,
            damping_ratio=body.damping_ratio,
            loss_factor=body.loss_factor,
            mass=body.stated_mass,
            crank_axis=tuples(body.crank_axis),
        )

    def build(self, source: Source) -> FlexibleBody:
        if not all(0 <= ratio < 1 for ratio in np.atleast_1d(self.damping_ratio)):
            words = (
                f"found {quoted(self.damping_ratio)}, expected a fraction of critical from 0 to below 1"
            )
            raise FaultsError(Fault("damping_ratio", words))
        properties = {
            "role": self.role,
            "label": self.spoken,
            "mesh": self.read_mesh(source),
            "damping_ratio": self.damping_ratio,
            "loss_factor": self.loss_factor,
            "stated_mass": self.mass,
            "crank_axis": self.crank,
        }
        with at_key("units"):
            conventions = source.conventions.with_units(self.units)
        own = replace(source, conventions=conventions)
        with at_key("modes"):
            body = read_flexible_body(source.path(self.modes), self.name, properties, own)
        n_elastic, n_ratios = body.n_normal - body.n_rigid, np.size(self.damping_ratio)
        if n_ratios > max(n_elastic, 1):
            words = f"found {n_ratios} for {n_elastic} elastic modes, expected one for all or one for "
            raise FaultsError(Fault("damping_ratio", f"{words}each; rigid modes have none"))
        with at_key("keep_modes"):
            return body.truncated(self.keep_modes or body.n_normal, self.residual_vectors)


class RigidBodyRecord(BodyRecord, kw_only=True):
    """[[rigid_body]]."""

    mass: Mass
    center_of_gravity: Position
    inertia: Inertia
    """Ixx, Iyy, Izz about the centre of gravity and, if any, the products Ixy, Ixz, Iyz.

    Ixy = +∫ x y dm, so that it stands in the matrix as -Ixy.
    """

    @classmethod
    def of(cls, body: RigidBody, mesh: str | None) -> Self:
        moments = np.diag(body.inertia).tolist()
        products = (0.0 - body.inertia[[0, 0, 1], [1, 2, 2]]).tolist()
        return cls(
            name=body.name,
            role=body.role,
            label=body.label,
            mesh=mesh,
            mass=body.mass,
            center_of_gravity=tuples(body.center_of_gravity),
            inertia=(*moments, *products) if any(products) else tuple(moments),
            crank_axis=tuples(body.crank_axis),
        )

    def build(self, source: Source) -> RigidBody:
        if len(self.inertia) not in (3, 6):
            raise FaultsError(Fault("inertia", f"found {len(self.inertia)} numbers, expected 3 or 6"))
        inertia = np.diag(self.inertia[:3])
        for (row, column), product in zip(((0, 1), (0, 2), (1, 2)), self.inertia[3:], strict=False):
            inertia[row, column] = inertia[column, row] = 0.0 - product
        mesh = self.read_mesh(source)
        center_of_gravity = np.array(self.center_of_gravity)
        return RigidBody(
            self.name,
            self.role,
            self.spoken,
            self.mass,
            center_of_gravity,
            inertia,
            mesh,
            self.crank,
        )


class AddedMassRecord(Record, kw_only=True):
    """[[added_mass]]."""

    name: Name
    body: str
    at: Position
    mass: Mass

    @classmethod
    def of(cls, mass: AddedMass) -> Self:
        return cls(name=mass.name, body=mass.body, at=tuples(mass.position), mass=mass.mass)

    def build(self) -> AddedMass:
        return AddedMass(self.name, self.body, np.array(self.at), self.mass)
