"""Goals of what gets through mounts: their forces, and the accelerations of their ends."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from modeviz.analysis.driven import Driven, driven, load_lines
from modeviz.analysis.forces import is_random
from modeviz.analysis.mount_forces import spring_damping
from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import AXIS, Conditions
from modeviz.analysis.sensitivity import spring_shares
from modeviz.dynamics.mount_rates import are_dampers, by_motion, rows_of_springs
from modeviz.dynamics.reanalysis import Receptances
from modeviz.dynamics.resonances import resonances_at
from modeviz.dynamics.spacing import placed_lines
from modeviz.errors import VehicleError
from modeviz.mounting.forces import solve_forces
from modeviz.optimise.objective import LoadCase, Objective, objective_on
from modeviz.ride.averaging import averaged_spectrum
from modeviz.ride.excitation import Load
from modeviz.ride.integration import integration_weights
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.connections import GROUND, Mount
from modeviz.vehicle.loads import HarmonicLoad, ResponsePoint, Road
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class MountCase:
    """Mounts under one load."""

    driven: Driven
    """Under that load, at lines that hold what its spectrum says."""
    selected: Floats
    """(n_mounts, 3): one for x, y, z of the mounts that count, else zero."""
    weight: float

    @property
    def load(self) -> Load:
        return self.driven.loads[0]

    @property
    def shaken(self) -> Conditions | HarmonicLoad:
        """The load as other goals have it."""
        load = self.load
        if is_random(load):
            return Conditions(load.name, self.driven.speed)
        assert not isinstance(load, Road)
        return load

    @property
    def counts(self) -> Floats:
        """What the square of each spring's force counts, (n_springs,): those about axes nothing.

        Dampers that are tuned have the force of the spring beside them, with which it counts.
        """
        counts = np.pad(self.selected, ((0, 0), (0, 3))).ravel()
        return self.weight * counts[rows_of_springs(self.driven.prepared.vehicle)]

    @property
    def once(self) -> Floats:
        """The same, with nothing for these dampers."""
        return np.where(are_dampers(self.driven.prepared.vehicle), 0.0, self.counts)

    def of(self, prepared: Prepared) -> "MountCase":
        """Return the case of the vehicle with mounts elsewhere, or more of them, which do not count."""
        vehicle = prepared.vehicle
        selected = np.pad(self.selected, ((0, len(vehicle.mounts) - len(self.selected)), (0, 0)))
        under = _under(prepared, vehicle.load(self.load.name), self.driven.speed)
        return MountCase(under, selected, self.weight)

    def lines(self, stiffness: Complexes) -> Floats:
        """Lines that mount rates want, (n_lines,), Hz: closer where any mode is sharp.

        Small changes of rates leave them where they are.
        """
        found = resonances_at(self.driven.prepared.basis, stiffness).rounded()
        return placed_lines(self.driven.frequency_hz, found.frequency_hz, found.damping_ratio)

    def spectrum(self, lines: Floats) -> Complexes:
        """The load's spectrum for sums over lines, (n_lines, n_inputs, n_inputs)."""
        weights = integration_weights(lines, (0.0, float(lines[-1])))
        averaged = averaged_spectrum(self.load, lines, self.driven.speed)
        return weights[:, None, None] * averaged


