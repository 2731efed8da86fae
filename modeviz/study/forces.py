"""The forces that the connections of a study's vehicle pass on under a load."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.forces import LoadedForces, solve_loaded
from modeviz.analysis.preparation import PreparedModes
from modeviz.errors import ModevizError, VehicleError, unknown
from modeviz.report.forces import ALONG, forces_record, forces_table, listed
from modeviz.report.records import Record
from modeviz.study.conditions import chosen_load
from modeviz.study.displayed import Displayed
from modeviz.study.notebook import block, paragraphs
from modeviz.text.markup import NONE, table, title
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.mount_rates import Rates


def loaded_forces(
    prepared: PreparedModes,
    rates: Rates,
    load: str | None,
    speed: float,
    frequency_hz: float | None = None,
    progress: Callable[[float], None] | None = None,
) -> LoadedForces:
    """Return the forces under the load of a name.

    Args:
        prepared: the vehicle made ready.
        rates: of the groups that differ from the vehicle's own.
        load: its name, see `chosen_load`.
        speed: on a road, m/s.
        frequency_hz: the only frequency that is asked for; None: the vehicle's band.
        progress: told the fraction that is done.

    Raises:
        ModevizError: there is no such load, it does not get into the vehicle, or its spectrum is not
            known there.
    """
    lines = None if frequency_hz is None else np.array([frequency_hz])
    chosen = chosen_load(prepared.vehicle, load)
    if frequency_hz is not None and isinstance(chosen, EngineOrder):
        low, high = chosen.frequency_hz[[0, -1]].tolist()
        if not low <= frequency_hz <= high:
            words = f"found {frequency_hz:g} Hz, expected {low:g} to {high:g} Hz, where the engine runs"
            raise VehicleError(f"load {chosen.name!r}: {words}")
    return solve_loaded(prepared, rates, chosen, speed, lines, progress)


@dataclass(frozen=True, eq=False, repr=False)
class MountForces(Displayed):
    """The force of every mount and other connection under a load, on the body that carries it.

    forces = study.forces("road 1")
    forces.rms("C1 left", "z"), forces.rms("C1 left", "z", in_vehicle_axes=True)
    """

    found: LoadedForces
    """As the functions of `analysis` take it."""

    @property
    def connections(self) -> tuple[str, ...]:
        """The names of all connections, mounts first."""
        return tuple(c.name for c in self.found.forces.connections)

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): lines of the vehicle's band, closer where modes are sharp."""
        return self.found.frequency_hz

    def rms(self, connection: str, motion: str, in_vehicle_axes: bool = False) -> float:
        """Return the RMS of a force under a random load, N, or of a moment, N m.

        Args:
            connection: its name.
            motion: "x", "y" or "z", along, or "rx", "ry" or "rz", about an axis.
            in_vehicle_axes: whether the axes are the vehicle's or the connection's own.

        Raises:
            VehicleError: there is no such connection or motion.
            ModevizError: the load is harmonic.
        """
        self._check(True)
        number, axis = self._place(connection, motion)
        return float(self.found.rms[int(in_vehicle_axes), number, axis])

    def psd(self, connection: str, motion: str, in_vehicle_axes: bool = False) -> Floats:
        """Return the PSD of a force under a random load, (n_freqs,), N²/Hz; arguments as `rms`."""
        self._check(True)
        return self.found.spectra.psd(self._force(connection, motion, in_vehicle_axes))[:, 0]

    def phasor(self, connection: str, motion: str, in_vehicle_axes: bool = False) -> Complexes:
        """Return amplitude and phase of a force under a harmonic load, (n_freqs,), N, complex.

        Its absolute value is the peak, its angle the phase to the load's; arguments as `rms`.

        Raises:
            VehicleError: as `rms`.
            ModevizError: the load is random.
        """
        self._check(False)
        return self._force(connection, motion, in_vehicle_axes)[:, 0, 0]

    def transmissibility(self, connection: str) -> Floats:
        """Return what gets across a connection, (n_freqs, 3): x, y, z of the vehicle.

        The acceleration of its carrying end, on the second body, over that of the first.

        Args:
            connection: its name.

        Raises:
            VehicleError: there is no such connection.
        """
        return self.found.transmissibility(self.found.number(connection))[0]

    @property
    def dissipated(self) -> dict[str, Floats]:
        """What turns energy into heat, (n_freqs,) by connection and body: W/Hz, or W if harmonic."""
        return dict(self.found.dissipation.by_place)

    @property
    def work(self) -> Floats:
        """What the load puts in, (n_freqs,), in the same units: as much as is dissipated."""
        return self.found.dissipation.work

    def table(self) -> str:
        """Return the forces of the mounts, what gets through, and what is dissipated."""
        return forces_table(self.found)

    def to_dict(self) -> Record:
        """Return what `modeviz forces --all --json` prints, see `report.forces.forces_record`."""
        return forces_record(self.found, every=True)

    def _repr_html_(self) -> str:
        found = self.found
        rows = [
            [title(found.forces.connections[i].name), *(self._cell(i, motion) for motion in ALONG)]
            for i in listed(found, every=False)
        ]
        what = "RMS, N" if found.is_random else "largest peak, N"
        return block(
            f"{found.vehicle.name} under {found.load.name}: forces of mounts",
            paragraphs(f"{what}, along local axes"),
            table(["", *ALONG], rows),
        )

    def _cell(self, number: int, motion: str) -> str:
        if motion not in self.found.acting(number):
            return NONE
        if self.found.is_random:
            return f"{self.found.rms[0, number, MOTIONS.index(motion)]:.4g}"
        return f"{np.abs(self.found.force(number, motion)).max():.4g}"

    def _force(self, connection: str, motion: str, in_vehicle_axes: bool) -> Complexes:
        number, axis = self._place(connection, motion)
        return self.found.force(number, MOTIONS[axis], in_vehicle_axes)

    def _place(self, connection: str, motion: str) -> tuple[int, int]:
        if motion not in MOTIONS:
            raise VehicleError(unknown("motion", motion, MOTIONS))
        return self.found.number(connection), MOTIONS.index(motion)

    def _check(self, is_random: bool) -> None:
        """Raises ModevizError unless the load is as random as is asked for."""
        if self.found.is_random == is_random:
            return
        words = (
            "has a spectrum: ask for rms or psd"
            if self.found.is_random
            else ("is harmonic: ask for phasor")
        )
        raise ModevizError(f"load {self.found.load.name!r} {words}")
