"""All that can be asked of a tuning session, as one value: what is undone is a whole state."""

from collections.abc import Container, Mapping
from dataclasses import dataclass, field, replace
from itertools import chain, count
from typing import Literal

from modeviz.analysis.results import Conditions
from modeviz.dynamics.roles import unit_of_role
from modeviz.text.wording import sentence_case
from modeviz.vehicle.connections import RATE_FIELDS, RIDE_DIRECTIONS, MountRates, Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.planning.plan import Plan, first_plan

ORIGINAL = "Original"
"""The name of the vehicle's own rates among the sets."""

LINKED_DIGITS = 5
"""Of a rate that follows another: as many as a number on the page has room for."""

Coloring = Literal["bodies", "displacement", "kinetic energy", "strain energy"]
"""What the colours of the bodies mean."""

Ghost = Literal["none", "rest", "compared"]
"""Whose outlines are drawn beside: those at rest, or moving in the shape that is compared with."""

Motion = Literal["mode", "damped mode", "operating shape", "component"]
"""What moves: an undamped mode, the same with its damping, the shape at a frequency of excitation, or
one component alone."""


@dataclass(frozen=True)
class ResponseCurve:
    """A response that is drawn."""

    point: int
    """Number of the response point."""
    direction: str
    """One of `DIRECTIONS`."""


@dataclass(frozen=True)
class Variant:
    """A pinned set of rates."""

    rates: Rates
    """Of every mount group."""
    number: int
    """Its own among the pinned sets while it lives: its colour goes by it."""


@dataclass(frozen=True)
class State:
    """All that can be asked of a session."""

    rates: Rates
    """Of every mount group."""
    conditions: Conditions
    mode: str
    """The name of the shown mode with `mode_rates`; with others it may be called something else."""
    group: str
    """The selected mount group, or none: ""."""
    mode_rates: Rates = field(default_factory=dict)
    """With which it is called so, of the groups that differ from the vehicle's own."""

    variants: Mapping[str, Variant] = field(default_factory=dict)
    """The sets that were pinned, by name; see `rate_sets` for all there are."""
    against: str = ORIGINAL
    """The name of the set that all is compared with."""
    overlaid: frozenset[str] = frozenset()
    """Names of the sets that are drawn in the charts beside the one compared with."""

    locked: frozenset[tuple[str, str]] = frozenset()
    """Rates, (group, field of `MountRates`), that nothing moves but loading a whole set."""
    linked: frozenset[str] = frozenset()
    """Groups whose rates keep their ratios when one of them moves."""
    unit: str = "N/mm"
    """In which rates are shown."""
    plan: Plan | None = None
    """What a search is to look for; None where there is nothing to optimise for."""

    load: str = ""
    """The wheel load whose response is drawn, or the road: ""."""
    curves: tuple[ResponseCurve, ...] = (ResponseCurve(0, "lateral"), ResponseCurve(0, "vertical"))
    """What is drawn, top down; nothing where there is no response point."""
    decibels: bool = True
    log_frequency: bool = False

    motion: Motion = "mode"
    operating_hz: float = 11.0
    """The frequency of the operating shape."""
    component: str = ""
    """The body that is shown alone."""
    component_mode: int = 6
    """Which of its free modes."""

    coloring: Coloring = "bodies"
    see_through: bool = True
    ghost: Ghost = "rest"
    ghost_before: Ghost = "rest"
    """What those of the set compared with took the place of."""
    hidden: frozenset[str] = frozenset()
    """Bodies that are not drawn."""
    follow: bool = False
    """Whether cameras look at the selected group."""
    classic: bool = False
    """Whether the error of the classic method is shown beside."""

    def with_rates(self, rates: Rates) -> "State":
        """With other rates in the groups that are named, locked ones excepted."""
        free = {group: self._unlocked(group, new) for group, new in rates.items()}
        return replace(self, rates={**self.rates, **free})

    def with_rate(self, group: str, direction: str, rate: float) -> "State":
        """With another rate, N/m, in a field of `MountRates`; of a linked group all go in its ratio."""
        before = self.rates[group]
        if (group, direction) in self.locked:
            return self
        old = getattr(before, direction)
        if group in self.linked and old > 0:
            scaled = {
                name: float(f"{value * rate / old:.{LINKED_DIGITS}g}")
                for name, value in zip(RATE_FIELDS, before.as_tuple(), strict=True)
            }
        else:
            scaled = {}
        after = replace(before, **{**scaled, direction: rate})
        return replace(self.with_rates({group: after}), group=group)

    def with_mode(self, name: str, rates: Rates, group: str | None = None) -> "State":
        """Showing the mode that has a name with some rates, and a mount group if given.

        To see it, if something else moves.
        """
        motion = self.motion if self.motion == "damped mode" else "mode"
        group = self.group if group is None else group
        return replace(self, mode=name, mode_rates=rates, motion=motion, group=group)

    def with_ghost(self, ghost: Ghost) -> "State":
        """With other outlines, and those before remembered while the compared set's are drawn."""
        before = self.ghost_before if self.ghost == "compared" else self.ghost
        return replace(self, ghost=ghost, ghost_before=before)

    def with_variant(self, name: str, rates: Rates) -> "State":
        """With a pinned set; one that takes the place of another keeps its number."""
        taken = {variant.number for variant in self.variants.values()}
        before = self.variants.get(name)
        number = before.number if before else next(i for i in count() if i not in taken)
        return replace(self, variants={**self.variants, name: Variant(dict(rates), number)})

    def with_curve(self, chart: int, curve: ResponseCurve) -> "State":
        """Drawing another response in a chart, counted from the top."""
        curves = (*self.curves[:chart], curve, *self.curves[chart + 1 :])
        return replace(self, curves=curves)

    def _unlocked(self, group: str, new: MountRates) -> MountRates:
        """New rates of a group, with its locked ones as they are."""
        kept = {d: getattr(self.rates[group], d) for g, d in self.locked if g == group}
        return replace(new, **kept)


