"""The tables of `vehicle.toml` and what each becomes, in SI.

A record is one table as it stands in the file, so its fields are the keys. `build` makes the vehicle's
part from it, `of` the record from the part.
"""

from collections.abc import Mapping
from dataclasses import asdict, replace
from typing import Annotated, Any, Self

import msgspec
import numpy as np
from msgspec import Meta

from modeviz.errors import VehicleError, located
from modeviz.files.meshes import DEFAULT_COLOR, read_mesh
from modeviz.files.modal import read_flexible_body
from modeviz.files.records.fields import (
    Damping,
    DampingRate,
    Ends,
    Frame,
    Frequency,
    Inertia,
    Length,
    Mass,
    Motions,
    Name,
    Place,
    Position,
    Rate,
    Ratio,
    RatioLimits,
    RotationalDamping,
    RotationalStiffness,
    Speed,
    Stiffness,
)
from modeviz.files.records.loads import (
    BaseMotionRecord,
    ForceRecord,
    RoadRecord,
    WheelLoadRecord,
)
from modeviz.files.records.problems import ProblemRecord
from modeviz.files.records.record import FileRecord, RatesRecord, Record
from modeviz.files.schema.axes import OURS
from modeviz.files.schema.quantities import UNITLESS
from modeviz.files.source import Source
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import AddedMass, FlexibleBody, Mesh, RigidBody, Role
from modeviz.vehicle.connections import (
    MOTIONS,
    SHARED,
    Connection,
    Mount,
    MountGroup,
    MountRates,
    Rod,
    Track,
    usual_bounds,
)
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mode_damping import ModeDamping

NO_RATES = (0.0, 0.0, 0.0)
VEHICLE_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class BodyRecord(Record, kw_only=True):
    """What flexible and rigid bodies have in common."""

    name: Name
    role: Role = "other"
    label: str = ""
    """The name, if not given."""
    mesh: str | None = None
    """A file of the folder: .glb, .stl, .obj or .ply."""
    mesh_unit: str = "m"
    """Of the mesh's coordinates."""
    color: Annotated[tuple[int, int, int], UNITLESS] = DEFAULT_COLOR
    """sRGB, of the mesh parts that have no material."""

    @property
    def spoken(self) -> str:
        """What a person calls it."""
        return self.label or self.name

    def read_mesh(self, source: Source) -> Mesh:
        if self.mesh is None:
            return ()
        with located("mesh"):
            path = source.path(self.mesh)
        conventions = source.conventions.with_units({"length": self.mesh_unit}, "mesh_unit")
        return tuple(
            replace(part, vertices=conventions.positions(part.vertices))
            for part in read_mesh(path, self.color)
        )


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
        )

    def build(self, source: Source) -> FlexibleBody:
        with located("modes"):
            path = source.path(self.modes)
        properties = {
            "role": self.role,
            "label": self.spoken,
            "mesh": self.read_mesh(source),
            "damping_ratio": self.damping_ratio,
            "loss_factor": self.loss_factor,
            "stated_mass": self.mass,
        }
        conventions = source.conventions.with_units(self.units, "units")
        own = replace(source, conventions=conventions)
        body = read_flexible_body(path, self.name, properties, own)
        n_elastic, n_ratios = body.n_normal - body.n_rigid, np.size(self.damping_ratio)
        if n_ratios > max(n_elastic, 1):
            raise VehicleError(
                f"damping_ratio: found {n_ratios} for {n_elastic} elastic modes, expected one for all "
                "or one for each; rigid modes have none"
            )
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
            center_of_gravity=_tuples(body.center_of_gravity),
            inertia=(*moments, *products) if any(products) else tuple(moments),
        )

    def build(self, source: Source) -> RigidBody:
        if len(self.inertia) not in (3, 6):
            raise VehicleError(f"inertia: found {len(self.inertia)} numbers, expected 3 or 6")
        inertia = np.diag(self.inertia[:3])
        for (row, column), product in zip(((0, 1), (0, 2), (1, 2)), self.inertia[3:], strict=False):
            inertia[row, column] = inertia[column, row] = 0.0 - product
        mesh = self.read_mesh(source)
        center_of_gravity = np.array(self.center_of_gravity)
        return RigidBody(self.name, self.role, self.spoken, self.mass, center_of_gravity, inertia, mesh)


class AddedMassRecord(Record, kw_only=True):
    """[[added_mass]]."""

    name: Name
    body: str
    at: Position
    mass: Mass

    @classmethod
    def of(cls, mass: AddedMass) -> Self:
        return cls(name=mass.name, body=mass.body, at=_tuples(mass.position), mass=mass.mass)

    def build(self) -> AddedMass:
        return AddedMass(self.name, self.body, np.array(self.at), self.mass)


