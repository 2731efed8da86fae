"""A vehicle made ready once, to be answered at any mount rates: its basis, names and receptances."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.dynamics.assembly import System, assemble
from modeviz.dynamics.basis import EnrichedBasis, prepare_basis
from modeviz.dynamics.inputs import directions
from modeviz.dynamics.interpolation import Between, modified_between, prepare_between
from modeviz.dynamics.mode_damping import with_mode_damping
from modeviz.dynamics.mount_rates import MountSprings
from modeviz.dynamics.naming import Namer, prepare_names
from modeviz.dynamics.reanalysis import Receptances, prepare_receptances
from modeviz.dynamics.receptance import receptances_along
from modeviz.dynamics.resonances import Resonances
from modeviz.dynamics.spacing import placed_lines
from modeviz.errors import of_file
from modeviz.mounting.working_point import WorkingPoint, working_point
from modeviz.ride.excitation import Load, excitation, input_directions, together
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import DAMPING_FIELDS, RATE_FIELDS, MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle

STIFFEST_BASE = 5e6
"""N/m, and N m/rad about axes: receptances are taken at no stiffer rates. From a rigid spring there is
no way back to a soft one: what it lets through is the small difference of large numbers."""

FIRMEST_BASE = 1e5
"""N s/m: likewise, of dampers."""

LEAST_DAMPER = 0.1
"""Receptances are taken with dampers that damp at least this part of what they can."""

NO_POLES = np.zeros(0, complex)


@dataclass(frozen=True, eq=False)
class PreparedModes:
    """A vehicle made ready for the modes of any mount rates."""

    system: System
    """With the vehicle's own rates."""
    basis: EnrichedBasis
    namer: Namer
    working: WorkingPoint
    """Where its mounts work, which tells how stiff progressive ones are."""

    @property
    def vehicle(self) -> Vehicle:
        """With its own rates."""
        return self.system.vehicle

    def vehicle_at(self, rates: Rates) -> Vehicle:
        """Return the vehicle with other rates, progressive mounts as they work then.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: progressive mounts do not settle.
        """
        return self.working.vehicle(self.vehicle, rates)

    def system_at(self, rates: Rates) -> System:
        """Return the system with other rates; raises as `vehicle_at`."""
        return self.system.with_mounts(self.vehicle_at(rates))

    @property
    def n_bytes(self) -> int:
        """The memory that the prepared arrays take."""
        return self.system.n_bytes + self.basis.n_bytes + self.namer.rows.nbytes

    def all_rates(self, rates: Rates) -> dict[str, MountRates]:
        """The rates of every group, see `Vehicle.all_rates`."""
        return self.vehicle.all_rates(rates)

    def mount_stiffness(self, rates: Rates) -> Complexes:
        """Complex rates k (1 + jg) of every mount spring, (n_springs,); raises as `MountSprings`."""
        return self.springs.stiffness(rates)

    def real_rates(self, rates: Rates) -> Floats:
        """K of every mount spring, zero of dampers, (n_springs,), N/m and N m/rad; raises likewise."""
        return self.basis.law.springs(self.mount_stiffness(rates)).real.astype(np.float64)

    @cached_property
    def springs(self) -> MountSprings:
        """The springs of the mounts, at any rates."""
        return MountSprings(self.vehicle, self.working.tangents)