def first_state(vehicle: Vehicle, rates: Rates, conditions: Conditions) -> State:
    """What a session opens with: the rates given and the yaw of the cabin on its mounts.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    group = vehicle.mount_groups[0].name if vehicle.mount_groups else ""
    cabin = unit_of_role(vehicle, "cabin")
    mode = f"{cabin.word} yaw" if cabin else ""
    every = vehicle.all_rates(rates)
    felt = tuple(ResponseCurve(0, direction) for direction in RIDE_DIRECTIONS)
    curves = felt if vehicle.response_points else ()
    return State(
        every,
        conditions,
        mode,
        group,
        mode_rates=every,
        plan=first_plan(vehicle),
        curves=curves,
        component=vehicle.bodies[0].name,
    )


def known_sets(vehicle: Vehicle) -> dict[str, Rates]:
    """The sets of rates that come with a vehicle, its own first."""
    sets: dict[str, Rates] = {ORIGINAL: vehicle.rates}
    for name, rates in vehicle.rate_sets.items():
        sets.setdefault(sentence_case(name), vehicle.all_rates(rates))
    return sets


def rate_sets(vehicle: Vehicle, state: State) -> dict[str, Rates]:
    """Every set of rates that has a name: the vehicle's, then the pinned ones."""
    pinned = {name: variant.rates for name, variant in state.variants.items()}
    return {**known_sets(vehicle), **pinned}


def set_numbers(vehicle: Vehicle, state: State) -> dict[str, int]:
    """A number for each of `rate_sets`, which stays the same whatever else is pinned or forgotten."""
    known = {name: i for i, name in enumerate(known_sets(vehicle))}
    return known | {name: len(known) + variant.number for name, variant in state.variants.items()}


def compared_rates(vehicle: Vehicle, state: State) -> Rates:
    """The rates that all is compared with."""
    return rate_sets(vehicle, state)[state.against]


def variant_name(vehicle: Vehicle, state: State) -> str:
    """What the present rates are called: a set's name, or that of the next one to be pinned."""
    for name, rates in rate_sets(vehicle, state).items():
        if dict(rates) == dict(state.rates):
            return name
    return next_name(state)


def free_name(name: str, taken: Container[str]) -> str:
    """A name, or the first of "name 2", "name 3" ... that is free."""
    numbered = (f"{name} {i}" for i in count(2))
    return next(free for free in chain((name,), numbered) if free not in taken)


def next_name(state: State) -> str:
    """The first of "Trial 1", "Trial 2" ... that is free."""
    names = (f"Trial {i}" for i in count(1))
    return next(name for name in names if name not in state.variants)
