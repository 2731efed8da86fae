"""The ride of a vehicle on a road, with its modes: one solve for screen, report and command line."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from modeviz.analysis.driven import Driven, driven, load_lines
from modeviz.analysis.engine_results import EngineResults, RunningEngine, running_engine
from modeviz.analysis.latest import Latest
from modeviz.analysis.modal_results import ModalResults, modes_of
from modeviz.analysis.mount_forces import MountForces, harmonic_mount_forces, mount_forces
from modeviz.analysis.preparation import Prepared
from modeviz.dynamics.band import Method, modes_above
from modeviz.dynamics.basis import REACH
from modeviz.dynamics.inputs import forces_on_rest, led
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.resonances import Resonances
from modeviz.dynamics.response import modal_coordinates
from modeviz.errors import ModevizError
from modeviz.mounting.levels import InputSpectra
from modeviz.ride.averaging import averaged_spectrum
from modeviz.ride.excitation import Load, excitation, input_spectrum
from modeviz.ride.participation import Peak, participation, participation_above, peak_lines, peaks
from modeviz.ride.psd import acceleration_psd, averaged_acceleration_psd, rms
from modeviz.ride.rating import Rating, rate
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.engine import Engine
from modeviz.vehicle.loads import HarmonicLoad, RandomLoad
from modeviz.vehicle.mount_rates import DIRECTIONS, Rates

AXIS: dict[str, int] = dict(zip(DIRECTIONS, (2, 1, 0), strict=True))
"""Where a direction is among x, y, z."""


@dataclass(frozen=True)
class Conditions:
    """What shakes the vehicle at random."""

    road: str
    """The name of a road, or of another random load."""
    speed: float
    """On a road, m/s."""

    def __post_init__(self) -> None:
        if not (np.isfinite(self.speed) and self.speed > 0):
            raise ModevizError(f"speed: found {self.speed} m/s, expected more than 0")


@dataclass(frozen=True, eq=False)
class RoadExcitation(Driven):
    """A prepared vehicle on a road: all of a ride that does not depend on mount rates."""

    conditions: Conditions
    load: RandomLoad
    """That of the conditions."""
    latest_spectrum: Latest[Complexes] = field(default_factory=Latest, init=False)
    latest_average: Latest[Complexes] = field(default_factory=Latest, init=False)
    latest_engine: Latest[RunningEngine] = field(default_factory=Latest, init=False)

    def spectrum_at(self, frequency_hz: Floats) -> Complexes:
        """Return the spectrum of the load's inputs, (n_freqs, n_inputs, n_inputs), m²/Hz of a road."""
        return self.latest_spectrum.get(
            frequency_hz.tobytes(),
            lambda: input_spectrum(self.load, frequency_hz, self.conditions.speed),
        )

    def spectrum_around(self, lines: Floats) -> Complexes:
        """Return the same averaged around lines, for integrals."""
        return self.latest_average.get(
            lines.tobytes(), lambda: averaged_spectrum(self.load, lines, self.conditions.speed)
        )

    @property
    def known(self) -> tuple[float, float]:
        """Hz: the part of the band in which the load is known."""
        return float(self.frequency_hz[0]), float(self.frequency_hz[-1])

    @property
    def is_known_from_start(self) -> bool:
        """Whether the load is known from the band's first line on."""
        return bool(self.frequency_hz[0] <= self.prepared.frequency_hz[0])

    @property
    def is_partial(self) -> bool:
        """Whether there is more of the band, of which nothing is known."""
        whole = self.prepared.frequency_hz
        return self.known != (float(whole[0]), float(whole[-1]))


