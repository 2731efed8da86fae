"""One vehicle, its mount rates, and all there is to ask of them."""

from functools import partial
from os import PathLike
from pathlib import Path
from typing import get_args

import numpy as np

from modeviz.analysis.absorbers import tuned_absorber
from modeviz.analysis.forces import LoadedForces
from modeviz.analysis.modal_results import solve_modal
from modeviz.compute.threads import one_thread
from modeviz.dynamics.band import Method
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.mounting.paths import By
from modeviz.mounting.statics import solve_statics
from modeviz.optimise.run import BUDGET
from modeviz.scatter.driving import ScatterOptions
from modeviz.scatter.searching import FRONT_STARTS, SearchOptions
from modeviz.scatter.tolerance import Tolerance
from modeviz.study.engine import EngineRide, engine_ride
from modeviz.study.forces import MountForces, loaded_forces
from modeviz.study.modes import ModesTable, modes_below
from modeviz.study.names import check_choice, number_of
from modeviz.study.notebook import block, paragraphs
from modeviz.study.optimum import OptimiseResult
from modeviz.study.output import StudyOutput
from modeviz.study.paths import ResponsePaths, point_paths
from modeviz.study.rates import StudyRates
from modeviz.study.ride import Ride
from modeviz.study.rigid import RigidBodies, rigid_bodies
from modeviz.study.scatter import ScatterResult
from modeviz.study.scattering import scattered
from modeviz.study.searching import better_rates, designs_between
from modeviz.study.sensitivity import RateSensitivity, rate_sensitivity
from modeviz.study.static import StaticResults
from modeviz.study.telling import Tell, say_nothing
from modeviz.study.trade_off import FrontResult
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.study.wheels import WheelRide, wheel_ride
from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.decoupling import Axes
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


