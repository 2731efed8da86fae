"""Rigid bodies of a study's vehicle on their mounts."""

from collections.abc import Iterator
from dataclasses import dataclass
from html import escape
from typing import get_args

import numpy as np

from modeviz.analysis.modal_results import ModalResults, solve_modal
from modeviz.analysis.rigid import RigidBodyFigures, rigid_figures
from modeviz.mounting.axes import ElasticAxes
from modeviz.mounting.purity import Purity
from modeviz.report.records import Record
from modeviz.report.rigid import listed_modes, percent, rigid_record, rigid_table, verdict_lines
from modeviz.study.displayed import Displayed
from modeviz.study.names import check_choice, number_of
from modeviz.study.notebook import block, paragraphs
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.text.markup import table, title
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.decoupling import Axes


@dataclass(frozen=True, eq=False)
class RigidOnMounts:
    """A rigid body, or the rigid part of a flexible one, on its mounts."""

    figures: RigidBodyFigures
    """As the functions of `analysis` take them."""

    @property
    def name(self) -> str:
        """Of the body."""
        return self.figures.name

    @property
    def energy(self) -> Floats:
        """(n_modes, 6): its kinetic energy in x, y, z, rx, ry, rz, parts of each mode's."""
        return self.figures.purity.energy

    @property
    def share(self) -> Floats:
        """(n_modes,): all of its kinetic energy, also that in which it bends."""
        return self.figures.purity.share

    @property
    def purity(self) -> dict[str, float]:
        """The part that each direction has in the body's energy in its mode; zero without a mode."""
        return {motion: self._found.purity(motion) or 0.0 for motion in MOTIONS}

    @property
    def frequency_hz(self) -> dict[str, float | None]:
        """The frequency of the mode of each direction, Hz; None if it has none in the band."""
        return {motion: self._found.frequency(motion) for motion in MOTIONS}

    @property
    def passes(self) -> bool:
        """Whether purity, band and gaps are as the vehicle's [decoupling] asks."""
        return self._found.passes

    @property
    def torque_roll_axis(self) -> Floats | None:
        """(3,), the direction about which it would turn freely; None of a rod along its crank."""
        axis = self.figures.axes.torque_roll_axis
        return None if axis is None else axis.direction

    @property
    def held(self) -> ElasticAxes | None:
        """Its elastic axes with the other ends of its mounts held still; None if it moves freely."""
        return self.figures.axes.held

    @property
    def mounted(self) -> ElasticAxes | None:
        """Those on all that is elastic, down to the ground; None if it moves freely."""
        return self.figures.axes.mounted

    @property
    def focus(self) -> Floats | None:
        """(3,), m: where the axes of its inclined mounts meet; None without such."""
        focus = self.figures.axes.focus
        return None if focus is None else focus.point

    @property
    def _found(self) -> Purity:
        return self.figures.purity


@dataclass(frozen=True, eq=False, repr=False)
class RigidBodies(Displayed):
    """Purity of modes, and axes and centres, of a vehicle's bodies on their mounts.

    rigid = study.rigid()
    rigid["engine"].purity["z"], rigid["engine"].held.center
    """

    results: ModalResults
    """The modes with the present rates, as the functions of `analysis` take them."""
    axes: Axes
    """Along which energy is told."""
    figures: tuple[RigidBodyFigures, ...]
    """Of each body."""

    @property
    def names(self) -> tuple[str, ...]:
        """Of the bodies."""
        return tuple(figures.name for figures in self.figures)

    @property
    def frequency_hz(self) -> Floats:
        """(n_modes,), rising."""
        return self.results.modes.frequency_hz

    def __len__(self) -> int:
        return len(self.figures)

    def __iter__(self) -> Iterator[RigidOnMounts]:
        return map(RigidOnMounts, self.figures)

    def __getitem__(self, name: str) -> RigidOnMounts:
        """Return a body by its name; raises VehicleError for none."""
        return RigidOnMounts(self.figures[number_of("body", name, self.names)])

    def table(self) -> str:
        """Return energy in six directions, purity and gaps, axes and centres of each body."""
        return rigid_table(self.results, self.figures, self.axes)

    def to_dict(self) -> Record:
        """Return what `modeviz rigid --json` prints, see `report.rigid.rigid_record`."""
        return rigid_record(self.results, self.figures, self.axes)

    def _repr_html_(self) -> str:
        content = [part for figures in self.figures for part in self._body(figures)]
        return block(f"{self.results.vehicle.name}: bodies on mounts", *content)

    def _body(self, figures: RigidBodyFigures) -> Iterator[str]:
        found = figures.purity
        rows = [
            [
                title(self.results.names[mode].spoken),
                f"{found.frequency_hz[mode]:.2f}",
                *map(percent, found.energy[mode]),
                percent(found.share[mode]),
            ]
            for mode in listed_modes(found)
        ]
        header = [f"{escape(figures.name)}, % of the mode", "Hz", *MOTIONS, "Share"]
        yield table(header, rows)
        yield paragraphs(*(line.strip() for line in verdict_lines(found)), *_said(figures))


def rigid_bodies(tuned: TunedVehicle, axes: Axes, up_to_hz: float | None) -> RigidBodies:
    """Return the bodies of a vehicle on their mounts; arguments and errors as of `Study.rigid`."""
    below = tuned.band_end("up_to_hz", up_to_hz)
    check_choice("axes", axes, get_args(Axes))
    results = solve_modal(tuned.prepared_modes(below), tuned.rates.by_group)
    return RigidBodies(results, axes, rigid_figures(results, axes))


def _said(figures: RigidBodyFigures) -> Iterator[str]:
    """Lines on its axes."""
    held = figures.axes.held
    if held is not None and np.isfinite(held.angle):
        yield (
            f"torque roll axis and elastic torque axis: {np.degrees(held.angle):.2f}°, "
            f"{1e3 * held.offset:.1f} mm apart"
        )
