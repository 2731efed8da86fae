"""The ride of a study's vehicle on a road."""

from dataclasses import dataclass

from modeviz.analysis.deflection_shapes import road_shape
from modeviz.analysis.exact_check import Check, checked
from modeviz.analysis.results import AXIS, Results
from modeviz.report.coverage import band_text, coverage_note
from modeviz.report.records import Record, psd_record
from modeviz.report.tables import psd_table
from modeviz.ride.psd import power_decibels
from modeviz.ride.psd import rms as rms_within
from modeviz.ride.rating import Rating
from modeviz.study.displayed import Displayed
from modeviz.study.names import axis_of, point_number
from modeviz.study.notebook import block, charts, paragraphs, spectrum
from modeviz.study.peaks import ResponsePeak, named_peaks, peaks_table
from modeviz.text.markup import table, title
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS


@dataclass(frozen=True, eq=False, repr=False)
class Ride(Displayed):
    """Accelerations of a vehicle on a road, or under another random load.

    ride = study.ride("road 1")
    ride.rms("seat track left", "lateral")
    ride.peaks("seat track left", "lateral")[0].parts
    ride.rating.mean_personal_rating
    """

    results: Results
    """As the functions of `analysis` take it."""

    @property
    def road(self) -> str:
        """Its name."""
        return self.results.conditions.road

    @property
    def speed(self) -> float:
        """m/s."""
        return self.results.conditions.speed

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the response points, the driver's first."""
        return tuple(point.name for point in self.results.vehicle.response_points)

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): where responses are given, closer where modes are sharp."""
        return self.results.frequency_hz

    @property
    def rating(self) -> Rating:
        """How the ride feels at the driver's point."""
        return self.results.rating

    def psd(self, point: str, direction: str) -> Floats:
        """Return the PSD of an acceleration, (n_freqs,), g²/Hz, one-sided.

        Args:
            point: name of a response point.
            direction: "vertical", "lateral" or "fore-aft".

        Raises:
            VehicleError: there is no such point or direction.
        """
        number, axis = self._place(point, direction)
        return self.results.psd[:, number, axis]

    def rms(self, point: str, direction: str, band_hz: tuple[float, float] | None = None) -> float:
        """Return an RMS acceleration, g.

        Args:
            point: as of `psd`, as is the direction.
            direction: likewise.
            band_hz: from where to where, Hz; None: the vehicle's band, as far as the road is known.

        Raises:
            VehicleError: as `psd`.
        """
        if band_hz is not None:
            return float(rms_within(self.frequency_hz, self.psd(point, direction), band_hz))
        return float(self.results.rms[self._place(point, direction)])

    def peaks(self, point: str, direction: str, count: int = 3) -> tuple[ResponsePeak, ...]:
        """Return the peaks of a spectrum, rising in frequency, each with its largest modes.

        Args:
            point: as of `psd`, as is the direction.
            direction: likewise.
            count: how many modes to name.

        Raises:
            VehicleError: as `psd`.
        """
        number, _ = self._place(point, direction)
        return named_peaks(self.results, self.results.peaks(number, direction, count))

    def shape(self, frequency_hz: float, point: str, direction: str) -> Complexes:
        """Return how the whole vehicle moves at one frequency, as seen from a response point.

        (n_dofs,), m/√Hz, real at the point, see `analysis.deflection_shapes.road_shape`.

        Raises:
            VehicleError: as `psd`.
            SolveError: the frequency is out of the band, or the point does not move there.
        """
        return road_shape(self.results, frequency_hz, self._place(point, direction)[0], direction)

    def check(self) -> Check:
        """Return how far the answer is from that of the full model, solved from scratch."""
        return checked(self.results)

    def table(self) -> str:
        """Return RMS values, the rating, and the peaks at the driver's point with their modes."""
        return psd_table(self.results)

    def to_dict(self) -> Record:
        """Return what `modeviz psd --json` prints, see `report.records.psd_record`."""
        return psd_record(self.results)

    def _repr_html_(self) -> str:
        results, driver = self.results, self.points[0]
        header = [f"RMS, g, {band_text(results)}", *map(str.capitalize, AXIS)]
        rows = [
            [title(point), *(f"{self.rms(point, direction):.4f}" for direction in AXIS)]
            for point in self.points
        ]
        drawn = (
            spectrum(
                self.frequency_hz,
                power_decibels(self.psd(driver, direction)),
                results.peak_lines(0, direction),
                results.vehicle.highest_frequency,
                "dB re 1 g²/Hz",
                f"{direction.capitalize()} acceleration at {driver}",
            )
            for direction in RIDE_DIRECTIONS
        )
        rating = self.rating
        about = (
            f"{self.road}, {3.6 * self.speed:.4g} km/h",
            f"Mean personal rating {rating.mean_personal_rating:.2f} of 10; ISO 2631-1 total "
            f"{rating.weighted_total:.3f} m/s²",
        )
        return block(
            f"Ride of {results.vehicle.name}",
            paragraphs(*about, rating.note, coverage_note(results)),
            table(header, rows),
            charts(drawn),
            peaks_table(
                {d: self.peaks(driver, d) for d in RIDE_DIRECTIONS}, power_decibels, "dB re 1 g²/Hz"
            ),
        )

    def _place(self, point: str, direction: str) -> tuple[int, int]:
        return point_number(self.results.vehicle, point), axis_of(direction)