@dataclass(frozen=True, eq=False)
class MountForceGoal:
    """F = Σ w ∫ Σ S_FF df over loads, mounts and their own axes, N²; S is one under a harmonic load.

    With F_i = z_i x_i, z_i = r_i k_i + jωc_i, ∂x_i/∂k_s = -G_is r_s x_s and G, the stretch of springs
    per force in others, symmetric,

        ∂F/∂k_s = 2 r_s x_s · (m_s P_s - G_s (m z P)),  P = S Fᴴ
    """

    cases: tuple[MountCase, ...]

    def values(self, rates: Rates) -> Floats:
        """Return what each case adds, (n_cases,); raises as `solve`."""
        return np.array([self._value(case, rates) for case in self.cases])

    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return float(self.values(rates).sum())

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """Return the goal and its derivatives to each of `rate_variables`; raises as `solve`."""
        value, gradient = 0.0, np.zeros(1)
        for case in self.cases:
            own, by_spring = self._case(case, rates)
            shares = spring_shares(case.driven.prepared, rates)
            value, gradient = value + own, gradient + (by_spring @ shares).real
        return value, gradient

    def exact_value(self, rates: Rates) -> float:
        """Return the goal from the forces of the vehicle solved anew; raises as `solve_forces`."""
        return sum(self._exact(case, rates) for case in self.cases)

    def of_vehicle(self, vehicle: Vehicle) -> "MountForceGoal":
        """Return the goal of the vehicle with mounts elsewhere or more of them; raises as `prepare`."""
        prepared = prepare(vehicle)
        return MountForceGoal(tuple(case.of(prepared) for case in self.cases))

    def scaled(self, factors: Floats) -> "MountForceGoal":
        """Return the goal with other weights: each case's times a factor, (n_cases,)."""
        return replace(self, cases=_scaled(self.cases, factors))

    def _value(self, case: MountCase, rates: Rates) -> float:
        """What a case adds."""
        once = case.once
        return sum(float((passed.power @ once).sum()) for passed in passed_on(case, rates))

    def _case(self, case: MountCase, rates: Rates) -> tuple[float, Complexes]:
        """What a case adds, and its derivatives to the complex rates of springs, (n_springs,)."""
        counts, value = case.counts, 0.0
        by_spring = np.zeros(len(counts), complex)
        for passed in passed_on(case, rates):
            x, P = passed.stretch, passed.weighted
            pushed = (counts * passed.stiffness)[:, :, None] * P.swapaxes(1, 2)
            through = (passed.moved_by(pushed) * x).sum(axis=2)
            own = counts * (x * P.swapaxes(1, 2)).sum(axis=2)
            value += float((passed.power @ case.once).sum())
            by_spring += 2 * (passed.ratios * (own - through)).sum(axis=0)
        return value, by_spring

    def _exact(self, case: MountCase, rates: Rates) -> float:
        prepared = case.driven.prepared
        lines = case.lines(prepared.mount_stiffness(rates))
        system = prepared.system_at(rates)
        forces = solve_forces(system, case.load, lines, case.driven.speed).force
        F = forces[:, rows_of_springs(prepared.vehicle)]
        power = ((F @ case.spectrum(lines)) * F.conj()).sum(axis=2).real
        return float((power @ case.once).sum())


@dataclass(frozen=True, eq=False)
class Passed:
    """What springs pass on at some lines with mount rates."""

    receptances: Receptances
    at_reference: Complexes
    """Rates of springs, (n_springs,), N/m."""
    ratios: Complexes
    """What they are in parts of these, (n_lines or 1, n_springs)."""
    stiffness: Complexes
    """z, (n_lines, n_springs), N/m."""
    stretch: Complexes
    """x, (n_lines, n_springs, n_inputs)."""
    spectrum: Complexes
    """S, (n_lines, n_inputs, n_inputs), for sums over lines."""
    force: Complexes
    """F, (n_lines, n_springs, n_inputs): of all springs together that resist a spring's motion."""
    weighted: Complexes
    """P = S Fᴴ, (n_lines, n_inputs, n_springs)."""

    @property
    def stretched(self) -> Floats:
        """X S xᴴ of each spring, (n_lines, n_springs)."""
        return ((self.stretch @ self.spectrum) * self.stretch.conj()).sum(axis=2).real

    @property
    def power(self) -> Floats:
        """F S Fᴴ of each spring, (n_lines, n_springs)."""
        return (self.force * self.weighted.swapaxes(1, 2)).sum(axis=2).real

    def moved_by(self, forces: Complexes) -> Complexes:
        """Return G f, how forces in springs stretch them, (n_lines, n_springs, n_columns)."""
        at = self.receptances
        return replace(at, inputs=at.springs @ forces).stretches(self.at_reference)


