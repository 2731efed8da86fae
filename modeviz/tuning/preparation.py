"""What is computed once for a vehicle, so that any mount rates are answered at once."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from modeviz.dynamics.assembly import System, assemble, mount_stiffness, mounts_of_springs
from modeviz.dynamics.basis import TOP_HZ, EnrichedBasis, prepare_basis
from modeviz.dynamics.component_trust import ComponentTrust, component_trust
from modeviz.dynamics.mode_damping import with_mode_damping
from modeviz.dynamics.naming import Namer, prepare_names
from modeviz.dynamics.reanalysis import Receptances, prepare_receptances
from modeviz.ride.excitation import Load, excitation, input_directions, together
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle

FREQUENCY_HZ = np.arange(1, 401) / 10
"""The band of the paper's RMS values, 0 to 40 Hz, without zero."""


STIFFEST_BASE = 5e6
"""N/m: receptances are taken at no stiffer rates. From a rigid spring there is no way back to a soft
one: what it lets through is the small difference of large numbers."""


@dataclass(frozen=True, eq=False)
class PreparedModes:
    """A vehicle made ready for the modes of any mount rates."""

    system: System
    """With the vehicle's own rates."""
    basis: EnrichedBasis
    namer: Namer

    @property
    def vehicle(self) -> Vehicle:
        return self.system.vehicle

    @property
    def n_bytes(self) -> int:
        """The memory that the prepared arrays take."""
        return self.system.n_bytes + self.basis.n_bytes + self.namer.rows.nbytes

    @property
    def components(self) -> tuple[ComponentTrust, ...]:
        """How far each flexible body is believed, with the vehicle's own rates."""
        return component_trust(self.system, self.basis.top_hz)

    def all_rates(self, rates: Rates) -> dict[str, MountRates]:
        """The rates of every group, see `Vehicle.all_rates`."""
        return self.vehicle.all_rates(rates)

    def mount_stiffness(self, rates: Rates) -> Complexes:
        """Complex rates k (1 + jg) of every mount spring, (n_springs,); raises as `all_rates`."""
        every = self.all_rates(rates)
        along = [every[g.name].local() for g in self.vehicle.mount_groups for _ in g.mounts]
        return np.concatenate([np.ravel(along), self._rotational]) * self.loss(rates)

    def loss(self, rates: Rates) -> Complexes:
        """1 + jg of every mount spring, (n_springs,); raises as `all_rates`."""
        every = self.all_rates(rates)
        factors = [
            g.loss_factor_with(every[g.name]) for g in self.vehicle.mount_groups for _ in g.mounts
        ]
        return 1 + 1j * np.array(factors)[self._mounts]

    @cached_property
    def _mounts(self) -> NDArray[np.intp]:
        """The number of each spring's mount, (n_springs,)."""
        return mounts_of_springs(self.vehicle)

    @cached_property
    def _rotational(self) -> Floats:
        """The rates of the springs about an axis, which are not tuned."""
        return mount_stiffness(self.vehicle)[3 * len(self.vehicle.mounts) :].real.astype(np.float64)


@dataclass(frozen=True, eq=False)
class Prepared(PreparedModes):
    """A vehicle made ready for the modes and responses of any mount rates."""

    receptances: Receptances
    """Of x, y, z at every response point, to forces along the input directions."""
    input_directions: Floats
    """(n_directions, n_dofs), see `ride.excitation`."""
    outputs: Floats
    """Rows (3 n_points, n_dofs) that read x, y, z of every response point."""

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): where responses are given."""
        return self.receptances.frequency_hz

    @property
    def n_bytes(self) -> int:
        """The memory that the prepared arrays take."""
        own = self.input_directions.nbytes + self.outputs.nbytes
        return super().n_bytes + self.receptances.n_bytes + own

    def excited(self, loads: Sequence[Load], speed: float) -> Receptances:
        """Receptances of every output per unit of each input of some loads, see `ride.excitation`."""
        at = self.receptances
        inputs = together(
            [
                excitation(self.vehicle, load, at.frequency_hz, speed, at.mount_stiffness)
                for load in loads
            ]
        )
        return at.driven(inputs.forces, inputs.ground)

    def near(self, rates: Rates) -> "Prepared":
        """The same with receptances at other rates, where these are soft: answers close by cost less.

        To be asked of what `prepare` gave, for rounding adds up.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: with these rates an undamped resonance lies on a frequency.
        """
        return replace(
            self,
            receptances=self.receptances.modified(self.mount_stiffness(_soft(self.all_rates(rates)))),
        )


def prepare_modes(vehicle: Vehicle, top_hz: float = TOP_HZ) -> PreparedModes:
    """A vehicle made ready for the modes of any mount rates.

    Args:
        vehicle: with the rates that the basis and the classic method start from.
        top_hz: modes below this are wanted.

    Raises:
        VehicleError: damping is stated of a mode that has none such.
        SolveError: the vehicle has no meaningful modes.
    """
    system = with_mode_damping(assemble(vehicle), top_hz)
    return PreparedModes(system, prepare_basis(system, top_hz), prepare_names(system))


def prepare(
    vehicle: Vehicle,
    frequency_hz: Floats = FREQUENCY_HZ,
    *,
    top_hz: float = TOP_HZ,
    progress: Callable[[float], None] | None = None,
) -> Prepared:
    """A vehicle made ready for the modes and responses of any mount rates.

    Receptances are taken at the softest rates of every group's bounds, so that a change within the
    bounds only ever adds springs, and nowhere above `STIFFEST_BASE`.

    Args:
        vehicle: with the rates that the basis and the classic method start from.
        frequency_hz: (n_freqs,), rising, above zero: where responses are wanted.
        top_hz: modes below this are wanted.
        progress: told the fraction that is done.

    Raises:
        SolveError: a frequency that is zero, repeated or not finite, an undamped resonance on one, or
            no meaningful modes.
    """
    modal = prepare_modes(vehicle, top_hz)
    softest = modal.system.with_rates(_soft({g.name: g.bounds[0] for g in vehicle.mount_groups}))
    inputs = input_directions(softest)
    rows = [softest.motion(p.body, p.position)[:3] for p in vehicle.response_points]
    outputs = np.vstack([np.zeros((0, softest.n_dofs)), *rows])
    receptances = prepare_receptances(softest, frequency_hz, outputs, inputs, progress)
    return Prepared(modal.system, modal.basis, modal.namer, receptances, inputs, outputs)


def _soft(rates: Rates) -> dict[str, MountRates]:
    """The same rates, but none above `STIFFEST_BASE`."""
    return {
        group: MountRates(
            *(min(rate, STIFFEST_BASE) for rate in r.as_tuple()), loss_factor=r.loss_factor
        )
        for group, r in rates.items()
    }
