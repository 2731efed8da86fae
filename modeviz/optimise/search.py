"""A goal, the designs among which it is to become small, and how good one is."""

from collections.abc import Hashable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from modeviz.analysis.latest import Latest
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.sensitivity import rate_variables
from modeviz.errors import SolveError, located
from modeviz.mounting.working_point import WorkingPoint, working_point
from modeviz.optimise.deflections import Deflections, prepare_deflections
from modeviz.optimise.design_space import DesignSpace, design_space
from modeviz.optimise.goals import Goal, prepare_goal
from modeviz.optimise.min_max import MinMax
from modeviz.optimise.place_checks import check_places, is_undamped, moved_masses
from modeviz.optimise.place_terms import change_of, goal_term, margin_terms
from modeviz.optimise.probes import Probes
from modeviz.optimise.windows import Windows, prepare_windows
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements, placed_vehicle
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Aims:
    """What is sought of a vehicle whose mounts are somewhere, and what it has to keep to."""

    goal: Goal
    windows: Windows | None = None
    deflections: Deflections | None = None

    @property
    def kept(self) -> tuple[Windows | Deflections, ...]:
        """What designs have to keep to beside bounds and ratio limits."""
        return tuple(each for each in (self.windows, self.deflections) if each is not None)

    def of_vehicle(self, vehicle: Vehicle) -> "Aims":
        """Return the same of the vehicle with mounts elsewhere or more of them; raises as `prepare`."""
        return Aims(
            self.goal.of_vehicle(vehicle),
            self.windows and self.windows.of_vehicle(vehicle),
            self.deflections and self.deflections.of_vehicle(vehicle),
        )


@dataclass(frozen=True, eq=False)
class Search:
    """A goal, and the designs among which it is to become small."""

    space: DesignSpace
    goal: Goal
    """Of the vehicle with its mounts where they were given, as are the next two."""
    windows: Windows | None = None
    deflections: Deflections | None = None
    is_undamped: bool = False
    """Whether damping has no part in the goal."""

    @property
    def kept(self) -> tuple[Windows | Deflections, ...]:
        """What designs have to keep to beside bounds and ratio limits."""
        return self._given.kept

    @property
    def kept_words(self) -> list[str]:
        """What a person calls each of `margins`."""
        return [words for each in self.kept for words in each.spoken]

    def evaluate(self, x: Floats) -> tuple[float, Floats]:
        """The goal of a design, and its derivatives, (n_variables,).

        Raises:
            SolveError: it has none, with the rates.
        """
        rates = self.space.rates(x)
        with self._naming(x):
            goal = self._probing(x).goal
            value, by_rate = goal.value_and_gradient(rates)
            more, by_move = change_of(goal, self._moved(x))
            by_place = self._told(x, by_rate) + goal_term(goal, rates, self.probes)
            gradient = self._by_x(rates, by_rate, by_place)
            gradient[self.space.n_rates :] += by_move
            _check_finite(value, gradient)
        return value + more, gradient

    def value(self, x: Floats) -> float:
        """The goal of a design; raises as `evaluate`."""
        with self._naming(x):
            goal = self.at(x).goal
            value = goal.value(self.space.rates(x)) + change_of(goal, self._moved(x))[0]
            _check_finite(value)
        return value

    def exact_value(self, x: Floats) -> float:
        """Return the goal of a design from the full model; raises as `Goal.exact_value`."""
        goal = self.at(x).goal
        return goal.exact_value(self.space.rates(x)) + change_of(goal, self._moved(x))[0]

    def parts(self, x: Floats) -> tuple[Floats, Floats]:
        """Return the parts of a `MinMax`, (n,), and their derivatives, (n, n_variables).

        Raises:
            SolveError: as `evaluate`.
        """
        rates = self.space.rates(x)
        with self._naming(x):
            goal = self._probing(x).goal
            assert isinstance(goal, MinMax)
            parts, by_rate = goal.parts_and_gradients(rates)
            gradients = self._by_x(rates, by_rate, self._told(x, by_rate))
            _check_finite(float(parts.max()), gradients)
        return parts, gradients

    def margins(self, x: Floats) -> tuple[Floats, Floats]:
        """Return what is left to ends of windows and to limits of deflections, and derivatives.

        (n_ends,) and (n_ends, n_variables).
        """
        if not self.kept:
            return np.zeros(0), np.zeros((0, self.space.n_variables))
        rates, found = self.space.rates(x), []
        for each in self._probing(x).kept:
            values, by_rate = each.margins(rates)
            if isinstance(each, Deflections):
                by_place = margin_terms(each, by_rate, rates, self.probes)
            else:
                by_place = self._told(x, by_rate)
            found.append((values, self._by_x(rates, by_rate, by_place)))
        values, slopes = zip(*found, strict=True)
        return np.concatenate(values), np.vstack(slopes)

    def at(self, x: Floats) -> Aims:
        """What is sought of a design with its mounts where it has them, at any rates."""
        placements = self.space.placements(x)
        if not placements:
            return self._given
        return self._latest.get(
            _key(placements),
            lambda: self._given.of_vehicle(placed_vehicle(self._unplaced, placements)),
        )

    def _probing(self, x: Floats) -> Aims:
        """The same with probes about mounts, if any may be placed otherwise."""
        if not self.space.places.variables:
            return self.at(x)
        placements = self.space.placements(x)
        return self._latest_probing.get(
            _key(placements), lambda: self._given.of_vehicle(self.probes.placed(placements))
        )

    @cached_property
    def _given(self) -> Aims:
        return Aims(self.goal, self.windows, self.deflections)

    @cached_property
    def probes(self) -> Probes:
        """Mounts without rates that tell what placing the vehicle's otherwise does."""
        return Probes(self._unplaced, self.space.places, self.space.base)

    @cached_property
    def _unplaced(self) -> Vehicle:
        """The vehicle to place mounts of, without dampers of modes where these do not matter."""
        vehicle = self.space.vehicle
        return replace(vehicle, mode_damping=()) if self.is_undamped else vehicle

    @cached_property
    def _latest(self) -> Latest[Aims]:
        return Latest()

    @cached_property
    def _latest_probing(self) -> Latest[Aims]:
        return Latest()

    @cached_property
    def _latest_working(self) -> Latest[WorkingPoint]:
        return Latest()

    @contextmanager
    def _naming(self, x: Floats) -> Iterator[None]:
        """Says with which rates something cannot be solved."""
        try:
            yield
        except SolveError as error:
            raise SolveError(f"{error}; with {self.space.spoken(x)}") from None

    def _moved(self, x: Floats) -> Floats:
        """How far mounts of a design are from where they were at first, parts of bounds' widths."""
        places = self.space.places
        return x[self.space.n_rates :] - places.to_x(places.base)

    def _told(self, x: Floats, by_rate: Floats) -> Floats:
        """What probes tell of derivatives to places, (..., n_places), per m or rad.

        Args:
            x: a design.
            by_rate: derivatives to rates, (..., n_rates), those of probes last.
        """
        if not self.space.places.variables:
            return np.zeros((*by_rate.shape[:-1], 0))
        rates, placements = self.space.rates(x), self.space.placements(x)
        working = self._latest_working.get(
            _key(placements), lambda: working_point(placed_vehicle(self.space.vehicle, placements))
        )
        by_place = self.probes.by_place(rates, working.tangents(rates))
        return by_rate[..., -len(by_place) :] @ by_place

    def _by_x(self, rates: Rates, by_rate: Floats, by_place: Floats) -> Floats:
        """Derivatives to x of what has derivatives to rates, (..., n_rates): dk = k dx.

        Args:
            rates: of a design.
            by_rate: those of probes may follow.
            by_place: of places, (..., n_places).
        """
        k = [getattr(rates[v.group], v.direction) for v in rate_variables(self.space.vehicle)]
        by_x = (by_rate[..., : len(k)] * k) @ self.space.members
        by_x[..., self.space.n_rates :] = by_place * self.space.places.widths
        return by_x


