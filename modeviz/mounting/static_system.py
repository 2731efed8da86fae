"""A vehicle made ready for loads that stay, at any mount rates.

    K x = F

K has the rates under a load that stays, those of mounts softer than when they vibrate. What no mount
rate changes is solved for once, at the vehicle's own rates:

    x = x₀ + K₀⁻¹Rᵀ q,    x₀ = K₀⁻¹F,    q = -(k - k₀) R x

R are the rows that stretch the mount springs, q the forces by which springs do less than those of K₀
would. Motions are small: no load turns with what it acts on.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System
from modeviz.dynamics.motions import rigid_coordinates
from modeviz.dynamics.mount_rates import (
    MountSprings,
    elastic_stiffness,
    rows_of_springs,
    static_ratios,
)
from modeviz.errors import SolveError
from modeviz.mounting.held import FreeMotions, body_rows, free_motions_of
from modeviz.mounting.settling import Settling
from modeviz.mounting.springs import SpringLaws, spring_laws
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import FlexibleBody
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.load_cases import LoadCase, StaticLoad
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

FREE_HZ = 10.0
"""What nothing holds is given springs of this frequency while it is solved for: loads without what
accelerates it do not move it."""


@dataclass(frozen=True)
class RefusedCase:
    """A load case that has no answer."""

    name: str
    reason: str
    """A sentence."""


@dataclass(frozen=True, eq=False)
class HeldCase:
    """A load case, and what of it the vehicle's springs and joints balance."""

    case: LoadCase
    notes: tuple[str, ...]
    """Sentences on what nothing holds."""
    force: Floats
    """(n_dofs,): its loads, less the mass that they accelerate."""


@dataclass(frozen=True, eq=False)
class PreparedStatics:
    """A vehicle made ready for its load cases at any mount rates."""

    system: System
    """With the vehicle's own rates, as they vibrate."""
    cases: tuple[HeldCase, ...]
    refused: tuple[RefusedCase, ...]
    base: Floats
    """k₀, (n_springs,), N/m and N m/rad: the rates under a load that stays that are in K₀."""
    sag: Floats
    """x₀, (n_dofs, n_cases)."""
    compliance: Floats
    """K₀⁻¹Rᵀ, (n_dofs, n_springs)."""

    @property
    def vehicle(self) -> Vehicle:
        """With its own rates."""
        return self.system.vehicle

    @cached_property
    def springs(self) -> MountSprings:
        """The springs of the mounts, at any rates."""
        return MountSprings(self.vehicle)

    @cached_property
    def between_springs(self) -> Floats:
        """R K₀⁻¹Rᵀ, (n_springs, n_springs), m/N."""
        return self.system.mount_motions @ self.compliance

    @cached_property
    def body_rows(self) -> Mapping[str, Floats]:
        """Rows (6, n_dofs) of each body, see `body_rows`."""
        return {body.name: body_rows(self.system, body.name) for body in self.vehicle.bodies}

    @cached_property
    def forces(self) -> Floats:
        """(n_dofs, n_cases): what is balanced in each case."""
        return np.stack([held.force for held in self.cases], axis=1)

    @cached_property
    def stretched(self) -> Floats:
        """R x₀, (n_springs, n_cases)."""
        return self.system.mount_motions @ self.sag

    @cached_property
    def spring_names(self) -> tuple[str, ...]:
        """Of the mount springs: the mount and the motion that it resists."""
        every = [
            f"mount {mount.name!r} along {motion}"
            for mount in self.vehicle.mounts
            for motion in MOTIONS
        ]
        return tuple(every[row] for row in rows_of_springs(self.vehicle))

    @cached_property
    def laws(self) -> SpringLaws:
        """What the mount springs do."""
        return spring_laws(self.vehicle)

    def settling(self, rates: Rates) -> Settling:
        """Return the mount springs under a load that stays.

        Args:
            rates: of the groups that differ from the vehicle's own.

        Raises:
            VehicleError: a group that the vehicle does not have.
        """
        unloaded = self.springs.elastic(rates) / static_ratios(self.vehicle)
        return Settling(self.laws, unloaded, self.base, self.between_springs)


