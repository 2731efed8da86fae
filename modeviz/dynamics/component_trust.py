"""Estimates of what truncating the components of a vehicle does to its frequencies.

Modes that a body was given without are missing in every answer, and no solve of the vehicle can tell.
What can be told is how high a body's modes reach, and how much its last ones matter: frequencies only
fall as modes are added (Courant and Fischer), and what the next modes would do is mostly less than what
the last ones did.
"""

import math
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System, connection_coefficients
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.dynamics.rigid_joints import rigid_joints
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import MOTIONS

LAST_PART = 5
"""One of so many elastic modes, the last ones, is left out to see what it does."""


@dataclass(frozen=True)
class ComponentTrust:
    """An estimate of what the truncation of one flexible body does."""

    body: str
    highest_hz: float
    """Of its highest normal mode; zero if all are rigid."""
    n_residuals: int
    """Residual vectors, which hold what the modes left out do statically."""
    n_left_out: int
    """How many of its elastic modes are a fifth."""
    change: float
    """What leaving these out does to natural frequencies of the band at most, a part of them; infinite
    where rigid connections then leave nothing that moves."""
    at_hz: float
    """The natural frequency that it does most to; zero if there is none."""


def component_trust(system: System, top_hz: float) -> tuple[ComponentTrust, ...]:
    """Estimate the truncation of each flexible body of a vehicle, in the order of its bodies.

    It takes as long as an eigenproblem of the vehicle for each.

    Args:
        system: of the vehicle, with the rates that are asked for: stiffer ones need more modes.
        top_hz: of the band that is looked at.

    Raises:
        SolveError: as `solve_modes`.
    """
    f = solve_modes(system, below_hz=top_hz).frequency_hz
    bodies = [body for body in system.vehicle.bodies if isinstance(body, FlexibleBody)]
    return tuple(_trust_in(body, system, f) for body in bodies)


def _trust_in(body: FlexibleBody, system: System, frequency_hz: Floats) -> ComponentTrust:
    n_left_out = math.ceil((body.n_normal - body.n_rigid) / LAST_PART)
    change = np.zeros(1)
    if n_left_out and frequency_hz.size:
        change = _changes(system, _without_last(body, n_left_out, system), frequency_hz)
    worst = int(change.argmax())
    return ComponentTrust(
        body.name,
        float(body.natural_frequency_hz[body.n_normal - 1]),
        body.n_residuals,
        n_left_out,
        float(change[worst]),
        float(frequency_hz[worst]) if frequency_hz.size else 0.0,
    )


def _without_last(body: FlexibleBody, n_left_out: int, system: System) -> Floats:
    """Coordinates (n_dofs, n_fewer) of a vehicle one of whose bodies lacks its last elastic modes.

    Its residual vectors are made anew, as many as it had at most: what the modes left out and the old
    ones do statically in the directions in which the vehicle pulls at the body.
    """
    own = system.dofs[body.name]
    more = np.arange(own.start + body.n_normal - n_left_out, own.stop)
    kept = np.delete(np.eye(system.n_dofs), more, axis=1)
    if not body.n_residuals:
        return kept
    omega_n = np.sqrt(body.omega_n_squared[-len(more) :])
    static = _pulls(system)[:, more] / omega_n
    directions = np.linalg.svd(static, full_matrices=False)[2][
        : min(body.n_residuals, np.linalg.matrix_rank(static))
    ]
    residuals = np.zeros((system.n_dofs, len(directions)))
    residuals[more] = directions.T / omega_n[:, None]
    return np.hstack([kept, residuals])


def _pulls(system: System) -> Floats:
    """Rows (n_directions, n_dofs) along which connections and added masses pull at bodies."""
    connections = system.vehicle.all_connections
    coefficients = [np.add(*connection_coefficients(c)[:2]) for c in connections]
    held = [[m in c.rigid for m in MOTIONS] for c in connections]
    pulling = (np.ravel(coefficients) > 0) | np.ravel(held).astype(bool)
    carried = [system.motion(a.body, a.position)[:3] for a in system.vehicle.added_masses]
    return np.vstack([system.connection_motions[pulling], *carried])


def _changes(system: System, coordinates: Floats, frequency_hz: Floats) -> Floats:
    """The part by which each natural frequency rises where only some coordinates move."""
    T = coordinates
    if system.rigid_joints is not None:
        joints = rigid_joints(T.T @ system.mass @ T, system.rigid_joints.held @ T)
        T = T @ joints.freedom
    if not T.size:
        return np.full(len(frequency_hz), np.inf)
    K, M = T.T @ system.stiffness @ T, T.T @ system.mass @ T
    last = min(len(frequency_hz), len(M)) - 1
    squares = scipy.linalg.eigh(K, M, eigvals_only=True, subset_by_index=[0, last])
    higher = np.sqrt(np.maximum(squares, 0.0)) / (2 * np.pi)
    before = frequency_hz[: len(higher)]
    vibrates = before > RESOLVED_HZ
    return np.where(vibrates, higher / np.where(vibrates, before, 1.0) - 1, 0.0)
