"""What the optimiser is to make small: weighted sums of squared accelerations, as the paper's."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import AXIS, Conditions
from modeviz.analysis.sensitivity import psd_gradient, psd_sum_gradient, spring_shares
from modeviz.dynamics.assembly import System
from modeviz.dynamics.reanalysis import Receptances
from modeviz.dynamics.response import check_frequencies, direct_response
from modeviz.errors import SolveError
from modeviz.ride.averaging import averaged_spectrum
from modeviz.ride.excitation import Excitation, Load, excitation, input_spectrum, together
from modeviz.ride.psd import averaged_acceleration_psd
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import HarmonicLoad, Road
from modeviz.vehicle.mount_rates import RIDE_DIRECTIONS, Rates
from modeviz.vehicle.vehicle import Vehicle

SAME_HZ = 1e-9
"""Frequencies this close are the same."""

Places = tuple[NDArray[np.intp], NDArray[np.intp]]
"""Of a case: numbers of lines and outputs, (n,) each."""


@dataclass(frozen=True, eq=False)
class LoadCase:
    """A load whose accelerations at some frequencies are to be small."""

    load: Conditions | HarmonicLoad
    frequency_hz: Sequence[float]
    """Rising, above zero."""
    weight: float = 1.0
    """Of every squared difference from the target."""
    pattern: Floats | None = None
    """(n_freqs, n_points, 3): factors of the weight for x, y, z of each response point; None is one for
    lateral and vertical."""
    target: float = 0.0
    """The desired acceleration: g under a wheel load, g/√Hz on a road."""
    is_averaged: bool = False
    """Whether the load's spectrum at a frequency is that around it, for an integral."""


@dataclass(frozen=True, eq=False)
class Term:
    """A case among the frequencies and inputs of all cases."""

    weights: Floats
    """(n_lines, n_outputs)."""
    target: float
    lines: NDArray[np.intp]
    inputs: slice
    input_psd: Complexes
    """Of the case's inputs at its lines."""

    def own(self, of_all: Complexes) -> Complexes:
        """The case's part of an array whose last axes are frequency, another one and input."""
        return of_all[..., self.inputs].take(self.lines, axis=-3)

    def squares(self, power: Floats) -> Floats:
        """W (a - target)², from a², (..., n_lines, n_outputs) both."""
        if not self.target:
            return self.weights * power
        return self.weights * (np.sqrt(np.maximum(power, 0.0)) - self.target) ** 2

    def value(self, power: Floats) -> Floats:
        """Σ w (a - target)², from a² (..., n_lines, n_outputs)."""
        return self.squares(power).sum(axis=(-2, -1))

    def slope(self, power: Floats) -> Floats:
        """∂value/∂a², as a² (n_lines, n_outputs); 0 where nothing moves, for there it has none."""
        if not self.target:
            return self.weights
        a = np.sqrt(np.maximum(power, 0.0))
        return self.weights * (1 - np.divide(self.target, a, out=np.ones_like(a), where=a > 0))


@dataclass(frozen=True, eq=False)
class Criterion:
    """What responses cost, whatever they come from."""

    frequency_hz: Floats
    """(n_freqs,): of all cases together."""
    terms: tuple[Term, ...]
    """One for each case."""

    def values(self, response: Complexes) -> Floats:
        """Return what each case adds to F, (..., n_cases).

        Args:
            response: (..., n_freqs, n_outputs, n_inputs), as of `Objective.driven`.
        """
        return np.stack([term.value(self.power(term, response)) for term in self.terms], axis=-1)

    def join(self, values: Floats) -> Floats:
        """F, (...,), from what each case adds to it."""
        return values.sum(axis=-1)

    def total(self, response: Complexes) -> Floats:
        """F, (...,); argument as of `values`."""
        return self.join(self.values(response))

    def power(self, term: Term, response: Complexes) -> Floats:
        """a² of a case, (..., n_lines, n_outputs), from the response of all outputs to all inputs."""
        return averaged_acceleration_psd(
            self.frequency_hz[term.lines], term.own(response), term.input_psd
        )


