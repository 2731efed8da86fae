"""How stiffly a body is held by its connections: their other ends still, or on all that is elastic."""

from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np
import scipy.linalg
from numpy.typing import NDArray

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ, Modes, solve_modes
from modeviz.dynamics.mount_rates import elastic_stiffness, mounts_of_springs
from modeviz.dynamics.reanalysis import Receptances
from modeviz.dynamics.spring_law import constant_law
from modeviz.errors import SolveError
from modeviz.mounting.rigid_part import RigidPart, rigid_parts
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import LIGHT_ROLES, Body, Role
from modeviz.vehicle.connections import GROUND, MOTIONS, Connection
from modeviz.vehicle.mount_rates import ROTATIONAL_FIELDS, STIFFNESS_FIELDS, MountRates
from modeviz.vehicle.vehicle import Vehicle

FREE = (2 * np.pi * RESOLVED_HZ) ** 2
"""rad²/s²: what is held more softly moves freely."""


@dataclass(frozen=True, eq=False)
class HeldBody:
    """A body, taken as rigid, on the connections that hold it, whose other ends do not move."""

    part: RigidPart
    fixed: Floats
    """(6, 6): the stiffness at its centre of gravity of all that is not tuned."""
    stretch: Floats
    """(n_springs, 6): of every mount spring per unit of its motion."""
    rigid: Floats
    """(n_rigid, 6): what rigid joints do not let it do."""
    springs: NDArray[np.intp]
    """(n_own,): which mount springs hold it."""
    relative: Floats
    """(n_own + n_others, n_dofs): how these and all others that hold it are stretched."""
    other_rates: Floats
    """(n_others,), N/m and N m/rad."""

    def stiffness(self, mount_rates: Floats) -> Floats:
        """Return the stiffness at the centre of gravity, (6, 6); rigid joints are not in it.

        Args:
            mount_rates: (n_springs,), real, N/m and N m/rad.
        """
        return self.fixed + (self.stretch.T * mount_rates) @ self.stretch

    def compliance(self, mount_rates: Floats) -> Floats | None:
        """Return its motion per force and moment at the centre of gravity, (6, 6).

        None if it moves freely in some way. Arguments as `stiffness`.
        """
        left = self.part.moving
        if len(self.rigid):
            left = left @ scipy.linalg.null_space(self.rigid @ left, rcond=1e-9)
        K = left.T @ self.stiffness(mount_rates) @ left
        if len(K) and np.linalg.eigvalsh(K)[0] < FREE:
            return None
        return left @ np.linalg.solve(K, left.T)

    def strain(self, modes: Modes, mount_rates: Floats) -> Floats:
        """Return the part of each mode's strain energy in what holds the body, (n_modes,).

        Zero of modes that move freely.

        Args:
            modes: of the vehicle.
            mount_rates: real, (n_modes or 1, n_springs), those of each mode, N/m and N m/rad.
        """
        stretch = np.square(self.relative @ modes.shapes)
        n_own = len(self.springs)
        twice = np.sum(mount_rates[:, self.springs].T * stretch[:n_own], axis=0)
        twice = twice + self.other_rates @ stretch[n_own:]
        squares = modes.omega_n_squared
        return np.where(squares > FREE, twice / np.maximum(squares, FREE), 0.0)


@lru_cache(maxsize=4)
def held_bodies(system: System) -> tuple[HeldBody, ...]:
    """Return every body on its connections, in their order."""
    return tuple(_held(system, part) for part in rigid_parts(system))


def _held(system: System, part: RigidPart) -> HeldBody:
    vehicle, n_mounts = system.vehicle, len(system.vehicle.mounts)
    holds = holding(vehicle, part.body)
    every = system.connection_motions[:, part.own] @ part.coordinates * np.repeat(holds, 6)[:, None]
    others, rates = every[6 * n_mounts :], system.connection_stiffness[6 * n_mounts :]
    is_rigid = np.array([m in c.rigid for c in vehicle.all_connections for m in MOTIONS], bool)
    rigid = every[is_rigid]
    by_spring = holds[mounts_of_springs(vehicle)]
    springs, own = np.flatnonzero(by_spring), np.repeat(holds[n_mounts:], 6) & (rates > 0)
    return HeldBody(
        part,
        (others.T * rates) @ others,
        system.mount_motions[:, part.own] @ part.coordinates * by_spring[:, None],
        rigid[np.abs(rigid).max(axis=1, initial=0.0) > 0],
        springs,
        np.vstack([system.mount_motions[springs], system.connection_motions[6 * n_mounts :][own]]),
        rates[own],
    )