def passed_on(case: MountCase, rates: Rates) -> Iterator[Passed]:
    """What passes at the lines of the band, then at those between; raises as `solve`."""
    system = case.driven.prepared.system
    stiffness = case.driven.prepared.mount_stiffness(rates)
    lines = case.lines(stiffness)
    spectrum = case.spectrum(lines)
    for at, own in case.driven.parts(lines):
        f = at.frequency_hz
        ratios, x = at.law.ratios(f), at.stretches(stiffness)
        z = stiffness * ratios + 2j * np.pi * f[:, None] * spring_damping(system)
        F = by_motion(system.vehicle, z[:, :, None] * x)[:, rows_of_springs(system.vehicle)]
        weighted = spectrum[own] @ F.conj().swapaxes(1, 2)
        yield Passed(at, stiffness, ratios, z, x, spectrum[own], F, weighted)


@dataclass(frozen=True, eq=False)
class TransmissibilityGoal:
    """Σ w ∫ Σ a₂² df / ∫ Σ a₁² df over loads: a of the carrying ends of mounts over the carried ones.

    The squares of `mounting.transmission.acceleration_ratio`, of all mounts and directions of a case
    together, at the places where the mounts hold on to both bodies.
    """

    cases: tuple[MountCase, ...]
    """Their vehicle's response points are the carried ends of its mounts, then the carrying ones."""

    def values(self, rates: Rates) -> Floats:
        """Return what each case adds, (n_cases,); raises as `solve`."""
        return np.array([self._ratio(case, rates, exact=False) for case in self.cases])

    def value(self, rates: Rates) -> float:
        """At rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return float(self.values(rates).sum())

    def exact_value(self, rates: Rates) -> float:
        """Return the goal from the equations of motion; raises as `Objective.exact_response`."""
        return sum(self._ratio(case, rates, exact=True) for case in self.cases)

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """Return the goal and its derivatives to each of `rate_variables`; raises as `solve`."""
        value, gradient = 0.0, np.zeros(1)
        for case in self.cases:
            carried, carrying = self._ends(case, rates)
            (below, slope_below), (above, slope_above) = (
                end.value_and_gradient(rates) for end in (carried, carrying)
            )
            value += case.weight * above / below
            gradient = gradient + case.weight * (slope_above - above / below * slope_below) / below
        return value, gradient

    def of_vehicle(self, vehicle: Vehicle) -> "TransmissibilityGoal":
        """Return the goal of the vehicle with mounts elsewhere or more of them; raises as `prepare`."""
        prepared = prepare(_with_end_points(vehicle))
        return TransmissibilityGoal(tuple(case.of(prepared) for case in self.cases))

    def scaled(self, factors: Floats) -> "TransmissibilityGoal":
        """Return the goal with other weights: each case's times a factor, (n_cases,)."""
        return replace(self, cases=_scaled(self.cases, factors))

    def mean_squares(self, case: MountCase, rates: Rates) -> Floats:
        """Return those of all carried ends, then of all carrying ones, (2, n_mounts, 3)."""
        every = replace(case, selected=np.ones_like(case.selected))
        both = (end for end in self._ends(every, rates))
        return np.array([_each(end, rates) for end in both]).reshape(2, -1, 3)

    def _ratio(self, case: MountCase, rates: Rates, exact: bool) -> float:
        carried, carrying = (
            end.exact_value(rates) if exact else end.value(rates) for end in self._ends(case, rates)
        )
        return case.weight * carrying / carried

    def _ends(self, case: MountCase, rates: Rates) -> tuple[Objective, Objective]:
        """The mean squares of the carried and of the carrying ends at the lines that rates want."""
        prepared = case.driven.prepared
        lines = case.lines(prepared.mount_stiffness(rates))
        weights = integration_weights(lines, (0.0, float(lines[-1])))[:, None, None]
        at, none = prepared.on(lines), np.zeros_like(case.selected)
        first, second = (
            objective_on(
                at, [LoadCase(case.shaken, tuple(lines.tolist()), 1.0, weights * pattern, 0.0, True)]
            )
            for pattern in (
                np.concatenate([case.selected, none]),
                np.concatenate([none, case.selected]),
            )
        )
        return first, second


MountGoal = MountForceGoal | TransmissibilityGoal


