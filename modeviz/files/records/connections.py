"""The tables of `vehicle.toml` that connect bodies, from mounts to tyres, in SI."""

from dataclasses import replace
from typing import Annotated, Any, Self

import msgspec
import numpy as np
from msgspec import Meta

from modeviz.errors import Fault, FaultsError, VehicleError, at_key, check_unique
from modeviz.files.records.dynamic import DynamicRecord
from modeviz.files.records.fields import (
    AngleOrder,
    Angles,
    Damping,
    DampingRate,
    Ends,
    ForeAftRange,
    Frame,
    LateralRange,
    Length,
    Motions,
    Name,
    Place,
    Position,
    Rate,
    Ratio,
    RatioLimits,
    RotationalDamping,
    RotationalStiffness,
    Stiffness,
    VerticalRange,
)
from modeviz.files.records.progressive import CurveRecord, GroupRatesRecord
from modeviz.files.records.rates import RatesRecord, bounds_of
from modeviz.files.records.record import Record, built, said, tuples
from modeviz.files.schema.axes import whole_frame
from modeviz.files.schema.quantities import UNITLESS
from modeviz.files.source import Source
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS, Connection, Mount, Rod, Track
from modeviz.vehicle.local_axes import TurnOrder, axes_of_angles
from modeviz.vehicle.mount_group import SHARED, USUAL_STATIC_RATIO, MountGroup, Travel
from modeviz.vehicle.mount_rates import DIRECTIONS, usual_bounds
from modeviz.vehicle.progressive import ForceCurve

NO_RATES = (0.0, 0.0, 0.0)
OF_ANGLES = ("angles", "angle_order")
VEHICLE_AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


def frame(axes: Frame, angles: Angles | None, angle_order: str) -> Floats:
    """Return local axes as rows, (3, 3).

    Args:
        axes: all three or x and y, where there are no angles.
        angles: about x, y and z, rad, by which they are turned out of the file's.
        angle_order: of these, as `TurnOrder` reads it.

    Raises:
        FaultsError: they are said twice, or the order of angles isn't where it matters.
    """
    if angles is None:
        with at_key("axes"):
            return whole_frame(axes)
    if axes != VEHICLE_AXES:
        raise FaultsError(Fault("angles", "found beside axes, expected one of them"))
    if not angle_order and np.count_nonzero(angles) > 1:
        words = 'missing, expected the order of the angles, such as "xyz fixed" or "zyx turned"'
        raise FaultsError(Fault("angle_order", words))
    with at_key("angle_order"):
        order = TurnOrder.of(angle_order) if angle_order else TurnOrder()
        return axes_of_angles(np.array(angles), order)


class MountRecord(Record, kw_only=True):
    """[[mount_group.mount]]; but for the place, the keys are the attributes of a connection."""

    name: Name
    bodies: tuple[str, str]
    at: Place
    rotational_stiffness: RotationalStiffness = NO_RATES
    damping: Damping = NO_RATES
    rotational_damping: RotationalDamping = NO_RATES
    axes: Frame = VEHICLE_AXES
    angles: Angles | None = None
    """About x, y and z, by which the local axes are turned out of the file's, instead of these."""
    angle_order: AngleOrder = ""
    """As `TurnOrder` reads it; where only one angle is not zero it does not matter."""
    elastic_center: Annotated[float, UNITLESS] = 0.5
    """Where between its ends it acts: 0 at the first, 1 at the second."""

    @classmethod
    def of(cls, connection: Connection) -> Self:
        first, second = map(tuples, connection.points)
        keys = (f for f in cls.__struct_fields__ if f not in ("at", *OF_ANGLES))
        fields = {key: tuples(getattr(connection, key)) for key in keys}
        return cls(at=first if first == second else (first, second), **said(cls, fields))

    def arguments(self) -> dict[str, Any]:
        """The constructor's arguments of a connection."""
        keys = (f for f in self.__struct_fields__ if f not in ("at", "axes", *OF_ANGLES))
        fields = {f: getattr(self, f) for f in keys}
        axes = frame(self.axes, self.angles, self.angle_order)
        return {"points": self._ends(), "axes": axes, **fields}

    def _ends(self) -> Floats:
        ends = self.at if len(self.at) == 2 else (self.at, self.at)
        if any(np.shape(end) != (3,) for end in ends):
            raise VehicleError(f"at: found {list(self.at)}, expected [x, y, z] or two of them")
        return np.array(ends, float)


