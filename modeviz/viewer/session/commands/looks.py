"""Commands that change how one looks at a design: nothing of them is undone."""

from dataclasses import dataclass, fields, replace
from typing import TypeVar

from modeviz.analysis.results import Conditions
from modeviz.mounting.paths import By
from modeviz.units import QuantityName
from modeviz.vehicle.decoupling import Axes
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.commands.command import Command
from modeviz.viewer.session.design import rate_sets
from modeviz.viewer.session.rigid_look import Crank, RigidLook, Support
from modeviz.viewer.session.state import (
    ChartCurve,
    Charts,
    Coloring,
    EngineLook,
    Ghost,
    Look,
    Motion,
    MotionKind,
    ResponseCurve,
    State,
)

Part = TypeVar("Part", Charts, Conditions, EngineLook, Look, Motion, RigidLook)


@dataclass(frozen=True)
class ShowMode(Command):
    """Shows another mode, also where something else moved, and selects a mount group if given."""

    name: str
    rates: Rates | None = None
    """With which it is called so; the present ones if None."""
    group: str | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        rates = state.design.rates if self.rates is None else self.rates
        kind = state.motion.kind if state.motion.kind == "damped mode" else "mode"
        motion = replace(state.motion, mode=self.name, mode_rates=rates, kind=kind)
        return replace(state, motion=motion, group=state.group if self.group is None else self.group)


@dataclass(frozen=True)
class ChangeMotion(Command):
    """Shows something else that moves; what is None stays."""

    kind: MotionKind | None = None
    operating_hz: float | None = None
    component: str | None = None
    component_mode: int | None = None
    load_case: str | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        return replace(state, motion=_changed(state.motion, self))


@dataclass(frozen=True)
class ChangeCharts(Command):
    """Draws other charts; what is None stays."""

    load: str | None = None
    decibels: bool | None = None
    log_frequency: bool | None = None
    cursor_hz: float | None = None
    path_curve: ResponseCurve | None = None
    paths_by: By | None = None
    in_vehicle_axes: bool | None = None
    rubber_direction: str | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        return replace(state, charts=_changed(state.charts, self))


@dataclass(frozen=True)
class ChangeLook(Command):
    """Draws bodies in another way; what is None stays."""

    coloring: Coloring | None = None
    see_through: bool | None = None
    follow: bool | None = None
    handle: bool | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        return replace(state, look=_changed(state.look, self))


@dataclass(frozen=True)
class LookAtRigid(Command):
    """Looks at another body on its mounts, or otherwise; what is None stays."""

    body: str | None = None
    axes: Axes | None = None
    crank: Crank | None = None
    support: Support | None = None
    drawn: bool | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if self.body is not None:
            vehicle.body(self.body)
        return replace(state, rigid=_changed(state.rigid, self))


@dataclass(frozen=True)
class LookAtEngine(Command):
    """Looks at another engine, at another response to it or at another speed; what is None stays."""

    engine: str | None = None
    curve: ChartCurve | None = None
    speed_hz: float | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if self.engine is not None:
            vehicle.engine(self.engine)
        return replace(state, engine=_changed(state.engine, self))


@dataclass(frozen=True)
class ShowGhost(Command):
    """Draws other outlines; those before are remembered while the compared set's are drawn."""

    ghost: Ghost

    def apply(self, state: State, vehicle: Vehicle) -> State:
        look = state.look
        before = look.ghost_before if look.ghost == "compared" else look.ghost
        return replace(state, look=replace(look, ghost=self.ghost, ghost_before=before))


@dataclass(frozen=True)
class ShowComparedGhost(Command):
    """Draws the outlines of the set compared with, or those that they took the place of."""

    drawn: bool

    def apply(self, state: State, vehicle: Vehicle) -> State:
        ghost = "compared" if self.drawn else state.look.ghost_before
        return ShowGhost(ghost).apply(state, vehicle)


@dataclass(frozen=True)
class ShowBody(Command):
    """Draws a body, or no longer."""

    name: str
    drawn: bool

    def apply(self, state: State, vehicle: Vehicle) -> State:
        vehicle.body(self.name)
        hidden = state.look.hidden - {self.name} if self.drawn else state.look.hidden | {self.name}
        return replace(state, look=replace(state.look, hidden=hidden))


@dataclass(frozen=True)
class ChooseCurve(Command):
    """Draws another response in a chart."""

    chart: int
    """Counted from the top."""
    curve: ChartCurve

    def apply(self, state: State, vehicle: Vehicle) -> State:
        before = state.charts.curves
        curves = (*before[: self.chart], self.curve, *before[self.chart + 1 :])
        return replace(state, charts=replace(state.charts, curves=curves))


@dataclass(frozen=True)
class Overlay(Command):
    """Draws a set in the charts too, or no longer."""

    name: str
    drawn: bool

    def apply(self, state: State, vehicle: Vehicle) -> State:
        others = state.charts.overlaid - {self.name}
        is_drawn = self.drawn and self.name in rate_sets(vehicle, state.design)
        overlaid = others | {self.name} if is_drawn else others
        return replace(state, charts=replace(state.charts, overlaid=overlaid))


@dataclass(frozen=True)
class CompareWith(Command):
    """Compares all with another set, if there is one of that name."""

    name: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        is_known = self.name in rate_sets(vehicle, state.design)
        return replace(state, against=self.name) if is_known else state


@dataclass(frozen=True)
class Drive(Command):
    """Drives on another road or at another speed, m/s; what is None stays."""

    road: str | None = None
    speed: float | None = None

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if self.road is not None:
            vehicle.random_load(self.road)
        return replace(state, conditions=_changed(state.conditions, self))


@dataclass(frozen=True)
class SelectGroup(Command):
    """Selects a mount group, or none: ""."""

    group: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        if self.group:
            vehicle.mount_group(self.group)
        return replace(state, group=self.group)


@dataclass(frozen=True)
class ChooseUnit(Command):
    """Shows rates of a quantity in another unit."""

    quantity: QuantityName
    unit: str

    def apply(self, state: State, vehicle: Vehicle) -> State:
        return replace(state, units={**state.units, self.quantity: self.unit})


@dataclass(frozen=True)
class ShowClassicError(Command):
    """Shows the error of the classic method beside, or no longer."""

    shown: bool

    def apply(self, state: State, vehicle: Vehicle) -> State:
        return replace(state, classic=self.shown)


def _changed(
    part: Part, command: ChangeMotion | ChangeCharts | ChangeLook | LookAtEngine | LookAtRigid | Drive
) -> Part:
    """A part of a state with what a command names."""
    asked = {field.name: getattr(command, field.name) for field in fields(command)}
    return replace(part, **{name: value for name, value in asked.items() if value is not None})
