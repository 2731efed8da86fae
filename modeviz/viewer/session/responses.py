"""What panels draw in the charts, made of an answer: responses to the road or to a wheel load.

With every set that is drawn.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.engine_results import EngineResults
from modeviz.analysis.force_peaks import force_participation
from modeviz.analysis.mount_forces import MountForces
from modeviz.analysis.results import AXIS, Results
from modeviz.analysis.wheel_peaks import wheel_peak_lines
from modeviz.errors import cut
from modeviz.report.tables import wheel_band
from modeviz.ride.excitation import Load, input_spectrum
from modeviz.ride.participation import Peak, peak_lines, peaks
from modeviz.ride.psd import amplitude_decibels, power_decibels
from modeviz.text.wording import sentence_case
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.loads import HarmonicLoad
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.state import ChartCurve, ForceCurve, ResponseCurve
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
FORCE_PSD, PEAK_FORCE = LevelUnit("N²/Hz", power_decibels, 1), LevelUnit("N", amplitude_decibels, 2)
MOMENT_PSD = LevelUnit("N²m²/Hz", power_decibels, 1)
PEAK_MOMENT = LevelUnit("N m", amplitude_decibels, 2)


class Responses:
    """The responses that an answer has to what excites the vehicle."""

    def __init__(self, solved: Solved) -> None:
        """Looks at an answer."""
        self._solved = solved
        self.quantity: LevelUnit = PEAK_ACCELERATION if solved.state.charts.load else PSD
        """Of accelerations."""

    @property
    def is_random(self) -> bool:
        """Whether what excites has a spectrum."""
        return self.quantity is PSD

    @property
    def overlaid(self) -> list[str]:
        """The sets drawn beside the one compared with, in the order of all sets."""
        state = self._solved.state
        return [
            n for n in self._solved.named.results if n in state.charts.overlaid and n != state.against
        ]

    @property
    def harmonic_load(self) -> HarmonicLoad | None:
        """The load whose response is drawn; None: the road's."""
        name = self._solved.state.charts.load
        return self._solved.now.prepared.vehicle.harmonic_load(name) if name else None

    def quantity_of(self, curve: ChartCurve) -> LevelUnit:
        """The unit of a curve."""
        if not self.is_random:
            return peak_unit(curve)
        if isinstance(curve, ResponseCurve):
            return PSD
        return FORCE_PSD if curve.motion in MOTIONS[:3] else MOMENT_PSD

    def of(self, name: str, curve: ChartCurve) -> Floats:
        """The response with a set's rates, or `NOW`, (n_freqs,), in the unit of `quantity_of`.

        No numbers where the set is without the mount.
        """
        if isinstance(curve, ForceCurve):
            vehicle = self._results(name).prepared.vehicle
            if not has_mount(vehicle, curve.mount):
                return np.full(len(self.lines(name)), np.nan)
            mount = mount_number(vehicle, curve.mount)
            return self.mount_forces(name).level(mount, curve.motion, curve.in_vehicle_axes)
        if self.is_random:
            return self._results(name).response(curve.point, curve.direction)
        return self._solved.wheels[name].acceleration_g[:, 0, curve.point, AXIS[curve.direction]]

    def power(self, name: str, curve: ChartCurve) -> Floats:
        """The same as a PSD, or squared where it is an amplitude."""
        level = self.of(name, curve)
        return level if self.is_random else np.square(level)

    def mount_forces(self, name: str) -> MountForces:
        """The forces of mounts with a set's rates, or `NOW`, under what excites the vehicle."""
        return self._results(name).mount_forces(self.harmonic_load)

    def lines(self, name: str) -> Floats:
        """The frequencies of all that, (n_freqs,)."""
        if self.is_random:
            return self._results(name).frequency_hz
        return self._solved.wheels[name].frequency_hz

    def figure(self, name: str, curve: ResponseCurve) -> float:
        """The RMS on the road, of an engine's orders at idle, or the mean under a wheel load, g."""
        at = curve.point, AXIS[curve.direction]
        if self.is_random:
            return float(self._results(name).rms[at])
        running = self.running(name)
        if running is not None:
            return float(running.rms[running.idle][at])
        band = wheel_band(self._solved.now.prepared.vehicle)
        return float(self._solved.wheels[name].mean(band)[0][at])

    def running(self, name: str) -> EngineResults | None:
        """What the engine whose order is drawn does as it runs up; None under another load."""
        order = self.harmonic_load
        if not isinstance(order, EngineOrder):
            return None
        results = self._results(name)
        return results.running(results.prepared.vehicle.engine(order.engine))

    def run_up(self, name: str) -> EngineResults:
        """What the engine that is looked at does as it runs up, with a set's rates, or `NOW`."""
        results = self._results(name)
        return results.running(results.prepared.vehicle.engine(self._solved.state.engine.engine))

    def peak_lines(self, curve: ChartCurve) -> list[int]:
        """Return the lines at which the present response has its peaks, numbers of frequencies."""
        if isinstance(curve, ForceCurve):
            return peak_lines(self.power(NOW, curve))
        if self.is_random:
            return self._solved.now.peak_lines(curve.point, curve.direction)
        return wheel_peak_lines(self._solved.wheels[NOW], 0, curve.point, curve.direction)

    def peaks(
        self, curve: ChartCurve, count: int, lines: list[int], others_hz: Sequence[float] = ()
    ) -> tuple[Peak, ...]:
        """Those peaks of the present response with the `count` modes that make most of each.

        Args:
            curve: the response.
            count: how many modes to name.
            lines: numbers of frequencies.
            others_hz: other frequencies that are told of likewise, after them.

        Raises:
            ModevizError: what excites the vehicle is not known at one of these.
        """
        every = self.lines(NOW)
        f = np.concatenate([every[lines], np.asarray(others_hz, float)])
        level = np.interp(f, every, self.of(NOW, curve))
        return peaks(f, level, self._participations(curve, f), count)

    def _participations(self, curve: ChartCurve, frequency_hz: Floats) -> Floats:
        """The parts of modes in the present response, (n_freqs, n_parts)."""
        now, load = self._solved.now, self._shaking
        if isinstance(curve, ResponseCurve):
            S = input_spectrum(load, frequency_hz, now.conditions.speed)
            row = now.prepared.outputs[3 * curve.point + AXIS[curve.direction]]
            return now.participation(row, load, frequency_hz, S)
        mount = mount_number(now.prepared.vehicle, curve.mount)
        return force_participation(now, load, frequency_hz, mount, curve.motion, curve.in_vehicle_axes)

    @property
    def _shaking(self) -> Load:
        return self.harmonic_load or self._solved.now.drive.load

    def _results(self, name: str) -> Results:
        return self._solved.now if name == NOW else self._solved.named.results[name]