class TravelRecord(Record, kw_only=True):
    """[mount_group.travel]: how far the first end of a mount may go from the second."""

    vertical: VerticalRange | None = None
    lateral: LateralRange | None = None
    fore_aft: ForeAftRange | None = None

    @classmethod
    def of(cls, travel: Travel) -> Self | None:
        """None if nothing is limited."""
        ranges = {d.replace("-", "_"): (float(low), float(high)) for d, (low, high) in travel.items()}
        return cls(**ranges) if ranges else None

    def build(self) -> Travel:
        ranges = dict(zip(DIRECTIONS, (self.vertical, self.lateral, self.fore_aft), strict=True))
        return {direction: limits for direction, limits in ranges.items() if limits is not None}


class MountGroupRecord(Record, kw_only=True):
    """[[mount_group]]."""

    name: Name
    label: str = ""
    """The name, if not given."""
    rates: GroupRatesRecord
    loss_factor: Ratio | None = None
    """That of `dynamic` at its reference, if not given."""
    dynamic: DynamicRecord | None = None
    """How rates depend on frequency."""
    softest: RatesRecord | None = None
    stiffest: RatesRecord | None = None
    ratio_limits: RatioLimits | None = None
    """The least and the most that lateral and fore-aft rates may be of the vertical one."""
    rotational_stiffness: RotationalStiffness = NO_RATES
    """Of each mount that has none of its own, as what follows."""
    damping: Damping = NO_RATES
    rotational_damping: RotationalDamping = NO_RATES
    static_ratio: Annotated[float, Meta(gt=0), UNITLESS] = USUAL_STATIC_RATIO
    """Its rates by those under a load that stays."""
    travel: TravelRecord | None = None
    curve: list[CurveRecord] = msgspec.field(default_factory=list)
    mount: list[MountRecord]

    @classmethod
    def of(cls, group: MountGroup, rate_file: str) -> Self:
        return cls(
            name=group.name,
            label=group.label,
            rates=GroupRatesRecord.of(group.rates),
            loss_factor=group.loss_factor,
            dynamic=group.dynamic and DynamicRecord.of(group.dynamic, rate_file),
            softest=RatesRecord.of(group.bounds[0], group.fields),
            stiffest=RatesRecord.of(group.bounds[1], group.fields),
            ratio_limits=group.ratio_limits,
            static_ratio=group.static_ratio,
            travel=TravelRecord.of(group.travel),
            curve=[CurveRecord.of(direction, curve) for direction, curve in group.curves.items()],
            mount=[MountRecord.of(_own(mount)) for mount in group.mounts],
            **{name: tuples(getattr(group, name)) for name in SHARED},
        )

    def build(self, source: Source) -> MountGroup:
        curves = self._curves(source)
        with at_key("rates"):
            rates = self.rates.build(curves, self.static_ratio)
        dynamic = None
        if self.dynamic is not None:
            with at_key("dynamic"):
                dynamic = self.dynamic.build(source)
        loss_factor = dynamic.loss_factor if dynamic and self.loss_factor is None else self.loss_factor
        if loss_factor is None:
            raise FaultsError(Fault("loss_factor", "missing"))
        return MountGroup(
            self.name,
            self.label or self.name,
            rates,
            loss_factor,
            bounds_of(self.softest, self.stiffest, usual_bounds(rates)),
            tuple(Mount(group=self.name, **mount.arguments()) for mount in self.mount),
            self.ratio_limits,
            static_ratio=self.static_ratio,
            travel=self.travel.build() if self.travel else {},
            curves=curves,
            dynamic=dynamic,
            rotational_stiffness=np.array(self.rotational_stiffness),
            damping=np.array(self.damping),
            rotational_damping=np.array(self.rotational_damping),
        )

    def _curves(self, source: Source) -> dict[str, ForceCurve]:
        """By direction; raises VehicleError for two of one direction."""
        check_unique("curve of", (curve.direction for curve in self.curve))
        curves = built(self.curve, "curve", lambda curve: curve.build(source))
        return dict(zip((curve.direction for curve in self.curve), curves, strict=True))


def _own(mount: Mount) -> Mount:
    """A mount with nothing that it has from its group."""
    shared = [name for name in SHARED if not mount.has_own(name)]
    return replace(mount, **dict.fromkeys(shared, np.zeros(3)))


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
        return cls(at=tuples(rod.points), **said(cls, fields))

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
