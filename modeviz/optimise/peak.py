"""The goal of a low peak: the largest acceleration over ranges of frequency."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions
from modeviz.analysis.sensitivity import spring_shares
from modeviz.dynamics.assembly import System
from modeviz.dynamics.resonances import resonances_at
from modeviz.optimise.heights import HighestBetween
from modeviz.optimise.min_max import MinMax
from modeviz.optimise.objective import (
    Criterion,
    LoadCase,
    Objective,
    Places,
    Term,
    lines_of,
    load_of,
    objective_on,
    pattern_of,
)
from modeviz.optimise.summits import Brackets, brackets, highest_lines, summits
from modeviz.ride.excitation import table_hz
from modeviz.vehicle.arrays import Complexes, Floats
from modeviz.vehicle.loads import HarmonicLoad
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle

WIDEST = 4
"""Steps of the band that a cell is wide at most: two summits in one take turns with a kink."""

BEYOND = 8
"""Steps by which what is prepared goes beyond all ranges, so that it holds at their ends."""

CLOSE = 1e-6
"""Hz: lines this close to the end of a cell or to a bend are left out."""

LEAST = 0.8
"""Of a case's largest square: what is below is far from being the largest, and taken at its line."""

NO_POWER = np.finfo(np.float64).tiny
"""G²/Hz: stands for zero where it is divided by."""


@dataclass(frozen=True, eq=False)
class PeakCase:
    """A load whose accelerations are to have no high peak between two frequencies."""

    load: Conditions | HarmonicLoad
    edges: Floats
    """(n_cells + 1,), Hz, rising: the range from the first to the last is parted here into cells; a
    single one is all of its range."""
    selected: Floats
    """(n_points, 3): factors of the weight for x, y, z of each response point."""
    weight: float = 1.0
    target: float = 0.0

    def on(self, lines: Floats) -> LoadCase:
        """Its squares at some lines."""
        pattern = np.broadcast_to(self.selected, (len(lines), *self.selected.shape))
        return LoadCase(self.load, tuple(lines.tolist()), self.weight, pattern, self.target)

    def of_vehicle(self, vehicle: Vehicle) -> "PeakCase":
        """Return the same case of the vehicle with mounts elsewhere or more of them."""
        if isinstance(self.load, Conditions):
            return self
        return replace(self, load=vehicle.harmonic_load(self.load.name))

    def parted(self, widest: float) -> "PeakCase":
        """Return the same cells, none wider than so many Hz."""
        counts = np.ceil(np.diff(self.edges) / widest - CLOSE).astype(int)
        spans = zip(pairwise(self.edges.tolist()), counts.tolist(), strict=True)
        parts = [np.linspace(low, high, n, endpoint=False) for (low, high), n in spans]
        return replace(self, edges=np.concatenate([*parts, self.edges[-1:]]))


@dataclass(frozen=True, eq=False)
class Largest(Criterion):
    """The largest w (a - target)² of each case at its lines, and of all."""

    def values(self, response: Complexes) -> Floats:
        squares = [term.squares(self.power(term, response)) for term in self.terms]
        return np.stack([own.max(axis=(-2, -1)) for own in squares], axis=-1)

    def join(self, values: Floats) -> Floats:
        return values.max(axis=-1)


@dataclass(frozen=True, eq=False)
class _AtLines(Objective):
    """The largest square of responses at given lines."""

    @property
    def criterion(self) -> Criterion:
        return Largest(self.driven.frequency_hz, self.terms)


@dataclass(frozen=True, eq=False)
class _Cells:
    """Where a case is highest at lines, in every cell at every output that counts."""

    frequency_hz: Floats
    """(n_parts,), a part being a cell at an output."""
    outputs: NDArray[np.intp]
    """(n_parts,)."""
    is_below: NDArray[np.bool_]
    """(n_parts,): whether the target is missed from below."""
    depth: Floats
    """(n_parts,), see `summits`."""
    brackets: Brackets
    """Of parts."""

    def depths(self, power: Floats, part: NDArray[np.intp]) -> Floats:
        """Depths of parts, (n, ...), from a² there."""
        is_below = self.is_below[part].reshape(len(part), *[1] * (power.ndim - 1))
        return np.where(is_below, power, 1 / np.maximum(power, NO_POWER))

    def at_summits(self, place: Floats, depth: Floats) -> Floats:
        """Return where parts are highest, (n_parts,), Hz, from the summits in brackets."""
        found, part = self.frequency_hz.copy(), self.brackets.part
        deepest_last = np.argsort(-depth)
        higher = deepest_last[depth[deepest_last] < self.depth[part[deepest_last]]]
        found[part[higher]] = place[higher]
        return found