def prepare_statics(system: System, cases: Sequence[LoadCase] | None = None) -> PreparedStatics:
    """Return a vehicle made ready for load cases at any mount rates.

    A mount without a rate is given its stiffest in K₀, so that what it could hold is held.

    Args:
        system: of the vehicle.
        cases: None: the vehicle's, or the usual ones if it has none.

    Raises:
        SolveError: nothing is held in any of the cases, with the reason of the first; or as
            `solve_modes`.
    """
    vehicle = system.vehicle
    own = elastic_stiffness(vehicle)
    stiffest = MountSprings(vehicle).elastic({g.name: g.bounds[1] for g in vehicle.mount_groups})
    k0 = np.where(own > 0, own, stiffest) / static_ratios(vehicle)
    standing = system.with_springs((k0 - own).astype(complex))
    free = free_motions_of(standing)
    held, refused = _held(free, vehicle.static_cases if cases is None else cases)
    if not held:
        raise SolveError(f"load case {refused[0].name!r}: {refused[0].reason}")
    forces = np.stack([one.force for one in held], axis=1)
    x = _solved(standing, free, np.hstack([forces, system.mount_motions.T]))
    return PreparedStatics(system, held, refused, k0, x[:, : len(held)], x[:, len(held) :])


def _held(
    free: FreeMotions, cases: Sequence[LoadCase]
) -> tuple[tuple[HeldCase, ...], tuple[RefusedCase, ...]]:
    """The load cases that have an answer, and those that do not."""
    held: list[HeldCase] = []
    refused: list[RefusedCase] = []
    for case in cases:
        try:
            relief = free.relieved(_force(free.system, case))
        except SolveError as error:
            refused.append(RefusedCase(case.name, str(error)))
        else:
            held.append(HeldCase(case, relief.notes, relief.forces))
    return tuple(held), tuple(refused)


def _force(system: System, case: LoadCase) -> Floats:
    """The loads of a case on the generalised coordinates, (n_dofs,)."""
    falling = rigid_coordinates(system, system.vehicle.bodies, np.zeros(3))[:, :3]
    weight = system.mass @ falling @ (STANDARD_GRAVITY * case.load_g)
    return weight + sum((_acting(system, load) for load in case.loads), np.zeros_like(weight))


def _acting(system: System, load: StaticLoad) -> Floats:
    """A load on a body on the generalised coordinates, (n_dofs,).

    On the centre of gravity of a flexible body it acts as mass does, straining nothing by itself.
    """
    body = system.vehicle.body(load.body)
    action = np.concatenate([load.force, load.torque])
    if load.position is not None:
        return system.motion(load.body, load.position).T @ action
    X = rigid_coordinates(system, [body], body.center_of_gravity)
    if not isinstance(body, FlexibleBody):
        return X @ action
    own = X.T @ X  # the modal mass is one
    return X @ np.linalg.lstsq(own, action, rcond=None)[0]


def _solved(system: System, free: FreeMotions, forces: Floats) -> Floats:
    """K⁻¹ of forces that accelerate nothing, (n_dofs, n_forces), without a share of free motions.

    Raises:
        SolveError: rounding drowns the stiffness of what is held.
    """
    K = system.condensed(system.stiffness)
    P = system.condensed_rows(free.shapes.T @ system.mass)
    held = K + (2 * np.pi * FREE_HZ) ** 2 * P.T @ P
    try:
        y = scipy.linalg.solve(held, system.condensed_rows(forces.T).T, assume_a="pos")
    except scipy.linalg.LinAlgError as error:
        raise SolveError(f"the sag cannot be found: {error}") from None
    return system.expanded(y)
