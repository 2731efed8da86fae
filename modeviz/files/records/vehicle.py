"""The whole of `vehicle.toml`, and its tables of points and modes, in SI."""

from collections.abc import Sequence
from itertools import chain
from typing import Annotated, Any, Self

import msgspec
import numpy as np

from modeviz.errors import at_key, check_unique
from modeviz.files.limits import check_size
from modeviz.files.records.absorbers import AbsorberRecord
from modeviz.files.records.bodies import AddedMassRecord, FlexibleBodyRecord, RigidBodyRecord
from modeviz.files.records.connections import (
    ConnectionRecord,
    JointRecord,
    MountGroupRecord,
    RodRecord,
    TyreRecord,
)
from modeviz.files.records.decoupling import DecouplingRecord
from modeviz.files.records.engines import EngineRecord
from modeviz.files.records.fields import (
    Frequency,
    Name,
    Position,
    Ratio,
    Speed,
)
from modeviz.files.records.load_cases import LoadCaseRecord
from modeviz.files.records.loads import (
    BaseMotionRecord,
    ForceRecord,
    RoadRecord,
    WheelLoadRecord,
)
from modeviz.files.records.problems import ProblemRecord
from modeviz.files.records.rates import RateSetRecord, rate_set
from modeviz.files.records.record import FileRecord, Record, built, tuples
from modeviz.files.records.tuned_parts import DamperGroupRecord, SpringGroupRecord, TunedPartsRecord
from modeviz.files.schema.quantities import UNITLESS
from modeviz.files.source import Source
from modeviz.vehicle.absorber_parts import absorber_guide, absorber_mass, absorber_spring
from modeviz.vehicle.absorbers import check_absorbers, on_attachment, put_in_place
from modeviz.vehicle.bodies import FlexibleBody, RigidBody
from modeviz.vehicle.connections import (
    Bolt,
    Connection,
    Damper,
    Rod,
    Spring,
    Tyre,
)
from modeviz.vehicle.decoupling import USUAL, Decoupling
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mode_damping import ModeDamping
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import OUR_AXES, USUAL_SPEED, Vehicle, track_width

MOST_TABLES = 2_000
"""Of a kind."""

COORDINATES, MOST_COORDINATES = "coordinates (6 of a rigid body, the modes of a flexible one)", 2_000
"""Five times the truck's; their time rises with the cube, their memory with the square."""

MOST_BODIES = 150
"""All that move freely have modes in the band, each of which takes time and is named."""

CONNECTION_KINDS: dict[str, type[Connection]] = {
    "spring": Spring,
    "rod": Rod,
    "bolt": Bolt,
    "damper": Damper,
    "tyre": Tyre,
}
"""The kind of connection in each of the file's tables."""

TUNED_KINDS = ("spring", "damper")
"""Those that a group can tune."""


