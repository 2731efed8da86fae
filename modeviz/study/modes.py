"""The modes of a study's vehicle."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import get_args

import numpy as np

from modeviz.analysis.deflection_shapes import complex_mode
from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.mode_tracking import Followed, solve_followed
from modeviz.dynamics.band import Method
from modeviz.dynamics.damped import DampedMode
from modeviz.report.records import Record, modes_record
from modeviz.report.tables import came_from, health, largest, modes_table
from modeviz.study.displayed import Displayed
from modeviz.study.names import check_choice, number_of
from modeviz.study.notebook import block, paragraphs
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.text.markup import table, title
from modeviz.vehicle.arrays import Floats


@dataclass(frozen=True, eq=False)
class Mode:
    """One undamped mode of a vehicle."""

    number: int
    """From one, in rising order."""
    name: str
    """What moves: "cab yaw"."""
    name_score: float
    """How well that fits: its share of the motion, 0 to 1."""
    frequency_hz: float
    frequency_error_hz: float
    """How far that may be from exact, for the model as given."""
    damping_ratio: float
    """Fraction of critical."""
    kinetic_energy: Mapping[str, float] = field(repr=False)
    """The share of each body."""
    strain_energy: Mapping[str, float] = field(repr=False)
    dissipated_energy: Mapping[str, float] = field(repr=False)
    """The share of each flexible body and connection group."""
    was: str
    """Which modes with the vehicle's own rates it comes from, with their frequencies."""
    shape: Floats = field(repr=False)
    """(n_dofs,), mass-normalised."""


@dataclass(frozen=True, eq=False, repr=False)
class ModesTable(Displayed):
    """The modes of a vehicle: they iterate, are found by number and by name, and become arrays.

    modes = study.modes()
    modes["cab yaw"].frequency_hz
    [mode.name for mode in modes if mode.damping_ratio > 0.1]
    modes.frequency_hz, modes.shapes
    """

    followed: Followed
    """The modes with the vehicle's own rates and with the present ones, and where the former went."""
    below_hz: float
    """Modes above are left out."""

    @property
    def results(self) -> ModalResults:
        """All modes with the present rates, as the functions of `analysis` take them."""
        return self.followed.now

    @property
    def frequency_hz(self) -> Floats:
        """(n_modes,), rising."""
        return self.results.modes.frequency_hz[: len(self)]

    @property
    def damping_ratio(self) -> Floats:
        """(n_modes,), fractions of critical."""
        return self.results.modes.damping_ratio[: len(self)]

    @property
    def shapes(self) -> Floats:
        """(n_dofs, n_modes), mass-normalised, a mode a column."""
        return self.results.modes.shapes[:, : len(self)]

    @property
    def names(self) -> tuple[str, ...]:
        """One for each mode."""
        return tuple(name.name for name in self.results.names[: len(self)])

    def damped(self, which: int | str) -> DampedMode:
        """Return a mode with its damping and phases.

        Args:
            which: the undamped mode it belongs to, its name or its place, from zero.

        Raises:
            VehicleError: there is no such mode.
            SolveError: it is damped so strongly that it does not vibrate.
        """
        return complex_mode(self.results, self._index(which))

    def __len__(self) -> int:
        return int(np.sum(self.results.modes.frequency_hz < self.below_hz))

    def __iter__(self) -> Iterator[Mode]:
        return (self._mode(i) for i in range(len(self)))

    def __getitem__(self, which: int | str) -> Mode:
        """Return a mode by its name, or by its place from zero; raises VehicleError for none."""
        return self._mode(self._index(which))

    def table(self) -> str:
        """Return name, frequency, damping, what moves and is strained most, and which mode each was."""
        return modes_table(self.followed, self.below_hz)

    def to_dict(self) -> Record:
        """Return what `modeviz modes --json` prints, see `report.records.modes_record`."""
        return modes_record(self.followed, self.below_hz)

    def _repr_html_(self) -> str:
        header = ["Mode", "Hz", "Damping, %", "Moves most", "Strained most", "Was originally"]
        rows = [
            [
                f'<span class="dim">{mode.number}</span> {title(self.results.names[i].spoken)}',
                f"{mode.frequency_hz:.2f}",
                f"{100 * mode.damping_ratio:.1f}",
                escape(largest(self.results.kinetic_energy, i)),
                escape(largest(self.results.strain_energy, i)),
                escape(mode.was),
            ]
            for i, mode in enumerate(self)
        ]
        about = paragraphs(health(self.results))
        return block(
            f"Modes of {self.results.vehicle.name}", table(header, rows, words=(3, 4, 5)), about
        )

    def _index(self, which: int | str) -> int:
        if isinstance(which, str):
            return number_of("mode", which, self.names)
        return range(len(self))[which]

    def _mode(self, i: int) -> Mode:
        results = self.results
        return Mode(
            number=i + 1,
            name=results.names[i].name,
            name_score=results.names[i].score,
            frequency_hz=float(results.modes.frequency_hz[i]),
            frequency_error_hz=float(results.trust.frequency_error_hz[i]),
            damping_ratio=float(results.modes.damping_ratio[i]),
            kinetic_energy=_shares(results.kinetic_energy, i),
            strain_energy=_shares(results.strain_energy, i),
            dissipated_energy=_shares(results.dissipated_energy, i),
            was=came_from(self.followed, i),
            shape=results.modes.shapes[:, i],
        )


def modes_below(tuned: TunedVehicle, below_hz: float | None, method: Method) -> ModesTable:
    """Return the modes of a vehicle; arguments and errors as of `Study.modes`."""
    below = tuned.band_end("below_hz", below_hz)
    check_choice("method", method, get_args(Method))
    return ModesTable(solve_followed(tuned.prepared_modes(below), tuned.rates.by_group, method), below)


def _shares(energy: Mapping[str, Floats], mode: int) -> dict[str, float]:
    return {name: float(share[mode]) for name, share in energy.items()}
