"""The vehicle: bodies, what joins them, what shakes them and where that is felt; checked as a whole."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from modeviz.errors import Fault, FaultsError, PartError, VehicleError, check_unique, of_part, unknown
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.bodies import AddedMass, Body, FlexibleBody
from modeviz.vehicle.connections import (
    GROUND,
    Bolt,
    Connection,
    Damper,
    Mount,
    MountGroup,
    MountRates,
    Rates,
    Rod,
    Spring,
    Tyre,
)
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
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import UNFELT, Problem

REACH = 0.10
"""m: how far from an attachment of a flexible body a connection may hold on to it."""

FARTHEST = 20.0
"""m: hardly a vehicle is farther from its origin."""

USUAL_SPEED = 20.0
"""m/s: 72 km/h."""

FEWEST_LINES, MOST_LINES = 10, 5000
"""Of a band: each is a solution of the vehicle's equations, kept in memory."""

OUR_AXES = "x rearward, y right, z up"
"""Of everything that is computed."""

WHOLE = 1e-9
"""Relative: a number of steps this close to a whole one is whole."""


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
    notes: tuple[str, ...] = ()
    """What reading it had to say: what was taken otherwise than it stands, or is likely wrong.

    A sentence each, which names what it is about."""
    file: str = ""
    """Where it was read from, to say so; empty for one that was made in Python."""
    axes: str = OUR_AXES
    """Those of that file, in which things are written for other programs; all here is in ours."""

    def __post_init__(self) -> None:
        if not self.bodies:
            raise VehicleError(f"vehicle {self.name!r} has no bodies")
        if not (np.isfinite(self.speed) and self.speed > 0):
            raise FaultsError(Fault("speed", f"found {self.speed} m/s, expected more than 0"))
        self._check_band()
        self._check_names()
        for connection in self.all_connections:
            with of_part("connection", connection.name):
                self._check_ends(connection)
        for kind, things in (
            ("added mass", self.added_masses),
            ("response point", self.response_points),
            ("force", self.forces),
            ("engine", self.engines),
        ):
            for thing in things:
                with of_part(kind, thing.name):
                    self._check_place(thing.body, thing.position)
        for case in self.load_cases:
            with of_part("load case", case.name):
                self._check_load_case(case)
        check_unique("mode damping of", (damping.name for damping in self.mode_damping))
        self._check_references()

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
        for group in problem.groups:
            self.mount_group(group.group)
        points = [point.name for point in self.response_points]
        if problem.goal not in UNFELT and not points:
            raise VehicleError(f"goal {problem.goal!r} needs a [[response_point]]")
        if problem.goal == "idle" and not self.engines:
            raise VehicleError("goal 'idle' needs an [[engine]]")
        for performance in problem.performance:
            for road in performance.roads:
                if not self.is_shaken_by(self.random_load(road)):
                    raise VehicleError(
                        f"road {road!r} shakes nothing; expected a [[tyre]] with stiffness or damping "
                        "along z"
                    )
            for load in performance.wheel_loads:
                self.harmonic_load(load)
            for point in performance.points:
                if point not in points:
                    raise VehicleError(unknown("response point", point, points))
        for target in problem.mounts:
            self._check_mount_target(target)
        for decoupled in problem.decoupling:
            self.body(decoupled.body)
        mounts, cases = ([x.name for x in every] for every in (self.mounts, self.static_cases))
        for limit in problem.deflections:
            if limit.mount not in mounts:
                raise VehicleError(unknown("mount", limit.mount, mounts))
            if limit.load_case not in cases:
                raise VehicleError(unknown("load case", limit.load_case, cases))
        if problem.reference and problem.reference not in self.rate_sets:
            raise VehicleError(unknown("set of rates", problem.reference, self.rate_sets))

    def _check_mount_target(self, target: MountTarget) -> None:
        """Raises VehicleError unless the mounts and loads are there."""
        names = [mount.name for mount in self.mounts]
        for mount in target.mounts:
            if mount not in names:
                raise VehicleError(unknown("mount", mount, names))
        for load in target.loads:
            self.load(load)

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

    def _check_band(self) -> None:
        for key in ("highest_frequency", "frequency_step"):
            value = getattr(self, key)
            if not (np.isfinite(value) and value > 0):
                raise FaultsError(Fault(key, f"found {value} Hz, expected more than 0"))
        count = self.highest_frequency / self.frequency_step
        if abs(count - round(count)) > WHOLE * count:
            words = (
                f"found {self.highest_frequency:g} Hz, expected a whole multiple of frequency_step, "
                f"{self.frequency_step:g} Hz"
            )
            raise FaultsError(Fault("highest_frequency", words))
        if not FEWEST_LINES <= round(count) <= MOST_LINES:
            words = (
                f"found {self.frequency_step:g} Hz for {self.highest_frequency:g} Hz, which makes "
                f"{round(count)} lines; expected {FEWEST_LINES} to {MOST_LINES}"
            )
            raise FaultsError(Fault("frequency_step", words))

    def _check_names(self) -> None:
        for kind, items in (
            ("body", self.bodies),
            ("connection", self.all_connections),
            ("mount group", self.mount_groups),
            ("added mass", self.added_masses),
            ("response point", self.response_points),
            ("random load", self.random_loads),
            ("engine", self.engines),
            ("harmonic load", (*self.harmonic_loads, *self.engine_orders)),
            ("problem", self.problems),
            ("load case", self.load_cases),
        ):
            check_unique(kind, (item.name for item in items))
        if GROUND in (body.name for body in self.bodies):
            raise PartError("body", GROUND, ": that name means what does not move; take another")
        for connection in self.all_connections:
            if connection.group in (body.name for body in self.bodies):
                words = f": group {connection.group!r} is the name of a body; their energies are "
                words += "reported side by side, so take another"
                raise PartError("connection", connection.name, words)

    def _check_references(self) -> None:
        """Raises VehicleError unless every tyre and mount group that is named exists."""
        tyres = [t.name for t in self.tyres]
        for load in self.wheel_loads:
            if load.tyre not in tyres:
                raise PartError("wheel load", load.name, ": " + unknown("tyre", load.tyre, tyres))
        for motion in self.base_motions:
            with of_part("base motion", motion.name):
                self._check_base_motion(motion)
        for name, rates in self.rate_sets.items():
            for group in rates:
                if group not in self.rates:
                    raise PartError("rates", name, ": " + unknown("mount group", group, self.rates))
        for problem in self.problems:
            with of_part("problem", problem.name):
                self.check_problem(problem)

    def _check_base_motion(self, motion: BaseMotion) -> None:
        """Raises VehicleError unless what it moves holds on to the ground."""
        grounded = [c.name for c in self.all_connections if c.bodies[1] == GROUND]
        for name in motion.connections:
            if name not in grounded:
                raise VehicleError(unknown("connection to the ground", name, grounded))
        if not self.moved_connections(motion):
            raise VehicleError("nothing is connected to the ground, so nothing moves")

    def _check_load_case(self, case: LoadCase) -> None:
        """Raises VehicleError unless every body it presses on is there, and can be where it does."""
        for load in case.loads:
            self.body(load.body)
            if load.position is not None:
                self._check_place(load.body, load.position)

    def _check_ends(self, connection: Connection) -> None:
        if not isinstance(connection, Mount | Spring | Rod | Bolt | Damper | Tyre):
            raise VehicleError("expected a Spring, Rod, Bolt, Damper or Tyre")
        if connection.rigid and not isinstance(connection, Spring | Rod | Bolt):
            raise VehicleError("only a spring, a rod or a bolt can be rigid")
        if connection.bodies[0] == GROUND:
            raise VehicleError(f"{GROUND!r} must be the second of its bodies")
        for body, point in zip(connection.bodies, connection.points, strict=True):
            if body != GROUND:
                self._check_place(body, point)

    def _check_place(self, body_name: str, position: Floats) -> None:
        """Raises VehicleError unless the body is there and something can hang on it at `position`."""
        body = self.body(body_name)
        if not isinstance(body, FlexibleBody):
            return
        nearest = body.nearest_attachment(position)
        distance = np.linalg.norm(nearest.position - position)
        if distance > REACH:
            raise VehicleError(
                f"{position.tolist()} is {distance:.2f} m from the nearest attachment of "
                f"{body_name!r}, {nearest.name!r}; at most {REACH} m is allowed"
                f"{_in_other_units(body, position)}"
            )


def _in_other_units(body: FlexibleBody, position: Floats) -> str:
    """Words for a place that would be near an attachment in mm where it is in m, or the reverse."""
    is_far = np.abs(position).max() > FARTHEST
    scale, meant, found = (1e-3, "mm", "m") if is_far else (1e3, "m", "mm")
    moved = scale * position
    if np.linalg.norm(body.nearest_attachment(moved).position - moved) > REACH:
        return ""
    return f"; it would fit if its numbers were in {meant} and not in {found}: see length in [units]"


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
