"""One solve for screen, report and command line."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from modeviz.analysis.driven import Driven, driven, load_lines
from modeviz.analysis.latest import Latest
from modeviz.analysis.preparation import Prepared, PreparedModes
from modeviz.dynamics.actions import forces_on_rest, led
from modeviz.dynamics.assembly import System
from modeviz.dynamics.band import BandModes, Method, band_modes, modes_above
from modeviz.dynamics.basis import REACH
from modeviz.dynamics.damped import DampedModes, damped_modes
from modeviz.dynamics.energy import kinetic_energy, strain_energy
from modeviz.dynamics.modes import Modes
from modeviz.dynamics.naming import ModeName, name_modes
from modeviz.dynamics.resonances import Resonances, resonances, resonances_at
from modeviz.dynamics.response import modal_coordinates
from modeviz.dynamics.trust import ErrorEstimate
from modeviz.errors import ModevizError
from modeviz.ride.averaging import averaged_spectrum
from modeviz.ride.excitation import Load, excitation, input_spectrum
from modeviz.ride.integration import line_distances
from modeviz.ride.participation import Peak, participation, participation_above, peak_lines, peaks
from modeviz.ride.psd import acceleration_psd, averaged_acceleration_psd, harmonic_acceleration, rms
from modeviz.ride.rating import Rating, rate
from modeviz.vehicle.arrays import Array, Complexes, Floats
from modeviz.vehicle.connections import DIRECTIONS, Rates
from modeviz.vehicle.loads import RandomLoad
from modeviz.vehicle.vehicle import Vehicle

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

    def spectrum_at(self, frequency_hz: Floats) -> Complexes:
        """Of the load's inputs, (n_freqs, n_inputs, n_inputs), m²/Hz of a road."""
        return self.latest_spectrum.get(
            frequency_hz.tobytes(),
            lambda: input_spectrum(self.load, frequency_hz, self.conditions.speed),
        )

    def spectrum_around(self, lines: Floats) -> Complexes:
        """The same averaged around lines, for integrals."""
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
class ModalResults:
    """A vehicle's modes in the prepared band, what they are called and where their energy is."""

    prepared: PreparedModes
    rates: Rates
    """Of every mount group."""
    band: BandModes

    @cached_property
    def names(self) -> tuple[ModeName, ...]:
        """One for each mode."""
        return name_modes(self.prepared.namer, self.modes)

    @property
    def modes(self) -> Modes:
        return self.band.modes

    @property
    def trust(self) -> ErrorEstimate:
        return self.band.trust

    @cached_property
    def system(self) -> System:
        """With these rates."""
        return self.prepared.system.with_rates(self.rates)

    @cached_property
    def vehicle(self) -> Vehicle:
        """With these rates."""
        return self.prepared.vehicle.with_rates(self.rates)

    @cached_property
    def resonances(self) -> Resonances:
        """Where the modes are in resonance, and how sharply."""
        return resonances(self.modes, self.band.damping, self.band.structural_damping)

    @cached_property
    def damped(self) -> DampedModes:
        """The modes with what damping couples, in the order of `modes`."""
        return damped_modes(self.band)

    @cached_property
    def momentum(self) -> Floats:
        """M φ of each mode, (n_dofs, n_modes)."""
        return self.prepared.system.momentum(self.modes.shapes)

    @cached_property
    def _mount_rates(self) -> Floats:
        return np.real(self.prepared.mount_stiffness(self.rates)).astype(np.float64)

    @cached_property
    def kinetic_energy(self) -> Mapping[str, Floats]:
        """Share of each body, (n_modes,) by name."""
        return kinetic_energy(self.prepared.system, self.modes.shapes)

    @cached_property
    def strain_energy(self) -> Mapping[str, Floats]:
        """Share of each flexible body and connection group, (n_modes,) by name."""
        return strain_energy(self.prepared.system, self.modes.shapes, self._mount_rates)

    def strain_shares(self, shape: Array) -> dict[str, float]:
        """The strain energy of a shape: share of each flexible body and connection group.

        Args:
            shape: (n_dofs,), real or complex, in any scale.
        """
        system, phi = self.prepared.system, shape[:, None]
        norm = np.sqrt(np.vdot(phi, system.momentum(phi)).real) or 1.0
        shares = strain_energy(system, phi / norm, self._mount_rates)
        return {name: float(share[0]) for name, share in shares.items()}

    def mode_index(self, name: str) -> int | None:
        """Which mode is called that; None if no mode is."""
        return next((i for i, n in enumerate(self.names) if n.name == name), None)


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

    def response(self, point: int, direction: str) -> Floats:
        """Acceleration PSD of a response point along one of `DIRECTIONS`, (n_freqs,), g²/Hz."""
        return self.psd[:, point, AXIS[direction]]

    def peak_lines(self, point: int, direction: str) -> list[int]:
        """Where that response has its peaks, numbers of frequencies."""
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
        output = 3 * point + AXIS[direction]
        parts = self.participation(output, self.drive.load, f, self.drive.spectrum_at(f))
        return peaks(f, self.response(point, direction)[at], parts, count)

    def participation(
        self, output: int, load: Load, frequency_hz: Floats, input_psd: Complexes
    ) -> Floats:
        """That of the band's modes, of those above, and of the rest, (n_freqs, n_parts).

        Args:
            output: which row of the prepared outputs.
            load: what shakes.
            frequency_hz: (n_freqs,).
            input_psd: of its inputs, (n_freqs, n_inputs, n_inputs).
        """
        band, above, prepared = self.band, self.above, self.prepared
        forces, moved = self._forces(load, frequency_hz)
        q = modal_coordinates(
            band.modes.omega_n_squared,
            band.damping,
            band.structural_damping,
            frequency_hz,
            self.modes.shapes.T @ forces,
        )
        row = prepared.outputs[output]
        return np.hstack(
            [
                participation(row @ self.modes.shapes, q, input_psd),
                participation_above(
                    above,
                    self._n_above,
                    row @ prepared.basis.vectors @ above.shapes,
                    above.shapes.T @ (prepared.basis.vectors.T @ forces),
                    row @ moved,
                    frequency_hz,
                    input_psd,
                ),
            ]
        )

    def _forces(self, load: Load, frequency_hz: Floats) -> tuple[Complexes, Complexes]:
        """What a load does, as forces on what rigid joints leave, and the motion that these are given.

        Per unit of each input, (n_freqs, n_dofs, n_inputs) both.
        """
        prepared, system = self.prepared, self.prepared.system
        stiffness = prepared.mount_stiffness(self.rates)
        inputs = excitation(prepared.vehicle, load, frequency_hz, self.conditions.speed, stiffness)
        actions = prepared.input_directions.T @ inputs.forces
        moved, change = led(system, actions), stiffness - prepared.basis.mount_stiffness
        pull = system.mount_motions.T @ (change[:, None] * (system.mount_motions @ moved))
        return forces_on_rest(system, frequency_hz, actions) - pull, moved

    def part_name(self, part: int) -> str:
        """What a contributor to a peak is called where it is spoken of."""
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