class Study(StudyOutput):
    """One vehicle, its mount rates, and all there is to ask of them.

        study = mv.Study("my-vehicle")               # a folder, a Vehicle, or nothing: the pickup
        study.rates["C2.lateral"] = "131 N/mm"
        study.modes()["cab yaw"].frequency_hz
        study.ride("road 1").rms("seat track left", "lateral")
        found = study.optimise("paper", starts=20)
        study.rates.use(found.rates)
        study.show()

    Every answer is for the rates as they are then, prints as a table, and shows itself in a notebook.
    Ctrl+C ends a search and keeps the best so far. Values are in SI units; accelerations are in g.
    """

    def __init__(
        self,
        vehicle: "str | PathLike[str] | Vehicle | None" = None,
        progress: Tell | None = None,
    ) -> None:
        """Reads a vehicle; nothing is solved yet.

        Args:
            vehicle: a vehicle folder, or one made in Python; None: the built-in pickup.
            progress: told what is being done and the fraction of it that is done, 0 to 1.

        Raises:
            VehicleError: there is no such folder, or something is wrong in it.
        """
        if not isinstance(vehicle, Vehicle):
            vehicle = read_vehicle(builtin_vehicle() if vehicle is None else Path(vehicle))
        tell = progress or say_nothing
        super().__init__(TunedVehicle(vehicle, tell), tell)

    @property
    def rates(self) -> StudyRates:
        """The present mount rates, which are read, set and reset through it."""
        return self._tuned.rates

    @property
    def vehicle(self) -> Vehicle:
        """With the rates that it has in its file; what reading it had to say is in its `notes`."""
        return self._tuned.vehicle

    @property
    def speed(self) -> float:
        """On the roads, m/s; set to a number, or to a text with its unit, "88 km/h"."""
        return self._tuned.speed

    @speed.setter
    def speed(self, value: float | str) -> None:
        self._tuned.speed = value

    @property
    def roads(self) -> tuple[str, ...]:
        """The names of its own roads and other random loads; those of ISO 8608 need not be its own."""
        return tuple(load.name for load in self.vehicle.random_loads)

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the response points, the driver's first."""
        return tuple(point.name for point in self.vehicle.response_points)

    @one_thread()
    def modes(self, below_hz: float | None = None, method: Method = "enriched") -> ModesTable:
        """Return the modes: frequencies, damping, names, energies and shapes.

        Args:
            below_hz: modes above are left out; None: those above the vehicle's band.
            method: "enriched"; "classic": the paper's equation on the original modes; or "exact".

        Raises:
            ModevizError: that frequency is not above zero, or there is no such method.
            SolveError: the vehicle has no meaningful modes.
        """
        return modes_below(self._tuned, below_hz, method)

    @one_thread()
    def rigid(self, axes: Axes = "vehicle", up_to_hz: float | None = None) -> RigidBodies:
        """Return how pure the modes of bodies on their mounts are, and their axes and centres.

        Args:
            axes: along which kinetic energy is told: "vehicle"; "principal": of the body's inertia; or
                "crank": the vehicle's, turned so that one lies along the crank.
            up_to_hz: to where modes are looked for, if beyond the vehicle's band.

        Raises:
            ModevizError: that frequency is not above zero, or there are no such axes.
        """
        return rigid_bodies(self._tuned, axes, up_to_hz)

    @one_thread()
    def tuned_absorber(
        self,
        name: str,
        body: str,
        position: tuple[float, float, float],
        mass: float,
        *,
        mode: str,
        directions: tuple[str, ...] = ("vertical",),
    ) -> Absorber:
        """Return an absorber tuned to a mode with the present rates, for `with_absorbers`.

        By J. P. Den Hartog's formulas for the mass that moves in the mode where it sits.

        Args:
            name: of the absorber.
            body: what it is to sit on.
            position: where, m.
            mass: kg.
            mode: the name of the mode.
            directions: along which it moves: some of "vertical", "lateral", "fore-aft".

        Raises:
            VehicleError: there is no such mode or body, or the mode does not move the body there.
        """
        results = solve_modal(self._tuned.prepared_modes(), self.rates.by_group)
        number = number_of("mode", mode, (found.name for found in results.names))
        place = np.array(position, float)
        return tuned_absorber(results, number, name, body, place, mass, directions)

    @one_thread()
    def ride(self, road: str | None = None) -> Ride:
        """Return the ride on a road, or under another random load.

        Args:
            road: its name, or one of ISO 8608: "ISO C", "ISO 100 cm³, waviness 2.3"; None: the first
                that shakes the vehicle, or else ISO C.

        Raises:
            ModevizError: there is no such road, or nothing to drive or to feel it with.
        """
        return Ride(self._tuned.ride(road))

    @one_thread()
    def wheels(self) -> WheelRide:
        """Return the response to every wheel load and other harmonic load.

        Raises:
            ModevizError: the vehicle has no such load, or nothing to feel it with.
        """
        return wheel_ride(self._tuned)

    @one_thread()
    def engine(self, name: str | None = None) -> EngineRide:
        """Return what the orders of an engine do at points and mounts, at idle and at its other speeds.

        Args:
            name: of the engine; None: the first.

        Raises:
            ModevizError: the vehicle has no such engine, or nothing to feel it with.
        """
        return engine_ride(self._tuned, name)

    @one_thread()
    def static(self) -> StaticResults:
        """Return sag, forces, deflections and travel of mounts in every load case.

        Raises:
            SolveError: nothing holds the vehicle in any of them.
        """
        return StaticResults(solve_statics(self._tuned.statics(), self.rates.by_group))

    @one_thread()
    def forces(self, load: str | None = None, frequency_hz: float | None = None) -> MountForces:
        """Return the force of every mount and other connection under a load.

        Args:
            load: name of a road, of another random load or of a harmonic one, or a road of ISO 8608;
                None: the random load that usually shakes the vehicle, else its first harmonic one.
            frequency_hz: the only frequency that is asked for; None: the vehicle's band.

        Raises:
            ModevizError: there is no such load, it does not get into the vehicle, or its spectrum is
                not known there.
        """
        return MountForces(self._loaded(load, frequency_hz))

    @one_thread()
    def paths(
        self,
        point: str | None = None,
        direction: str = "vertical",
        load: str | None = None,
        *,
        by: By = "mount",
        frequency_hz: float | None = None,
    ) -> ResponsePaths:
        """Return what of the acceleration at a point comes through which mount or other connection.

        Args:
            point: name of a response point; None: the driver's.
            direction: "vertical", "lateral" or "fore-aft".
            load: as of `forces`, as is the frequency.
            by: "mount", "direction": each direction of each mount, "body": the one at the mount's other
                end, or "group".
            frequency_hz: likewise.

        Raises:
            ModevizError: there is no such point or direction, or as `forces`.
        """
        check_choice("way to tell paths", by, get_args(By))
        solve = partial(self._loaded, load, frequency_hz)
        return ResponsePaths(point_paths(self.vehicle, point, direction, solve), by)

    def _loaded(self, load: str | None, frequency_hz: float | None) -> LoadedForces:
        tell = partial(self._tell, "solving")
        return loaded_forces(
            self._tuned.prepared_modes(), self.rates.by_group, load, self.speed, frequency_hz, tell
        )

    @one_thread()
    def sensitivity(self, road: str | None = None) -> RateSensitivity:
        """Return what ten percent more of each mount rate do to frequencies and to the ride.

        Args:
            road: as of `ride`, as are errors.

        Raises:
            ModevizError: as `ride`.
        """
        return rate_sensitivity(self._tuned, road)

    @one_thread()
    def optimise(
        self,
        problem: "str | Path | Problem | None" = None,
        starts: int = SearchOptions.starts,
        *,
        seed: int = 0,
        budget: int = BUDGET,
        everywhere: bool = False,
        robust: Tolerance | None = None,
        scheduler: str | None = None,
    ) -> OptimiseResult:
        """Return better mount rates for a problem; the study's stay as they are, see `StudyRates.use`.

        Args:
            problem: itself, the name of one of the vehicle's, or a .toml file; None: the usual one.
            starts: from how many designs to search, the first being the present rates.
            seed: random seed; the same finds the same.
            budget: the most evaluations, besides those that choose where to start.
            everywhere: search everywhere at once instead of from starts: slower, and finds what these
                may miss.
            robust: then make the 95th percentile over parts within this tolerance small.
            scheduler: compute on the dask cluster at this address.

        Raises:
            ModevizError: there is no such problem, or a number that no search can have.
            SolveError: a design that cannot be solved, or none that keeps a mode where it has to be.
        """
        options = SearchOptions(starts, seed, budget, everywhere, robust, scheduler)
        return better_rates(self._tuned, problem, options, self._tell)

    @one_thread()
    def front(
        self,
        goals: str,
        problem: "str | Path | Problem | None" = None,
        starts: int = FRONT_STARTS,
        *,
        seed: int = 0,
        budget: int = BUDGET,
    ) -> FrontResult:
        """Return designs between two goals of a problem.

        Args:
            goals: such as "lateral against vertical".
            problem: as of `optimise`.
            starts: for each design, besides those found before.
            seed: random seed; the same finds the same.
            budget: the most evaluations, besides those that choose where to start.

        Raises:
            ModevizError: the problem has no such goals; else as `optimise`.
        """
        options = SearchOptions(starts, seed, budget)
        return designs_between(self._tuned, goals, problem, options, self._tell)

    @one_thread()
    def scatter(
        self,
        samples: int = 1000,
        problem: "str | Path | Problem | None" = None,
        *,
        road: str | None = None,
        tolerance: Tolerance | None = None,
        point: str | None = None,
        seed: int = 0,
        scheduler: str | None = None,
    ) -> ScatterResult:
        """Return what many vehicles do whose mounts are anywhere within their tolerance.

        Args:
            samples: how many.
            problem: whose goal is looked at; as of `optimise`.
            road: as of `ride`.
            tolerance: of the parts; None: ±15 % in hardness and ±30 % in loss factor.
            point: name of the response point that is looked at; None: the driver's.
            seed: random seed; the same gives the same vehicles.
            scheduler: compute on the dask cluster at this address.

        Raises:
            ModevizError: there is no such problem, road or point, or its goal does not scatter.
        """
        points = () if point is None else (point,)
        options = ScatterOptions(samples, tolerance or Tolerance(), seed, points, scheduler)
        return scattered(self._tuned, problem, road, options, self._tell)

    def __repr__(self) -> str:
        return "\n".join(
            [f"Study of {self.vehicle.name}", *(f"  {line}" for line in self._tuned.described())]
        )

    def _repr_html_(self) -> str:
        return block(f"Study of {self.vehicle.name}", paragraphs(*self._tuned.described()))
