"""The mounts of a vehicle as a table that is read again, see docs/mount-tables.md."""

import csv
from collections.abc import Iterable, Iterator
from io import StringIO

import numpy as np

from modeviz.export.axes import FileAxes
from modeviz.files.mount_tables.limits import RATIOS, STATIC_RATIO, TRAVEL
from modeviz.files.schema.scaling import written
from modeviz.units import WRITTEN_UNITS, QuantityName, factor
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Mount
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DAMPING_FIELDS, DIRECTIONS, ROTATIONAL_FIELDS
from modeviz.vehicle.vehicle import Vehicle

AXES = ("x", "y", "z")

OTHER_BOUNDS: tuple[tuple[str, QuantityName, tuple[str, ...]], ...] = (
    ("r{}", "rotational_stiffness", ROTATIONAL_FIELDS),
    ("c_{}", "damping", DAMPING_FIELDS[::-1]),
)
"""What columns of bounds end with, their quantity, and the rates along or about x, y and z."""


def mount_table(vehicle: Vehicle) -> bytes:
    """Return the mounts as comma-separated text in UTF-8, a line each, in the axes of its file."""
    axes = FileAxes(vehicle.axes)
    lines = [
        dict(_cells(group, mount, axes)) for group in vehicle.mount_groups for mount in group.mounts
    ]
    text = StringIO()
    table = csv.DictWriter(text, list(lines[0]), lineterminator="\n")
    table.writeheader()
    table.writerows(lines)
    return text.getvalue().encode()


def _cells(group: MountGroup, mount: Mount, axes: FileAxes) -> Iterator[tuple[str, str | float]]:
    """The headers of all columns, and what stands there in the line of a mount."""
    first, second = axes.vectors(mount.points)
    softest, stiffest = (axes.rates(np.array(bound.local())) for bound in group.bounds)
    frame = axes.frame(mount.axes)
    yield "name", mount.name
    yield "group", group.name
    yield from zip(("body_1", "body_2"), mount.bodies, strict=True)
    yield from _with_unit("{}", "length", first)
    yield from _with_unit("{}_2", "length", second)
    yield from _with_unit("k_{}", "stiffness", axes.rates(mount.stiffness / mount.tangent))
    yield from _with_unit("k_r{}", "rotational_stiffness", axes.rates(mount.rotational_stiffness))
    yield from _with_unit("c_{}", "damping", axes.rates(mount.damping))
    yield from _with_unit("c_r{}", "rotational_damping", axes.rates(mount.rotational_damping))
    yield "loss_factor", mount.loss_factor
    yield from _with_unit("softest_{}", "stiffness", softest)
    yield from _with_unit("stiffest_{}", "stiffness", stiffest)
    yield from _other_bounds(group, axes)
    for name, ends in zip(TRAVEL, axes.ranges(_travel(group)), strict=True):
        yield from _with_unit(f"{name}_{{}}", "length", ends)
    yield STATIC_RATIO, group.static_ratio
    yield from zip(RATIOS, group.ratio_limits or ("", ""), strict=True)
    yield from _plain("x_axis_{}", frame[0])
    yield from _plain("z_axis_{}", frame[2])
    yield "elastic_center", mount.elastic_center


def _other_bounds(group: MountGroup, axes: FileAxes) -> Iterator[tuple[str, str | float]]:
    """The bounds of rates about axes and of dampers, where they are tuned."""
    for what, quantity, fields in OTHER_BOUNDS:
        tuned = axes.rates(np.array([field in group.fields for field in fields], float)) > 0
        for which, bound in zip(("softest", "stiffest"), group.bounds, strict=True):
            values = axes.rates(np.array([getattr(bound, field) for field in fields]))
            yield from _with_unit(f"{which}_{what}", quantity, np.where(tuned, values, np.nan))


def _travel(group: MountGroup) -> Floats:
    """The least and the most along local x, y, z, (2, 3), m; not numbers where nothing is limited."""
    nothing = (np.nan, np.nan)
    return np.array([group.travel.get(direction, nothing) for direction in DIRECTIONS[::-1]]).T


def _with_unit(name: str, quantity: QuantityName, values: Floats) -> Iterable[tuple[str, str | float]]:
    """A cell for each axis, empty where there is no number."""
    unit = WRITTEN_UNITS[quantity]
    for axis, value in zip(AXES, values.tolist(), strict=True):
        cell = "" if np.isnan(value) else written(value, factor(unit, quantity))
        yield f"{name.format(axis)} [{unit}]", cell


def _plain(name: str, values: Floats) -> Iterable[tuple[str, float]]:
    return zip(map(name.format, AXES), values.tolist(), strict=True)