@dataclass(frozen=True, eq=False)
class Results(ModalResults):
    """A vehicle's modes, and its ride on one road."""

    prepared: Prepared
    drive: RoadExcitation
    frequency_hz: Floats
    """(n_freqs,): lines of the band, closer where modes are sharp, so that integrals hold."""
    psd: Floats
    """(n_freqs, n_points, 3): acceleration x, y, z of each response point, g²/Hz."""
    averaged_psd: Floats
    """The same around each line, of which RMS values are made: see `averaged_spectrum`."""

    latest_forces: Latest[MountForces] = field(default_factory=Latest, init=False)
    """Under the load that was asked for last."""
    latest_engine: Latest[EngineResults] = field(default_factory=Latest, init=False)

    @property
    def conditions(self) -> Conditions:
        return self.drive.conditions

    @cached_property
    def rms(self) -> Floats:
        """(n_points, 3), g, over the band, as far as the load is known."""
        return rms(self.frequency_hz, self.averaged_psd, self.band_hz)

    @property
    def band_hz(self) -> tuple[float, float]:
        """From zero to the end of the vehicle's band."""
        return 0.0, self.prepared.vehicle.highest_frequency

    @cached_property
    def rating(self) -> Rating:
        """Of the first response point, the driver's."""
        return rate(self.frequency_hz, self.averaged_psd[:, 0], self.drive.is_known_from_start)

    def mount_forces(self, load: HarmonicLoad | None = None) -> MountForces:
        """Return the forces of mounts under a harmonic load of the vehicle; None: on the road.

        Raises:
            SolveError: with these rates an undamped resonance lies on a line.
        """
        return self.latest_forces.get(load, lambda: self._mount_forces(load))

    def running(self, engine: Engine) -> EngineResults:
        """Return what one of the vehicle's engines does as it runs up."""

        def solve() -> EngineResults:
            prepared = self.prepared
            at_rest = self.drive.latest_engine.get(engine, lambda: running_engine(prepared, engine))
            return at_rest.solve(self.rates)

        return self.latest_engine.get(engine, solve)

    def _mount_forces(self, load: HarmonicLoad | None) -> MountForces:
        if load is not None:
            return harmonic_mount_forces(self.prepared, self.rates, load, self.conditions.speed)
        f, drive = self.frequency_hz, self.drive
        spectra = InputSpectra(f, drive.spectrum_at(f), drive.spectrum_around(f))
        return mount_forces(drive, self.prepared.mount_stiffness(self.rates), f, spectra, True)

    def response(self, point: int, direction: str) -> Floats:
        """Acceleration PSD of a response point along one of `DIRECTIONS`, (n_freqs,), g²/Hz."""
        return self.psd[:, point, AXIS[direction]]

    def peak_lines(self, point: int, direction: str) -> list[int]:
        """Return where that response has its peaks, numbers of frequencies."""
        return peak_lines(self.response(point, direction))

    def peaks(
        self, point: int, direction: str, count: int = 3, lines: Sequence[int] | None = None
    ) -> tuple[Peak, ...]:
        """Peaks of that response with the `count` modes that make most of each, see `part_name`.

        Args:
            point: number of the response point.
            direction: one of `DIRECTIONS`.
            count: how many modes to name.
            lines: which peaks, all of `peak_lines` if None.
        """
        at = np.asarray(self.peak_lines(point, direction) if lines is None else lines, int)
        f = self.frequency_hz[at]
        row = self.prepared.outputs[3 * point + AXIS[direction]]
        parts = self.participation(row, self.drive.load, f, self.drive.spectrum_at(f))
        return peaks(f, self.response(point, direction)[at], parts, count)

    def participation(
        self,
        row: Array,
        load: Load,
        frequency_hz: Floats,
        input_psd: Complexes,
        given: Complexes | float = 0.0,
    ) -> Floats:
        """Return the parts of the band's modes, of those above, and of the rest, (n_freqs, n_parts).

        Args:
            row: (n_dofs,), reads the response.
            load: what shakes.
            frequency_hz: (n_freqs,).
            input_psd: of its inputs, (n_freqs, n_inputs, n_inputs).
            given: (n_freqs, n_inputs), what it reads besides, whatever moves: part of the rest.
        """
        band, above, prepared = self.band, self.above, self.prepared
        forces, moved = self._forces(load, frequency_hz)
        shapes = band.modes.shapes / np.sqrt(band.dispersion)
        q = modal_coordinates(
            band.modes.omega_n_squared,
            band.damping,
            band.structural_damping,
            frequency_hz,
            shapes.T @ forces,
        )
        return np.hstack(
            [
                participation(row @ shapes, q, input_psd),
                participation_above(
                    above,
                    self._n_above,
                    row @ prepared.basis.vectors @ above.shapes,
                    above.shapes.T @ (prepared.basis.vectors.T @ forces),
                    row @ moved + given,
                    frequency_hz,
                    input_psd,
                ),
            ]
        )

    def _forces(self, load: Load, frequency_hz: Floats) -> tuple[Complexes, Complexes]:
        """Return a load as forces on what rigid joints leave, and the motion that these are given.

        Per unit of each input, (n_freqs, n_dofs, n_inputs) both.
        """
        prepared, system = self.prepared, self.prepared.system
        law = prepared.basis.law
        there = law.stiffness(prepared.mount_stiffness(self.rates), frequency_hz)
        inputs = excitation(prepared.vehicle, load, frequency_hz, self.conditions.speed, there)
        actions = prepared.input_directions.T @ inputs.forces
        own = law.at_reference.stiffness(prepared.basis.mount_stiffness, frequency_hz)
        moved, change = led(system, actions), there - own
        pull = system.mount_motions.T @ (change[:, :, None] * (system.mount_motions @ moved))
        return forces_on_rest(system, frequency_hz, actions) - pull, moved

    def part_name(self, part: int) -> str:
        """Return what a contributor to a peak is called where it is spoken of."""
        if part < len(self.names):
            return self.names[part].spoken
        f = self.part_frequency(part)
        return "static rest" if f is None else f"mode above the band, {f:.1f} Hz"

    def part_frequency(self, part: int) -> float | None:
        """The frequency of a contributor to a peak, Hz; the rest has none."""
        frequencies = [*self.modes.frequency_hz, *self.above.frequency_hz[: self._n_above]]
        return float(frequencies[part]) if part < len(frequencies) else None

    @cached_property
    def above(self) -> Modes:
        """The modes of the basis above those of the band, in its vectors."""
        stiffness = self.prepared.mount_stiffness(self.rates)
        return modes_above(self.prepared.basis, stiffness, self.band)

    @cached_property
    def _n_above(self) -> int:
        """How many of these are modes of the vehicle and not of the basis alone."""
        return int(np.searchsorted(self.above.frequency_hz, REACH * self.prepared.basis.top_hz))


