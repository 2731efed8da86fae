"""Estimates of the memory and work that the responses of a vehicle take, made beforehand."""

from dataclasses import dataclass

import numpy as np

from modeviz.files.limits import check_size
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import GROUND, Connection
from modeviz.vehicle.mount_rates import OTHER_FIELDS
from modeviz.vehicle.vehicle import Vehicle

MOST_NUMBERS = 50_000_000
"""Complex ones that are kept, 0.8 GB; with other rates there are as many again."""

MOST_OPERATIONS = 300_000_000_000
"""With floating-point numbers: 10 s of one core."""

AT_ONCE = 24
"""Matrices of the equations of a frequency that are there while some are solved side by side."""

PER_POLE = 5
"""Frequencies at which the equations are solved to find a pole."""


def check_workload(vehicle: Vehicle) -> None:
    """Checks that a vehicle's responses can be had in a few seconds and two gigabytes.

    Raises:
        VehicleError: there is too much that multiplies; the text says what.
    """
    n = counted(vehicle)
    where = f"at {n.lines:,} frequencies"
    among = f"{n.springs:,} mount springs, {n.outputs:,} directions of points and {n.inputs:,} of loads"
    check_size(f"responses among {among} {where}", n.receptances, MOST_NUMBERS)
    check_size(f"operations to solve {n.rows:,} directions {where}", n.operations, MOST_OPERATIONS)
    check_size(f"responses to {n.loads:,} harmonic loads {where}", n.responses, MOST_NUMBERS)


@dataclass(frozen=True)
class Counts:
    """Counts of all that multiplies, see `dynamics.receptance`."""

    lines: int
    """Of the band."""
    springs: int
    """Of mounts."""
    outputs: int
    inputs: int
    loads: int
    """Harmonic ones, all of which are answered at once."""
    joints: int
    """Directions that are joined, at most."""
    modes: int
    """Of the body that has most."""
    slow: int
    """Modes in the band, at most: springs only raise those that bodies have by themselves."""

    @property
    def rows(self) -> int:
        return self.springs + self.outputs + self.inputs

    @property
    def receptances(self) -> int:
        """The receptances kept at the lines, and those at work at once."""
        kept = self.springs * self.rows + self.outputs * self.inputs
        return self.lines * kept + AT_ONCE * (self.joints + self.rows) ** 2

    @property
    def operations(self) -> int:
        """To solve the equations of the joints for all rows, wherever that is done."""
        n, m = self.joints, self.rows
        solved = 8 * (n**3 // 3 + n**2 * m + n * m**2) + 4 * (n + m) ** 2 * self.modes
        return (self.lines + PER_POLE * self.slow) * solved

    @property
    def responses(self) -> int:
        """The responses of inputs, springs and outputs to the loads."""
        each = 2 * (self.inputs + self.springs) + self.springs + self.outputs
        return self.lines * self.loads * each


def counted(vehicle: Vehicle) -> Counts:
    """Return how many a vehicle has of what multiplies."""
    joints = 3 * len(vehicle.added_masses) + sum(map(_n_joined, vehicle.all_connections))
    others = sum(
        int(np.count_nonzero(mount.rotational_stiffness)) + len(set(group.fields) & {*OTHER_FIELDS})
        for group in vehicle.mount_groups
        for mount in group.mounts
    )
    flexible = [body for body in vehicle.bodies if isinstance(body, FlexibleBody)]
    n_rigid = len(vehicle.bodies) - len(flexible)
    top = (2 * np.pi * vehicle.highest_frequency) ** 2
    return Counts(
        lines=len(vehicle.frequency_hz),
        springs=3 * len(vehicle.mounts) + others,
        outputs=3 * len(vehicle.response_points),
        inputs=6 * len(vehicle.tyres) + len(vehicle.forces) + 3 * _n_moved(vehicle),
        loads=len(vehicle.harmonic_loads),
        joints=joints,
        modes=max([6, *(body.n_modes for body in flexible)]),
        slow=min(6 * n_rigid, joints)
        + sum(int(np.count_nonzero(body.omega_n_squared < top)) for body in flexible),
    )


def _n_joined(connection: Connection) -> int:
    """The number of motions that a connection joins."""
    along = connection.stiffness + connection.damping
    about = connection.rotational_stiffness + connection.rotational_damping
    return int(np.count_nonzero([*along, *about])) + len(connection.rigid)


def _n_moved(vehicle: Vehicle) -> int:
    """The number of connections, at most, whose ground end a base motion moves."""
    if all(motion.connections for motion in vehicle.base_motions):
        return len({name for motion in vehicle.base_motions for name in motion.connections})
    return sum(connection.bodies[1] == GROUND for connection in vehicle.all_connections)
