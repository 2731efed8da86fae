"""A block on one mount that stands on a flexible sheet, which stands on springs."""

from dataclasses import replace
from functools import cache

import numpy as np
from small_meshes import STEEL, shell

from modeviz.fem.attachments import OnFootprint, OnNode
from modeviz.fem.component import body_from_matrices
from modeviz.fem.matrices import assemble as assemble_mesh
from modeviz.fem.mesh import ShellSection
from modeviz.vehicle.bodies import FlexibleBody, RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Spring
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, usual_bounds
from modeviz.vehicle.placement import Placement, with_placements
from modeviz.vehicle.vehicle import Vehicle

N_U, N_V = 22, 16
HELD = [25, 57, 300, 371]
"""Nodes in the corners on which the sheet stands."""
A, B = 130, 180
RATES = MountRates(3e4, 2e4, 2e4)


@cache
def matrices():
    section = ShellSection(0.004, **STEEL)
    return assemble_mesh(shell(lambda u, v: (1.1 * u, 0.8 * v, 0.1 * u * v), N_U, N_V, section))


def place(node):
    return matrices().nodes[node]


@cache
def sheet(*points) -> FlexibleBody:
    on_nodes = tuple(OnNode(f"held {n}", place(n), n) for n in HELD)
    return body_from_matrices("sheet", "frame", "sheet", matrices(), (*on_nodes, *points), 50, 0.01)


def at(node, name="mount") -> OnNode:
    return OnNode(name, place(node), node)


def beyond(position, *offset):
    return np.add(position, offset)


def near(node, name="mount") -> OnFootprint:
    apart = np.linalg.norm(matrices().nodes - place(node), axis=1)
    around = np.argsort(apart)[:9]
    return OnFootprint(name, matrices().nodes[around].mean(axis=0), tuple(around.tolist()))


def on_a_block(body, position, corners=HELD) -> Vehicle:
    """The sheet on springs; a block on a mount at some place of it."""
    springs = tuple(
        Spring(
            f"s{i}", "springs", ("sheet", GROUND), np.tile(place(n), (2, 1)), stiffness=np.full(3, 5e4)
        )
        for i, n in enumerate(corners)
    )
    ends = np.tile(np.asarray(position, float), (2, 1))
    mount = Mount("m", "m", ("block", "sheet"), ends, rotational_stiffness=np.full(3, 50.0))
    block = RigidBody("block", "powertrain", "block", 8.0, ends[0] + [0, 0, 0.05], 0.05 * np.eye(3))
    group = MountGroup("m", "m", RATES, 0.1, usual_bounds(RATES), (mount,))
    return Vehicle("sheet", (body, block), springs, (group,))


def moved(vehicle, to) -> Vehicle:
    """With its mount there, and its block with it."""
    offset = np.asarray(to, float) - vehicle.mounts[0].center
    bodies = tuple(
        replace(b, center_of_gravity=b.center_of_gravity + offset) if isinstance(b, RigidBody) else b
        for b in vehicle.bodies
    )
    return with_placements(replace(vehicle, bodies=bodies), {"m": Placement(tuple(offset))})
