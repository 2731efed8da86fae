"""A vehicle with the rates and the speed that a study has at the moment, made ready once."""

from functools import partial

from modeviz.analysis.preparation import Prepared, PreparedModes, prepare, prepare_modes
from modeviz.analysis.results import Conditions, Results, solve
from modeviz.dynamics.assembly import assemble
from modeviz.errors import ModevizError, located, of_file
from modeviz.mounting.static_system import PreparedStatics, prepare_statics
from modeviz.study.conditions import has_ride, on_even_road, road_conditions
from modeviz.study.rates import StudyRates
from modeviz.study.telling import Tell
from modeviz.units import parse
from modeviz.vehicle.vehicle import Vehicle


class TunedVehicle:
    """A vehicle, its present rates and speed; nothing is prepared before it is asked for."""

    def __init__(self, vehicle: Vehicle, tell: Tell) -> None:
        """Begins with the vehicle's own rates and speed; `tell` is told how far a preparation is."""
        self.vehicle: Vehicle = vehicle
        self.rates: StudyRates = StudyRates(vehicle)
        self._tell = tell
        self._speed = vehicle.speed
        self._prepared: PreparedModes | None = None
        self._statics: PreparedStatics | None = None

    @property
    def speed(self) -> float:
        """On the roads, m/s; set to a number, or to a text with its unit."""
        return self._speed

    @speed.setter
    def speed(self, value: float | str) -> None:
        with located("speed"):
            speed = parse(value, "speed") if isinstance(value, str) else float(value)
            if not 0 < speed < float("inf"):
                raise ModevizError(f"found {value}, expected a finite speed above zero")
        self._speed = speed

    def band_end(self, what: str, given: float | None) -> float:
        """Return to where modes are asked for, Hz.

        Args:
            what: the frequency is called.
            given: itself; None: the end of the vehicle's band.

        Raises:
            ModevizError: it is not above zero.
        """
        found = self.vehicle.highest_frequency if given is None else given
        if not 0 < found < float("inf"):
            raise ModevizError(f"{what}: found {found:g}, expected a frequency above zero")
        return found

    def prepared_modes(self, below_hz: float = 0.0) -> PreparedModes:
        """Return it made ready for modes at least, those of its band or below a higher frequency."""
        if below_hz > self.vehicle.highest_frequency:
            return prepare_modes(self.vehicle, below_hz)
        if self._prepared is None:
            self._prepared = prepare_modes(self.vehicle)
        return self._prepared

    def prepared(self) -> Prepared:
        """Return it made ready for modes and responses."""
        if not isinstance(self._prepared, Prepared):
            self._prepared = prepare(self.vehicle, progress=partial(self._tell, "preparing"))
        return self._prepared

    def statics(self) -> PreparedStatics:
        """Return it made ready for its load cases; raises as `prepare_statics`."""
        if self._statics is None:
            with of_file(self.vehicle.file):
                self._statics = prepare_statics(assemble(self.vehicle))
        return self._statics

    def ride(self, road: str | None) -> Results:
        """Return the answer on a road; arguments and errors as `road_conditions`."""
        conditions = road_conditions(self.vehicle, road, self._speed)
        return solve(self.prepared(), self.rates.by_group, conditions)

    def conditions(self, road: str | None) -> Conditions | None:
        """Return the road asked for, or the vehicle's; None if it has none and none is asked for."""
        if road is None and not has_ride(self.vehicle):
            return None
        return road_conditions(self.vehicle, road, self._speed)

    def shown(self, road: str | None) -> tuple[Vehicle, Conditions]:
        """Return a vehicle that can be shown, and what it drives over."""
        conditions = self.conditions(road)
        return on_even_road(self.vehicle) if conditions is None else (self.vehicle, conditions)

    def described(self) -> list[str]:
        """Return what there is to ask for, a line for each kind."""
        vehicle, rates = self.vehicle, self.rates
        groups = ", ".join(group.name for group in vehicle.mount_groups)
        lines = [
            f"bodies: {', '.join(body.name for body in vehicle.bodies)}",
            f"mount groups: {groups}; rates: {rates.name}, of {', '.join(rates.sets)}",
            f"response points: {', '.join(point.name for point in vehicle.response_points)}",
            f"roads: {', '.join(load.name for load in vehicle.random_loads)}; "
            f"speed: {3.6 * self._speed:.4g} km/h",
            f"problems: {', '.join(problem.name for problem in vehicle.problems)}",
            *(f"note: {note}" for note in vehicle.notes),
        ]
        return [line for line in lines if not line.endswith(": ")]