def _key(placements: Placements) -> Hashable:
    return frozenset(placements.items())


def _check_finite(value: float, gradient: Floats | float = 0.0) -> None:
    if not (np.isfinite(value) and np.isfinite(gradient).all()):
        raise SolveError(f"the goal is {value} and its derivatives are {gradient}")


def prepare_search(
    vehicle: Vehicle,
    problem: Problem,
    rates: Rates,
    speed: float,
    locked: frozenset[tuple[str, str]] = frozenset(),
    placements: Placements | None = None,
) -> Search:
    """The search for better rates that a problem asks for.

    Args:
        vehicle: with the rates that the goal is normalised with.
        problem: which rates may change, within what, and what is to become small.
        rates: of every group: what others keep, what fixed ratios are of, and from which a change is
            measured.
        speed: on the roads, m/s.
        locked: rates, (group, field of `MountRates`), that may not change.
        placements: where mounts are that may not be placed otherwise, and where others begin; None:
            where they were given. The goal is normalised with all of them where they were given.

    Raises:
        VehicleError: as `prepare_goal`, `design_space` and `prepare_windows`.
        SolveError: as `prepare_goal`.
    """
    with located(f"problem {problem.name!r}"):
        space = design_space(vehicle, problem.groups, rates, locked, placements)
        check_places(vehicle, problem)
    goal = prepare_goal(vehicle, problem, rates, speed)
    with located(f"problem {problem.name!r}"):
        windows = prepare_windows(prepare_modes(vehicle), problem.windows) if problem.windows else None
        limits = problem.deflections
        deflections = prepare_deflections(vehicle, limits) if limits else None
        if deflections and any(moved_masses(vehicle, problem)):
            deflections.check_held()
    return Search(space, goal, windows, deflections, is_undamped(problem))
