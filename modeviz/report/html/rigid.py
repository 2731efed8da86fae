"""The report's section on bodies on their mounts: purity of their modes, axes and centres."""

from collections.abc import Iterator
from html import escape

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.analysis.rigid import BodyAxes, RigidBodyFigures, main_bodies, rigid_figures
from modeviz.mounting.purity import Purity
from modeviz.report.comparison import Comparison
from modeviz.report.rigid import vector
from modeviz.text.markup import NONE, note, section, table, title
from modeviz.vehicle.connections import MOTIONS


def rigid(comparison: Comparison) -> str:
    """Return purity and frequency of each direction's mode, and the axes of each body on mounts."""
    vehicle = comparison.vehicle
    on_mounts = {name for mount in vehicle.mounts for name in mount.bodies}
    compared = {body.name for body in comparison.base.prepared.vehicle.bodies}
    bodies = [name for name in main_bodies(vehicle) if name in on_mounts & compared]
    if not bodies:
        return ""
    sets = [rigid_figures(results, bodies=bodies) for results in (comparison.base, comparison.now)]
    asked, names = vehicle.decoupling, [*map(escape, comparison.names)]
    header = ["Body", *(f"{what}, {name}" for what in ("Hz", "Purity, %") for name in names), "Mode"]
    rows = [row for pair in zip(*sets, strict=True) for row in _body_rows(comparison.now, *pair)]
    axes = [row for pair in zip(*sets, strict=True) for row in _axes_rows(*pair)]
    return section(
        "Bodies on their mounts",
        table(header, rows, words={5}),
        note(
            "Each direction along the vehicle’s axes has the mode with most of the body’s kinetic "
            "energy in it that strains what holds the body; purity is its part in the body’s energy "
            f"there. In bold: {100 * asked.purity:g} % or more, and frequencies from "
            f"{asked.lowest_frequency:g} to {asked.highest_frequency:g} Hz."
        ),
        "<h3>Axes and centres</h3>",
        table(["Body", *names], axes, words={1, 2}),
        note(
            "With the other ends of what holds the body still. The torque roll axis is that of the "
            "free body under a torque about its crank, or its long axis if it has none, the elastic "
            "torque axis that of it at rest."
        ),
    )


def _body_rows(
    now: ModalResults, before: RigidBodyFigures, after: RigidBodyFigures
) -> Iterator[list[str]]:
    yield [title(after.part.body.label)]
    sides = before.purity, after.purity
    for motion in MOTIONS:
        mode = after.purity.modes[MOTIONS.index(motion)]
        yield [
            motion,
            *(_frequency(side, motion) for side in sides),
            *(_purity(side, motion) for side in sides),
            NONE if mode is None else escape(now.names[mode].spoken),
        ]


def _frequency(found: Purity, motion: str) -> str:
    f = found.frequency(motion)
    return NONE if f is None else _marked(f"{f:.2f}", found.is_in_band(motion))


def _purity(found: Purity, motion: str) -> str:
    part = found.purity(motion)
    return NONE if part is None else _marked(f"{100 * part:.1f}", found.is_pure(motion))


def _marked(text: str, passes: bool) -> str:
    return f"<b>{text}</b>" if passes else text


def _axes_rows(before: RigidBodyFigures, after: RigidBodyFigures) -> Iterator[list[str]]:
    sides = [_axes_cells(figures.axes) for figures in (before, after)]
    yield [title(after.part.body.label)]
    for what in sides[0]:
        yield [what, *(cells[what] for cells in sides)]


def _axes_cells(axes: BodyAxes) -> dict[str, str]:
    roll, held = axes.torque_roll_axis, axes.held
    torque = held and held.torque_axis
    apart = NONE
    if held is not None and np.isfinite(held.angle):
        apart = f"{np.degrees(held.angle):.2f}°, {1e3 * held.offset:.0f} mm"
    return {
        "torque roll axis": NONE if roll is None else vector(roll.direction),
        "elastic torque axis": NONE if torque is None else vector(torque.direction),
        "between them": apart,
        "elastic centre, m": NONE if held is None or held.center is None else vector(held.center, 3),
    }