def holding(vehicle: Vehicle, body: Body) -> NDArray[np.bool_]:
    """Return which of all connections hold a body, (n_connections,).

    What joins it to a linkage, such as a propshaft, or to an absorber does not, for these go along
    with it; unless nothing else holds it, or it is such a body itself.
    """
    holds_nothing = {
        mount.name for g in vehicle.mount_groups if g.kind == "inerter" for mount in g.mounts
    }
    others = [
        None if c.name in holds_nothing else _other_end(vehicle, c, body)
        for c in vehicle.all_connections
    ]
    joined = np.array([other is not None for other in others], bool)
    firm = np.array([other not in (None, *LIGHT_ROLES) for other in others], bool)
    return firm if firm.any() and body.role not in LIGHT_ROLES else joined


def _other_end(vehicle: Vehicle, connection: Connection, body: Body) -> Role | None:
    """The role of what a connection joins a body to, "other" of the ground; None if not this body."""
    if body.name not in connection.bodies:
        return None
    first, second = connection.bodies
    name = second if first == body.name else first
    return "other" if name == GROUND else vehicle.body(name).role


@dataclass(frozen=True, eq=False)
class MountedBodies:
    """All bodies on all that is elastic in the vehicle, at rest.

    The vehicle's ends on the ground are still. A force is spread over a body as its mass is. What
    moves freely, as a vehicle that nothing holds lengthways, is left out of the motion, as if its
    inertia held it (inertia relief).
    """

    receptances: Receptances
    """At 0 Hz: mount springs, and six motions of every body."""

    def compliance(self, number: int, mount_rates: Floats) -> Floats | None:
        """Return the motion of one body per force and moment at its centre of gravity, (6, 6).

        None if with these rates more moves freely than with the vehicle's own.

        Args:
            number: of the body.
            mount_rates: (n_springs,), real, N/m and N m/rad.
        """
        of_body = slice(6 * number, 6 * number + 6)
        every = self.receptances
        own = Receptances(
            every.frequency_hz,
            every.mount_stiffness,
            every.springs,
            every.outputs[:, :, of_body],
            every.inputs[:, :, of_body],
            every.direct[:, of_body, of_body],
            every.law,
        )
        try:
            found = own.response(mount_rates.astype(complex))[0].real
        except SolveError:
            return None
        return found.astype(np.float64)


@lru_cache(maxsize=4)
def mounted_bodies(system: System) -> MountedBodies:
    """Return the bodies of a vehicle, made ready for the static compliance at any mount rates.

    Raises:
        SolveError: as `solve_modes`.
    """
    firm = system.with_rates(_firm(system.vehicle))
    motions = np.zeros((6 * len(system.dofs), system.n_dofs))
    for i, part in enumerate(rigid_parts(system)):
        motions[6 * i : 6 * i + 6, part.own] = part.rows
    n_springs = len(system.mount_motions)
    G = _static_receptances(firm, np.vstack([system.mount_motions, motions]))[None].astype(complex)
    to_bodies = G[:, :n_springs, n_springs:]
    return MountedBodies(
        Receptances(
            np.zeros(1),
            elastic_stiffness(firm.vehicle).astype(complex),
            G[:, :n_springs, :n_springs],
            to_bodies,
            to_bodies,
            G[:, n_springs:, n_springs:],
            constant_law(n_springs),
        )
    )


def _static_receptances(system: System, rows: Floats) -> Floats:
    """The motion along rows per force along others at rest, (n_rows, n_rows), free motions left out."""
    K, M = system.condensed(system.stiffness), system.condensed(system.mass)
    R = system.condensed_rows(rows)
    try:
        scipy.linalg.cholesky(K - FREE * M, check_finite=False)  # there is one if nothing is free
        return R @ scipy.linalg.cho_solve(scipy.linalg.cho_factor(K), R.T)
    except scipy.linalg.LinAlgError:
        modes = solve_modes(system)
        held = modes.omega_n_squared > FREE
        motion = rows @ modes.shapes[:, held] / np.sqrt(modes.omega_n_squared[held])
        return motion @ motion.T


def _firm(vehicle: Vehicle) -> dict[str, MountRates]:
    """The vehicle's own rates, with those of zero as stiff as they can be made.

    So nothing moves freely that a mount can hold: from a spring there is a way to none, but none back.
    """
    springs = (*STIFFNESS_FIELDS, *ROTATIONAL_FIELDS)
    return {
        g.name: replace(g.rates, **{f: getattr(g.rates, f) or getattr(g.bounds[1], f) for f in springs})
        for g in vehicle.mount_groups
    }
