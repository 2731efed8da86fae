"""All that can be asked of a tuning session: what was decided, and how one looks at it."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Literal

import numpy as np

from modeviz.analysis.results import Conditions
from modeviz.dynamics.roles import unit_of_role
from modeviz.mounting.paths import By
from modeviz.units import WRITTEN_UNITS, QuantityName
from modeviz.vehicle.connections import MOTIONS
from modeviz.vehicle.engine import EngineOrder
from modeviz.vehicle.loads import Road
from modeviz.vehicle.mount_rates import DIRECTIONS, RIDE_DIRECTIONS, Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.design import ORIGINAL, Design, rate_sets
from modeviz.viewer.session.planning.plan import first_plan
from modeviz.viewer.session.rigid_look import RigidLook, first_look

Coloring = Literal["bodies", "displacement", "kinetic energy", "strain energy"]
"""What the colours of the bodies mean."""

Ghost = Literal["none", "rest", "compared"]
"""Whose outlines are drawn beside: those at rest, or moving in the shape that is compared with."""

MotionKind = Literal["mode", "damped mode", "operating shape", "component", "sag"]
"""What moves: an undamped mode, the same with its damping, the shape at a frequency of excitation, or
one component alone; or nothing: the sag under a load that stays."""


@dataclass(frozen=True)
class ResponseCurve:
    """A response that is drawn."""

    point: int
    """Number of the response point."""
    direction: str
    """One of `DIRECTIONS`."""


@dataclass(frozen=True)
class ForceCurve:
    """The force of a mount that is drawn, on the body that carries it."""

    mount: str
    motion: str
    """One of `vehicle.connections.MOTIONS`."""
    in_vehicle_axes: bool = False
    """Whether along or about the vehicle's axes, else the mount's own."""


ChartCurve = ResponseCurve | ForceCurve


@dataclass(frozen=True)
class Motion:
    """The motion in the scene, and the mode that is followed whatever moves."""

    mode: str
    """The name of that mode with `mode_rates`; with others it may be called something else."""
    mode_rates: Rates = field(default_factory=dict)
    """With which it is called so, of the groups that differ from the vehicle's own."""
    kind: MotionKind = "mode"
    operating_hz: float = 11.0
    """The frequency of the operating shape."""
    component: str = ""
    """The body that is shown alone."""
    component_mode: int = 6
    """Which of its free modes."""
    load_case: str = ""
    """The name of the load case that is looked at."""


@dataclass(frozen=True)
class Charts:
    """The choices of the charts."""

    load: str = ""
    """The wheel load whose response is drawn, or the road: ""."""
    curves: tuple[ChartCurve, ...] = tuple(ResponseCurve(0, d) for d in RIDE_DIRECTIONS)
    """What is drawn, top down; nothing where there is no response point."""
    overlaid: frozenset[str] = frozenset()
    """Names of the sets that are drawn beside the one compared with."""
    decibels: bool = True
    log_frequency: bool = False
    cursor_hz: float = 11.0
    """The frequency at which modes, forces and paths are told, besides peaks."""
    path_curve: ResponseCurve = field(default_factory=lambda: ResponseCurve(0, RIDE_DIRECTIONS[0]))
    """The response whose paths are told."""
    paths_by: By = "mount"
    in_vehicle_axes: bool = False
    """Whether forces are told along the vehicle's axes, else the mounts' own."""
    rubber_direction: str = DIRECTIONS[0]
    """Along which rates over frequency are drawn, one of `DIRECTIONS`."""

    @property
    def reference(self) -> ResponseCurve | None:
        """The first acceleration that is drawn, or could be; None where there is no response point."""
        drawn = (curve for curve in self.curves if isinstance(curve, ResponseCurve))
        return next(drawn, self.path_curve) if self.curves else None


@dataclass(frozen=True)
class EngineLook:
    """The choices of how a running engine is looked at."""

    engine: str = ""
    """Its name; "" where there is none."""
    curve: ChartCurve = field(default_factory=lambda: ResponseCurve(0, "vertical"))
    """What is drawn over its speed."""
    speed_hz: float = 0.0
    """Revolutions per second where the cursor is."""


@dataclass(frozen=True)
class Look:
    """The choices of how bodies are drawn."""

    coloring: Coloring = "bodies"
    see_through: bool = True
    ghost: Ghost = "rest"
    ghost_before: Ghost = "rest"
    """What those of the set compared with took the place of."""
    hidden: frozenset[str] = frozenset()
    """Bodies that are not drawn."""
    follow: bool = False
    """Whether cameras look at the selected group."""
    handle: bool = False
    """Whether the mounts of the selected group have a handle, by which they are moved and turned."""


