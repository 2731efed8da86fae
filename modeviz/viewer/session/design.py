"""What is decided in a tuning session: rates, pinned sets, what may move and what is sought."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from itertools import count

from modeviz.report.rate_fields import is_damping
from modeviz.text.wording import sentence_case
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorber_parts import absorber_spring
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.decoupling import USUAL, Decoupling
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.placement import Placement, Placements
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.planning.plan import Plan

ORIGINAL = "Original"
"""The name of the vehicle's own rates among the sets."""

LINKED_DIGITS = 4
"""Of a rate that follows another: as many as a number on the page has room for."""


STIFFEST = 1e9
"""N/m, or whatever it is in SI: what is stiffer is rigid, or a slip of the finger."""


@dataclass(frozen=True)
class Variant:
    """A pinned set of rates."""

    rates: Rates
    """Of every mount group that there was when it was pinned."""
    number: int
    """Its own among the pinned sets while it lives: its colour goes by it."""
    placements: Placements = field(default_factory=dict)
    """Where mounts were with these rates, of the groups that were placed otherwise."""
    absorbers: tuple[Absorber, ...] = ()
    """Those that it has and the file does not."""

    @property
    def alterations(self) -> Alterations:
        """What is other with it than in the vehicle's file."""
        return Alterations(self.placements, self.absorbers)


@dataclass(frozen=True)
class NamedSet:
    """What a name stands for: rates, and the vehicle that has them."""

    rates: Rates
    """Of every mount group that this vehicle has."""
    alterations: Alterations


@dataclass(frozen=True)
class Design:
    """All that is decided; `History` goes back over nothing else."""

    rates: Rates
    """Of every mount group."""
    variants: Mapping[str, Variant] = field(default_factory=dict)
    """The sets that were pinned, by name; see `rate_sets` for all there are."""
    locked: frozenset[tuple[str, str]] = frozenset()
    """Rates, (group, field of `MountRates`), that nothing moves but loading a whole set."""
    linked: frozenset[str] = frozenset()
    """Groups whose rates keep their ratios when one of them moves; dampers go with dampers only."""
    plan: Plan | None = None
    """What a search is to look for; None where there is nothing to optimise for."""
    alterations: Alterations = field(default_factory=Alterations)
    """What else is other than in the vehicle's file."""
    decoupling: Decoupling = USUAL
    """What the modes of bodies on their mounts are held against."""

    def with_rates(self, rates: Rates) -> "Design":
        """Return it with other rates in the groups that are named, locked ones excepted."""
        free = {group: self._unlocked(group, new) for group, new in rates.items()}
        return replace(self, rates={**self.rates, **free})

    def with_rate(self, group: MountGroup, field: str, rate: float) -> "Design":
        """Return it with another rate, in SI, and those of a linked group that keep a ratio to it.

        Args:
            group: whose rate.
            field: which, one of the group's own.
            rate: what it becomes.
        """
        before = self.rates[group.name]
        if (group.name, field) in self.locked:
            return self
        old, scaled = getattr(before, field), {}
        if group.name in self.linked and old > 0:
            alike = (f for f in group.fields if is_damping(f) == is_damping(field))
            scaled = {
                name: float(f"{getattr(before, name) * rate / old:.{LINKED_DIGITS}g}") for name in alike
            }
        return self.with_rates({group.name: replace(before, **{**scaled, field: rate})})

    def with_placement(self, group: str, placement: Placement) -> "Design":
        """Return it with the mounts of a group moved and turned otherwise."""
        return replace(self, alterations=self.alterations.with_placement(group, placement))

    def with_absorber(self, absorber: Absorber) -> "Design":
        """Return it with one more absorber, which the search may tune, or another of its name."""
        spring = absorber_spring(absorber)
        plan = self.plan and self.plan.with_mounts(spring)
        alterations = self.alterations.with_absorber(absorber)
        rates = {**self.rates, absorber.name: spring.rates}
        return replace(self, alterations=alterations, rates=rates, plan=plan)

    def without_absorber(self, name: str) -> "Design":
        """Return it without an absorber that was added, and without all that is said of its mounts.

        Sets that were pinned with it keep it.
        """
        return replace(
            self,
            alterations=self.alterations.without_absorber(name),
            rates={group: rates for group, rates in self.rates.items() if group != name},
            locked=frozenset(key for key in self.locked if key[0] != name),
            linked=self.linked - {name},
            plan=self.plan and self.plan.without_mounts(name),
        )

    def with_set(self, wanted: NamedSet) -> "Design":
        """Return it as a set has it: its rates, locked ones too, its places and its absorbers."""
        design, absorbers = self, wanted.alterations.absorbers
        for absorber in self.alterations.absorbers:
            if wanted.alterations.absorber(absorber.name) is None:
                design = design.without_absorber(absorber.name)
        for absorber in absorbers:
            design = design.with_absorber(absorber)
        return replace(design, rates=wanted.rates, alterations=wanted.alterations)

    def with_placements(self, placements: Placements) -> "Design":
        """Return it with all mounts placed so."""
        return replace(self, alterations=self.alterations.placed(placements))

    def with_variant(self, name: str, rates: Rates) -> "Design":
        """Return it with rates pinned as all else is now; in place of another by its number."""
        taken = {variant.number for variant in self.variants.values()}
        before = self.variants.get(name)
        number = before.number if before else next(i for i in count() if i not in taken)
        alterations = self.alterations
        pinned = Variant(dict(rates), number, alterations.placements, alterations.absorbers)
        return replace(self, variants={**self.variants, name: pinned})

    def _unlocked(self, group: str, new: MountRates) -> MountRates:
        """New rates of a group, with its locked ones as they are."""
        kept = {d: getattr(self.rates[group], d) for g, d in self.locked if g == group}
        return replace(new, **kept)


