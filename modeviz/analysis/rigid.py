"""Rigid bodies on their mounts with some mount rates: purity of their modes, axes and centres."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.modal_results import ModalResults
from modeviz.mounting.axes import ElasticAxes, Line, elastic_axes, torque_roll_axis
from modeviz.mounting.focus import Focus, focus
from modeviz.mounting.frames import crank_direction, frame, has_crank
from modeviz.mounting.purity import Purity, direction_energy, sorted_modes
from modeviz.mounting.rigid_part import RigidPart, rigid_parts
from modeviz.mounting.stiffness import held_bodies, mounted_bodies
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import LIGHT_ROLES
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.decoupling import Axes, Decoupling
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class BodyAxes:
    """Axes and centres of one body."""

    crank: Floats
    """(3,), the direction of its crank."""
    has_crank: bool
    """Whether it has one; else that is the direction of any torque on it."""
    torque_roll_axis: Line | None
    held: ElasticAxes | None
    """With the other ends of what holds it still; None if it moves freely then."""
    mounted: ElasticAxes | None
    """On all that is elastic, down to the ground; None if more moves freely than with its own rates."""
    focus: Focus | None


@dataclass(frozen=True, eq=False)
class RigidBodyFigures:
    """A rigid body, or the rigid part of a flexible one, on its mounts."""

    part: RigidPart
    frame: Floats
    """(3, 3): the axes along which energy is told, as rows."""
    purity: Purity
    axes: BodyAxes

    @property
    def name(self) -> str:
        return self.part.body.name


def body_purity(
    results: ModalResults, number: int, axes: Axes, targets: Decoupling, crank: Floats | None = None
) -> Purity:
    """Return how pure the modes of one body are.

    Args:
        results: its modes.
        number: of the body.
        axes: along which its energy is told.
        targets: what it is held against.
        crank: its direction, (3,), if not the body's own.
    """
    held = held_bodies(results.prepared.system)[number]
    part, modes = held.part, results.modes
    direction = crank_direction(part) if crank is None else crank
    turned = frame(part, axes, direction)
    energy = direction_energy(part, modes.shapes, turned)
    return Purity(
        modes.frequency_hz,
        energy,
        results.kinetic_energy[part.body.name],
        sorted_modes(energy, held.strain(modes, results.band.springs.real.astype(np.float64))),
        targets,
        MOTIONS[3 + int(np.argmax(np.abs(turned @ direction)))],
        has_crank(part.body),
    )


def body_axes(results: ModalResults, number: int, crank: Floats | None = None) -> BodyAxes:
    """Return the axes and centres of one body; arguments as `body_purity`."""
    system = results.prepared.system
    rates, held = results.mount_rates, held_bodies(system)[number]
    part = held.part
    direction = crank_direction(part) if crank is None else crank
    roll, mounts = torque_roll_axis(part, direction), system.vehicle.mounts
    still = held.compliance(rates)
    mounted = mounted_bodies(system).compliance(number, rates)
    return BodyAxes(
        direction,
        has_crank(part.body),
        roll,
        None if still is None else elastic_axes(part.center, still, direction, roll),
        None if mounted is None else elastic_axes(part.center, mounted, direction, roll),
        focus(mounts, rates[: 3 * len(mounts)].reshape(-1, 3), part.body.name),
    )


def rigid_figures(
    results: ModalResults,
    axes: Axes = "vehicle",
    bodies: Sequence[str] = (),
    targets: Decoupling | None = None,
) -> tuple[RigidBodyFigures, ...]:
    """Return the figures of bodies on their mounts.

    Args:
        results: the modes.
        axes: along which energy is told.
        bodies: their names; all, if none is given.
        targets: what purity and frequencies are held against; None: the vehicle's.

    Raises:
        VehicleError: there is no such body, or `solve_modes` fails.
    """
    vehicle, wanted = results.vehicle, set(bodies)
    for name in bodies:
        vehicle.body(name)
    parts = rigid_parts(results.prepared.system)
    return tuple(
        RigidBodyFigures(
            part,
            frame(part, axes, crank_direction(part)),
            body_purity(results, i, axes, targets or vehicle.decoupling),
            body_axes(results, i),
        )
        for i, part in enumerate(parts)
        if not wanted or part.body.name in wanted
    )


def usual_body(vehicle: Vehicle) -> str:
    """Return the name of the body to look at first: the powertrain, what is on mounts, or any."""
    on_mounts = {name for mount in vehicle.mounts for name in mount.bodies}
    main = main_bodies(vehicle)
    engines = [body.name for body in vehicle.bodies if body.role == "powertrain"]
    mounted = [name for name in main if name in on_mounts]
    return (*engines, *mounted, *main)[0]


def main_bodies(vehicle: Vehicle) -> tuple[str, ...]:
    """Return the names of the bodies that are neither light parts nor wheels, or of all if all are."""
    names = tuple(b.name for b in vehicle.bodies if b.role not in (*LIGHT_ROLES, "unsprung"))
    return names or tuple(body.name for body in vehicle.bodies)
