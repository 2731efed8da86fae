"""What a running engine does to a study's vehicle."""

from dataclasses import dataclass

from modeviz.analysis.engine_results import EngineResults, solve_engine
from modeviz.analysis.results import AXIS
from modeviz.errors import VehicleError, unknown
from modeviz.report.engine import (
    engine_record,
    engine_table,
    force_columns,
    force_rows,
    order_rows,
    speed_rows,
)
from modeviz.report.records import Record
from modeviz.study.conditions import need
from modeviz.study.displayed import Displayed
from modeviz.study.names import axis_of, number_of, point_number
from modeviz.study.notebook import block
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.text.markup import table, title
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False, repr=False)
class EngineRide(Displayed):
    """Accelerations and forces of mounts while an engine runs at one speed after the other.

    engine = study.engine()
    engine.idle_rms("seat track left", "vertical")
    engine.speed_rpm, engine.acceleration(2, "seat track left", "vertical")
    engine.force(2, "engine mount", "z"), engine.force_rms("engine mount", "z")
    """

    vehicle: Vehicle
    """With the present rates."""
    results: EngineResults
    """As the functions of `analysis` take it."""

    @property
    def speed_rpm(self) -> Floats:
        """(n_speeds,), rising."""
        return 60 * self.results.speed_hz

    @property
    def orders(self) -> tuple[float, ...]:
        """The engine's orders, rising."""
        return tuple(order.order for order in self.results.engine.orders)

    def acceleration(self, order: float, point: str, direction: str) -> Floats:
        """Return the peak acceleration at each speed, (n_speeds,), g; nan beyond the vehicle's band.

        Args:
            order: one of `orders`.
            point: name of a response point.
            direction: "vertical", "lateral" or "fore-aft".

        Raises:
            VehicleError: there is no such order, point or direction.
        """
        place = point_number(self.vehicle, point), axis_of(direction)
        return self.results.acceleration_g[:, self._number(order), *place]

    def force(self, order: float, mount: str, motion: str, in_vehicle_axes: bool = False) -> Complexes:
        """Return amplitude and phase of a mount's force at each speed, (n_speeds,), N or N m, complex.

        On the body that carries the mount, the phase to the engine's crank; nan beyond the band.

        Args:
            order: one of `orders`.
            mount: its name.
            motion: "x", "y", "z", or "rx", "ry", "rz" of its moment.
            in_vehicle_axes: along or about the vehicle's axes, else the mount's own.

        Raises:
            VehicleError: there is no such order, mount or motion.
        """
        results = self.results
        every = results.force_in_vehicle_axes if in_vehicle_axes else results.force
        return every[:, self._number(order), *self._place(mount, motion)]

    def force_rms(self, mount: str, motion: str) -> Floats:
        """Return the RMS over time of a force under all orders in the band, (n_speeds,), N or N m.

        Args:
            mount: its name.
            motion: one of its own axes, as of `force`.

        Raises:
            VehicleError: there is no such mount or motion.
        """
        return self.results.force_rms[:, *self._place(mount, motion)]

    def rms(self, point: str, direction: str) -> Floats:
        """Return the RMS over time of all orders in the band at each speed, (n_speeds,), g.

        Args:
            point: as of `acceleration`, as are the direction and what is raised.
            direction: likewise.

        Raises:
            VehicleError: as `acceleration`.
        """
        return self.results.rms[:, point_number(self.vehicle, point), axis_of(direction)]

    def idle_rms(self, point: str, direction: str) -> float:
        """Return `rms` at idle, g; raises as it does."""
        return float(self.rms(point, direction)[self.results.idle])

    def table(self) -> str:
        """Return peaks of the orders at idle and the RMS over speed."""
        return engine_table(self.vehicle, self.results)

    def to_dict(self) -> Record:
        """Return what `modeviz engine --json` prints, see `report.engine.engine_record`."""
        return engine_record(self.vehicle, self.results)

    def _number(self, order: float) -> int:
        if order not in self.orders:
            raise VehicleError(unknown("order", f"{order:g}", [f"{o:g}" for o in self.orders]))
        return self.orders.index(order)

    def _place(self, mount: str, motion: str) -> tuple[int, int]:
        names = (each.name for each in self.vehicle.mounts)
        return number_of("mount", mount, names), number_of("motion", motion, MOTIONS)

    def _repr_html_(self) -> str:
        results, places = (
            self.results,
            [f"{p.name} {d}" for p in self.vehicle.response_points for d in AXIS],
        )
        idle = f"Idle, {60 * results.speed_hz[results.idle]:.4g} rpm: peak, 0.001 g"
        parts = []
        if places:
            parts = [
                table([idle, "Hz", *map(title, places)], order_rows(results)),
                table(["rpm: RMS of all orders, 0.001 g", *map(title, places)], speed_rows(results)),
            ]
        forces = table(["RMS of all orders at idle, N", *force_columns()], force_rows(results))
        return block(f"{self.vehicle.name} while {results.engine.name} runs", *parts, forces)


def engine_ride(tuned: TunedVehicle, name: str | None) -> EngineRide:
    """Return what an engine does to a vehicle; arguments and errors as of `Study.engine`."""
    vehicle, rates = tuned.vehicle, tuned.rates.by_group
    need(vehicle, "engine", vehicle.engines)
    need(vehicle, "response point", (*vehicle.response_points, *vehicle.mounts))
    engine = vehicle.engines[0] if name is None else vehicle.engine(name)
    return EngineRide(vehicle.with_rates(rates), solve_engine(tuned.prepared(), rates, engine))
