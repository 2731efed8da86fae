"""The whole truck, from its parameters."""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.fem.attachments import AttachmentPoint, Axis, OnFootprint, OnNearestNodes, OnNode
from modeviz.fem.component import flexible_body
from modeviz.vehicle.bodies import AddedMass, FlexibleBody, Role
from modeviz.vehicle.connections import Connection
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.vehicle import Vehicle
from pickup.box import box
from pickup.cab import cab
from pickup.connections import connections
from pickup.dressing.meshes import display_meshes
from pickup.frame import frame
from pickup.front_end import front_end
from pickup.half_mesh import Structure
from pickup.loads import FOOTPRINTS, added_masses, response_points, wheel_loads
from pickup.mounts import OPTIMISED, ORIGINAL, mount_groups
from pickup.parameters import Parameters
from pickup.problem import paper_problem
from pickup.rigid_bodies import rigid_bodies
from pickup.roads import SPEED, RoadShapes, roads

DAMPING_RATIO = 0.03
"""Of every component mode; the paper gives none."""


@dataclass(frozen=True)
class Component:
    """A flexible body before it is solved."""

    name: str
    role: Role
    structure: Structure
    n_modes: int
    """The paper's, the six rigid ones included."""
    stiffness_factor: float = 1.0
    mass_factor: float = 1.0


def components(p: Parameters) -> tuple[Component, ...]:
    """The four flexible bodies."""
    return (
        Component(
            "front end", "cabin", front_end(), 60, p.front_end_stiffness_factor, p.front_end_mass_factor
        ),
        Component("cab", "cabin", cab(), 40, p.cab_stiffness_factor, p.cab_mass_factor),
        Component("box", "bed", box(), 40, p.box_stiffness_factor, p.box_mass_factor),
        Component("frame", "frame", frame(p), 30),
    )


def pickup(
    p: Parameters,
    solve: Callable[..., FlexibleBody] = flexible_body,
    road_shapes: RoadShapes | None = None,
) -> Vehicle:
    """The truck at its original rates.

    Args:
        p: its numbers.
        solve: what makes bodies of components; the calibration has one that remembers.
        road_shapes: of its roads, if not the built-in ones.
    """
    groups, fixed = mount_groups(p), connections(p)
    joints = (*(m for g in groups for m in g.mounts), *fixed)
    masses, points = added_masses(p), response_points(p)
    parts = components(p)
    meshes = display_meshes({part.name: part.structure for part in parts}, p)
    tracks, loads = roads(road_shapes or RoadShapes()), wheel_loads()

    def solved(part: Component) -> FlexibleBody:
        return solve(
            part.name,
            part.role,
            part.name,
            part.structure.mesh,
            attachments(part.name, part.structure, joints, masses, points),
            part.n_modes,
            DAMPING_RATIO,
            meshes[part.name],
            part.stiffness_factor,
            part.mass_factor,
        )

    return Vehicle(
        name="Pickup",
        bodies=(*(solved(part) for part in parts), *rigid_bodies(p, meshes)),
        connections=fixed,
        mount_groups=groups,
        added_masses=masses,
        response_points=points,
        roads=tracks,
        wheel_loads=loads,
        rate_sets={"original": ORIGINAL, "optimised": OPTIMISED},
        speed=SPEED,
        problems=(paper_problem(tracks[0], loads),),
    )


def attachments(
    body: str,
    structure: Structure,
    joints: Iterable[Connection],
    masses: Iterable[AddedMass],
    points: Iterable[ResponsePoint],
) -> Sequence[AttachmentPoint]:
    """Where anything hangs on a flexible body, each with the directions in which it pulls."""
    ends = [
        OnNode(joint.name, place, structure.node_near(place), directions=_pulling(joint))
        for joint in joints
        for name, place in zip(joint.bodies, joint.points, strict=True)
        if name == body
    ]
    loads = [
        OnFootprint(mass.name, mass.position, tuple(map(structure.node_near, FOOTPRINTS[mass.name])))
        for mass in masses
        if mass.body == body
    ]
    read = [OnNearestNodes(p.name, p.position, directions=()) for p in points if p.body == body]
    return [*ends, *loads, *read]


def _pulling(joint: Connection) -> tuple[Axis, ...]:
    pulls = (joint.stiffness > 0) | (joint.damping > 0)
    along = (np.abs(joint.axes[pulls]) > 1e-9).any(axis=0)
    axes: tuple[Axis, ...] = ("x", "y", "z")
    return tuple(axes[i] for i in np.flatnonzero(along))