def order_peaks(results: EngineResults, curve: ChartCurve) -> Floats:
    """Peaks of a response to each order of a running engine, (n_speeds, n_orders), g, N or N m.

    No numbers where the vehicle is without the mount.
    """
    if isinstance(curve, ResponseCurve):
        return results.acceleration_g[:, :, curve.point, AXIS[curve.direction]]
    if not has_mount(results.vehicle, curve.mount):
        return np.full(results.acceleration_g.shape[:2], np.nan)
    every = results.force_in_vehicle_axes if curve.in_vehicle_axes else results.force
    number = mount_number(results.vehicle, curve.mount)
    return np.abs(every[:, :, number, MOTIONS.index(curve.motion)])


def peak_unit(curve: ChartCurve) -> LevelUnit:
    """The unit of a response to a harmonic load."""
    if isinstance(curve, ResponseCurve):
        return PEAK_ACCELERATION
    return PEAK_FORCE if curve.motion in MOTIONS[:3] else PEAK_MOMENT


def has_mount(vehicle: Vehicle, name: str) -> bool:
    """Whether a vehicle has a mount of that name."""
    return any(mount.name == name for mount in vehicle.mounts)


def mount_number(vehicle: Vehicle, name: str) -> int:
    """The number of the mount of that name."""
    return [mount.name for mount in vehicle.mounts].index(name)


def curve_label(vehicle: Vehicle, curve: ChartCurve) -> str:
    """A response as people call it: "Seat track left, lateral", "C1 left, force, local z".

    Long names of points are cut in their midst, if they still differ.
    """
    if isinstance(curve, ForceCurve):
        axes = "vehicle" if curve.in_vehicle_axes else "local"
        what = "force" if curve.motion in MOTIONS[:3] else "moment"
        name = _short([mount.name for mount in vehicle.mounts])[mount_number(vehicle, curve.mount)]
        return f"{sentence_case(name)}, {what}, {axes} {curve.motion}"
    name = _short([point.name for point in vehicle.response_points])[curve.point]
    return f"{sentence_case(name)}, {curve.direction}"


def _short(names: list[str]) -> list[str]:
    """Names that leave their box room, if they still differ."""
    short = [cut(name, LONGEST_POINT) for name in names]
    return short if len(set(short)) == len(short) else names
