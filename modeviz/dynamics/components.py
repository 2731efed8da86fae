"""One body alone: its free-free modes, and which of them make up a mode of the vehicle."""

from dataclasses import dataclass

import numpy as np
import scipy.linalg

from modeviz.dynamics.assembly import System, assemble
from modeviz.dynamics.motions import MASSLESS, center_of_gravity, rigid_coordinates
from modeviz.dynamics.naming import MOTION_WORDS
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.bodies import Body, FlexibleBody
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class ComponentModes:
    """A body's free-free modes, mass-normalised without the masses that the vehicle adds to it."""

    names: tuple[str, ...]
    """Six rigid motions, "fore-aft" to "yaw", then "mode 7" and on; a rod's five, then "mode 6"."""
    frequency_hz: Floats
    """(n_modes,), zero for the rigid ones."""
    shapes: Floats
    """(n_dofs, n_modes), in the vehicle's coordinates: all other bodies rest."""


@dataclass(frozen=True)
class ComponentShare:
    """The share of one of a body's own modes in the kinetic energy of a motion of the vehicle."""

    name: str
    """As `ComponentModes.names`, or "residual vectors" or "added masses"."""
    mode: int | None
    """Which of the body's modes, from zero; None for those two."""
    share: float
    """0 to 1, of the whole vehicle's kinetic energy."""


def component_modes(system: System, body: str) -> ComponentModes:
    """The free-free modes of one body: the rigid ones and, if it is flexible, its elastic ones.

    The rigid ones are motions along and about the vehicle's axes through the body's own centre of
    gravity. Where products of inertia couple these they are changed as little as makes them orthogonal
    in mass (P.-O. Löwdin, "On the non-orthogonality problem", Advances in Quantum Chemistry 5, 1970).
    Residual vectors are no free-free modes and left out.

    Args:
        system: of the vehicle; its rates and added masses do not matter.
        body: its name.

    Raises:
        VehicleError: no body has that name.
    """
    its = system.vehicle.body(body)
    elastic = _elastic(its)
    words, rigid = _rigid_modes(_alone(its))
    n_rigid = len(words)
    shapes = np.zeros((system.n_dofs, n_rigid + len(elastic)))
    own = system.dofs[body]
    shapes[own, :n_rigid] = rigid
    shapes[own.start + elastic, n_rigid + np.arange(len(elastic))] = 1
    frequency_hz = np.zeros(shapes.shape[1])
    if isinstance(its, FlexibleBody):
        frequency_hz[n_rigid:] = its.natural_frequency_hz[elastic]
    names = (*words, *(f"mode {i + 1}" for i in elastic))
    return ComponentModes(names, frequency_hz, shapes)


def component_shares(
    system: System, shape: Floats | Complexes, body: str
) -> tuple[ComponentShare, ...]:
    """The body's free-free modes that make up a motion of the vehicle, the largest share first.

    |q|² / φᴴMφ with the body's mass-normalised coordinates q. Its residual vectors are one share
    together, and so are the masses added to it, which its own modes do not know; the shares of a body
    add up to its `kinetic_energy`.

    Args:
        system: what vibrates.
        shape: φ, (n_dofs,), a mode, damped mode or operating shape of it.
        body: its name.

    Raises:
        VehicleError: no body has that name.
    """
    its, moved = system.vehicle.body(body), shape[system.dofs[body]]
    modes = component_modes(system, body)
    q = modes.shapes[system.dofs[body]].T @ (_alone(its).mass @ moved)
    energy = dict(zip(modes.names, np.abs(q) ** 2, strict=True))
    if isinstance(its, FlexibleBody) and its.n_residuals:
        energy["residual vectors"] = np.sum(np.abs(moved[-its.n_residuals :]) ** 2)
    carried = [added for added in system.vehicle.added_masses if added.body == body]
    if carried:
        energy["added masses"] = sum(
            added.mass * np.sum(np.abs(system.motion(body, added.position)[:3] @ shape) ** 2)
            for added in carried
        )
    total = np.real(shape.conj() @ (system.mass @ shape))
    own = {name: i for i, name in enumerate(modes.names)}
    shares = [ComponentShare(name, own.get(name), float(e / total)) for name, e in energy.items()]
    return tuple(sorted(shares, key=lambda s: -s.share))


def _alone(body: Body) -> System:
    """The body as a vehicle of its own, held by nothing."""
    return assemble(Vehicle(body.name, (body,), ()))


def _elastic(body: Body) -> np.ndarray:
    """The indices of a body's coordinates that are its elastic normal modes."""
    if not isinstance(body, FlexibleBody):
        return np.arange(0)
    return np.arange(body.n_rigid, body.n_normal)


def _rigid_modes(alone: System) -> tuple[tuple[str, ...], Floats]:
    """Names of a body's rigid modes, and their shapes in its coordinates, (n_dofs, n_rigid)."""
    bodies = alone.vehicle.bodies
    X = rigid_coordinates(alone, bodies, center_of_gravity(alone, bodies))
    kept = _independent(X.T @ alone.mass @ X)
    X = X[:, kept]
    X /= np.sqrt(np.einsum("ij,ij->j", X, alone.mass @ X))
    return tuple(MOTION_WORDS[i] for i in kept), X @ scipy.linalg.fractional_matrix_power(
        X.T @ alone.mass @ X, -0.5
    )


def _independent(rigid_mass: Floats) -> list[int]:
    """The rigid motions, of six, that a body can do: all but the one closest to having no inertia."""
    scale = np.sqrt(np.maximum(np.diag(rigid_mass), MASSLESS * np.trace(rigid_mass)))
    inertia, motions = np.linalg.eigh(rigid_mass / np.outer(scale, scale))
    kept = list(range(6))
    for motion in motions[:, inertia < MASSLESS].T:
        kept.remove(max(kept, key=lambda i: abs(motion[i])))
    return kept