@dataclass(frozen=True, eq=False)
class Prepared(PreparedModes):
    """A vehicle made ready for the modes and responses of any mount rates."""

    receptances: Receptances
    """Of x, y, z at every response point, to forces along the input directions."""
    between: Between
    """The same at any frequency."""
    is_graded: bool
    """Whether responses are also given between these lines, where modes are sharp."""
    input_directions: Floats
    """(n_directions, n_dofs + n_rigid), see `ride.excitation`."""
    outputs: Floats
    """Rows (3 n_points, n_dofs) that read x, y, z of every response point."""

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): where responses are given; others are where `lines` puts them."""
        return self.receptances.frequency_hz

    @property
    def n_bytes(self) -> int:
        """The memory that the prepared arrays take."""
        own = self.input_directions.nbytes + self.outputs.nbytes
        return super().n_bytes + self.receptances.n_bytes + own

    def lines(self, resonances: Resonances, grid: Floats | None = None) -> Floats:
        """The lines at which responses hold the integrals, (n_lines,): closer where modes are sharp.

        Args:
            resonances: at the mount rates that are looked at.
            grid: lines that would do if no mode were sharp, evenly spaced, `frequency_hz` if None.
        """
        lines = self.frequency_hz if grid is None else grid
        if not self.is_graded:
            return lines
        seen = resonances.seen(self.outputs, self.input_directions).rounded()
        return placed_lines(lines, seen.frequency_hz, seen.damping_ratio)

    def on(self, lines: Floats) -> "Prepared":
        """Return the same at other lines within its own, (n_lines,), rising, and nowhere else."""
        receptances = self.between.at(lines)
        return replace(
            self, receptances=receptances, between=Between(receptances, NO_POLES), is_graded=False
        )

    def excited(self, loads: Sequence[Load], speed: float) -> Receptances:
        """Receptances of every output per unit of each input of some loads, see `ride.excitation`."""
        at = self.receptances
        inputs = together(
            [excitation(self.vehicle, load, at.frequency_hz, speed, at.present) for load in loads]
        )
        return at.driven(inputs.forces, inputs.ground)

    def near(self, rates: Rates) -> "Prepared":
        """Return the same with receptances at other rates, where soft: answers close by cost less.

        To be asked of what `prepare` gave, for rounding adds up.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: with these rates an undamped resonance lies on a frequency.
        """
        stiffness = self.mount_stiffness(softened(self.all_rates(rates)))
        if not self.is_graded:
            return replace(self, receptances=self.receptances.modified(stiffness))
        between = modified_between(
            self.between, stiffness, self.basis, (self.outputs, self.input_directions)
        )
        return replace(self, receptances=between.known, between=between)


def prepare_modes(vehicle: Vehicle, top_hz: float | None = None) -> PreparedModes:
    """A vehicle made ready for the modes of any mount rates.

    Args:
        vehicle: with the rates that the basis and the classic method start from.
        top_hz: modes below this are wanted; None: as high as the vehicle's band.

    Raises:
        VehicleError: damping is stated of a mode that has none such, or rigid connections leave nothing
            that moves.
        SolveError: the vehicle has no meaningful modes.
    """
    top_hz = vehicle.highest_frequency if top_hz is None else top_hz
    with of_file(vehicle.file):
        working = working_point(vehicle)
        system = with_mode_damping(assemble(working.vehicle(vehicle, {})), top_hz)
        return PreparedModes(system, prepare_basis(system, top_hz), prepare_names(system), working)


def prepare(
    vehicle: Vehicle,
    frequency_hz: Floats | None = None,
    *,
    top_hz: float | None = None,
    progress: Callable[[float], None] | None = None,
    is_graded: bool | None = None,
) -> Prepared:
    """A vehicle made ready for the modes and responses of any mount rates.

    Receptances are taken at the softest rates of every group's bounds, so that a change within the
    bounds only ever adds springs, and nowhere above `STIFFEST_BASE`; dampers see `LEAST_DAMPER`.

    Args:
        vehicle: with the rates that the basis and the classic method start from.
        frequency_hz: (n_freqs,), rising, above zero: where responses are wanted; None: the lines of
            the vehicle's band.
        top_hz: modes below this are wanted; None: as high as the vehicle's band.
        progress: told the fraction that is done.
        is_graded: whether responses are also wanted between these lines, which are then evenly spaced,
            where modes are sharp, so that integrals hold; None: in the vehicle's band.

    Raises:
        VehicleError: as `prepare_modes` and `input_directions`.
        SolveError: a frequency that is zero, repeated or not finite, an undamped resonance on one, or
            no meaningful modes.
    """
    modal = prepare_modes(vehicle, top_hz)
    with of_file(vehicle.file):
        is_graded = frequency_hz is None if is_graded is None else is_graded
        lines = vehicle.frequency_hz if frequency_hz is None else frequency_hz
        return _with_responses(modal, lines, is_graded, progress)


def _with_responses(
    modal: PreparedModes,
    lines: Floats,
    is_graded: bool,
    progress: Callable[[float], None] | None,
) -> Prepared:
    """Return what is ready for modes made ready for responses; arguments and errors as `prepare`."""
    vehicle = modal.vehicle
    softest = modal.system_at(softened({g.name: _base(g) for g in vehicle.mount_groups}))
    inputs = input_directions(softest)
    points = [softest.motion(p.body, p.position)[:3] for p in vehicle.response_points]
    outputs = np.vstack([np.zeros((0, softest.n_dofs)), *points])
    receptances = prepare_receptances(softest, lines, outputs, inputs, progress)
    between = Between(receptances, NO_POLES)
    if is_graded:
        rows = directions(softest, softest.mount_motions, outputs, inputs)
        along = receptances_along(softest.with_constant_rates(), rows)
        between = prepare_between(receptances, modal.basis, (outputs, inputs), along)
    return Prepared(
        modal.system,
        modal.basis,
        modal.namer,
        modal.working,
        receptances,
        between,
        is_graded,
        inputs,
        outputs,
    )


def softened(rates: Rates) -> dict[str, MountRates]:
    """Return the same rates, but none above `STIFFEST_BASE`, and no damper above `FIRMEST_BASE`."""
    most = {f: FIRMEST_BASE if f in DAMPING_FIELDS else STIFFEST_BASE for f in RATE_FIELDS}
    return {
        group: replace(r, **{f: min(k, most[f]) for f, k in r.of(RATE_FIELDS).items()})
        for group, r in rates.items()
    }


def _base(group: MountGroup) -> MountRates:
    """Return the softest rates of a group, but dampers that damp: without, a resonance may be sharp."""
    softest, firmest = group.bounds
    least = {f: LEAST_DAMPER * c for f, c in firmest.of(DAMPING_FIELDS).items()}
    return replace(softest, **{f: max(c, getattr(softest, f)) for f, c in least.items()})