class ResponsePointRecord(Record, kw_only=True):
    """[[response_point]]."""

    name: Name
    body: str
    at: Position

    @classmethod
    def of(cls, point: ResponsePoint) -> Self:
        return cls(name=point.name, body=point.body, at=tuples(point.position))

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
    axes: str = OUR_AXES
    """See `axes_of`."""
    speed: Speed | None = None
    """`USUAL_SPEED`, if not given."""
    highest_frequency: Frequency = 40.0
    """Hz: up to where modes and responses are looked at."""
    frequency_step: Frequency = 0.1
    """Hz: between the lines at which responses are given."""
    remarks: list[str] = msgspec.field(default_factory=list)
    """Sentences that are told with all notes on the vehicle."""
    body_table: str | None = None
    """A file of the folder, .csv or .xlsx, with rigid bodies."""
    mount_table: str | None = None
    """A file of the folder, .csv or .xlsx, with mounts, springs and dampers."""
    flexible_body: list[FlexibleBodyRecord] = msgspec.field(default_factory=list)
    rigid_body: list[RigidBodyRecord] = msgspec.field(default_factory=list)
    added_mass: list[AddedMassRecord] = msgspec.field(default_factory=list)
    absorber: list[AbsorberRecord] = msgspec.field(default_factory=list)
    mount_group: list[MountGroupRecord] = msgspec.field(default_factory=list)
    spring: list[JointRecord] = msgspec.field(default_factory=list)
    rod: list[RodRecord] = msgspec.field(default_factory=list)
    bolt: list[JointRecord] = msgspec.field(default_factory=list)
    damper: list[ConnectionRecord] = msgspec.field(default_factory=list)
    spring_group: list[SpringGroupRecord] = msgspec.field(default_factory=list)
    damper_group: list[DamperGroupRecord] = msgspec.field(default_factory=list)
    tyre: list[TyreRecord] = msgspec.field(default_factory=list)
    response_point: list[ResponsePointRecord] = msgspec.field(default_factory=list)
    road: list[RoadRecord] = msgspec.field(default_factory=list)
    wheel_load: list[WheelLoadRecord] = msgspec.field(default_factory=list)
    force: list[ForceRecord] = msgspec.field(default_factory=list)
    base_motion: list[BaseMotionRecord] = msgspec.field(default_factory=list)
    engine: list[EngineRecord] = msgspec.field(default_factory=list)
    mode_damping: list[ModeDampingRecord] = msgspec.field(default_factory=list)
    rates: dict[str, dict[str, RateSetRecord]] = msgspec.field(default_factory=dict)
    """[rates.SET.GROUP]."""
    problem: list[ProblemRecord] = msgspec.field(default_factory=list)
    decoupling: DecouplingRecord | None = None
    load_case: list[LoadCaseRecord] = msgspec.field(default_factory=list)

    def build(self, source: Source) -> Vehicle:
        """The vehicle: flexible bodies first, connections as in `CONNECTION_KINDS`."""
        self._check_counts()

        def known(record: FlexibleBodyRecord | RigidBodyRecord) -> Any:
            return source.once(msgspec.json.encode(record), lambda: record.build(source))

        absorbers = built(self.absorber, "absorber", AbsorberRecord.build)
        check_unique("absorber", (absorber.name for absorber in absorbers))
        flexible: tuple[FlexibleBody, ...] = built(self.flexible_body, "flexible_body", known)
        rigid: tuple[RigidBody, ...] = built(self.rigid_body, "rigid_body", known)
        n_coordinates = sum(body.n_modes for body in flexible) + 6 * len((*rigid, *absorbers))
        check_size(COORDINATES, n_coordinates, MOST_COORDINATES)
        by_name = {body.name: body for body in (*flexible, *rigid, *source.stand_ins)}
        parts, tuned = self._connections()
        check_absorbers(absorbers, by_name.values(), parts)
        near = [on_attachment(a, by_name[a.body]) if a.body in by_name else a for a in absorbers]
        tyres = [c for c in parts if isinstance(c, Tyre)]
        roads = built(self.road, "road", lambda r: r.build(source, track_width(tyres)))
        forces = built(self.force, "force", lambda r: r.build(source))
        base_motions = built(self.base_motion, "base_motion", lambda r: r.build(source))
        engines = built(self.engine, "engine", lambda r: r.build(source, by_name))
        given = built(self.mount_group, "mount_group", lambda r: r.build(source))
        mount_groups = (*given, *tuned, *map(absorber_spring, near))
        source.check_lines()
        vehicle = Vehicle(
            name=self.name,
            bodies=(*flexible, *rigid, *source.stand_ins, *map(absorber_mass, near)),
            connections=(*parts, *map(absorber_guide, near)),
            mount_groups=mount_groups,
            added_masses=built(self.added_mass, "added_mass", AddedMassRecord.build),
            response_points=built(self.response_point, "response_point", ResponsePointRecord.build),
            roads=roads,
            wheel_loads=built(self.wheel_load, "wheel_load", WheelLoadRecord.build),
            forces=forces,
            base_motions=base_motions,
            rate_sets=self._rate_sets(mount_groups),
            problems=built(self.problem, "problem", ProblemRecord.build),
            speed=self.speed or USUAL_SPEED,
            highest_frequency=self.highest_frequency,
            frequency_step=self.frequency_step,
            mode_damping=built(self.mode_damping, "mode_damping", ModeDampingRecord.build),
            decoupling=self._decoupling(),
            engines=engines,
            load_cases=built(self.load_case, "load_case", LoadCaseRecord.build),
            remarks=tuple(self.remarks),
        )
        return put_in_place(vehicle, absorbers)

    def _connections(self) -> tuple[list[Connection], list[MountGroup]]:
        """What joins bodies and is not tuned, and the groups of springs and dampers that are."""
        kept: dict[str, tuple[Connection, ...]] = {
            key: built(getattr(self, key), key, lambda r, kind=kind: r.build(kind))
            for key, kind in CONNECTION_KINDS.items()
        }
        tuned: list[MountGroup] = []
        for key in TUNED_KINDS:
            records: list[TunedPartsRecord] = getattr(self, f"{key}_group")
            check_unique(f"{key} group", (record.name for record in records))
            tuned += built(records, f"{key}_group", lambda r, key=key: r.build(kept[key]))
            names = {record.name for record in records}
            kept[key] = tuple(c for c in kept[key] if c.group not in names)
        return list(chain(*kept.values())), tuned

    def _rate_sets(self, groups: Sequence[MountGroup]) -> dict[str, Rates]:
        sets: dict[str, Rates] = {}
        for name, records in self.rates.items():
            with at_key(f"rates.{name}"):
                sets[name] = rate_set(records, groups)
        return sets

    def _decoupling(self) -> Decoupling:
        if self.decoupling is None:
            return USUAL
        with at_key("decoupling"):
            return self.decoupling.build()

    def _check_counts(self) -> None:
        """Raises VehicleError for more than can be computed, before it is built."""
        for key in self.__struct_fields__:
            tables = getattr(self, key)
            if isinstance(tables, list):
                check_size(f"tables [[{key}]]", len(tables), MOST_TABLES)
        check_size("bodies", len((*self.rigid_body, *self.flexible_body, *self.absorber)), MOST_BODIES)
        check_size("mounts", sum(len(group.mount) for group in self.mount_group), MOST_TABLES)
        check_size(COORDINATES, 6 * len((*self.rigid_body, *self.absorber)), MOST_COORDINATES)