def prepare_mount_goal(vehicle: Vehicle, problem: Problem, speed: float) -> MountGoal:
    """The goal forces or transmissibility of a problem, whose cases all weigh what they are told to.

    Args:
        vehicle: whose mounts.
        problem: with that goal.
        speed: on roads, m/s.

    Raises:
        VehicleError: the vehicle has no mounts or no load, or a mount to the ground, whose carrying end
            stands still, has a transmissibility to become small.
        SolveError: as `prepare`.
    """
    if not vehicle.mounts:
        raise VehicleError(f"problem {problem.name!r}: goal {problem.goal!r} needs a [[mount_group]]")
    targets = problem.mounts or (MountTarget(),)
    if problem.goal == "forces":
        return MountForceGoal(_cases(prepare(vehicle), problem, targets, speed))
    for target in targets:
        for mount in _chosen(vehicle, target):
            if mount.bodies[1] == GROUND:
                raise VehicleError(
                    f"problem {problem.name!r}: mount {mount.name!r} stands on the ground, which has "
                    "no acceleration to become small; name mounts between bodies in a [[problem.mount]]"
                )
    return TransmissibilityGoal(_cases(prepare(_with_end_points(vehicle)), problem, targets, speed))


def _with_end_points(vehicle: Vehicle) -> Vehicle:
    """Return a vehicle that is felt at the ends of its mounts."""
    return replace(vehicle, response_points=_end_points(vehicle), problems=())


def _end_points(vehicle: Vehicle) -> tuple[ResponsePoint, ...]:
    """The carried ends of all mounts, then the carrying ones, to the ground the carried ones again."""
    last = [1 - (mount.bodies[1] == GROUND) for mount in vehicle.mounts]
    ends = [(mount, 0) for mount in vehicle.mounts] + list(zip(vehicle.mounts, last, strict=True))
    return tuple(
        ResponsePoint(f"{i}: {mount.name}", mount.bodies[end], mount.points[end])
        for i, (mount, end) in enumerate(ends)
    )


def _cases(
    prepared: Prepared, problem: Problem, targets: Sequence[MountTarget], speed: float
) -> tuple[MountCase, ...]:
    vehicle = prepared.vehicle
    cases = []
    for target in targets:
        selected = _selected(vehicle, target)
        for load in _loads(vehicle, problem, target):
            cases.append(MountCase(_under(prepared, load, speed), selected, target.weight))
    return tuple(cases)


def _under(prepared: Prepared, load: Load, speed: float) -> Driven:
    """Return a vehicle under a load, at lines that hold what its spectrum says."""
    lines = load_lines(prepared, [(load, speed)]) if is_random(load) else None
    return driven(prepared, [load], speed, lines)


def _loads(vehicle: Vehicle, problem: Problem, target: MountTarget) -> list[Load]:
    if target.loads:
        return [vehicle.load(name) for name in target.loads]
    usual = vehicle.usual_load or next(iter(vehicle.swept_loads), None)
    if usual is None:
        raise VehicleError(f"problem {problem.name!r}: goal {problem.goal!r} needs a load")
    return [usual]


def _chosen(vehicle: Vehicle, target: MountTarget) -> list[Mount]:
    return [m for m in vehicle.mounts if not target.mounts or m.name in target.mounts]


def _selected(vehicle: Vehicle, target: MountTarget) -> Floats:
    """(n_mounts, 3): one for the mounts and directions of a target."""
    chosen = _chosen(vehicle, target)
    selected = np.zeros((len(vehicle.mounts), 3))
    rows = [i for i, mount in enumerate(vehicle.mounts) if mount in chosen]
    selected[np.ix_(rows, [AXIS[direction] for direction in target.directions])] = 1.0
    return selected


def _each(end: Objective, rates: Rates) -> Floats:
    """What each output of an objective with one term adds to it, (n_outputs,)."""
    (term,) = end.terms
    return term.squares(end.criterion.power(term, end.response(rates))).sum(axis=0)


def _scaled(cases: Sequence[MountCase], factors: Floats) -> tuple[MountCase, ...]:
    pairs = zip(cases, factors.tolist(), strict=True)
    return tuple(replace(case, weight=factor * case.weight) for case, factor in pairs)
