"""What a vehicle can do without straining anything: as a whole, and as mechanisms within it."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.dynamics.motions import MASSLESS, center_of_gravity, rigid_coordinates, rigid_rows
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.islands import islands

MOSTLY = 0.95
"""A motion with more than this part of its kinetic energy in something is that thing's."""

TAKES_PART = 0.02
"""A body with less than this part of the kinetic energy goes unmentioned."""


@dataclass(frozen=True)
class FreeMotion:
    """A motion that no spring and no joint holds."""

    bodies: tuple[str, ...]
    """Those that move, the one with most kinetic energy first."""
    motion: str
    """Of `MOTIONS`: what the first of them, or all as one, mostly do."""
    is_whole: bool
    """Whether all that hangs together moves as one body; the others are mechanisms."""


def free_motions(system: System) -> tuple[FreeMotion, ...]:
    """Return the motions of a vehicle that nothing holds, those of wholes first.

    Any mix of free motions is one, so they are sorted: first the rigid motions of all that hangs
    together, then what single bodies do by themselves, then what is left.

    Raises:
        SolveError: as `solve_modes`.
    """
    phi = solve_modes(system, below_hz=RESOLVED_HZ).shapes
    found: list[FreeMotion] = []
    for island in islands(system.vehicle):
        whole = [system.vehicle.body(name) for name in island.bodies]
        coordinates = rigid_coordinates(system, whole, center_of_gravity(system, whole))
        own, phi = _split(phi, _orthonormal(coordinates, system.mass) @ phi)
        found += [
            FreeMotion(island.bodies, motion, True) for motion in _motions(system, island.bodies, own)
        ]
    for body, dofs in system.dofs.items():
        root = scipy.linalg.cholesky(system.mass[dofs, dofs])
        own, phi = _split(phi, root @ phi[dofs])
        found += [FreeMotion((body,), motion, False) for motion in _motions(system, (body,), own)]
    return (*found, *(_shared(system, shape) for shape in phi.T))


def _orthonormal(coordinates: Floats, mass: Floats) -> Floats:
    """Rows that give a shape's parts in the space of some coordinates, orthonormal in mass."""
    squares, directions = np.linalg.eigh(coordinates.T @ mass @ coordinates)
    kept = squares > MASSLESS * squares.max()
    return (coordinates @ directions[:, kept] / np.sqrt(squares[kept])).T @ mass


def _split(phi: Floats, parts: Floats) -> tuple[Floats, Floats]:
    """Shapes sorted into those that are mostly in some parts, and the others.

    Args:
        phi: (n_dofs, n_shapes), orthonormal in mass.
        parts: (n_parts, n_shapes), whose squares add up to the energy of the parts.
    """
    if not phi.shape[1]:
        return phi, phi
    shares, mix = np.linalg.eigh(parts.T @ parts)
    mixed = phi @ mix[:, ::-1]
    n_own = int((shares > MOSTLY).sum())
    return mixed[:, :n_own], mixed[:, n_own:]


def _motions(system: System, bodies: Sequence[str], shapes: Floats) -> list[str]:
    """What bodies as one do in shapes, as different motions as can be."""
    rows = rigid_rows(system, [system.vehicle.body(name) for name in bodies])
    shares = (rows @ shapes) ** 2
    left = shares.sum(axis=1)  # of a motion in all shapes: they may be mixed
    order = np.argsort(-left, kind="stable")[: shapes.shape[1]]
    return [MOTIONS[i] for i in sorted(order)]


def _shared(system: System, shape: Floats) -> FreeMotion:
    """A free motion in which several bodies take part."""
    energy = {name: float(shape[d] @ system.mass[d, d] @ shape[d]) for name, d in system.dofs.items()}
    moving = sorted((name for name in energy if energy[name] > TAKES_PART), key=lambda n: -energy[n])
    (motion,) = _motions(system, moving[:1], shape[:, None])
    return FreeMotion(tuple(moving), motion, False)
