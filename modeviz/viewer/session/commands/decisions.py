"""Commands that decide something: they can be undone."""

import math
from collections.abc import Callable, Hashable, Mapping
from dataclasses import dataclass, replace
from typing import Any

from modeviz.errors import VehicleError
from modeviz.text.wording import free_name
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placement, Placements
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.design import (
    NamedSet,
    current_set,
    known_sets,
    named_sets,
    next_name,
    rate_sets,
)
from modeviz.viewer.session.planning.plan import Plan
from modeviz.viewer.session.state import State, compared_rates


@dataclass(frozen=True)
class SetRate(Command):
    """Sets a rate, unless it is locked, and selects its group; of a linked group all go along."""

    group: str
    field: str
    """Of `MountRates`."""
    rate: float
    """In SI."""

    @property
    def step(self) -> Hashable:
        return "rate", self.group, self.field

    def apply(self, state: State, vehicle: Vehicle) -> State:
        group = vehicle.mount_group(self.group)
        design = state.design.with_rate(group, self.field, self.rate)
        return replace(state, design=design, group=self.group)


@dataclass(frozen=True)
class SetLossFactor(Command):
    """Gives a group another loss factor, and selects it."""

    group: str
    loss_factor: float

    @property
    def step(self) -> Hashable:
        return "loss factor", self.group

    def apply(self, state: State, vehicle: Vehicle) -> State:
        group = vehicle.mount_group(self.group)
        plain = group.plain(replace(state.design.rates[self.group], loss_factor=self.loss_factor))
        taken = TakeRates({self.group: plain}).apply(state, vehicle)
        return replace(taken, group=self.group)


@dataclass(frozen=True)
class PlaceMounts(Command):
    """Moves the mounts of a group, or turns them, and selects it."""

    group: str
    field: str
    """Of `Placement`."""
    values: tuple[float | None, float | None, float | None]
    """Along or about x, y, z, m or rad, from how they were given; None: as before."""

    @property
    def step(self) -> Hashable:
        changed = tuple(value is not None for value in self.values)
        return "place", self.group, self.field, changed

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.mount_group(self.group)
        before = state.design.alterations.placement(self.group)
        old = getattr(before, self.field)
        values = tuple(o if v is None else v for o, v in zip(old, self.values, strict=True))
        placement = replace(before, **{self.field: values})
        design = state.design.with_placement(self.group, placement)
        return replace(state, design=design, group=self.group)


@dataclass(frozen=True)
class DragMounts(Command):
    """Puts the mounts of a group where its handle is, and selects it."""

    group: str
    placement: Placement
    drag: int
    """Its number: all of a drag is undone together."""

    @property
    def step(self) -> Hashable:
        return "drag", self.group, self.drag

    @property
    def within(self) -> float:
        return math.inf

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.mount_group(self.group)
        return replace(
            state, design=state.design.with_placement(self.group, self.placement), group=self.group
        )


@dataclass(frozen=True)
class ResetPlacement(Command):
    """Puts the mounts of a group back to where they were given, as they were turned there."""

    group: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.mount_group(self.group)
        return replace(state, design=state.design.with_placement(self.group, Placement()))


@dataclass(frozen=True)
class TakeRates(Command):
    """Takes over the rates of some groups, locked ones too."""

    rates: Rates

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.all_rates(self.rates)
        return _designed(state, rates={**state.design.rates, **self.rates})


@dataclass(frozen=True)
class TakeDesign(Command):
    """Takes over the rates of some groups, locked ones too, and where all mounts are."""

    rates: Rates
    placements: Placements

    def apply(self, state: State, vehicle: Vehicle) -> State:
        taken = TakeRates(self.rates).apply(state, vehicle)
        return replace(taken, design=taken.design.with_placements(self.placements))


@dataclass(frozen=True)
class ResetGroups(Command):
    """Sets groups back to the rates compared with; locked ones stay, and what has none there."""

    groups: tuple[str, ...]

    def apply(self, state: State, vehicle: Vehicle) -> State:
        compared = compared_rates(vehicle, state)
        back = {group: compared[group] for group in self.groups if group in compared}
        return replace(state, design=state.design.with_rates(back))


@dataclass(frozen=True)
class ResetRate(Command):
    """Sets one rate back to that compared with, if there is one, and no other of a linked group."""

    group: str
    field: str
    """Of `MountRates`."""

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.mount_group(self.group)
        compared = compared_rates(vehicle, state).get(self.group)
        if compared is None:
            return state
        changed = {self.field: getattr(compared, self.field)}
        rates = replace(state.design.rates[self.group], **changed)
        return replace(state, design=state.design.with_rates({self.group: rates}))