def solve(
    prepared: Prepared, rates: Rates, conditions: Conditions, method: Method = "enriched"
) -> Results:
    """Modes and ride of a vehicle with other mount rates; the ride is exact whatever the method.

    Args:
        prepared: see `prepare`.
        rates: of the groups that differ from the vehicle's own.
        conditions: road and speed.
        method: how modes are found.

    Raises:
        VehicleError: a group or a road that the vehicle does not have.
        SolveError: with these rates an undamped resonance lies on a frequency.
    """
    return solve_on(drive(prepared, conditions), rates, method)


def drive(prepared: Prepared, conditions: Conditions) -> RoadExcitation:
    """A prepared vehicle on a road; for several sets of rates with `solve_on`.

    Raises:
        VehicleError: a road that the vehicle does not have.
        ModevizError: nothing of the band is known of the road at that speed.
    """
    load, speed = prepared.vehicle.random_load(conditions.road), conditions.speed
    under = driven(prepared, [load], speed, load_lines(prepared, [(load, speed)]))
    return RoadExcitation(prepared, under.loads, speed, under.receptances, conditions, load)


def solve_on(drive: RoadExcitation, rates: Rates, method: Method = "enriched") -> Results:
    """Modes and ride on a road with other mount rates; arguments and errors as `solve`."""
    prepared = drive.prepared
    stiffness = prepared.mount_stiffness(rates)
    modal = modes_of(prepared, rates, stiffness, method)
    spectra = solve_spectra(drive, stiffness, modal.resonances)
    return Results(prepared, modal.rates, modal.band, drive, *spectra)


def solve_spectra(
    drive: RoadExcitation, stiffness: Complexes, resonances: Resonances
) -> tuple[Floats, Floats, Floats]:
    """The lines that mount rates want, (n_lines,), and PSDs at and around them, see `Results`."""
    lines = drive.lines(resonances)
    H = drive.response(stiffness, lines)
    at = acceleration_psd(lines, H, drive.spectrum_at(lines))
    around = averaged_acceleration_psd(lines, H, drive.spectrum_around(lines))
    shape = len(lines), H.shape[1] // 3, 3
    return lines, at.reshape(shape), around.reshape(shape)
