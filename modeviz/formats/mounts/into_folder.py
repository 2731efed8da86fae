"""Bushings put into a vehicle folder, as mount groups that are tuned, springs and dampers."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.folder import VEHICLE_FILE, read_vehicle
from modeviz.files.records.connections import (
    ConnectionRecord,
    JointRecord,
    MountGroupRecord,
    MountRecord,
)
from modeviz.files.records.rates import RatesRecord
from modeviz.files.records.record import Record, said, tuples
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.schema.axes import axes_of
from modeviz.files.toml_reader import read_toml
from modeviz.formats.append import append_tables
from modeviz.formats.mounts.bushing import AXES, Bushing
from modeviz.formats.mounts.ends import Ends, Joined
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND, MountRates, usual_bounds
from modeviz.vehicle.vehicle import Vehicle

SAME = 1e-9
"""Relative: rates of mounts of a group that differ by less are the same."""


@dataclass(frozen=True, eq=False)
class Target:
    """The vehicle folder that bushings are put into."""

    folder: Path
    vehicle: Vehicle
    axes: Floats
    """(3, 3): turns what is in the axes of its file into ours."""

    @classmethod
    def of(cls, folder: Path) -> "Target":
        """Raises VehicleError if there is no vehicle in a folder."""
        path = folder / VEHICLE_FILE
        if not path.is_file():
            raise VehicleError(
                f"{folder}: has no {VEHICLE_FILE}; import the bodies first, then what joins them"
            )
        vehicle = read_vehicle(folder)
        return cls(folder, vehicle, axes_of(read_toml(path, VehicleRecord).axes))

    @property
    def named(self) -> dict[str, str]:
        """Along which of x, y and z of the file the directions of rates are."""
        ours = {"fore_aft": 0, "lateral": 1, "vertical": 2}
        return {name: AXES[int(np.abs(self.axes[row]).argmax())] for name, row in ours.items()}


def near_bushings(
    bushings: Sequence[Bushing], target: Target, note: Callable[[str], None]
) -> tuple[Bushing, ...]:
    """Return the bushings that something of a vehicle is near, or all if there is nothing near any.

    Those of an input file may be within bodies, as spot welds are; but where most are near nothing, the
    file is likely in other units or elsewhere.

    Args:
        bushings: in SI and the axes of the vehicle's file.
        target: of the vehicle.
        note: told which are left out.

    Raises:
        VehicleError: most of them are near nothing.
    """
    ends = Ends(target.vehicle, target.axes)
    far = [bushing.name for bushing in bushings if ends.is_far(bushing)]
    if not far or len(far) == len(bushings):
        return tuple(bushings)
    if 2 * len(far) > len(bushings):
        raise VehicleError(
            f"{len(far)} of {len(bushings)} springs have no attachment of a body near, such as "
            f"{listed(far[:3])}; are the units others, or does the file stand elsewhere (--pose)? "
            "Take springs within bodies out of it"
        )
    note(f"{listed(far)}: no body has an attachment near, and are left out")
    return tuple(bushing for bushing in bushings if bushing.name not in far)


def add_bushings(bushings: Sequence[Bushing], target: Target, source: str) -> Vehicle:
    """Return the vehicle of a folder into which bushings are put.

    What stands in its vehicle.toml stays to the letter; the new tables come after it.

    Args:
        bushings: in SI and the axes of the vehicle's file.
        target: what to put them into.
        source: the file that they are from.

    Raises:
        VehicleError: a name is there already, an end holds on to nothing, or mounts of a group differ;
            the folder is as it was then.
    """
    with located(source):
        _check_new(bushings, target.vehicle)
        ends = Ends(target.vehicle, target.axes)
        joined = {b.name: ends.joined(b) for b in bushings}
        tables = dict(_records(bushings, joined, target))
    heading = f"# {len(bushings)} connections from {' '.join(source.split())}"
    return append_tables(target.folder, tables, heading)


def _check_new(bushings: Sequence[Bushing], vehicle: Vehicle) -> None:
    """Raises VehicleError for a name that the vehicle has."""
    names = {connection.name for connection in vehicle.all_connections}
    groups = {group.name for group in vehicle.mount_groups}
    bodies = {body.name for body in vehicle.bodies}
    for bushing in bushings:
        if bushing.name in names:
            raise VehicleError(
                f"{bushing.where}: the vehicle has a connection {quoted(bushing.name)} already; give "
                "this one another name, or take its table out of vehicle.toml"
            )
        if bushing.group in groups:
            raise VehicleError(
                f"{bushing.where}: the vehicle has a mount group {quoted(bushing.group)} already; to "
                "try other rates give commands a file of them with --rates"
            )
        if bushing.group in bodies:
            raise VehicleError(
                f"{bushing.where}: the group {quoted(bushing.group)} has the name of a body; take "
                "another"
            )


def _records(
    bushings: Sequence[Bushing], joined: Mapping[str, Joined], target: Target
) -> Iterator[tuple[str, list[Record]]]:
    """The tables of bushings, by their key."""
    groups: dict[str, list[Bushing]] = {}
    springs: list[Record] = []
    dampers: list[Record] = []
    for bushing in bushings:
        is_spring = bushing.stiffness.any() or bushing.rigid
        if bushing.group and bushing.stiffness[:3].any() and not bushing.rigid:
            groups.setdefault(bushing.group, []).append(bushing)
        elif is_spring or bushing.damping.any():
            record = JointRecord if is_spring else ConnectionRecord
            (springs if is_spring else dampers).append(_connection(bushing, joined, record))
        else:
            raise VehicleError(f"{bushing.where}: {quoted(bushing.name)} has no rate that is not zero")
    yield "mount_group", [_group(name, lot, joined, target) for name, lot in groups.items()]
    yield "spring", springs
    yield "damper", dampers


def _placed(bushing: Bushing, joined: Joined) -> dict[str, object]:
    """Bodies, place and axes as the keys of a record; the ground is the second."""
    bodies, places, center = joined.bodies, joined.places, bushing.elastic_center
    if bodies[0] == GROUND:
        bodies, places, center = bodies[::-1], places[::-1], 1 - center
    first, second = map(tuples, places)
    return {
        "bodies": bodies,
        "at": first if first == second else (first, second),
        "axes": tuples(bushing.axes),
        "elastic_center": center,
        "rotational_stiffness": tuples(bushing.stiffness[3:]),
        "damping": tuples(bushing.damping[:3]),
        "rotational_damping": tuples(bushing.damping[3:]),
    }


def _connection(bushing: Bushing, joined: Mapping[str, Joined], kind: type[ConnectionRecord]) -> Record:
    fields = {
        **_placed(bushing, joined[bushing.name]),
        "stiffness": tuples(bushing.stiffness[:3]),
        "loss_factor": bushing.loss_factor,
    }
    if kind is JointRecord:
        fields["rigid"] = bushing.rigid or False
    return kind(name=bushing.name, group=bushing.group, **said(kind, fields))


def _group(
    name: str, lot: Sequence[Bushing], joined: Mapping[str, Joined], target: Target
) -> MountGroupRecord:
    """The mount group of bushings.

    Raises:
        VehicleError: they are not the same part.
    """
    first = lot[0]
    for other in lot[1:]:
        _check_same(other, first)
    softest, stiffest = _bounds(first, target)
    return MountGroupRecord(
        name=name,
        rates=_rates(first.stiffness[:3], target),
        loss_factor=first.loss_factor,
        softest=softest,
        stiffest=stiffest,
        mount=[MountRecord(name=b.name, **said(MountRecord, _placed(b, joined[b.name]))) for b in lot],
    )


def _check_same(other: Bushing, first: Bushing) -> None:
    """Raises VehicleError unless a mount has the rates, loss factor and bounds of its group's first."""
    values = (
        ("stiffness", other.stiffness[:3], first.stiffness[:3]),
        ("loss factor", other.loss_factor, first.loss_factor),
        ("softest", other.softest, first.softest),
        ("stiffest", other.stiffest, first.stiffest),
    )
    for what, found, expected in values:
        if not np.allclose(found, expected, rtol=SAME, atol=0, equal_nan=True):
            raise VehicleError(
                f"{other.where}: the {what} of {quoted(other.name)} is {_list(found)} and that of "
                f"{quoted(first.name)} in {first.where} {_list(expected)}; mounts of a group, here "
                f"{quoted(other.group)}, are the same part"
            )


def _list(values: Floats | float) -> str:
    return ", ".join(f"{value:.6g}" for value in np.atleast_1d(values))


def _rates(stiffness: Floats, target: Target) -> RatesRecord:
    named = target.named
    return RatesRecord(**{name: float(stiffness[AXES.index(named[name])]) for name in named})


def _bounds(bushing: Bushing, target: Target) -> list[RatesRecord | None]:
    """The softest and the stiffest rates of a group, where they are given.

    Raises:
        VehicleError: the softest are above the stiffest.
    """
    given = bushing.softest, bushing.stiffest
    if np.isnan(given).all():
        return [None, None]
    usual = usual_bounds(MountRates(*bushing.stiffness[:3]))  # three numbers, whatever they are called
    low, high = (
        np.where(np.isnan(bound), other.as_tuple(), bound)
        for bound, other in zip(given, usual, strict=True)
    )
    if not (low < high).all():
        raise VehicleError(
            f"{bushing.where}: the softest rates, {_list(low)} N/m, are not below the stiffest, "
            f"{_list(high)} N/m"
        )
    return [_rates(low, target), _rates(high, target)]