@dataclass(frozen=True, eq=False)
class Objective:
    """F = Σ w (a - target)² over load cases, frequencies, response points and directions.

    a is the peak acceleration, g, under a wheel load and the root of the PSD, g/√Hz, on a road (Duncan,
    "Optimization": all targets zero, all weights one, so that the two units add up as they are).
    """

    prepared: Prepared
    """At the frequencies of all cases together."""
    driven: Receptances
    """With the inputs of all cases, one case after the other, and those outputs that have a weight."""
    loads: tuple[tuple[Load, float], ...]
    """Those of the cases, and the speed, m/s."""
    outputs: NDArray[np.intp]
    """Which rows of `prepared.outputs` have a weight."""
    terms: tuple[Term, ...]
    """One for each case."""

    def value(self, rates: Rates) -> float:
        """F at rates of the groups that differ from the vehicle's own; raises as `solve`."""
        return float(self.criterion.total(self.response(rates)))

    def values(self, rates: Rates) -> Floats:
        """Return what each case adds to F, (n_cases,); raises as `solve`."""
        return self.criterion.values(self.response(rates))

    def exact_value(self, rates: Rates) -> float:
        """F from the equations of motion of the full model; raises as `exact_response`."""
        return float(self.criterion.total(self.exact_response(rates)))

    def response(self, rates: Rates) -> Complexes:
        """Return the response, (n_freqs, n_outputs, n_inputs); raises as `solve`."""
        return self.driven.response(self.prepared.mount_stiffness(rates))

    def exact_response(self, rates: Rates) -> Complexes:
        """Return the response from the equations of motion of the full model, frequency by frequency.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: as `direct_response`.
        """
        system = self.prepared.system_at(rates)
        return self.exact_response_of(system, self.prepared.mount_stiffness(rates))

    def totals(self, stiffness: Complexes) -> Floats:
        """F of many sets of rates, (n_sets,), from (n_sets, n_springs), complex, N/m; as `solve`."""
        return self.criterion.total(self.driven.responses(stiffness))

    def exact_total(self, system: System, stiffness: Complexes) -> float:
        """F of a system with these mount rates; raises as `direct_response`."""
        return float(self.criterion.total(self.exact_response_of(system, stiffness)))

    def join(self, values: Floats) -> float:
        """F from what each case adds to it."""
        return float(self.criterion.join(values))

    def exact_response_of(self, system: System, stiffness: Complexes) -> Complexes:
        """Return the exact response of a system other than the prepared one, as `direct_response`.

        Args:
            system: with its mounts.
            stiffness: (n_springs,), their complex rates, N/m.
        """
        prepared = self.prepared
        there = self.driven.law.stiffness(stiffness, prepared.frequency_hz)
        inputs = _inputs(prepared, self.loads, there)
        forces = prepared.input_directions.T @ inputs.forces
        return direct_response(system, prepared.frequency_hz, forces, prepared.outputs[self.outputs])

    def value_and_gradient(self, rates: Rates) -> tuple[float, Floats]:
        """F and ∂F/∂k, (n_variables,) in the order of `rate_variables`; raises as `solve`."""
        stiffness = self.prepared.mount_stiffness(rates)
        return self.of_springs(stiffness, spring_shares(self.prepared, rates))

    def of_springs(self, stiffness: Complexes, shares: Complexes) -> tuple[float, Floats]:
        """F and its derivatives to whatever the springs depend on, (n_variables,).

        Args:
            stiffness: (n_springs,), complex rates, N/m.
            shares: (n_springs, n_variables), the derivatives of these.

        Raises:
            SolveError: with these rates an undamped resonance lies on a frequency.
        """
        value, gradient = 0.0, np.zeros(shares.shape[1])
        for term, power, response in self._responses(stiffness):
            value += float(term.value(power))
            gradient += psd_sum_gradient(*response, shares, term.slope(power))
        return value, gradient

    def squares(
        self, stiffness: Complexes, shares: Complexes, places: Sequence[Places]
    ) -> tuple[Floats, Floats]:
        """W (a - target)² at some places, (n_parts,), and derivatives, (n_parts, n_variables).

        Args:
            stiffness: as of `of_springs`, as is what it raises.
            shares: likewise.
            places: of each case.
        """
        squares, gradients = [], []
        cases = zip(self._responses(stiffness), places, strict=True)
        for (term, power, response), at in cases:
            change = psd_gradient(*response, shares)
            squares.append(term.squares(power)[at])
            gradients.append(term.slope(power)[at][:, None] * change[at])
        return np.concatenate(squares), np.concatenate(gradients)

    def _responses(
        self, stiffness: Complexes
    ) -> Iterator[tuple[Term, Floats, tuple[Floats, Complexes, Complexes, Complexes, Complexes]]]:
        """Each case, its a², and the first five arguments of `psd_gradient`; raises as `of_springs`."""
        H, a, b = self.driven.response_gradient(stiffness)
        for term in self.terms:
            f, own = self.driven.frequency_hz[term.lines], term.own(H)
            power = averaged_acceleration_psd(f, own, term.input_psd)
            yield term, power, (f, own, a[term.lines], term.own(b), term.input_psd)

    @property
    def criterion(self) -> Criterion:
        """What makes F of responses."""
        return Criterion(self.driven.frequency_hz, self.terms)

    def of_vehicle(self, vehicle: Vehicle) -> "Objective":
        """Return the objective of the vehicle with mounts elsewhere or more of them; as `prepare`."""
        prepared = prepare(vehicle, self.prepared.frequency_hz)
        loads = tuple((vehicle.load(load.name), speed) for load, speed in self.loads)
        driven = _driven(prepared, loads, self.outputs)
        return replace(self, prepared=prepared, loads=loads, driven=driven)

    def scaled(self, factors: Floats) -> "Objective":
        """Return the objective with other weights: each case's times a factor, (n_cases,)."""
        terms = tuple(
            replace(term, weights=factor * term.weights)
            for term, factor in zip(self.terms, factors, strict=True)
        )
        return replace(self, terms=terms)


