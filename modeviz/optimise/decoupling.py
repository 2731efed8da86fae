"""Goals of bodies on their mounts: pure modes, in a band, far enough from each other."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise, product

import numpy as np

from modeviz.analysis.preparation import PreparedModes, prepare_modes
from modeviz.analysis.rigid import usual_body
from modeviz.analysis.sensitivity import spring_shares
from modeviz.dynamics.basis import REACH
from modeviz.dynamics.modes import solve_modes
from modeviz.errors import VehicleError
from modeviz.mounting.body_modes import BasisModes, BodyModes, BodyRows, body_modes, body_rows
from modeviz.mounting.frames import crank_direction, frame
from modeviz.mounting.stiffness import HeldBody, held_bodies
from modeviz.optimise.min_max import MinMax
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.decoupling import DecoupledBody, Decoupling
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle

BOUNCE = MOTIONS.index("z")

OFFERED = 3
"""So many modes may be a direction's: those that miss least."""


@dataclass(frozen=True, eq=False)
class Decoupled:
    """A body whose modes are to be decoupled."""

    asked: DecoupledBody
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
    """The modes of some bodies at any mount rates."""

    prepared: PreparedModes
    bodies: tuple[Decoupled, ...]

    def at(self, rates: Rates) -> list[BodyModes]:
        """Return those of each body; raises as `solve_modal`."""
        basis, k = self.prepared.basis, self.prepared.real_rates(rates)
        change = k - basis.law.springs(basis.mount_stiffness).real
        R = basis.spring_motions
        squares, y = np.linalg.eigh(basis.stiffness + (R.T * change) @ R)
        n_known = int(np.searchsorted(squares, REACH**2 * basis.top))
        modes = BasisModes(np.maximum(squares, 0.0), y, R @ y, n_known, basis.law.are_masses)
        return [body_modes(body.rows, modes, k) for body in self.bodies]

    def exactly_at(self, rates: Rates) -> list[BodyModes]:
        """Return the same from the full eigenproblem."""
        system = self.prepared.system_at(rates)
        k = self.prepared.real_rates(rates)
        found = solve_modes(system, below_hz=REACH * self.prepared.basis.top_hz)
        stretch = system.mount_motions @ found.shapes
        n_modes, are_masses = len(found.frequency_hz), self.prepared.basis.law.are_masses
        modes = BasisModes(found.omega_n_squared, found.shapes, stretch, n_modes, are_masses)
        own = np.eye(system.n_dofs)
        rows = (body_rows(body.held, body.axes, own) for body in self.bodies)
        return [body_modes(r, modes, k) for r in rows]

    def of_vehicle(self, vehicle: Vehicle) -> "DecoupledModes":
        """Return those of the vehicle with mounts elsewhere or more of them; as `prepare_modes`."""
        return _decoupled_modes(vehicle, [body.asked for body in self.bodies])

    def by_rate(self, gradients: Floats, rates: Rates) -> Floats:
        """Return derivatives to each of `rate_variables` of what has them to every spring's rate."""
        are_dampers = self.prepared.basis.law.are_dampers[:, None]
        shares = spring_shares(self.prepared, rates).real.astype(np.float64)
        return gradients @ np.where(are_dampers, 0.0, shares)


@dataclass(frozen=True, eq=False)
class Impurity(MinMax):
    """What of each direction that is to be pure is not, of which the largest is to become small.

    1 - purity of the direction's leading mode, or of a purer one, which counts by how much of the
    direction it has beside that: so that nothing jumps where another mode takes the lead.
    """

    modes: DecoupledModes

    def value(self, rates: Rates) -> float:
        return float(self._parts(self.modes.at(rates)).max())

    def exact_value(self, rates: Rates) -> float:
        return float(self._parts(self.modes.exactly_at(rates)).max())

    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        found = self.modes.at(rates)
        gradients = [
            _pure_gradient(own, direction)
            for own, body in zip(found, self.modes.bodies, strict=True)
            for direction in body.motions
        ]
        return self._parts(found), -self.modes.by_rate(np.array(gradients), rates)

    def of_vehicle(self, vehicle: Vehicle) -> "Impurity":
        return Impurity(self.modes.of_vehicle(vehicle))

    def _parts(self, found: Sequence[BodyModes]) -> Floats:
        pure = [
            _counted(own)[:, list(body.motions)].max(axis=0)
            for own, body in zip(found, self.modes.bodies, strict=True)
        ]
        return 1 - np.concatenate(pure)


def _counted(own: BodyModes) -> Floats:
    """Purity times how much of a direction a mode has, (n_modes, 6)."""
    return own.purity * own.leading


def _pure_gradient(own: BodyModes, direction: int) -> Floats:
    """The derivatives of the largest that is counted of a direction, (n_springs,)."""
    mode = int(_counted(own)[:, direction].argmax())
    if not own.leading[mode, direction]:
        return np.zeros(len(own.mount_rates))
    return own.leading[mode, direction] * own.purity_gradient(mode, direction) + own.purity[
        mode, direction
    ] * own.leading_gradient(mode, direction)


