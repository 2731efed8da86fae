"""What wheel loads and other harmonic loads do to a study's vehicle."""

from dataclasses import dataclass

import numpy as np

from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.wheel_peaks import wheel_peak_lines, wheel_peaks
from modeviz.analysis.wheel_results import WheelResults, solve_wheels
from modeviz.errors import ModevizError
from modeviz.report.records import Record, wheels_record
from modeviz.report.tables import wheel_band, wheels_table
from modeviz.ride.psd import amplitude_decibels
from modeviz.study.conditions import has_ride, need
from modeviz.study.displayed import Displayed
from modeviz.study.names import axis_of, number_of, point_number
from modeviz.study.notebook import block, charts, paragraphs, spectrum
from modeviz.study.peaks import ResponsePeak, named_peaks
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.text.markup import table, title
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False, repr=False)
class WheelRide(Displayed):
    """Peak accelerations of a vehicle under each of its wheel loads and other harmonic loads.

    wheels = study.wheels()
    wheels.mean("rear left radial force", "seat track left", "lateral", band_hz=(11, 16))
    """

    vehicle: Vehicle
    """With the present rates."""
    results: WheelResults
    """As the functions of `analysis` take it."""
    ride: Results | None
    """The modes with the same rates, which make the peaks; None for a vehicle that has no road."""

    @property
    def loads(self) -> tuple[str, ...]:
        """Their names."""
        return tuple(load.name for load in self.vehicle.harmonic_loads)

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the response points, the driver's first."""
        return tuple(point.name for point in self.vehicle.response_points)

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): a wheel's revolutions per second, closer where modes are sharp."""
        return self.results.frequency_hz

    def acceleration(self, load: str, point: str, direction: str) -> Floats:
        """Return the peak acceleration at each frequency, (n_freqs,), g.

        Args:
            load: name of a wheel load, force or motion of the ground.
            point: name of a response point.
            direction: "vertical", "lateral" or "fore-aft".

        Raises:
            VehicleError: there is no such load, point or direction.
        """
        return self.results.acceleration_g[:, *self._place(load, point, direction)]

    def mean(
        self, load: str, point: str, direction: str, band_hz: tuple[float, float] | None = None
    ) -> float:
        """Return the mean peak acceleration, g.

        Args:
            load: as of `acceleration`, as are the point and the direction.
            point: likewise.
            direction: likewise.
            band_hz: from where to where, Hz; None: that of the paper's tables, 11 to 16 Hz, or the
                whole band of a vehicle whose band ends below.

        Raises:
            VehicleError: as `acceleration`.
        """
        band = band_hz or wheel_band(self.vehicle)
        return float(self.results.mean(band)[self._place(load, point, direction)])

    def peaks(self, load: str, point: str, direction: str, count: int = 3) -> tuple[ResponsePeak, ...]:
        """Return the peaks under a load, rising in frequency, each with its largest modes.

        Args:
            load: as of `acceleration`, as are the point and the direction.
            point: likewise.
            direction: likewise.
            count: how many modes to name.

        Raises:
            VehicleError: as `acceleration`.
            ModevizError: the vehicle has no road: modes are told by its ride.
        """
        number, at, _ = self._place(load, point, direction)
        if self.ride is None:
            raise ModevizError(
                f"vehicle {self.vehicle.name!r} has no road, by whose ride the modes in a peak are "
                "told: give its vehicle.toml a [[road]]"
            )
        return named_peaks(
            self.ride, wheel_peaks(self.ride, self.results, number, at, direction, count)
        )

    def table(self) -> str:
        """Return mean and highest peak accelerations at every point for each load."""
        return wheels_table(self.vehicle, self.results)

    def to_dict(self) -> Record:
        """Return what `modeviz wheels --json` prints, see `report.records.wheels_record`."""
        return wheels_record(self.vehicle, self.results)

    def _repr_html_(self) -> str:
        low, high = wheel_band(self.vehicle)
        means = 1000 * self.results.mean((low, high))
        axes = list(AXIS.values())
        rows = [
            [title(load), *(f"{value:.2f}" for value in means[i][:, axes].ravel())]
            for i, load in enumerate(self.loads)
        ]
        header = ["", *(d for _ in self.points for d in map(str.capitalize, AXIS))]
        groups = [("", 1), *((title(point), len(AXIS)) for point in self.points)]
        return block(
            f"{self.vehicle.name} under its wheel loads",
            paragraphs(f"Mean peak acceleration from {low:g} to {high:g} Hz, 0.001 g"),
            table(header, rows, groups),
            charts(self._chart(direction) for direction in RIDE_DIRECTIONS),
        )

    def _chart(self, direction: str) -> str:
        """The driver's acceleration under the load that shakes him most."""
        largest = self.results.acceleration_g[:, :, 0, axis_of(direction)].max(axis=0)
        load = int(np.argmax(largest))
        name, driver = self.loads[load], self.points[0]
        return spectrum(
            self.frequency_hz,
            amplitude_decibels(self.acceleration(name, driver, direction)),
            wheel_peak_lines(self.results, load, 0, direction),
            self.vehicle.highest_frequency,
            "dB re 1 g, peak",
            f"{direction.capitalize()} acceleration at {driver}, {name}",
        )

    def _place(self, load: str, point: str, direction: str) -> tuple[int, int, int]:
        return (
            number_of("harmonic load", load, self.loads),
            point_number(self.vehicle, point),
            axis_of(direction),
        )


def wheel_ride(tuned: TunedVehicle) -> WheelRide:
    """Return the response of a vehicle to its harmonic loads; errors as of `Study.wheels`."""
    vehicle, rates = tuned.vehicle, tuned.rates.by_group
    need(vehicle, "response point", vehicle.response_points)
    need(vehicle, "wheel load", vehicle.harmonic_loads)
    results = solve_wheels(tuned.prepared(), rates)
    ride = tuned.ride(None) if has_ride(vehicle) else None
    return WheelRide(vehicle.with_rates(rates), results, ride)
