"""Bushings as the tables of a vehicle file: mount groups that are tuned, springs and dampers."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.others import OtherRate, tuned_others, untuned_others
from modeviz.files.mount_tables.same_part import difference
from modeviz.files.records.connections import (
    ConnectionRecord,
    JointRecord,
    MountGroupRecord,
    MountRecord,
    TravelRecord,
)
from modeviz.files.records.progressive import GroupRatesRecord
from modeviz.files.records.rates import RatesRecord
from modeviz.files.records.record import Record, said, tuples
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.local_axes import AXES
from modeviz.vehicle.mount_group import USUAL_STATIC_RATIO


@dataclass(frozen=True, eq=False)
class Joined:
    """What a bushing holds on to."""

    bodies: tuple[str, str]
    places: tuple[Floats, Floats]
    """(3,) each, m, in the axes of the vehicle's file."""


def connection_tables(
    bushings: Sequence[Bushing], joined: Mapping[str, Joined], named: Mapping[str, str]
) -> Iterator[tuple[str, list[Record]]]:
    """Return the tables of a vehicle file that bushings become, by their key.

    Those of a group are mounts, which are tuned; others are springs or, without stiffness, dampers.

    Args:
        bushings: in SI and the axes of the vehicle's file.
        joined: what each holds on to, by its name.
        named: as of `Reading`.

    Raises:
        VehicleError: mounts of a group differ, or one has no rate.
    """
    groups: dict[str, list[Bushing]] = {}
    springs: list[Record] = []
    dampers: list[Record] = []
    for bushing in bushings:
        is_spring = bushing.stiffness.any() or bushing.rigid
        if bushing.group and bushing.is_tuned:
            groups.setdefault(bushing.group, []).append(bushing)
        elif bushing.limits.are_said:
            raise VehicleError(
                f"{bushing.where}: travel and ratios are of mounts that are tuned; give "
                f"{quoted(bushing.name)} a group and rates, or nothing in these columns"
            )
        elif is_spring or bushing.damping.any():
            record = JointRecord if is_spring else ConnectionRecord
            (springs if is_spring else dampers).append(_connection(bushing, joined, record))
        else:
            raise VehicleError(f"{bushing.where}: {quoted(bushing.name)} has no rate that is not zero")
    yield "mount_group", [_group(name, lot, joined, named) for name, lot in groups.items()]
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
    name: str, lot: Sequence[Bushing], joined: Mapping[str, Joined], named: Mapping[str, str]
) -> MountGroupRecord:
    """The mount group of bushings.

    Raises:
        VehicleError: they are not the same part.
    """
    first = lot[0]
    for other in lot:
        _check_same(other, first)
        _check_way(other, joined[other.name])
    limits, tuned = first.limits, tuned_others(first, named)
    softest, stiffest = _bounds(first, named, tuned)
    others = {field: rate for field, (rate, _, _) in tuned.items()}
    return MountGroupRecord(
        name=name,
        rates=GroupRatesRecord(**_rates(first.stiffness[:3], named), **others),
        loss_factor=first.loss_factor,
        softest=softest,
        stiffest=stiffest,
        ratio_limits=None if np.isnan(limits.ratios).all() else limits.ratios,
        static_ratio=USUAL_STATIC_RATIO if np.isnan(limits.static_ratio) else limits.static_ratio,
        travel=_travel(limits.travel, named),
        mount=[MountRecord(name=b.name, **said(MountRecord, _mount(b, joined[b.name]))) for b in lot],
        **untuned_others(first),
    )


def _mount(bushing: Bushing, joined: Joined) -> dict[str, object]:
    """What a mount of a group has of its own: nothing of what its group is tuned in."""
    placed = _placed(bushing, joined)
    return {key: value for key, value in placed.items() if key not in untuned_others(bushing)}


def _check_same(other: Bushing, first: Bushing) -> None:
    """Raises VehicleError unless a mount is the same part as its group's first, in SI."""
    if differs := difference(other, first):
        name, found, expected = differs
        raise VehicleError(
            f"{other.where}: {name} of {quoted(other.name)} is {found:.6g} and that of "
            f"{quoted(first.name)} in {first.where} {expected:.6g}; mounts of a group, here "
            f"{quoted(other.group)}, are the same part"
        )


def _check_way(bushing: Bushing, joined: Joined) -> None:
    """Raises VehicleError for a travel from a mount's second end, which is called the first here."""
    if joined.bodies[0] == GROUND and not np.isnan(bushing.limits.travel).all():
        raise VehicleError(
            f"{bushing.where}: travel is how far the first body goes from the second, and the first of "
            f"{quoted(bushing.name)} is the ground; give the ground as the second"
        )


def _travel(travel: Floats, named: Mapping[str, str]) -> TravelRecord | None:
    """The travel of a group as a table of its own; None if nothing is limited."""
    along = {name: travel[:, AXES.index(axis)].tolist() for name, axis in named.items()}
    ranges = {name: (low, high) for name, (low, high) in along.items() if not np.isnan(low)}
    return TravelRecord(**ranges) if ranges else None


def _rates(stiffness: Floats, named: Mapping[str, str]) -> dict[str, float]:
    """Rates by what they are called."""
    return {name: float(stiffness[AXES.index(named[name])]) for name in named}


def _bounds(
    bushing: Bushing, named: Mapping[str, str], tuned: Mapping[str, OtherRate]
) -> list[RatesRecord | None]:
    """The softest and the stiffest rates of a group, where they are given."""
    if np.isnan([bushing.softest, bushing.stiffest]).all() and not tuned:
        return [None, None]
    return [
        RatesRecord(**_rates(bound, named), **{field: other[1 + i] for field, other in tuned.items()})
        for i, bound in enumerate(bushing.bounds)
    ]