class RateSetRecord(RatesRecord, kw_only=True):
    """The rates of a mount, and its loss factor if that is not the group's own."""

    loss_factor: Ratio | None = None

    @classmethod
    def of(cls, rates: MountRates) -> Self:
        return cls(**asdict(rates))

    def build(self) -> MountRates:
        return replace(super().build(), loss_factor=self.loss_factor)


class MountRecord(Record, kw_only=True):
    """[[mount_group.mount]]; but for the place, the keys are the attributes of a connection."""

    name: Name
    bodies: tuple[str, str]
    at: Place
    rotational_stiffness: RotationalStiffness = NO_RATES
    damping: Damping = NO_RATES
    rotational_damping: RotationalDamping = NO_RATES
    axes: Frame = VEHICLE_AXES
    elastic_center: Annotated[float, UNITLESS] = 0.5
    """Where between its ends it acts: 0 at the first, 1 at the second."""

    @classmethod
    def of(cls, connection: Connection) -> Self:
        first, second = map(_tuples, connection.points)
        keys = (f for f in cls.__struct_fields__ if f != "at")
        fields = {key: _tuples(getattr(connection, key)) for key in keys}
        return cls(at=first if first == second else (first, second), **_said(cls, fields))

    def arguments(self) -> dict[str, Any]:
        """The constructor's arguments of a connection."""
        fields = {f: getattr(self, f) for f in self.__struct_fields__ if f != "at"}
        return {"points": self._ends(), **fields}

    def _ends(self) -> Floats:
        ends = self.at if len(self.at) == 2 else (self.at, self.at)
        if any(np.shape(end) != (3,) for end in ends):
            raise VehicleError(f"at: found {list(self.at)}, expected [x, y, z] or two of them")
        return np.array(ends, float)


class MountGroupRecord(Record, kw_only=True):
    """[[mount_group]]."""

    name: Name
    label: str = ""
    """The name, if not given."""
    rates: RatesRecord
    loss_factor: Ratio
    softest: RatesRecord | None = None
    stiffest: RatesRecord | None = None
    ratio_limits: RatioLimits | None = None
    """The least and the most that lateral and fore-aft rates may be of the vertical one."""
    rotational_stiffness: RotationalStiffness = NO_RATES
    """Of each mount that has none of its own, as what follows."""
    damping: Damping = NO_RATES
    rotational_damping: RotationalDamping = NO_RATES
    mount: list[MountRecord]

    @classmethod
    def of(cls, group: MountGroup) -> Self:
        return cls(
            name=group.name,
            label=group.label,
            rates=RatesRecord.of(group.rates),
            loss_factor=group.loss_factor,
            softest=RatesRecord.of(group.bounds[0]),
            stiffest=RatesRecord.of(group.bounds[1]),
            ratio_limits=group.ratio_limits,
            mount=[MountRecord.of(_own(mount, group)) for mount in group.mounts],
            **{name: _tuples(getattr(group, name)) for name in SHARED},
        )

    def build(self) -> MountGroup:
        rates = self.rates.build()
        softest, stiffest = usual_bounds(rates)
        return MountGroup(
            self.name,
            self.label or self.name,
            rates,
            self.loss_factor,
            (
                self.softest.build() if self.softest else softest,
                self.stiffest.build() if self.stiffest else stiffest,
            ),
            tuple(Mount(group=self.name, **mount.arguments()) for mount in self.mount),
            self.ratio_limits,
            **{name: np.array(getattr(self, name)) for name in SHARED},
        )


class ConnectionRecord(MountRecord, kw_only=True):
    """[[damper]], and what springs, bolts and tyres have in common with it."""

    group: Name | None = None
    """After the kind of connection, "springs", if not given."""
    stiffness: Stiffness = NO_RATES
    loss_factor: Ratio = 0.0

    def build(self, kind: type[Connection]) -> Connection:
        arguments: dict[str, Any] = {
            **self.arguments(),
            "group": self.group or f"{kind.__name__.lower()}s",
        }
        return kind(**arguments)


class JointRecord(ConnectionRecord, kw_only=True):
    """[[spring]] or [[bolt]]."""

    rigid: Motions = False
    """Whether its ends do not move relative to each other, or in which of `MOTIONS` they do not."""

    @classmethod
    def of(cls, connection: Connection) -> Self:
        rigid = connection.rigid == MOTIONS or connection.rigid or False
        return msgspec.structs.replace(super().of(connection), rigid=rigid)

    def arguments(self) -> dict[str, Any]:
        rigid = (MOTIONS if self.rigid else ()) if isinstance(self.rigid, bool) else self.rigid
        return {**super().arguments(), "rigid": rigid}


