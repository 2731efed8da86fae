"""The vehicle: bodies, what joins them, what shakes them and where that is felt; checked as a whole."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from modeviz.errors import VehicleError, unknown
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import AddedMass, Body
from modeviz.vehicle.checks import check_problem, check_vehicle
from modeviz.vehicle.connections import GROUND, Connection, Mount, Tyre
from modeviz.vehicle.decoupling import USUAL, Decoupling
from modeviz.vehicle.engine import Engine, EngineOrder
from modeviz.vehicle.iso_8608 import CLASSES, USUAL_ROAD, named_road
from modeviz.vehicle.load_cases import LoadCase, usual_cases
from modeviz.vehicle.loads import (
    BaseMotion,
    Force,
    HarmonicLoad,
    RandomLoad,
    ResponsePoint,
    Road,
    Spectrum,
    WheelLoad,
)
from modeviz.vehicle.mode_damping import ModeDamping
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates, Rates
from modeviz.vehicle.problem import Problem

USUAL_SPEED = 20.0
"""m/s: 72 km/h."""

OUR_AXES = "x rearward, y right, z up"
"""Of everything that is computed."""


@dataclass(frozen=True, eq=False)
class Vehicle:
    """A vehicle on its wheels: x rearward, y to the right, z up, SI units."""

    name: str
    bodies: tuple[Body, ...]
    connections: tuple[Connection, ...]
    """What is not tuned."""
    mount_groups: tuple[MountGroup, ...] = ()
    added_masses: tuple[AddedMass, ...] = ()
    response_points: tuple[ResponsePoint, ...] = ()
    """The first is the driver's: it is the one that is rated."""
    roads: tuple[Road, ...] = ()
    wheel_loads: tuple[WheelLoad, ...] = ()
    rate_sets: Mapping[str, Rates] = field(default_factory=dict)
    """Named sets of rates besides the vehicle's own."""
    speed: float = USUAL_SPEED
    """m/s."""
    highest_frequency: float = 40.0
    """Hz: up to where modes and responses are looked at; 40 is that of the paper's RMS values."""
    frequency_step: float = 0.1
    """Hz: between the lines at which responses are given; where a mode is sharp there are more."""
    problems: tuple[Problem, ...] = ()
    """What the mounts are to be optimised for; the first is the usual one."""
    forces: tuple[Force, ...] = ()
    base_motions: tuple[BaseMotion, ...] = ()
    mode_damping: tuple[ModeDamping, ...] = ()
    """Damping ratios of modes of the vehicle with its own rates, where they are known."""
    decoupling: Decoupling = USUAL
    """What the rigid modes of its bodies are held against."""
    engines: tuple[Engine, ...] = ()
    load_cases: tuple[LoadCase, ...] = ()
    """Those in which it is looked at standing still; none are the usual ones, see `static_cases`."""
    remarks: tuple[str, ...] = ()
    """What is to be known of it wherever it is looked at, a sentence each; its file keeps them."""
    notes: tuple[str, ...] = ()
    """What reading it had to say: what was taken otherwise than it stands, or is likely wrong.

    A sentence each, which names what it is about."""
    file: str = ""
    """Where it was read from, to say so; empty for one that was made in Python."""
    axes: str = OUR_AXES
    """Those of that file, in which things are written for other programs; all here is in ours."""

    def __post_init__(self) -> None:
        check_vehicle(self)

    @cached_property
    def frequency_hz(self) -> Floats:
        """The lines of the band, (n_freqs,), zero left out: every `frequency_step`."""
        count = round(self.highest_frequency / self.frequency_step)
        lines = np.round(np.arange(1, count + 1) * self.frequency_step, 12).astype(np.float64)
        lines.flags.writeable = False
        return lines

    @cached_property
    def all_connections(self) -> tuple[Connection, ...]:
        """Mounts first, group by group, then the rest."""
        return (*self.mounts, *self.connections)

    @property
    def mounts(self) -> tuple[Mount, ...]:
        """Every mount, group by group."""
        return tuple(m for g in self.mount_groups for m in g.mounts)

    @cached_property
    def tyres(self) -> tuple[Tyre, ...]:
        """The connections that are tyres."""
        return tuple(c for c in self.connections if isinstance(c, Tyre))

    @property
    def rates(self) -> dict[str, MountRates]:
        """The mount rates this vehicle has; their loss factors are the groups'."""
        return {g.name: g.rates for g in self.mount_groups}

    def all_rates(self, rates: Rates) -> dict[str, MountRates]:
        """The rates of every group: those given, and the vehicle's own for the others.

        They have a loss factor where it is not the vehicle's own.

        Raises:
            VehicleError: a group that does not exist.
        """
        given = {name: self.mount_group(name).plain(its_rates) for name, its_rates in rates.items()}
        return {**self.rates, **given}

    def body(self, name: str) -> Body:
        """The body of that name.

        Raises:
            VehicleError: there is none, with the names there are.
        """
        return _named("body", name, self.bodies)

    @cached_property
    def random_loads(self) -> tuple[RandomLoad, ...]:
        """Loads with a spectrum: roads first, then forces, then motions of the ground."""
        others = (*self.forces, *self.base_motions)
        return (*self.roads, *(load for load in others if isinstance(load.amplitude, Spectrum)))

    @cached_property
    def harmonic_loads(self) -> tuple[HarmonicLoad, ...]:
        """Loads with an amplitude: wheel loads first, then forces, then motions of the ground."""
        others = (*self.forces, *self.base_motions)
        return (
            *self.wheel_loads,
            *(load for load in others if not isinstance(load.amplitude, Spectrum)),
        )

    @cached_property
    def engine_orders(self) -> tuple[EngineOrder, ...]:
        """The orders of its engines, engine by engine: harmonic loads that depend on speed."""
        return tuple(order for engine in self.engines for order in engine.orders)

    @cached_property
    def swept_loads(self) -> tuple[HarmonicLoad, ...]:
        """Its harmonic loads, and the orders of engines that act at two or more lines of its band."""
        orders = (o for o in self.engine_orders if o.acts(self.frequency_hz).sum() > 1)
        return (*self.harmonic_loads, *orders)

    def is_shaken_by(self, load: RandomLoad) -> bool:
        """Whether a load gets into the vehicle: a road does through tyres with rates along their z."""
        return self.has_driven_tyres or not isinstance(load, Road)

    @cached_property
    def static_cases(self) -> tuple[LoadCase, ...]:
        """Its load cases, or the usual ones if it says none."""
        return self.load_cases or usual_cases(self.bodies)

    @property
    def has_driven_tyres(self) -> bool:
        """Whether a road gets into it: some tyre has stiffness or damping along its z."""
        return any(tyre.stiffness[2] or tyre.damping[2] for tyre in self.tyres)

    @cached_property
    def offered_loads(self) -> tuple[RandomLoad, ...]:
        """Its random loads and, where it stands on tyres, roads of the classes of ISO 8608."""
        own = {load.name for load in self.random_loads}
        classes = [f"ISO {name}" for name in CLASSES if f"ISO {name}" not in own]
        roads = [self.random_load(name) for name in classes if self.has_driven_tyres]
        return (*self.random_loads, *roads)

    @property
    def usual_load(self) -> RandomLoad | None:
        """The first random load that gets into it, else a usual road; None: it has no tyres."""
        own = next(filter(self.is_shaken_by, self.random_loads), None)
        return own or (self.random_load(USUAL_ROAD) if self.has_driven_tyres else None)

    def random_load(self, name: str) -> RandomLoad:
        """The road or other random load of that name, else the road of ISO 8608 that it means.

        Raises:
            VehicleError: there is none, with the names there are; or ISO 8608 has no such road.
        """
        own = next((load for load in self.random_loads if load.name == name), None)
        found = own or named_road(name, track_width(self.tyres))
        return found or _named("random load", name, self.offered_loads)

    def harmonic_load(self, name: str) -> HarmonicLoad:
        """The harmonic load or engine's order of that name; raises VehicleError as `body` does."""
        return _named("harmonic load", name, (*self.harmonic_loads, *self.engine_orders))

    def engine(self, name: str) -> Engine:
        """The engine of that name; raises VehicleError as `body` does."""
        return _named("engine", name, self.engines)

    def moved_connections(self, motion: BaseMotion) -> tuple[Connection, ...]:
        """The connections whose ground ends a base motion moves, in the order of `all_connections`."""
        grounded = (c for c in self.all_connections if c.bodies[1] == GROUND)
        return tuple(c for c in grounded if not motion.connections or c.name in motion.connections)

    def mount_group(self, name: str) -> MountGroup:
        """The mount group of that name; raises VehicleError as `body` does."""
        return _named("mount group", name, self.mount_groups)

    def problem(self, name: str) -> Problem:
        """The problem of that name; raises VehicleError as `body` does."""
        return _named("problem", name, self.problems)

    def with_rates(self, rates: Rates) -> "Vehicle":
        """The vehicle with other rates and loss factors in the groups that are named.

        Raises:
            VehicleError: a group that does not exist.
        """
        for group in rates:
            self.mount_group(group)
        groups = tuple(g.with_rates(rates[g.name]) if g.name in rates else g for g in self.mount_groups)
        return replace(self, mount_groups=groups)

    def check_problem(self, problem: Problem) -> None:
        """Raises VehicleError unless all that a problem names is there."""
        check_problem(self, problem)

    def load(self, name: str) -> RandomLoad | HarmonicLoad:
        """The harmonic or random load of that name, else the road of ISO 8608 that it means.

        Raises:
            VehicleError: there is none, with the names there are.
        """
        every = (*self.harmonic_loads, *self.engine_orders)
        harmonic = next((load for load in every if load.name == name), None)
        if harmonic is not None:
            return harmonic
        try:
            return self.random_load(name)
        except VehicleError:
            every = (*self.offered_loads, *every)
            raise VehicleError(unknown("load", name, (load.name for load in every))) from None


def track_width(tyres: Sequence[Tyre]) -> float:
    """The distance, m, of the mean of the tyres in the left track from that of those in the right one.

    Zero where all are in one track.
    """
    left, right = ([t.points[1, 1] for t in tyres if t.side == side] for side in ("left", "right"))
    return abs(float(np.mean(right) - np.mean(left))) if left and right else 0.0


def _named(kind: str, name: str, items: Iterable):
    for item in items:
        if item.name == name:
            return item
    raise VehicleError(unknown(kind, name, (i.name for i in items)))
