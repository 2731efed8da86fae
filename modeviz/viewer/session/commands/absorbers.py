"""Commands that add, change and remove absorbers: they can be undone."""

from collections.abc import Hashable
from dataclasses import dataclass, fields, replace

from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.state import State


@dataclass(frozen=True)
class AddAbsorber(Command):
    """Adds an absorber, and selects its mount group."""

    absorber: Absorber

    def apply(self, state: State, vehicle: Vehicle) -> State:
        with_absorbers(vehicle, [self.absorber])
        design = state.design.with_absorber(self.absorber)
        return replace(state, design=design, group=self.absorber.name)


@dataclass(frozen=True)
class RemoveAbsorber(Command):
    """Removes an absorber that was added, if there is one of that name, and forgets its rates."""

    name: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if state.design.alterations.absorber(self.name) is None:
            return state
        return replace(state, design=state.design.without_absorber(self.name))


@dataclass(frozen=True)
class WeighAbsorber(Command):
    """Gives an absorber that was added another mass; its rates go along and its frequency stays."""

    name: str
    mass: float
    """kg."""

    @property
    def step(self) -> Hashable:
        return "absorber", self.name

    def apply(self, state: State, vehicle: Vehicle) -> State:
        alterations = state.design.alterations
        absorber = alterations.absorber(self.name)
        if absorber is None:
            raise VehicleError(unknown("absorber", self.name, (a.name for a in alterations.absorbers)))
        weighed = replace(absorber, mass=self.mass)
        rates = _scaled(state.design.rates[self.name], self.mass / absorber.mass)
        design = state.design.with_absorber(weighed)
        with_its_own = replace(design, rates={**design.rates, self.name: rates})
        return replace(state, design=with_its_own, group=self.name)


def _scaled(rates: MountRates, by: float) -> MountRates:
    """Rates so many times as large, with the same loss factor."""
    names = (field.name for field in fields(rates) if field.name != "loss_factor")
    return replace(rates, **{name: by * getattr(rates, name) for name in names})
