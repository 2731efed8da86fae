"""What panels draw in the charts, made of an answer: responses to the road or to a wheel load.

With every set that is drawn.
"""

from collections.abc import Callable
from dataclasses import dataclass

from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.wheel_peaks import wheel_peak_lines, wheel_peaks
from modeviz.analysis.wheel_results import WheelResults
from modeviz.errors import cut
from modeviz.report.tables import wheel_band
from modeviz.ride.participation import Peak
from modeviz.ride.psd import amplitude_decibels, power_decibels
from modeviz.text.wording import sentence_case
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.state import ResponseCurve
from modeviz.viewer.session.wheel_responses import NOW

LONGEST_POINT = 26
"""Letters of a point's name that leave its box room for the direction."""


@dataclass(frozen=True)
class LevelUnit:
    """The unit of what is drawn."""

    unit: str
    decibels: Callable[[Floats], Floats]
    bels_per_decade: int
    """How many times ten decibels a power of ten of it is."""

    def unit_text(self, in_decibels: bool) -> str:
        return f"dB re 1 {self.unit}" if in_decibels else self.unit


PSD = LevelUnit("g²/Hz", power_decibels, 1)
PEAK_ACCELERATION = LevelUnit("g", amplitude_decibels, 2)


class Responses:
    """The responses that an answer has to what excites the vehicle."""

    def __init__(self, solved: Solved) -> None:
        """Looks at an answer."""
        self._solved = solved
        self._load = load_number(solved.now.prepared.vehicle, solved.state.charts.load)
        self.quantity: LevelUnit = PSD if self._load is None else PEAK_ACCELERATION

    @property
    def overlaid(self) -> list[str]:
        """The sets drawn beside the one compared with, in the order of all sets."""
        state = self._solved.state
        return [
            n for n in self._solved.named.results if n in state.charts.overlaid and n != state.against
        ]

    def of(self, name: str, curve: ResponseCurve) -> Floats:
        """The response with a set's rates, or `NOW`, (n_freqs,), in the unit of `quantity`."""
        if self._load is None:
            return self._results(name).response(curve.point, curve.direction)
        g = self._solved.wheels[name].acceleration_g
        return g[:, self._load, curve.point, AXIS[curve.direction]]

    def lines(self, name: str) -> Floats:
        """The frequencies of that, (n_freqs,)."""
        if self._load is None:
            return self._results(name).frequency_hz
        return self._solved.wheels[name].frequency_hz

    def figure(self, name: str, curve: ResponseCurve) -> float:
        """The RMS on the road, or the mean over the paper's band under a wheel load, g."""
        at = curve.point, AXIS[curve.direction]
        if self._load is None:
            return float(self._results(name).rms[at])
        band = wheel_band(self._solved.now.prepared.vehicle)
        return float(self._solved.wheels[name].mean(band)[self._load][at])

    def peak_lines(self, curve: ResponseCurve) -> list[int]:
        """Return the lines at which the present response has its peaks, numbers of frequencies."""
        if self._load is None:
            return self._solved.now.peak_lines(curve.point, curve.direction)
        return wheel_peak_lines(self._wheels, self._load, curve.point, curve.direction)

    def peaks(self, curve: ResponseCurve, count: int, lines: list[int]) -> tuple[Peak, ...]:
        """Those peaks of the present response with the `count` modes that make most of each."""
        now = self._solved.now
        if self._load is None:
            return now.peaks(curve.point, curve.direction, count, lines)
        return wheel_peaks(now, self._wheels, self._load, curve.point, curve.direction, count, lines)

    @property
    def _wheels(self) -> WheelResults:
        return self._solved.wheels[NOW]

    def _results(self, name: str) -> Results:
        return self._solved.now if name == NOW else self._solved.named.results[name]


def load_number(vehicle: Vehicle, name: str) -> int | None:
    """The number of the harmonic load of that name; None for the road."""
    return next((i for i, load in enumerate(vehicle.harmonic_loads) if load.name == name), None)


def curve_label(vehicle: Vehicle, curve: ResponseCurve) -> str:
    """A response as people call it: "Seat track left, lateral".

    Long names of points are cut in their midst, if they still differ.
    """
    names = [point.name for point in vehicle.response_points]
    short = [cut(name, LONGEST_POINT) for name in names]
    name = short[curve.point] if len(set(short)) == len(short) else names[curve.point]
    return f"{sentence_case(name)}, {curve.direction}"