def prepare_objective(vehicle: Vehicle, cases: Sequence[LoadCase]) -> Objective:
    """The objective of some load cases.

    Raises:
        VehicleError: a road that the vehicle does not have.
        SolveError: no cases, frequencies that are not above zero and rising, or as `prepare`.
    """
    if not cases:
        raise SolveError("the objective has no load cases, expected one or more")
    for case in cases:
        check_frequencies(np.asarray(case.frequency_hz, float))
    return objective_on(prepare(vehicle, lines_of(cases)), cases)


def lines_of(cases: Sequence[LoadCase]) -> Floats:
    """The frequencies of all cases, rising, each once."""
    every = np.sort(np.concatenate([np.asarray(c.frequency_hz, float) for c in cases]))
    return every[np.diff(every, prepend=0.0) > SAME_HZ]


def objective_on(
    prepared: Prepared, cases: Sequence[LoadCase], kind: type[Objective] = Objective
) -> Objective:
    """Return the objective of a vehicle that is prepared for the frequencies of all cases."""
    vehicle = prepared.vehicle
    loads = tuple(load_of(vehicle, case.load) for case in cases)
    widths = [2 if isinstance(load, Road) else 1 for load, _ in loads]
    ends = np.cumsum([0, *widths])
    weights = [_weights(vehicle, case) for case in cases]
    outputs = np.flatnonzero(sum(w.sum(axis=0) for w in weights))
    terms = tuple(
        _term(prepared, case, its[:, outputs], slice(*own))
        for case, its, own in zip(cases, weights, pairwise(ends), strict=True)
    )
    return kind(prepared, _driven(prepared, loads, outputs), loads, outputs, terms)


def _driven(
    prepared: Prepared, loads: Sequence[tuple[Load, float]], outputs: NDArray[np.intp]
) -> Receptances:
    """Receptances of some outputs to some loads, one after the other."""
    receptances = prepared.receptances.with_outputs(outputs)
    inputs = _inputs(prepared, loads, receptances.present)
    return receptances.driven(inputs.forces, inputs.ground)


def pattern_of(vehicle: Vehicle, case: LoadCase) -> Floats:
    """The pattern of a case, (n_freqs, n_points, 3)."""
    shape = (len(case.frequency_hz), len(vehicle.response_points), 3)
    if case.pattern is not None:
        return np.broadcast_to(case.pattern, shape)
    pattern = np.zeros(shape)
    pattern[..., [AXIS[d] for d in RIDE_DIRECTIONS]] = 1.0
    return pattern


def _weights(vehicle: Vehicle, case: LoadCase) -> Floats:
    """Return what each acceleration squared of a case counts, (n_freqs, 3 n_points)."""
    n_outputs = 3 * len(vehicle.response_points)
    return case.weight * pattern_of(vehicle, case).reshape(-1, n_outputs)


def _term(prepared: Prepared, case: LoadCase, weights: Floats, inputs: slice) -> Term:
    """A case among the frequencies of all cases, given which of all inputs it has."""
    lines = np.searchsorted(prepared.frequency_hz, np.subtract(case.frequency_hz, SAME_HZ))
    f = prepared.frequency_hz[lines]
    load, speed = load_of(prepared.vehicle, case.load)
    spectrum = (averaged_spectrum if case.is_averaged else input_spectrum)(load, f, speed)
    return Term(weights, case.target, lines, inputs, spectrum)


def load_of(vehicle: Vehicle, load: Conditions | HarmonicLoad) -> tuple[Load, float]:
    """The load of a case and its speed, m/s, which only a road minds."""
    if isinstance(load, Conditions):
        return vehicle.random_load(load.road), load.speed
    return load, vehicle.speed


def _inputs(
    prepared: Prepared, loads: Sequence[tuple[Load, float]], stiffness: Complexes
) -> Excitation:
    """Return all inputs of some loads with the mount rates given."""
    vehicle, f = prepared.vehicle, prepared.frequency_hz
    return together([excitation(vehicle, load, f, speed, stiffness) for load, speed in loads])