@dataclass(frozen=True, eq=False)
class PeakGoal(MinMax):
    """max w (a - target)² over load cases, ranges of frequency, response points and directions.

    A range is parted into cells, in each of which the largest square is found between the lines that
    modes place. On a summit a curve does not change with frequency, so the derivatives of its height
    are those at a frequency that stays (J. M. Danskin, "The theory of max-min, with applications",
    SIAM Journal on Applied Mathematics 14(4), 1966).
    """

    prepared: Prepared
    """At lines that reach beyond all ranges, and between."""
    cases: tuple[PeakCase, ...]

    def value(self, rates: Rates) -> float:
        return self.join(self.values(rates))

    def values(self, rates: Rates) -> Floats:
        """The largest square of each case, (n_cases,); raises as `solve`."""
        return self._values(self.prepared.mount_stiffness(rates))

    def totals(self, stiffness: Complexes) -> Floats:
        """The largest of all, (n_sets,), of rates (n_sets, n_springs), complex, N/m; as `solve`."""
        return np.array([self.join(self._values(each)) for each in stiffness])

    def exact_value(self, rates: Rates) -> float:
        stiffness = self.prepared.mount_stiffness(rates)
        return self.exact_total(self.prepared.system_at(rates), stiffness)

    def exact_total(self, system: System, stiffness: Complexes) -> float:
        """Return the exact value of a system with these mount rates; raises as `direct_response`."""
        objective, _ = self._found(stiffness)
        return objective.exact_total(system, stiffness)

    def parts_and_gradients(self, rates: Rates) -> tuple[Floats, Floats]:
        stiffness = self.prepared.mount_stiffness(rates)
        return self._parts(stiffness, spring_shares(self.prepared, rates))

    def of_springs(self, stiffness: Complexes, shares: Complexes) -> tuple[float, Floats]:
        """The largest and its derivatives, see `Objective.of_springs`."""
        parts, gradients = self._parts(stiffness, shares)
        largest = parts.argmax()
        return float(parts[largest]), gradients[largest]

    def join(self, values: Floats) -> float:
        """The goal from the largest of each case."""
        return float(values.max())

    def scaled(self, factors: Floats) -> "PeakGoal":
        """Return the goal with other weights: each case's times a factor, (n_cases,)."""
        pairs = zip(self.cases, factors.tolist(), strict=True)
        return replace(
            self, cases=tuple(replace(case, weight=factor * case.weight) for case, factor in pairs)
        )

    def of_vehicle(self, vehicle: Vehicle) -> "PeakGoal":
        """Return the goal of the vehicle with mounts elsewhere or more of them; raises as `prepare`."""
        f, top_hz = self.prepared.frequency_hz, self.prepared.basis.top_hz
        prepared = prepare(vehicle, f, top_hz=top_hz, is_graded=True)
        return replace(self, prepared=prepared, cases=tuple(c.of_vehicle(vehicle) for c in self.cases))

    def on(self, lines: Floats) -> Objective:
        """Return the goal of vehicles with these lines, found between them and their midpoints."""
        closer = np.union1d(lines, (lines[1:] + lines[:-1]) / 2)
        return self._at([self._lines(case, closer) for case in self.cases], HighestBetween)

    def _values(self, stiffness: Complexes) -> Floats:
        objective, _ = self._found(stiffness)
        return objective.criterion.values(objective.driven.response(stiffness))

    def _parts(self, stiffness: Complexes, shares: Complexes) -> tuple[Floats, Floats]:
        """The largest square of every part, and derivatives."""
        objective, places = self._found(stiffness)
        return objective.squares(stiffness, shares, places)

    def _found(self, stiffness: Complexes) -> tuple[Objective, list[Places]]:
        """The objective at the frequencies where parts are highest, and where in it these are."""
        every = self._cells(stiffness)
        ends = np.cumsum([len(cells.brackets.part) for cells in every])[:-1]

        def depth(places: Floats) -> Floats:
            return np.concatenate(self._depths(stiffness, every, np.split(places, ends)))

        low, high = (
            np.concatenate([getattr(cells.brackets, end) for cells in every]) for end in ("low", "high")
        )
        found = (np.split(values, ends) for values in summits(low, high, depth))
        frequencies = [cells.at_summits(*own) for cells, *own in zip(every, *found, strict=True)]
        lines = [np.unique(f) for f in frequencies]
        places = [
            (np.searchsorted(own, f), cells.outputs)
            for own, f, cells in zip(lines, frequencies, every, strict=True)
        ]
        return self._at(lines), places

    def _cells(self, stiffness: Complexes) -> list[_Cells]:
        """The highest lines of each case."""
        placed = self.prepared.lines(resonances_at(self.prepared.basis, stiffness))
        lines = [self._lines(case, placed) for case in self.cases]
        objective = self._at(lines)
        response = objective.driven.response(stiffness)
        return [
            self._highest(case, f, term, objective.criterion.power(term, response))
            for case, f, term in zip(self.cases, lines, objective.terms, strict=True)
        ]

    def _highest(self, case: PeakCase, lines: Floats, term: Term, power: Floats) -> _Cells:
        """The highest lines of a case, from a² at its lines."""
        outputs = np.flatnonzero(term.weights[0])
        squares = term.squares(power)[:, outputs]
        edges = np.searchsorted(lines, case.edges)
        highest = highest_lines(squares, edges)
        bends = np.isin(lines, self._bends(case))
        least = LEAST * squares.max(initial=0.0)
        found = brackets(lines, squares, edges, bends, highest, least)
        own = np.broadcast_to(outputs, highest.shape).ravel()
        at_top = power[highest.ravel(), own]
        cells = _Cells(lines[highest.ravel()], own, at_top < case.target**2, at_top, found)
        return replace(cells, depth=cells.depths(at_top, np.arange(len(own))))

    def _depths(
        self, stiffness: Complexes, every: Sequence[_Cells], places: Sequence[Floats]
    ) -> list[Floats]:
        """Depths of the parts of each case's brackets at places, (n, 3) of each."""
        lines = [np.unique(own) for own in places]
        objective = self._at(lines)
        response, found = objective.driven.response(stiffness), []
        for cells, own, at, term in zip(every, lines, places, objective.terms, strict=True):
            part = cells.brackets.part
            power = objective.criterion.power(term, response)
            found.append(
                cells.depths(power[np.searchsorted(own, at), cells.outputs[part][:, None]], part)
            )
        return found

    def _at(self, lines: Sequence[Floats], kind: type[Objective] = _AtLines) -> Objective:
        """The largest square of each case at lines of its own, or of another kind."""
        cases = [case.on(own) for case, own in zip(self.cases, lines, strict=True)]
        return objective_on(self.prepared.on(lines_of(cases)), cases, kind)

    def _lines(self, case: PeakCase, placed: Floats) -> Floats:
        """The lines of a case among those placed, with the ends of its cells and bends of its load."""
        fixed = np.union1d(case.edges, self._bends(case))
        after = np.searchsorted(fixed, placed)
        low, high = (fixed[np.clip(after + side, 0, len(fixed) - 1)] for side in (-1, 0))
        is_between = (placed > low + CLOSE) & (placed < high - CLOSE)
        return np.union1d(fixed, placed[is_between])

    def _bends(self, case: PeakCase) -> Floats:
        """Return where within the range the load's spectrum bends."""
        bends = table_hz(*load_of(self.prepared.vehicle, case.load))
        apart = np.abs(bends[:, None] - case.edges).min(axis=1)
        is_within = (bends > case.edges[0]) & (bends < case.edges[-1])
        return bends[is_within & (apart > CLOSE)]


def prepare_peak(vehicle: Vehicle, listed: Sequence[LoadCase]) -> PeakGoal:
    """The peak of load cases, of each from its first frequency to its last.

    Args:
        vehicle: which they shake.
        listed: one or more; what weighs at one of its frequencies does so in all of the range.

    Raises:
        VehicleError: a load that the vehicle does not have.
        SolveError: as `prepare`.
    """
    cases = [_ranged(vehicle, case) for case in listed]
    step = vehicle.frequency_step
    first = min(case.edges[0] for case in cases)
    last = max(case.edges[-1] for case in cases)
    numbers = np.arange(max(1, int(first / step) - BEYOND), int(last / step) + BEYOND + 2)
    lines = np.round(numbers * step, 12).astype(np.float64)
    top_hz = max(vehicle.highest_frequency, last)
    prepared = prepare(vehicle, lines, top_hz=top_hz, is_graded=True)
    return PeakGoal(prepared, tuple(case.parted(WIDEST * step) for case in cases))


def _ranged(vehicle: Vehicle, case: LoadCase) -> PeakCase:
    edges = np.asarray(case.frequency_hz, np.float64)
    selected = pattern_of(vehicle, case).max(axis=0)
    return PeakCase(case.load, edges, selected, case.weight, case.target)