@dataclass(frozen=True)
class LinkRates(Command):
    """Keeps the ratios of a group's rates from now on, or no longer."""

    group: str
    linked: bool

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.mount_group(self.group)
        others = state.design.linked - {self.group}
        return _designed(state, linked=others | {self.group} if self.linked else others)


@dataclass(frozen=True)
class ToggleLock(Command):
    """Locks a rate, or lets it move again."""

    group: str
    field: str
    """Of `MountRates`."""

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.mount_group(self.group)
        return _designed(state, locked=state.design.locked ^ {(self.group, self.field)})


class TakenNameError(VehicleError):
    """There is another pinned set of a name that the present rates are to have."""

    def __init__(self, name: str, free: str) -> None:
        """Says so, and which name like it is free."""
        super().__init__(f"there is another set called {name}: replace it, or pin this as {free}")
        self.name: str = name
        self.free: str = free


@dataclass(frozen=True)
class Pin(Command):
    """Gives a name to the present rates, and to where mounts are, and keeps them.

    A set that comes with the vehicle stays its own. Raises TakenNameError where another set is pinned
    under that name, unless it is to be replaced.
    """

    name: str
    replaces: bool = False

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if self.name in known_sets(vehicle):
            return state
        sets = named_sets(vehicle, state.design)
        present = NamedSet(dict(state.design.rates), state.design.alterations)
        if not self.replaces and sets.get(self.name, present) != present:
            raise TakenNameError(self.name, free_name(self.name, sets))
        return replace(state, design=state.design.with_variant(self.name, state.design.rates))


@dataclass(frozen=True)
class AddVariant(Command):
    """Pins other rates, and replaces no set that there is.

    Where another set is called so, this is the first free of "name 2", "name 3" ...
    """

    name: str
    rates: Rates
    """Of the groups that differ from the vehicle's own."""

    def apply(self, state: State, vehicle: Vehicle) -> State:
        every, sets = vehicle.all_rates(self.rates), named_sets(vehicle, state.design)
        if sets.get(self.name) == NamedSet(every, state.design.alterations):
            return state
        return replace(state, design=state.design.with_variant(free_name(self.name, sets), every))


@dataclass(frozen=True)
class Forget(Command):
    """Forgets a pinned set, if there is one of that name."""

    name: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        left = {n: variant for n, variant in state.design.variants.items() if n != self.name}
        return _designed(state, variants=left).with_known_sets(state.design, vehicle)


@dataclass(frozen=True)
class Rename(Command):
    """Calls a pinned set something else, unless another set is called so."""

    name: str
    new: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        design, name, new = state.design, self.name, self.new
        if name not in design.variants or new in rate_sets(vehicle, design):
            return state
        variants = {new if n == name else n: variant for n, variant in design.variants.items()}
        return _designed(state, variants=variants).with_known_sets(design, vehicle)


@dataclass(frozen=True)
class Load(Command):
    """Takes over the rates of a set, locked ones too, and where its mounts are, if there is one."""

    name: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        wanted = named_sets(vehicle, state.design).get(self.name)
        if wanted is None:
            return state
        return replace(state, design=state.design.with_set(wanted))


@dataclass(frozen=True)
class Swap(Command):
    """Changes places: the set compared with becomes the present one, and the other way round.

    What has no name is pinned, so that there is a way back.
    """

    def apply(self, state: State, vehicle: Vehicle) -> State:
        design = state.design
        other = named_sets(vehicle, design)[state.against]
        own = current_set(vehicle, design)
        if own is None:
            own = next_name(design)
            design = design.with_variant(own, design.rates)
        return replace(state, design=design.with_set(other), against=own)


@dataclass(frozen=True)
class ChangeTargets(Command):
    """Holds the modes of bodies on their mounts against something else."""

    fields: Mapping[str, float]
    """Those of `Decoupling` that change."""

    def apply(self, state: State, vehicle: Vehicle) -> State:
        return _designed(state, decoupling=replace(state.design.decoupling, **self.fields))


@dataclass(frozen=True)
class ChangePlan(Command):
    """Changes what a search is to look for, where there is something to optimise for."""

    change: Callable[[State, Plan], Plan]

    def apply(self, state: State, vehicle: Vehicle) -> State:
        plan = state.design.plan
        return state if plan is None else _designed(state, plan=self.change(state, plan))


def _designed(state: State, **fields: Any) -> State:
    """A state with something else decided."""
    return replace(state, design=replace(state.design, **fields))
