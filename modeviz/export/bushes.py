"""The mounts of a vehicle as Nastran cards: a CBUSH for each, a PBUSH for each kind, GRIDs for ends.

A CBUSH acts where our mounts do, at a part S of the way between its ends, along a coordinate system of
its own; the GE of a PBUSH is the loss factor (MSC Nastran, Quick Reference Guide).
"""

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from modeviz.export.axes import FileAxes
from modeviz.export.cards import Field, card, comment
from modeviz.formats.component import UnitSystem
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.vehicle import Vehicle

UNIT_NAMES = {
    "m-kg-s": ("m", "kg", "N"),
    "mm-t-s": ("mm", "t", "N"),
    "mm-kg-mN": ("mm", "kg", "mN"),
    "in-lbf-s": ("in", "lbf s^2/in", "lbf"),
    "ft-lbf-s": ("ft", "slug", "lbf"),
}
"""What length, mass and force are in, by the name of a system of `UNIT_SYSTEMS`."""

BASIC = 0
"""The coordinate system that all others stand in."""

HELD = "123456"
"""Of a grid on the ground: all its directions."""

Thing = TypeVar("Thing", bound=Hashable)
Frame = tuple[float, ...]
"""Local axes as rows, one after the other."""


@dataclass(frozen=True)
class _Property:
    """What mounts have in common that share a PBUSH, in the units that are written."""

    group: str
    stiffness: tuple[float, ...]
    """(6,), of `MOTIONS`, as is the damping."""
    damping: tuple[float, ...]
    loss_factor: float


def bush_deck(vehicle: Vehicle, units: UnitSystem, first_id: int = 1) -> bytes:
    """Return the mounts of a vehicle as bulk data cards, with comments that name each.

    Args:
        vehicle: with the rates that are written.
        units: to write them in, one of `UNIT_SYSTEMS`.
        first_id: grids, elements, properties and coordinate systems are each counted from it.
    """
    mounts, axes = vehicle.mounts, FileAxes(vehicle.axes)
    properties = [_property(mount, units, axes) for mount in mounts]
    pids = _numbered(properties, first_id)
    frames = [_frame(mount, axes) for mount in mounts]
    cids = {None: BASIC} | _numbered((f for f in frames if f is not None), first_id)
    lines = [*_heading(vehicle, units, axes)]
    for kind, pid in pids.items():
        lines += _property_lines(vehicle, kind, pid, units, axes)
    lines += [_frame_card(cid, frame) for frame, cid in cids.items() if frame is not None]
    for number, mount in enumerate(mounts):
        grids = first_id + 2 * number, first_id + 2 * number + 1
        places = axes.vectors(mount.points) / units.length
        lines += _grid_lines(vehicle, mount, grids, places)
        pid, cid = pids[properties[number]], cids[frames[number]]
        lines.append(_bush_card(mount, first_id + number, pid, grids, cid))
    return "".join(lines).encode("ascii")


def _numbered(things: Iterable[Thing], first: int) -> dict[Thing, int]:
    """The different ones of things, numbered in their order."""
    return {thing: first + i for i, thing in enumerate(dict.fromkeys(things))}


def _property(mount: Mount, units: UnitSystem, axes: FileAxes) -> _Property:
    of_force, of_moment = units.mass, units.mass * units.length**2

    def six(along: Floats, about: Floats) -> tuple[float, ...]:
        written = axes.rates(along) / of_force, axes.rates(about) / of_moment
        return tuple(np.concatenate(written).tolist())

    return _Property(
        mount.group,
        six(mount.stiffness, mount.rotational_stiffness),
        six(mount.damping, mount.rotational_damping),
        mount.loss_factor,
    )


def _frame(mount: Mount, axes: FileAxes) -> Frame | None:
    """The local axes of a mount; None if they are the basic ones."""
    frame = axes.frame(mount.axes)
    return None if np.array_equal(frame, np.eye(3)) else tuple(frame.ravel().tolist())


def _heading(vehicle: Vehicle, units: UnitSystem, axes: FileAxes) -> Iterator[str]:
    length, mass, force = UNIT_NAMES[units.name]
    yield comment(f"Mounts of {vehicle.name}, written by modeviz.")
    yield comment(
        f"Units: length {length}, mass {mass}, force {force}, time s; rates {force}/{length} and "
        f"{force} {length}/rad, viscous damping {force} s/{length} and {force} {length} s/rad."
    )
    yield comment(f"Basic coordinates: {axes.text}, from the vehicle's origin.")
    named = ", ".join(f"K{i} {direction}" for i, direction in enumerate(axes.directions, 1))
    yield comment(f"Rates of a PBUSH are {named}; GE is the loss factor.")


def _property_lines(
    vehicle: Vehicle, kind: _Property, pid: int, units: UnitSystem, axes: FileAxes
) -> Iterator[str]:
    length, _, force = UNIT_NAMES[units.name]
    label = vehicle.mount_group(kind.group).label
    rates = zip(axes.directions, kind.stiffness[:3], strict=True)
    said = ", ".join(f"{direction} {rate:.6g}" for direction, rate in rates)
    named = kind.group if label == kind.group else f"{kind.group} ({label})"
    yield comment(
        f"PBUSH {pid}: group {named}: {said} {force}/{length}, loss factor {kind.loss_factor:.6g}"
    )
    if dynamic := vehicle.mount_group(kind.group).dynamic:
        yield comment(f"These are its rates at {dynamic.reference_hz:g} Hz; they depend on frequency.")
    fields: list[Field] = [pid, "K", *_unless_zero(kind.stiffness)]
    if any(kind.damping):
        fields += [None, "B", *_unless_zero(kind.damping)]
    if kind.loss_factor:
        fields += [None, "GE", *[kind.loss_factor] * len(kind.stiffness)]
    yield card("PBUSH", fields)


def _unless_zero(values: Iterable[float]) -> list[float | None]:
    return [value or None for value in values]


def _frame_card(cid: int, frame: Frame) -> str:
    """The coordinate system of some axes: a point on its z and one on its x, from the origin."""
    x, z = frame[:3], frame[6:]
    return card("CORD2R", [cid, BASIC, 0.0, 0.0, 0.0, *z, *x])


def _grid_lines(
    vehicle: Vehicle, mount: Mount, grids: tuple[int, int], places: Floats
) -> Iterator[str]:
    ends = list(zip(mount.bodies, mount.points, strict=True))
    held = " to ".join(_end(vehicle, body, point) for body, point in ends)
    yield comment(f"CBUSH {mount.name}, group {mount.group}: GRID {grids[0]} and {grids[1]}, {held}")
    for grid, body, place in zip(grids, mount.bodies, places.tolist(), strict=True):
        yield card("GRID", [grid, BASIC, *place, BASIC, *([HELD] if body == GROUND else [])])


def _end(vehicle: Vehicle, body: str, point: Floats) -> str:
    """What a mount holds on to at an end."""
    if body == GROUND:
        return GROUND
    its = vehicle.body(body)
    if not isinstance(its, FlexibleBody):
        return body
    return f'{body} at "{its.nearest_attachment(point).name}"'


def _bush_card(mount: Mount, number: int, pid: int, grids: tuple[int, int], cid: int) -> str:
    fields: list[Field] = [number, pid, *grids, None, None, None, cid]
    if not np.array_equal(*mount.points):
        fields.append(mount.elastic_center)
    return card("CBUSH", fields)
