"""What holds a vehicle that stands still, and how it falls where nothing does (inertia relief)."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.dynamics.assembly import System
from modeviz.dynamics.modes import RESOLVED_HZ, solve_modes
from modeviz.dynamics.motions import MASSLESS, center_of_gravity, rigid_coordinates
from modeviz.errors import SolveError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.islands import islands
from modeviz.vehicle.vehicle import Vehicle

ROUNDING = 1e-6
"""What is less than this part of a load is none: so well are free motions known."""

MECHANISM = 0.02
"""What moves within the vehicle may take less than this part of a load, as a shaft whose bearings are
not quite on its axis; with more there is no answer."""

ALONG = ("along x", "along y", "along z", "about x", "about y", "about z")
"""How each of `MOTIONS` is spoken of."""


@dataclass(frozen=True, eq=False)
class Whole:
    """Bodies that hang together, and their motions as one rigid body."""

    name: str
    """What they are called in a sentence."""
    motions: Floats
    """(n_dofs, 6), about their common centre of gravity."""


@dataclass(frozen=True, eq=False)
class Relief:
    """Loads that what is held balances, and the accelerations that take the rest of them."""

    forces: Floats
    """(n_dofs,): the load less the mass that it accelerates."""
    notes: tuple[str, ...]
    """A sentence for each whole that accelerates."""


@dataclass(frozen=True, eq=False)
class FreeMotions:
    """The motions of a system that strain nothing."""

    system: System
    shapes: Floats
    """N, (n_dofs, n_free), NᵀMN = I."""
    wholes: tuple[Whole, ...]

    def relieved(self, force: Floats) -> Relief:
        """Return a load without what accelerates the vehicle: F - M N NᵀF.

        Wholes that nothing holds accelerate as rigid bodies and are seen from there: inertia relief, as
        in MSC Nastran's "Linear Statics Analysis User's Guide".

        Args:
            force: (n_dofs,), on the generalised coordinates.

        Raises:
            SolveError: the load drives a mechanism, or does nothing but accelerate.
        """
        acceleration = self.shapes @ (self.shapes.T @ force)
        inertia = self.system.mass @ acceleration
        size = _size(self.system, force)
        if _size(self.system, inertia) < ROUNDING * size:
            return Relief(force - inertia, ())
        notes = self._mechanism(acceleration, size)
        if _size(self.system, force - inertia) < ROUNDING * size:
            raise SolveError(
                f"nothing holds {self._falling(acceleration)}, so it falls and nothing is loaded; give "
                'it a [[tyre]], or a spring or mount to "ground"'
            )
        return Relief(force - inertia, (*notes, *self._notes(acceleration)))

    def _mechanism(self, acceleration: Floats, size: float) -> tuple[str, ...]:
        """A sentence on what accelerates within its whole, if anything does.

        Raises:
            SolveError: it takes more of a load, of that size, than `MECHANISM`.
        """
        momentum = self.system.mass @ acceleration
        rest = acceleration.copy()
        for whole in self.wholes:
            rest -= whole.motions @ _part(self.system, whole, momentum)
        taken = {
            n: _size(self.system, self.system.mass[:, d] @ rest[d]) for n, d in self.system.dofs.items()
        }
        moving = max(taken, key=taken.__getitem__)
        if taken[moving] < ROUNDING * size:
            return ()
        way = _main(body_rows(self.system, moving) @ rest)
        words = f"nothing holds {moving!r} {way} within the vehicle"
        if taken[moving] > MECHANISM * size:
            raise SolveError(f"{words}, and the load drives it; give it a spring or a joint there")
        return (f"{words}: the little of the load that drives it accelerates it",)

    def _falling(self, acceleration: Floats) -> str:
        momentum = self.system.mass @ acceleration
        parts = {w.name: _part(self.system, w, momentum) for w in self.wholes}
        name = max(parts, key=lambda n: float(np.abs(parts[n][:3]).max()))
        return f"{name} {_main(parts[name])}"

    def _notes(self, acceleration: Floats) -> Sequence[str]:
        """Sentences on the wholes that accelerate, and how."""
        momentum, notes = self.system.mass @ acceleration, []
        largest = np.sqrt(acceleration @ momentum)
        for whole in self.wholes:
            part = _part(self.system, whole, momentum)
            moved = whole.motions @ part
            if np.sqrt(moved @ self.system.mass @ moved) > ROUNDING * largest:
                notes.append(
                    f"nothing holds {whole.name} {_main(part)}: it accelerates as a whole, and what is "
                    "shown is seen from it (inertia relief)"
                )
        return notes


def free_motions_of(system: System) -> FreeMotions:
    """Return the motions of a system that strain nothing, see `FreeMotions`.

    Raises:
        SolveError: as `solve_modes`.
    """
    N = solve_modes(system, below_hz=RESOLVED_HZ).shapes
    return FreeMotions(system, N, tuple(_wholes(system)) if N.size else ())


def body_rows(system: System, body: str) -> Floats:
    """Return rows (6, n_dofs) that give x, y, z, rx, ry, rz of a body's centre of gravity.

    Of a flexible body what its rigid modes do.
    """
    own, dofs = system.vehicle.body(body), system.dofs[body]
    rows = np.zeros((6, system.n_dofs))
    rows[:, dofs] = np.linalg.pinv(rigid_coordinates(system, [own], own.center_of_gravity)[dofs])
    return rows


def _wholes(system: System) -> Sequence[Whole]:
    found = []
    for island in islands(system.vehicle):
        bodies = [system.vehicle.body(name) for name in island.bodies]
        center = center_of_gravity(system, bodies)
        found.append(
            Whole(_name(system.vehicle, island.bodies), rigid_coordinates(system, bodies, center))
        )
    return found


def _name(vehicle: Vehicle, bodies: Sequence[str]) -> str:
    """What bodies are called in a sentence: the vehicle, or one of them and how many more."""
    if len(bodies) == len(vehicle.bodies):
        return "the vehicle" if len(bodies) > 1 else repr(bodies[0])
    more = f" and the {len(bodies) - 1} with it" if len(bodies) > 1 else ""
    return f"{bodies[0]!r}{more}"


def _part(system: System, whole: Whole, momentum: Floats) -> Floats:
    """The rigid motion of a whole, (6,), that has its part of a momentum M a."""
    X = whole.motions
    part = np.linalg.lstsq(X.T @ system.mass @ X, X.T @ momentum, rcond=MASSLESS)[0]
    return np.asarray(part, np.float64)


def _main(motion: Floats) -> str:
    """The direction that a motion mostly has, its angles by a lever of a metre: "along z"."""
    return ALONG[int(np.abs(motion).argmax())]


def _size(system: System, force: Floats) -> float:
    """√(Fᵀ M⁻¹ F) of a load: how much it would accelerate what is free, body by body."""
    parts = (force[d] @ np.linalg.solve(system.mass[d, d], force[d]) for d in system.dofs.values())
    return float(np.sqrt(sum(parts)))
