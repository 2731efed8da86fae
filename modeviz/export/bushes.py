"""The mounts of a vehicle as Nastran cards: a CBUSH for each, a PBUSH for each kind, GRIDs for ends.

A CBUSH acts where our mounts do, at a part S of the way between its ends, along a coordinate system of
its own; the GE of a PBUSH is the loss factor (MSC Nastran, Quick Reference Guide).
"""

from collections.abc import Hashable, Iterable, Iterator
from dataclasses import dataclass
from typing import TypeVar

import numpy as np

from modeviz.export.cards import Field, card, comment
from modeviz.formats.component import UnitSystem
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import DIRECTIONS, GROUND, Mount
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
Axes = tuple[float, ...]


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
    mounts = vehicle.mounts
    properties = [_property(mount, units) for mount in mounts]
    pids = _numbered(properties, first_id)
    axes = [_axes(mount) for mount in mounts]
    cids = {None: BASIC} | _numbered((a for a in axes if a is not None), first_id)
    lines = [*_heading(vehicle, units)]
    for kind, pid in pids.items():
        lines += _property_lines(vehicle, kind, pid, units)
    lines += [_axes_card(cid, a) for a, cid in cids.items() if a is not None]
    for number, mount in enumerate(mounts):
        grids = first_id + 2 * number, first_id + 2 * number + 1
        lines += _grid_lines(vehicle, mount, units, grids)
        pid, cid = pids[properties[number]], cids[axes[number]]
        lines.append(_bush_card(mount, first_id + number, pid, grids, cid))
    return "".join(lines).encode("ascii")


def _numbered(things: Iterable[Thing], first: int) -> dict[Thing, int]:
    """The different ones of things, numbered in their order."""
    return {thing: first + i for i, thing in enumerate(dict.fromkeys(things))}


def _property(mount: Mount, units: UnitSystem) -> _Property:
    along, about = 1 / units.mass, 1 / (units.mass * units.length**2)
    return _Property(
        mount.group,
        (*(mount.stiffness * along).tolist(), *(mount.rotational_stiffness * about).tolist()),
        (*(mount.damping * along).tolist(), *(mount.rotational_damping * about).tolist()),
        mount.loss_factor,
    )


def _axes(mount: Mount) -> Axes | None:
    """The local axes of a mount as rows, one after the other; None if they are the vehicle's."""
    return None if np.array_equal(mount.axes, np.eye(3)) else tuple(mount.axes.ravel().tolist())


def _heading(vehicle: Vehicle, units: UnitSystem) -> Iterator[str]:
    length, mass, force = UNIT_NAMES[units.name]
    yield comment(f"Mounts of {vehicle.name}, written by modeviz.")
    yield comment(
        f"Units: length {length}, mass {mass}, force {force}, time s; rates {force}/{length} and "
        f"{force} {length}/rad, viscous damping {force} s/{length} and {force} {length} s/rad."
    )
    yield comment("Basic coordinates: x rearward, y to the right, z up, from the vehicle's origin.")
    yield comment("Rates of a PBUSH are K1 fore-aft, K2 lateral, K3 vertical; GE is the loss factor.")


def _property_lines(vehicle: Vehicle, kind: _Property, pid: int, units: UnitSystem) -> Iterator[str]:
    length, _, force = UNIT_NAMES[units.name]
    label = vehicle.mount_group(kind.group).label
    rates = zip(DIRECTIONS, kind.stiffness[2::-1], strict=True)
    said = ", ".join(f"{direction} {rate:.6g}" for direction, rate in rates)
    named = kind.group if label == kind.group else f"{kind.group} ({label})"
    yield comment(
        f"PBUSH {pid}: group {named}: {said} {force}/{length}, loss factor {kind.loss_factor:.6g}"
    )
    fields: list[Field] = [pid, "K", *_unless_zero(kind.stiffness)]
    if any(kind.damping):
        fields += [None, "B", *_unless_zero(kind.damping)]
    if kind.loss_factor:
        fields += [None, "GE", *[kind.loss_factor] * len(kind.stiffness)]
    yield card("PBUSH", fields)


def _unless_zero(values: Iterable[float]) -> list[float | None]:
    return [value or None for value in values]


def _axes_card(cid: int, axes: Axes) -> str:
    """The coordinate system of some axes: a point on its z and one on its x, from the origin."""
    x, z = axes[:3], axes[6:]
    return card("CORD2R", [cid, BASIC, 0.0, 0.0, 0.0, *z, *x])


def _grid_lines(
    vehicle: Vehicle, mount: Mount, units: UnitSystem, grids: tuple[int, int]
) -> Iterator[str]:
    ends = list(zip(mount.bodies, mount.points, strict=True))
    held = " to ".join(_end(vehicle, body, point) for body, point in ends)
    yield comment(f"CBUSH {mount.name}, group {mount.group}: GRID {grids[0]} and {grids[1]}, {held}")
    for grid, (body, point) in zip(grids, ends, strict=True):
        place = (point / units.length).tolist()
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
