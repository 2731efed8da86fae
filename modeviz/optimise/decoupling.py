"""Goals of bodies on their mounts: pure modes, in a band, far enough from each other."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from modeviz.analysis.preparation import PreparedModes, prepare_modes
from modeviz.analysis.rigid import usual_body
from modeviz.analysis.sensitivity import spring_shares
from modeviz.dynamics.basis import REACH
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.mounting.frames import crank_direction, frame
from modeviz.mounting.own_modes import BasisModes, BodyRows, OwnModes, body_rows, own_modes
from modeviz.mounting.stiffness import HeldBody, held_bodies
from modeviz.optimise.min_max import MinMax
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS, Rates
from modeviz.vehicle.decoupling import DecoupledBody, Decoupling
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

BOUNCE = MOTIONS.index("z")


@dataclass(frozen=True, eq=False)
class Decoupled:
    """A body whose modes are to be decoupled."""

    held: HeldBody
    axes: Floats
    """(3, 3), as rows."""
    rows: BodyRows
    """In the vectors of the vehicle's enriched basis."""
    motions: tuple[int, ...]
    """Numbers of those whose modes are to be pure."""
    crank: int
    """Number of the turning nearest to that about its crank."""


@dataclass(frozen=True, eq=False)
class DecoupledModes:
    """The own modes of some bodies at any mount rates."""

    prepared: PreparedModes
    bodies: tuple[Decoupled, ...]

    def at(self, rates: Rates) -> list[OwnModes]:
        """Return those of each body; raises as `solve_modal`."""
        basis, k = self.prepared.basis, self.prepared.mount_stiffness(rates).real.astype(np.float64)
        change = k - basis.mount_stiffness.real
        R = basis.spring_motions
        squares, y = np.linalg.eigh(basis.stiffness + (R.T * change) @ R)
        n_known = int(np.searchsorted(squares, REACH**2 * basis.top))
        modes = BasisModes(np.maximum(squares, 0.0), y, R @ y, n_known)
        return [own_modes(body.rows, modes, k) for body in self.bodies]

    def exactly_at(self, rates: Rates) -> list[OwnModes]:
        """Return the same from the full eigenproblem."""
        system = self.prepared.system_at(rates)
        k = self.prepared.mount_stiffness(rates).real.astype(np.float64)
        found = solve_modes(system, below_hz=REACH * self.prepared.basis.top_hz)
        stretch = system.mount_motions @ found.shapes
        modes = BasisModes(found.omega_n_squared, found.shapes, stretch, len(found.frequency_hz))
        own = np.eye(system.n_dofs)
        rows = (body_rows(body.held, body.axes, own) for body in self.bodies)
        return [own_modes(r, modes, k) for r in rows]

    def by_rate(self, gradients: Floats, rates: Rates) -> Floats:
        """Return derivatives to each of `rate_variables` of what has them to every spring's rate."""
        shares: Floats = spring_shares(self.prepared, rates).real.astype(np.float64)
        return gradients @ shares


@dataclass(frozen=True, eq=False)
class Impurity(MinMax):
    """1 - purity of the modes that are to be pure, of which the largest is to become small."""

    modes: DecoupledModes

    def value(self, rates: Rates) -> float:
        return float(self._parts(self.modes.at(rates)).max())

    def exact_value(self, rates: Rates) -> float:
        return float(self._parts(self.modes.exactly_at(rates)).max())

    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        found = self.modes.at(rates)
        gradients = self._pure([own.purity_gradient for own in found])
        return self._parts(found), -self.modes.by_rate(gradients, rates)

    def _parts(self, found: Sequence[OwnModes]) -> Floats:
        return 1 - self._pure([own.purity for own in found])

    def _pure(self, values: Sequence[Floats]) -> Floats:
        """The values of the motions that are to be pure."""
        pairs = zip(values, self.modes.bodies, strict=True)
        return np.concatenate([own[list(body.motions)] for own, body in pairs])