def known_sets(vehicle: Vehicle) -> dict[str, Rates]:
    """Return the sets of rates that come with a vehicle, its own first."""
    sets: dict[str, Rates] = {ORIGINAL: vehicle.rates}
    for name, rates in vehicle.rate_sets.items():
        sets.setdefault(sentence_case(name), vehicle.all_rates(rates))
    return sets


def named_sets(vehicle: Vehicle, design: Design) -> dict[str, NamedSet]:
    """Return every set that has a name: the vehicle's, all as in its file, then the pinned ones.

    Each is as it was, without what has been added since.

    Args:
        vehicle: altered as in the design, or not.
        design: what is decided.
    """
    given = [group for group in design.rates if design.alterations.absorber(group) is None]
    known = {
        name: NamedSet({group: rates[group] for group in given}, Alterations())
        for name, rates in known_sets(vehicle).items()
    }
    pinned = {n: NamedSet(dict(each.rates), each.alterations) for n, each in design.variants.items()}
    return {**known, **pinned}


def rate_sets(vehicle: Vehicle, design: Design) -> dict[str, Rates]:
    """Return the rates of `named_sets`."""
    return {name: each.rates for name, each in named_sets(vehicle, design).items()}


def current_set(vehicle: Vehicle, design: Design) -> str | None:
    """Return the name of the set that the present design is; None if it has none."""
    present = NamedSet(dict(design.rates), design.alterations)
    return next((n for n, each in named_sets(vehicle, design).items() if each == present), None)


def set_numbers(vehicle: Vehicle, design: Design) -> dict[str, int]:
    """Return a number for each of `rate_sets`, the same whatever else is pinned or forgotten."""
    known = {name: i for i, name in enumerate(known_sets(vehicle))}
    return known | {name: len(known) + variant.number for name, variant in design.variants.items()}


def variant_name(vehicle: Vehicle, design: Design) -> str:
    """Return what the present design is called: a set's name, or that of the next one to be pinned."""
    return current_set(vehicle, design) or next_name(design)


def next_name(design: Design) -> str:
    """Return the first of "Trial 1", "Trial 2" ... that is free."""
    names = (f"Trial {i}" for i in count(1))
    return next(name for name in names if name not in design.variants)
