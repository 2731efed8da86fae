"""The tables of `vehicle.toml` that say how an engine shakes the body it is part of, in SI."""

from typing import Annotated, ClassVar, Self

import numpy as np
from msgspec import Meta

from modeviz.errors import Fault, FaultsError, VehicleError, at_key, unknown
from modeviz.files.engine_tables import Orders, read_orders
from modeviz.files.records.fields import Direction, Length, Mass, Name, Position, Ratio, Torque
from modeviz.files.records.record import Record, tuples, vector_along
from modeviz.files.schema.quantities import UNITLESS, FixedUnit
from modeviz.files.source import Source
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.engine import Engine, EngineOrder, InlineEngine

CrankSpeed = Annotated[float, Meta(gt=0), FixedUnit("rpm")]
Count = Annotated[int, Meta(gt=0), UNITLESS]

STEP_RPM = 25.0
"""Between the speeds for which a formula is tabulated: less than 0.1 % off where it rises as ω²."""


class InlineRecord(Record, kw_only=True):
    """[engine.inline]: pistons in line, four-stroke, firing at even intervals, see `InlineEngine`."""

    cylinders: Count
    stroke: Length
    rod_ratio: Ratio
    """Of the crank's radius to the length of the rod."""
    reciprocating_mass: Mass
    """Of each cylinder."""
    firing_torque: Torque = 0.0
    """Peak, of the gas at the firing order."""
    cylinder_axis: Direction = "vertical"
    """From the crank along the cylinders."""
    lowest_speed: CrankSpeed
    """rpm."""
    highest_speed: CrankSpeed
    """rpm."""

    def build(self, crank: Floats) -> Orders:
        """Return the orders; raises VehicleError."""
        cylinder = _unit(vector_along(self.cylinder_axis))
        if abs(cylinder @ crank) > 1e-6:
            raise FaultsError(Fault("cylinder_axis", "expected one at a right angle to the crank's"))
        if not self.lowest_speed < self.highest_speed:
            raise FaultsError(Fault("highest_speed", "expected more than lowest_speed"))
        formula = InlineEngine(
            cylinders=self.cylinders,
            stroke=self.stroke,
            rod_ratio=self.rod_ratio,
            reciprocating_mass=self.reciprocating_mass,
            firing_torque=self.firing_torque,
        )
        n_steps = max(1, int(np.ceil((self.highest_speed - self.lowest_speed) / STEP_RPM)))
        speed_hz = np.linspace(self.lowest_speed, self.highest_speed, n_steps + 1) / 60
        loads = formula.loads(speed_hz, crank, cylinder)
        return {order: (speed_hz, load) for order, load in loads.items()}


class EngineRecord(Record, kw_only=True):
    """[[engine]]."""

    depending: ClassVar[frozenset[str]] = frozenset(("file", "inline"))

    name: Name
    body: str
    at: Position | None = None
    """Where its forces act; at the centre of gravity of a rigid body, if not given."""
    crank_axis: Direction | None = None
    """About which the crank turns, right-handed; the body's, if not given."""
    idle_speed: CrankSpeed | None = None
    """rpm; the lowest of its speeds, if not given."""
    file: str | None = None
    """A file of the folder, .csv, see `engine_tables`."""
    inline: InlineRecord | None = None

    @classmethod
    def of(cls, engine: Engine, file: str) -> Self:
        return cls(
            name=engine.name,
            body=engine.body,
            at=tuples(engine.position),
            idle_speed=60 * engine.idle_hz,
            file=file,
        )

    def build(self, source: Source, bodies: dict[str, Body]) -> Engine:
        """Return the engine of one of the bodies; raises VehicleError."""
        if (self.file is None) == (self.inline is None):
            found = "none" if self.file is None else "file and inline"
            raise VehicleError(f"found {found}, expected one of file, inline")
        if self.body not in bodies:
            raise FaultsError(Fault("body", unknown("body", self.body, bodies)))
        crank = self._crank(bodies[self.body])
        orders = self._orders(source, crank)
        speeds = np.unique(np.concatenate([speed for speed, _ in orders.values()]))
        return Engine(
            self.name,
            self.body,
            self._position(bodies[self.body]),
            speeds,
            self.idle_speed / 60 if self.idle_speed else float(speeds[0]),
            tuple(
                EngineOrder(f"{self.name} order {order:g}", self.name, order, order * speed, load)
                for order, (speed, load) in orders.items()
            ),
        )

    def _crank(self, body: Body) -> Floats | None:
        if self.crank_axis is not None:
            with at_key("crank_axis"):
                return _unit(vector_along(self.crank_axis))
        return body.crank_axis

    def _position(self, body: Body) -> Floats:
        if self.at is not None:
            return np.array(self.at)
        if isinstance(body, FlexibleBody):
            raise FaultsError(Fault("at", "missing, expected a place, as of every flexible body"))
        return body.center_of_gravity

    def _orders(self, source: Source, crank: Floats | None) -> Orders:
        if self.inline is not None:
            if crank is None:
                raise FaultsError(Fault("crank_axis", "missing, here and at the body"))
            with at_key("inline"):
                return self.inline.build(crank)
        assert self.file is not None
        with at_key("file"):
            path = source.path(self.file)
            return source.once(
                (path, "orders", None if crank is None else tuple(crank.tolist())),
                lambda: read_orders(path, crank, source.conventions, source.note),
            )


def _unit(direction: Floats) -> Floats:
    length = np.linalg.norm(direction)
    if not length:
        raise VehicleError("found three zeros, expected a direction")
    return direction / length