def solve_modal(prepared: PreparedModes, rates: Rates, method: Method = "enriched") -> ModalResults:
    """The modes of a vehicle with other mount rates.

    Args:
        prepared: see `prepare` and `prepare_modes`.
        rates: of the groups that differ from the vehicle's own.
        method: how modes are found.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    return _modal(prepared, rates, prepared.mount_stiffness(rates), method)


def _modal(prepared: PreparedModes, rates: Rates, stiffness: Complexes, method: Method) -> ModalResults:
    """The same, given the springs' complex rates."""
    return ModalResults(
        prepared, prepared.all_rates(rates), band_modes(prepared.basis, stiffness, method)
    )


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
    modal = _modal(prepared, rates, stiffness, method)
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


@dataclass(frozen=True, eq=False)
class WheelResults:
    """Harmonic response to each of a vehicle's wheel and other harmonic loads."""

    frequency_hz: Floats
    """(n_freqs,)."""
    acceleration_g: Floats
    """(n_freqs, n_loads, n_points, 3): peak x, y, z, g."""
    is_graded: bool = False
    """Whether lines lie closer where modes are sharp; else each counts alike."""

    def mean(self, band: tuple[float, float]) -> Floats:
        """Mean over a band, ends included, (n_loads, n_points, 3), g."""
        f = self.frequency_hz
        inside = (f > band[0] - 1e-6) & (f < band[1] + 1e-6)
        weights = inside * line_distances(f) if self.is_graded else 1.0 * inside
        return np.tensordot(weights, self.acceleration_g, 1) / weights.sum()


def solve_wheels(prepared: Prepared, rates: Rates) -> WheelResults:
    """The response to every harmonic load of the vehicle; arguments and errors as `solve`."""
    loads, n_points = prepared.vehicle.harmonic_loads, len(prepared.vehicle.response_points)
    if not loads:
        f = prepared.frequency_hz
        return WheelResults(f, np.zeros((len(f), 0, n_points, 3)))
    stiffness = prepared.mount_stiffness(rates)
    under = driven(prepared, loads, prepared.vehicle.speed)
    f = under.lines(resonances_at(prepared.basis, stiffness))
    g = harmonic_acceleration(f, under.response(stiffness, f)).transpose(0, 2, 1)
    g = g.reshape(len(f), len(loads), n_points, 3)
    return WheelResults(f, g, prepared.is_graded)