@dataclass(frozen=True, eq=False)
class Shortfall:
    """Σ max(0, what is missing)², relative to what is asked: zero where all of it holds.

    Of the purity of modes, of their frequencies to both ends of the band, of the gaps between those
    that follow each other, and of that between bounce and turning about the crank. One-sided squares,
    so that derivatives are continuous where something begins to hold.
    """

    modes: DecoupledModes
    targets: Decoupling

    def value(self, rates: Rates) -> float:
        return self._total(self.modes.at(rates))[0]

    def exact_value(self, rates: Rates) -> float:
        return self._total(self.modes.exactly_at(rates))[0]

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        value, gradient = self._total(self.modes.at(rates))
        return value, self.modes.by_rate(gradient, rates)

    def _total(self, found: Sequence[OwnModes]) -> tuple[float, Floats]:
        """The sum, and its derivatives to the rate of every spring."""
        missing = [self._missing(own, body) for own, body in zip(found, self.modes.bodies, strict=True)]
        values = np.concatenate([values for values, _ in missing]).clip(min=0.0)
        gradients = np.concatenate([gradients for _, gradients in missing])
        return float(values @ values), 2 * values @ gradients

    def _missing(self, own: OwnModes, body: Decoupled) -> tuple[Floats, Floats]:
        """What is missing to all that is asked, (n,), below zero if nothing is, and derivatives."""
        asked, pure = self.targets, list(body.motions)
        values = [1 - own.purity[pure] / asked.purity]
        gradients = [-own.purity_gradient[pure] / asked.purity]
        there = np.flatnonzero(np.isfinite(own.frequency_hz))
        there = there[np.argsort(own.frequency_hz[there], kind="stable")]
        f, slope = own.frequency_hz[there], own.frequency_gradient[there]
        if asked.lowest_frequency > 0:
            values.append(1 - f / asked.lowest_frequency)
            gradients.append(-slope / asked.lowest_frequency)
        values.append(f / asked.highest_frequency - 1)
        gradients.append(slope / asked.highest_frequency)
        is_main = np.isin(there, (BOUNCE, body.crank))
        for which, gap in ((np.full(len(there), True), asked.gap), (is_main, asked.bounce_gap)):
            if gap > 0:
                values.append(1 - np.diff(f[which]) / gap)
                gradients.append(-np.diff(slope[which], axis=0) / gap)
        return np.concatenate(values), np.concatenate(gradients)


def prepare_decoupling(vehicle: Vehicle, problem: Problem) -> Impurity | Shortfall:
    """Return the goal purity or decoupling of a problem.

    Raises:
        VehicleError: nothing is on mounts, or rates of mounts depend on frequency.
        SolveError: the vehicle has no meaningful modes.
    """
    for group in vehicle.mount_groups:
        if group.dynamic is not None:
            raise VehicleError(
                f"problem {problem.name!r}: goal {problem.goal!r} needs mounts whose rates do not "
                f"depend on frequency; those of {group.name!r} do"
            )
    asked = problem.decoupling or (DecoupledBody(_main_body(vehicle, problem)),)
    top_hz = max(vehicle.highest_frequency, vehicle.decoupling.highest_frequency)
    prepared = prepare_modes(vehicle, top_hz)
    modes = DecoupledModes(prepared, tuple(_decoupled(prepared, body) for body in asked))
    return Impurity(modes) if problem.goal == "purity" else Shortfall(modes, vehicle.decoupling)


def _main_body(vehicle: Vehicle, problem: Problem) -> str:
    on_mounts = {name for mount in vehicle.mounts for name in mount.bodies}
    name = usual_body(vehicle)
    if name not in on_mounts:
        raise VehicleError(
            f"problem {problem.name!r}: goal {problem.goal!r} needs a body on mounts; name one in a "
            "[[problem.decoupling]]"
        )
    return name


def _decoupled(prepared: PreparedModes, asked: DecoupledBody) -> Decoupled:
    names = [body.name for body in prepared.vehicle.bodies]
    held = held_bodies(prepared.system)[names.index(asked.body)]
    crank = crank_direction(held.part)
    axes = frame(held.part, asked.axes, crank)
    rows = body_rows(held, axes, prepared.basis.vectors)
    motions = tuple(MOTIONS.index(motion) for motion in asked.motions)
    return Decoupled(held, axes, rows, motions, 3 + int(np.argmax(np.abs(axes @ crank))))