@dataclass(frozen=True, eq=False)
class Shortfall:
    """Σ max(0, what is missing)², relative to what is asked: zero where all of it holds.

    Of the purity of modes, of their frequencies to both ends of the band, of the gaps between those
    that follow each other, and of that between bounce and turning about the crank. One-sided squares,
    so that derivatives are continuous where something begins to hold.

    Each direction has a mode of its own, chosen so that the sum is least; one that does not lead the
    direction misses what it has less than the one that does. So nothing jumps where modes cross or veer
    and another takes the lead.
    """

    modes: DecoupledModes
    targets: Decoupling

    def value(self, rates: Rates) -> float:
        return self._value(self.modes.at(rates))

    def exact_value(self, rates: Rates) -> float:
        return self._value(self.modes.exactly_at(rates))

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        value, gradient = 0.0, np.zeros(len(self.modes.prepared.basis.mount_stiffness))
        for own, body in zip(self.modes.at(rates), self.modes.bodies, strict=True):
            chosen = self._chosen(own, body)
            values, gradients = self._missing(own, body, chosen, with_gradients=True)
            clipped = values.clip(min=0.0)
            value += float(clipped @ clipped)
            gradient += 2 * clipped @ gradients
        return value, self.modes.by_rate(gradient, rates)

    def of_vehicle(self, vehicle: Vehicle) -> "Shortfall":
        """Return what is missing to the same, of the vehicle with mounts elsewhere or more of them."""
        return Shortfall(self.modes.of_vehicle(vehicle), self.targets)

    def _value(self, found: Sequence[BodyModes]) -> float:
        total = 0.0
        for own, body in zip(found, self.modes.bodies, strict=True):
            values, _ = self._missing(own, body, self._chosen(own, body))
            total += float(np.sum(values.clip(min=0.0) ** 2))
        return total

    def _chosen(self, own: BodyModes, body: Decoupled) -> tuple[int | None, ...]:
        """The mode of each direction with which the sum is least; None where one has none."""
        f, asked = own.frequency_hz[:, None], self.targets
        cost = (1 - own.leading).clip(min=0.0) ** 2 + (f / asked.highest_frequency - 1).clip(min=0) ** 2
        if asked.lowest_frequency > 0:
            cost = cost + (1 - f / asked.lowest_frequency).clip(min=0.0) ** 2
        pure = list(body.motions)
        cost[:, pure] += (1 - own.purity[:, pure] / asked.purity).clip(min=0.0) ** 2
        offers: list[list[int | None]] = [
            [i for i in np.argsort(cost[:, d])[:OFFERED].tolist() if own.leading[i, d] > 0] or [None]
            for d in range(len(MOTIONS))
        ]
        best, least = tuple(offer[0] for offer in offers), np.inf
        for modes in product(*offers):
            taken = [mode for mode in modes if mode is not None]
            if len(set(taken)) == len(taken):
                values, _ = self._missing(own, body, modes)
                total = float(np.sum(values.clip(min=0.0) ** 2))
                if total < least:
                    best, least = modes, total
        return best

    def _missing(
        self,
        own: BodyModes,
        body: Decoupled,
        chosen: Sequence[int | None],
        with_gradients: bool = False,
    ) -> tuple[Floats, Floats]:
        """What is missing to all that is asked, (n,), below zero if nothing is, and derivatives."""
        asked, none = self.targets, np.zeros(len(own.mount_rates))
        values, gradients = [], []
        there = sorted((own.frequency_hz[m], d, m) for d, m in enumerate(chosen) if m is not None)

        def add(value: float, gradient: Callable[[], Floats]) -> None:
            values.append(value)
            if with_gradients:
                gradients.append(gradient() if value > 0 else none)

        for d in body.motions:
            if chosen[d] is None:
                add(1.0, lambda: none)
        for f, d, m in there:
            if d in body.motions:
                add(
                    1 - own.purity[m, d] / asked.purity,
                    lambda m=m, d=d: -own.purity_gradient(m, d) / asked.purity,
                )
            add(1 - own.leading[m, d], lambda m=m, d=d: -own.leading_gradient(m, d))
            add(
                f / asked.highest_frequency - 1,
                lambda m=m: own.frequency_gradient(m) / asked.highest_frequency,
            )
            if asked.lowest_frequency > 0:
                add(
                    1 - f / asked.lowest_frequency,
                    lambda m=m: -own.frequency_gradient(m) / asked.lowest_frequency,
                )
        main = [own_mode for own_mode in there if own_mode[1] in (BOUNCE, body.crank)]
        for modes, gap in ((there, asked.gap), (main, asked.bounce_gap)):
            for (low, _, i), (high, _, j) in pairwise(modes) if gap > 0 else ():
                add(
                    1 - (high - low) / gap,
                    lambda i=i, j=j, gap=gap: (
                        (own.frequency_gradient(i) - own.frequency_gradient(j)) / gap
                    ),
                )
        return np.array(values), np.array(gradients).reshape(-1, len(none))


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
    modes = _decoupled_modes(vehicle, asked)
    return Impurity(modes) if problem.goal == "purity" else Shortfall(modes, vehicle.decoupling)


def _decoupled_modes(vehicle: Vehicle, asked: Sequence[DecoupledBody]) -> DecoupledModes:
    top_hz = max(vehicle.highest_frequency, vehicle.decoupling.highest_frequency)
    prepared = prepare_modes(vehicle, top_hz)
    return DecoupledModes(prepared, tuple(_decoupled(prepared, body) for body in asked))


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
    return Decoupled(asked, held, axes, rows, motions, 3 + int(np.argmax(np.abs(axes @ crank))))
