"""How a vehicle sags under loads that stay, and what its mounts and other connections then carry."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.dynamics.assembly import is_rigid
from modeviz.dynamics.mount_rates import are_dampers, rows_of_springs
from modeviz.errors import SolveError, VehicleError, quoted, unknown
from modeviz.mounting.settling import Settling
from modeviz.mounting.static_system import HeldCase, PreparedStatics, RefusedCase
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import Connection
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

LARGE_TURN = np.radians(5.0)
"""What is linear in a rotation θ is off by θ/2 of itself, some 4 % here, as rates are at best known."""


@dataclass(frozen=True, eq=False)
class Carried:
    """What a connection does in a load case, along and about its local axes: x, y, z, rx, ry, rz."""

    connection: Connection
    """With the vehicle's own rates."""
    deflection: Floats
    """(6,), m and rad: how far its first body has gone from the second."""
    force: Floats
    """(6,), N and N m, on its first body at the elastic centre; the second has the opposite."""

    @property
    def vehicle_force(self) -> Floats:
        """The same force and moment along and about the vehicle's axes, (6,)."""
        return np.kron(np.eye(2), self.connection.axes.T) @ self.force


@dataclass(frozen=True, eq=False)
class StaticCase:
    """A vehicle in one load case."""

    name: str
    notes: tuple[str, ...]
    """Sentences on what nothing holds, on bodies that turn far, and on mounts beyond their curves."""
    motion: Floats
    """(n_dofs,), in the generalised coordinates."""
    bodies: Mapping[str, Floats]
    """x, y, z, rx, ry, rz of the centre of gravity, (6,), m and rad, by the body's name; of a flexible
    body what its rigid modes do."""
    connections: Mapping[str, Carried]
    """By the connection's name, mounts first."""


@dataclass(frozen=True, eq=False)
class Statics:
    """A vehicle in its load cases."""

    prepared: PreparedStatics
    rates: Rates
    """Of the groups that differ from the prepared vehicle's own."""
    cases: tuple[StaticCase, ...]
    refused: tuple[RefusedCase, ...]

    @cached_property
    def vehicle(self) -> Vehicle:
        """With the rates that it has there."""
        return self.prepared.vehicle.with_rates(self.rates)

    def case(self, name: str) -> StaticCase:
        """Return the case of that name.

        Raises:
            VehicleError: there is none, with the names there are.
            SolveError: it has no answer, and why.
        """
        return self.chosen((name,)).cases[0]

    def chosen(self, names: Sequence[str]) -> "Statics":
        """Return some cases alone, all if none is named; raises as `case`."""
        if not names:
            return self
        by_name = {case.name: case for case in self.cases}
        why_not = {refused.name: refused.reason for refused in self.refused}
        for name in names:
            if name in why_not:
                raise SolveError(f"load case {name!r}: {why_not[name]}")
            if name not in by_name:
                raise VehicleError(unknown("load case", name, (*by_name, *why_not)))
        return replace(self, cases=tuple(by_name[name] for name in names), refused=())


def solve_statics(prepared: PreparedStatics, rates: Rates) -> Statics:
    """Return a vehicle in its load cases with other mount rates.

    Args:
        prepared: see `prepare_statics`.
        rates: of the groups that differ from the vehicle's own.

    Raises:
        VehicleError: a group that the vehicle does not have.
        SolveError: with these rates nothing holds what a mount held, or progressive mounts do not
            settle.
    """
    settling = prepared.settling(rates)
    x = prepared.sag + prepared.compliance @ _missing(prepared, settling)
    stretched = prepared.system.mount_motions @ x
    of_mounts = [settling.laws.force(settling.stiffness, d) for d in stretched.T]
    forces = _forces(prepared, x, np.array(of_mounts).T)
    cases = (_case(prepared, held, x[:, i], forces[:, i]) for i, held in enumerate(prepared.cases))
    return Statics(prepared, rates, tuple(cases), prepared.refused)


def _missing(prepared: PreparedStatics, settling: Settling) -> Floats:
    """q, (n_springs, n_cases): the forces that springs lack of those that K₀ has."""
    if not settling.laws.curves:
        return settling.straight(prepared.stretched)
    settled = (
        settling.settled(d, held.case.name, prepared.spring_names)
        for d, held in zip(prepared.stretched.T, prepared.cases, strict=True)
    )
    return np.stack(list(settled), axis=1)


def _forces(prepared: PreparedStatics, x: Floats, of_mounts: Floats) -> Floats:
    """What every connection does to its first body along its axes, (6 n_connections, n_cases).

    Rigid joints carry Uᵀ times what springs leave of the loads; where joints hold more than is needed,
    it is shared so that the squares are least.

    Args:
        prepared: of the vehicle.
        x: (n_dofs, n_cases).
        of_mounts: (n_springs, n_cases), with which the mounts resist.
    """
    system, vehicle = prepared.system, prepared.vehicle
    springs = ~are_dampers(vehicle)
    rows, of_mounts = rows_of_springs(vehicle)[springs], of_mounts[springs]
    resisting = system.connection_stiffness[:, None] * (system.connection_motions @ x)
    change = of_mounts - resisting[rows]
    resisting[rows] = of_mounts
    if system.rigid_joints is not None:
        left = prepared.forces - system.stiffness @ x - system.mount_motions[springs].T @ change
        resisting[is_rigid(vehicle)] += system.rigid_joints.led.T @ left
    return -resisting


def _case(prepared: PreparedStatics, held: HeldCase, x: Floats, forces: Floats) -> StaticCase:
    """The answer to a case from its motion, (n_dofs,), and the forces on first bodies, (n_rows,)."""
    deflections = (prepared.system.connection_motions @ x).reshape(-1, 6)
    bodies = {body: rows @ x for body, rows in prepared.body_rows.items()}
    every = zip(prepared.vehicle.all_connections, deflections, forces.reshape(-1, 6), strict=True)
    return StaticCase(
        held.case.name,
        (*held.notes, *_turned(bodies), *_beyond(prepared, deflections)),
        x,
        bodies,
        {connection.name: Carried(connection, d, f) for connection, d, f in every},
    )


def _turned(bodies: Mapping[str, Floats]) -> Iterator[str]:
    """Sentences on bodies that turn so far that their motion is no longer linear in it.

    A place at an arm r moves by r sin θ along and r (1 - cos θ) across, of which r θ is left.
    """
    for name, motion in bodies.items():
        turn = float(np.linalg.norm(motion[3:]))
        if turn > LARGE_TURN:
            yield (
                f"body {quoted(name)} turns by {np.degrees(turn):.3g}°, and turns are taken for small: "
                f"what it moves and what its mounts carry is known to about {50 * turn:.0f} %"
            )


def _beyond(prepared: PreparedStatics, deflections: Floats) -> Iterator[str]:
    """Sentences on progressive mounts that are where their curves say nothing.

    Args:
        prepared: of the vehicle.
        deflections: (n_connections, 6).
    """
    rows = rows_of_springs(prepared.vehicle)
    for spring, curve in prepared.laws.curves.items():
        d = float(deflections.reshape(-1)[rows[spring]])
        if not curve.deflection[0] <= d <= curve.deflection[-1]:
            yield (
                f"{prepared.spring_names[spring]} is at {1e3 * d:.3g} mm, beyond the last point of its "
                "curve, which is taken to go on straight"
            )