@dataclass(frozen=True)
class State:
    """All that can be asked of a session."""

    design: Design
    conditions: Conditions
    motion: Motion
    charts: Charts = field(default_factory=Charts)
    look: Look = field(default_factory=Look)
    rigid: RigidLook = field(default_factory=RigidLook)
    engine: EngineLook = field(default_factory=EngineLook)
    against: str = ORIGINAL
    """The name of the set that all is compared with."""
    group: str = ""
    """The selected mount group, or none: ""."""
    units: Mapping[QuantityName, str] = field(default_factory=lambda: dict(WRITTEN_UNITS))
    """In which rates are shown."""
    classic: bool = False
    """Whether the error of the classic method is shown beside."""

    def with_known_parts(self, before: Design, vehicle: Vehicle) -> "State":
        """Return it looking at what there is; arguments as of `with_known_sets`."""
        groups, mounts, bodies = (
            {part.name for part in parts}
            for parts in (vehicle.mount_groups, vehicle.mounts, vehicle.bodies)
        )

        def is_gone(curve: ChartCurve) -> bool:
            return isinstance(curve, ForceCurve) and curve.mount not in mounts

        curves = tuple(
            ResponseCurve(0, RIDE_DIRECTIONS[i % len(RIDE_DIRECTIONS)]) if is_gone(curve) else curve
            for i, curve in enumerate(self.charts.curves)
        )
        engine = self.engine
        if is_gone(engine.curve):
            engine = replace(engine, curve=_first_engine(vehicle).curve)
        named = {group: rates for group, rates in self.motion.mode_rates.items() if group in groups}
        looking = replace(
            self,
            motion=replace(self.motion, mode_rates=named),
            group=self.group if self.group in groups else "",
            charts=replace(self.charts, curves=curves),
            engine=engine,
            look=replace(self.look, hidden=self.look.hidden & bodies),
        )
        return looking.with_known_sets(before, vehicle)

    def with_known_sets(self, before: Design, vehicle: Vehicle) -> "State":
        """Return it compared with, and overlaid by, sets that there are, by what they are called.

        Args:
            before: the design in which sets may have had other names.
            vehicle: of the session.
        """
        known = rate_sets(vehicle, self.design)
        renamed = {variant.number: name for name, variant in self.design.variants.items()}

        def called(name: str) -> str:
            variant = before.variants.get(name)
            return renamed.get(variant.number, name) if variant and name not in known else name

        overlaid = frozenset(map(called, self.charts.overlaid)).intersection(known)
        against = called(self.against)
        charts = replace(self.charts, overlaid=overlaid)
        return replace(self, charts=charts, against=against if against in known else ORIGINAL)


def first_state(vehicle: Vehicle, rates: Rates, conditions: Conditions) -> State:
    """Return what a session opens with: the rates given and the yaw of the cabin on its mounts.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    group = vehicle.mount_groups[0].name if vehicle.mount_groups else ""
    cabin = unit_of_role(vehicle, "cabin")
    every = vehicle.all_rates(rates)
    mode = f"{cabin.word} yaw" if cabin else ""
    charts = Charts(load=_first_load(vehicle, conditions))
    charts = replace(charts, cursor_hz=_first_cursor(vehicle, charts))
    return State(
        Design(every, plan=first_plan(vehicle), decoupling=vehicle.decoupling),
        conditions,
        Motion(
            mode,
            every,
            operating_hz=charts.cursor_hz,
            component=vehicle.bodies[0].name,
            load_case=vehicle.static_cases[0].name,
        ),
        charts if vehicle.response_points else replace(charts, curves=()),
        rigid=first_look(vehicle),
        engine=_first_engine(vehicle),
        group=group,
    )


def _first_engine(vehicle: Vehicle) -> EngineLook:
    """The first engine at idle, and what it does to the first point or else to the first mount."""
    if not vehicle.engines:
        return EngineLook()
    engine = vehicle.engines[0]
    look = EngineLook(engine.name, speed_hz=engine.idle_hz)
    if vehicle.response_points or not vehicle.mounts:
        return look
    return replace(look, curve=ForceCurve(vehicle.mounts[0].name, MOTIONS[2]))


def _first_load(vehicle: Vehicle, conditions: Conditions) -> str:
    """The harmonic load that a session opens with: on an even road the first, else the road, ""."""
    road = vehicle.random_load(conditions.road)
    loads = vehicle.swept_loads if isinstance(road, Road) and road.is_even else ()
    return next((load.name for load in loads), "")


def _first_cursor(vehicle: Vehicle, charts: Charts) -> float:
    """Where the cursor is that a session opens with, Hz: under an order of an engine its idle."""
    load = vehicle.harmonic_load(charts.load) if charts.load else None
    if not isinstance(load, EngineOrder):
        return min(charts.cursor_hz, vehicle.highest_frequency / 2)
    inside = vehicle.frequency_hz[load.acts(vehicle.frequency_hz)]
    return float(np.clip(load.order * vehicle.engine(load.engine).idle_hz, *inside[[0, -1]]))


def compared_rates(vehicle: Vehicle, state: State) -> Rates:
    """Return the rates that all is compared with."""
    return rate_sets(vehicle, state.design)[state.against]