class RodRecord(Record, kw_only=True):
    """[[rod]]: a link between two places, hinged at both; it acts along the line between them."""

    name: Name
    group: Name = "rods"
    bodies: tuple[str, str]
    at: Ends
    stiffness: Rate = 0.0
    damping: DampingRate = 0.0
    loss_factor: Ratio = 0.0
    rigid: bool = False
    """Whether its length does not change."""

    @classmethod
    def of(cls, rod: Rod) -> Self:
        fields = {
            "name": rod.name,
            "group": rod.group,
            "bodies": rod.bodies,
            "stiffness": float(rod.stiffness[0]),
            "damping": float(rod.damping[0]),
            "loss_factor": rod.loss_factor,
            "rigid": bool(rod.rigid),
        }
        return cls(at=_tuples(rod.points), **_said(cls, fields))

    def build(self, kind: type[Rod]) -> Rod:
        fields = {f: getattr(self, f) for f in self.__struct_fields__ if f != "at"}
        return kind.between(points=np.array(self.at), **fields)


class TyreRecord(ConnectionRecord, kw_only=True):
    """[[tyre]]."""

    elastic_center: Annotated[float, UNITLESS] = 1.0
    """As any connection's, but at the patch, its second end, unless told otherwise."""
    wheel_center: Position
    trail: Length = 0.0
    track: Track | None = None
    """Which track of a road it runs in; that of its side, if not given."""


class ResponsePointRecord(Record, kw_only=True):
    """[[response_point]]."""

    name: Name
    body: str
    at: Position

    @classmethod
    def of(cls, point: ResponsePoint) -> Self:
        return cls(name=point.name, body=point.body, at=_tuples(point.position))

    def build(self) -> ResponsePoint:
        return ResponsePoint(self.name, self.body, np.array(self.at))


class ModeDampingRecord(Record, kw_only=True):
    """[[mode_damping]]."""

    mode: Annotated[int, UNITLESS] | Name | None = None
    """What it is called or its number, as `modeviz modes` has them; all others, if not given."""
    damping_ratio: Ratio

    @classmethod
    def of(cls, damping: ModeDamping) -> Self:
        return cls(mode=damping.mode, damping_ratio=damping.damping_ratio)

    def build(self) -> ModeDamping:
        return ModeDamping(self.damping_ratio, self.mode)


class VehicleRecord(FileRecord, kw_only=True):
    """The whole file."""

    name: Name
    axes: str = OURS
    """See `axes_of`."""
    speed: Speed | None = None
    """`USUAL_SPEED`, if not given."""
    highest_frequency: Frequency = 40.0
    """Hz: up to where modes and responses are looked at."""
    frequency_step: Frequency = 0.1
    """Hz: between the lines at which responses are given."""
    flexible_body: list[FlexibleBodyRecord] = msgspec.field(default_factory=list)
    rigid_body: list[RigidBodyRecord] = msgspec.field(default_factory=list)
    added_mass: list[AddedMassRecord] = msgspec.field(default_factory=list)
    mount_group: list[MountGroupRecord] = msgspec.field(default_factory=list)
    spring: list[JointRecord] = msgspec.field(default_factory=list)
    rod: list[RodRecord] = msgspec.field(default_factory=list)
    bolt: list[JointRecord] = msgspec.field(default_factory=list)
    damper: list[ConnectionRecord] = msgspec.field(default_factory=list)
    tyre: list[TyreRecord] = msgspec.field(default_factory=list)
    response_point: list[ResponsePointRecord] = msgspec.field(default_factory=list)
    road: list[RoadRecord] = msgspec.field(default_factory=list)
    wheel_load: list[WheelLoadRecord] = msgspec.field(default_factory=list)
    force: list[ForceRecord] = msgspec.field(default_factory=list)
    base_motion: list[BaseMotionRecord] = msgspec.field(default_factory=list)
    mode_damping: list[ModeDampingRecord] = msgspec.field(default_factory=list)
    rates: dict[str, dict[str, RateSetRecord]] = msgspec.field(default_factory=dict)
    """[rates.SET.GROUP]."""
    problem: list[ProblemRecord] = msgspec.field(default_factory=list)


def _own(mount: Mount, group: MountGroup) -> Mount:
    """A mount with nothing that it has from its group."""
    shared = [name for name in SHARED if np.array_equal(getattr(mount, name), getattr(group, name))]
    return replace(mount, **dict.fromkeys(shared, np.zeros(3)))


def _said(kind: type[Record], fields: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a record that differ from its defaults."""
    default = {field.name: field.default for field in msgspec.structs.fields(kind)}
    return {key: value for key, value in fields.items() if value != default[key]}


def _tuples(value: Any) -> Any:
    """An array as tuples, whatever else as it is."""
    if isinstance(value, np.ndarray):
        return tuple(map(_tuples, value)) if value.ndim else float(value)
    return float(value) if isinstance(value, np.floating) else value
