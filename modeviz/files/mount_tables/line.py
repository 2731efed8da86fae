"""A line of a mount table as a bushing."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, listed, located, quoted, unknown
from modeviz.files.columns import Column, rate_unit
from modeviz.files.disk import inside
from modeviz.files.headed_table import TableLine
from modeviz.files.mount_tables.bushing import DIRECTIONS, Bushing, End
from modeviz.files.mount_tables.columns import NAMED, has_known_order
from modeviz.files.mount_tables.limits import (
    TRAVEL,
    GroupLimits,
    check_travel,
    read_others,
    read_ratios,
    read_static_ratio,
)
from modeviz.files.mount_tables.reading import Reading, SixRates
from modeviz.files.mount_tables.same_part import difference
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.local_axes import AXES, TurnOrder, axes_of_angles, axes_of_vectors

RATES = tuple(f"k_{direction}" for direction in DIRECTIONS)
DAMPINGS = tuple(f"c_{direction}" for direction in DIRECTIONS)
ANGLES = tuple(f"angle_{axis}" for axis in AXES)


@dataclass(frozen=True)
class MountLine(TableLine):
    """The line of a mount."""

    reading: Reading

    @property
    def otherwise(self) -> str:
        """What else may be done where a header has no unit."""
        return "" if self.reading.is_own else ", or give --units"

    def factor(self, column: Column) -> float | None:
        """One of a column's numbers in SI; None if nothing says it."""
        if column.kind == "stiffness" and not column.unit and self.text("units"):
            with located(self.where("units")):
                return rate_unit(self.text("units"))
        return super().factor(column)

    def bushing(self, path: Path, before: Mapping[str, Bushing], refused: Collection[str]) -> Bushing:
        """The mount of this line.

        Args:
            path: of the table.
            before: the mounts of the lines above it, by name.
            refused: groups of lines above it that are wrong, of which it may have what it does not say.
        """
        name = self.required("name", "the mount's name")
        group = self.text("group") if "group" in self.columns else name
        twin = next((b for b in before.values() if group and b.group == group), None)
        stiffness, damping = self._rates(path, twin, refused)
        loss_factor = self.number("loss_factor", 0)
        if loss_factor is None:
            loss_factor = twin.loss_factor if twin else 0.0
        bounds = [self._along(which) for which in ("softest", "stiffest")]
        if twin and np.isnan(bounds).all():
            bounds = [twin.softest, twin.stiffest]
        bushing = Bushing(
            f"line {self.row.line}",
            name,
            (self._end("1", self._place("")), self._end("2", self._second_place())),
            group or None,
            stiffness,
            damping,
            loss_factor,
            *bounds,
            axes=self._axes(),
            elastic_center=self._elastic_center(),
            limits=self._limits(twin.limits if twin else GroupLimits()),
        )
        self._check_same(bushing, before)
        self._check_bounds(bushing)
        return bushing

    def _limits(self, groups: GroupLimits) -> GroupLimits:
        """Travel and ratios of a line, or else what the first of its group has."""
        travel = np.array([self._along(which, -np.inf) for which in TRAVEL])
        for axis, low, high in zip(AXES, *travel.tolist(), strict=True):
            least, most = (self._column(which, axis) for which in TRAVEL)
            check_travel(self, (least, most), (low, high))
        static_ratio, ratios, others = read_static_ratio(self), read_ratios(self), read_others(self)
        return GroupLimits(
            groups.travel if np.isnan(travel).all() else travel,
            groups.static_ratio if np.isnan(static_ratio) else static_ratio,
            groups.ratios if np.isnan(ratios).all() else ratios,
            groups.others if np.isnan(others).all() else others,
        )

    def _check_same(self, bushing: Bushing, before: Mapping[str, Bushing]) -> None:
        """Raises VehicleError unless a mount is the same part as the mounts of its group above it."""
        group = bushing.group
        lot = (b for b in before.values() if group and b.group == group and b.stiffness[:3].any())
        first = next(lot, None)
        if first is None or not bushing.stiffness[:3].any():
            return
        if found := difference(bushing, first):
            name, _, expected = found
            prefix, _, axis = name.rpartition("_")
            name = self._column(prefix, axis) if axis in AXES else name
            words = "nothing" if np.isnan(expected) else self._written(name, expected)
            raise VehicleError(
                f"{self.where(name)}: found {self.text(name) or 'nothing'}, expected {words} as "
                f"{quoted(first.name)} has it in {first.where}: mounts of a group, here "
                f"{quoted(group)}, are the same part"
            )

    def _check_bounds(self, bushing: Bushing) -> None:
        """Raises VehicleError for a bound that is given here and on the wrong side of the other."""
        for axis, low, high in zip(AXES, *bushing.bounds, strict=True):
            softest, stiffest = (self._column(which, axis) for which in ("softest", "stiffest"))
            if low < high or low == high == bushing.stiffness[AXES.index(axis)]:
                continue
            if self.text(softest):
                words = f"less than the stiffest, {self._written(softest, high)}"
                raise VehicleError(
                    f"{self.where(softest)}: found {self.text(softest)}, expected {words}"
                )
            if self.text(stiffest):
                words = f"more than the softest, {self._written(stiffest, low)}"
                raise VehicleError(
                    f"{self.where(stiffest)}: found {self.text(stiffest)}, expected {words}"
                )

    def _written(self, name: str, value: float) -> str:
        """A value in the unit of its column."""
        one = self.factor(self.columns[name]) if name in self.columns else None
        return f"{value / (one or 1.0):.6g}"

    def _column(self, prefix: str, axis: str) -> str:
        """What the column along a local axis is called in this table."""
        direction = next(d for d in NAMED if self.reading.named[d] == axis)
        plain, named = f"{prefix}_{axis}", f"{prefix}_{direction}"
        return named if named in self.columns and not self.text(plain) else plain

    def _elastic_center(self) -> float:
        value = self.number("elastic_center", 0)
        if value is not None and value > 1:
            raise VehicleError(
                f"{self.where('elastic_center')}: found {value:g}, expected 0 (at the first end) to 1"
            )
        return 0.5 if value is None else value

    def _rates(self, path: Path, twin: Bushing | None, refused: Collection[str]) -> SixRates:
        """Stiffness and damping of a line, or else of the first of its group."""
        stiffness, damping = self._directed("k", RATES, 0.0), self.numbers(DAMPINGS, 0)
        is_said = stiffness is not None or damping is not None
        if file := self.text("property"):
            if is_said:
                raise VehicleError(f"{self.where('property')}: found rates beside it, expected either")
            with located(self.where("property")):
                if self.reading.read_property is None:
                    raise VehicleError("found a property file, expected its rates in k_x, k_y and k_z")
                return self.reading.read_property(inside(path.parent, file, "the folder of the table"))
        if twin and not is_said:
            return twin.stiffness, twin.damping
        if not is_said and self.text("group") not in refused:
            raise VehicleError(
                f"{self.row.where(self.columns['name'].header)}: {quoted(self.text('name'))} has no "
                "rates; expected numbers in k_x, k_y, k_z or others"
            )
        zeros = np.zeros(6)
        return (zeros if stiffness is None else stiffness), (zeros if damping is None else damping)

    def _directed(
        self, prefix: str, names: tuple[str, ...], empty: float, at_least: float = 0
    ) -> Floats | None:
        """Values along the local axes, of which some columns are called by directions."""
        values = self.numbers(names, at_least, empty)
        for direction in NAMED:
            value = self.number(f"{prefix}_{direction}", at_least)
            if value is None:
                continue
            axis = self.reading.named[direction]
            if self.text(f"{prefix}_{axis}"):
                raise VehicleError(
                    f"{self.where(f'{prefix}_{direction}')}: found a value beside that of "
                    f"{self.columns[f'{prefix}_{axis}'].header}, which is the same direction"
                )
            values = np.full(len(names), empty) if values is None else values
            values[AXES.index(axis)] = value
        return values

    def _along(self, which: str, at_least: float = 0) -> Floats:
        """Bounds along x, y, z, (3,), such as the softest rates; not numbers where there are none."""
        names = tuple(f"{which}_{axis}" for axis in AXES)
        found = self._directed(which, names, np.nan, at_least)
        return np.full(3, np.nan) if found is None else found

    def _place(self, suffix: str) -> Floats | None:
        """A place of which all coordinates are there, or none; raises VehicleError if some are."""
        names = tuple(f"{axis}{suffix}" for axis in AXES)
        return self.near_place(names) if self.reading.is_own else self.place(names)

    def _second_place(self) -> Floats | None:
        """That of the second end, the first one's unless it is given."""
        place = self._place("_2")
        return self._place("") if place is None else place

    def _end(self, side: str, place: Floats | None) -> End:
        body, attachment = self.text(f"body_{side}"), self.text(f"attachment_{side}")
        if self.reading.bodies is not None:
            self._check_own(side, body, place)
        column = f"attachment_{side}" if attachment and not body else f"body_{side}"
        return End(self.where(column), body, attachment, place)

    def _check_own(self, side: str, body: str, place: Floats | None) -> None:
        """Raises VehicleError unless an end says which body of the vehicle it is on, and where."""
        bodies = (*(self.reading.bodies or ()), GROUND)
        if not body:
            raise VehicleError(f"{self.where(f'body_{side}')}: empty, expected one of {listed(bodies)}")
        if body not in bodies:
            raise VehicleError(f"{self.where(f'body_{side}')}: {unknown('body', body, bodies)}")
        if side == "2" and body == self.text("body_1"):
            raise VehicleError(f"{self.where('body_2')}: joins {quoted(body)} to itself")
        if place is None:
            raise VehicleError(f"{self.where('x')}: empty, expected a place in x, y, z")

    def _axes(self) -> Floats:
        vectors = {
            axis: self.numbers(names)
            for axis in AXES
            if any(map(self.text, names := tuple(f"{axis}_axis_{c}" for c in AXES)))
        }
        angles = self.numbers(ANGLES)
        if vectors and angles is not None:
            raise VehicleError(
                f"line {self.row.line}: found vectors and angles of its axes, expected one"
            )
        if angles is not None:
            return axes_of_angles(angles, self._order(angles))
        if not vectors:
            return np.eye(3)
        with located(f"line {self.row.line}, columns {', '.join(f'{a}_axis' for a in vectors)}"):
            return axes_of_vectors({a: v for a, v in vectors.items() if v is not None})

    def _order(self, angles: Floats) -> TurnOrder:
        """In which order the angles of a line turn its axes; of a single one it does not matter.

        Raises:
            VehicleError: it is not said where it matters.
        """
        if text := self.text("angle_order"):
            with located(self.where("angle_order")):
                return TurnOrder.of(text)
        given = [name for name, angle in zip(ANGLES, angles, strict=True) if angle]
        if len(given) > 1 and not all(has_known_order(self.columns[name]) for name in given):
            raise VehicleError(
                f"{self.where('angle_order')}: empty, expected the order of the angles, such as "
                "'xyz fixed', about axes that stay, or 'zyx turned', about those turned before"
            )
        return TurnOrder()
