"""One vehicle, its mount rates, and all there is to ask of them."""

import threading
from datetime import date
from functools import partial
from os import PathLike
from pathlib import Path

from modeviz.analysis.exact_check import Check, checked
from modeviz.analysis.following import solve_followed
from modeviz.analysis.preparation import Prepared, PreparedModes, prepare, prepare_modes
from modeviz.analysis.results import Conditions, Results, solve, solve_wheels
from modeviz.analysis.sensitivity import sensitivity
from modeviz.compute.threads import one_thread
from modeviz.dynamics.band import Method
from modeviz.errors import ModevizError, located, unknown
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.files.disk import check_writable, write_bytes, write_text
from modeviz.files.rate_settings import ORIGINAL, resolve_rates
from modeviz.optimise.run import BUDGET
from modeviz.optimise.search import prepare_search
from modeviz.optimise.trade_off import prepare_trade_off, sides
from modeviz.report.comparison import Comparison, RateSet, compare
from modeviz.report.html import report
from modeviz.scatter.driving import ScatterOptions, drive_many
from modeviz.scatter.searching import SearchOptions, find_best
from modeviz.scatter.tolerance import Tolerance
from modeviz.study.conditions import has_ride, need, on_even_road, road_conditions
from modeviz.study.modes import ModesTable
from modeviz.study.notebook import block, paragraphs
from modeviz.study.optimum import OptimiseResult
from modeviz.study.page import Page, is_notebook, open_page
from modeviz.study.pictures import (
    Background,
    Colors,
    PictureOptions,
    View,
    WrittenFile,
    draw,
    report_pictures,
)
from modeviz.study.rates import StudyRates
from modeviz.study.ride import Ride
from modeviz.study.scatter import ScatterResult
from modeviz.study.searching import chosen_problem, find_designs, telling
from modeviz.study.sensitivity import RateSensitivity
from modeviz.study.telling import Tell, cancelled_by_ctrl_c, say_nothing
from modeviz.study.trade_off import FrontResult
from modeviz.study.wheels import WheelRide
from modeviz.units import parse
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


class Study:
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
        self._vehicle, self._tell = vehicle, progress or say_nothing
        self._speed = vehicle.speed
        self._prepared: PreparedModes | None = None
        self._page: Page | None = None
        self._rates = StudyRates(vehicle)

    @property
    def rates(self) -> StudyRates:
        """The present mount rates, which are read, set and reset through it."""
        return self._rates

    @property
    def vehicle(self) -> Vehicle:
        """With the rates that it has in its file; what reading it had to say is in its `notes`."""
        return self._vehicle

    @property
    def speed(self) -> float:
        """On the roads, m/s; set to a number, or to a text with its unit, "88 km/h"."""
        return self._speed

    @speed.setter
    def speed(self, value: float | str) -> None:
        with located("speed"):
            speed = parse(value, "speed") if isinstance(value, str) else float(value)
            if not 0 < speed < float("inf"):
                raise ModevizError(f"found {value}, expected a finite speed above zero")
        self._speed = speed

    @property
    def roads(self) -> tuple[str, ...]:
        """The names of the roads and other random loads."""
        return tuple(load.name for load in self._vehicle.random_loads)

    @property
    def points(self) -> tuple[str, ...]:
        """The names of the response points, the driver's first."""
        return tuple(point.name for point in self._vehicle.response_points)

    @one_thread()
    def modes(self, below_hz: float | None = None, method: Method = "enriched") -> ModesTable:
        """Return the modes: frequencies, damping, names, energies and shapes.

        Args:
            below_hz: modes above are left out; None: those above the vehicle's band.
            method: "enriched"; "classic": the paper's equation on the original modes; or "exact".

        Raises:
            ModevizError: that frequency is not above zero.
            SolveError: the vehicle has no meaningful modes.
        """
        top = self._vehicle.highest_frequency
        below = top if below_hz is None else below_hz
        if not 0 < below < float("inf"):
            raise ModevizError(f"below_hz: found {below:g}, expected a frequency above zero")
        prepared = self._modes_prepared() if below <= top else prepare_modes(self._vehicle, below)
        return ModesTable(solve_followed(prepared, self.rates.by_group, method), below)

    @one_thread()
    def ride(self, road: str | None = None) -> Ride:
        """Return the ride on a road, or under another random load.

        Args:
            road: its name; None: the first that shakes the vehicle.

        Raises:
            ModevizError: there is no such road, or nothing to drive or to feel it with.
        """
        return Ride(self._ride(road))

    @one_thread()
    def wheels(self) -> WheelRide:
        """Return the response to every wheel load and other harmonic load.

        Raises:
            ModevizError: the vehicle has no such load, or nothing to feel it with.
        """
        vehicle = self._vehicle
        need(vehicle, "response point", vehicle.response_points)
        need(vehicle, "wheel load", vehicle.harmonic_loads)
        results = solve_wheels(self._all_prepared(), self.rates.by_group)
        ride = self._ride(None) if has_ride(vehicle) else None
        return WheelRide(vehicle.with_rates(self.rates.by_group), results, ride)

    @one_thread()
    def sensitivity(self, road: str | None = None) -> RateSensitivity:
        """Return what ten percent more of each mount rate do to frequencies and to the ride.

        Args:
            road: as of `ride`, as are errors.

        Raises:
            ModevizError: as `ride`.
        """
        need(self._vehicle, "mount group", self._vehicle.mount_groups)
        results = self._ride(road)
        return RateSensitivity(results, sensitivity(self._all_prepared(), results))

    @one_thread()
    def optimise(
        self,
        problem: "str | Path | Problem | None" = None,
        starts: int = 20,
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
        chosen, rates = chosen_problem(self._vehicle, problem), self.rates.by_group
        search = prepare_search(self._vehicle, chosen, rates, self._speed)
        with cancelled_by_ctrl_c() as token:
            self._tell("choosing where to start", 0.0)
            search, optimum = find_best(search, rates, options, token, telling(self._tell, token))
        return OptimiseResult(chosen, search, optimum)

    @one_thread()
    def front(
        self,
        goals: str,
        problem: "str | Path | Problem | None" = None,
        starts: int = 5,
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
        chosen, rates = chosen_problem(self._vehicle, problem), self.rates.by_group
        offers = sides(self._vehicle, chosen)
        if goals not in offers:
            raise ModevizError(unknown("trade-off", goals, offers))
        trade_off = prepare_trade_off(self._vehicle, chosen, offers[goals], rates, self._speed)
        with cancelled_by_ctrl_c() as token:
            front = find_designs(trade_off, rates, options, token, self._tell)
        return FrontResult(chosen, trade_off, front)

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
        need(self._vehicle, "mount group", self._vehicle.mount_groups)
        points = () if point is None else (point,)
        options = ScatterOptions(samples, tolerance or Tolerance(), seed, points, scheduler)
        conditions = road_conditions(self._vehicle, road, self._speed)
        chosen, rates = chosen_problem(self._vehicle, problem), self.rates.by_group
        tell = partial(self._tell, "scattering")
        with cancelled_by_ctrl_c() as token:
            told = drive_many(
                self._vehicle,
                self._all_prepared,
                rates,
                conditions,
                chosen,
                options,
                token,
                tell,
            )
        return ScatterResult(told)

    @one_thread()
    def report(
        self,
        path: "str | PathLike[str]" = "report.html",
        against: str = ORIGINAL,
        *,
        road: str | None = None,
        pictures: bool = True,
    ) -> WrittenFile:
        """Write a comparison of the present rates with others as an HTML file that needs no network.

        Args:
            path: of the file.
            against: "original", the name of a set of the vehicle, or a JSON or CSV file.
            road: as of `ride`.
            pictures: whether it has some, for which a Chromium is needed.

        Raises:
            ModevizError: there is no such set or road, it cannot be written, or what draws is missing.
        """
        base = RateSet(Path(against).name, resolve_rates(self._vehicle, against))
        now = RateSet(self.rates.name, self.rates.by_group)
        conditions = self._conditions(road)
        check_writable(Path(path))
        drawn = []
        if pictures and conditions is not None:
            drawn = report_pictures(self._vehicle, (base, now), conditions, self._tell)
        comparison = compare(self._all_prepared(), base, now, conditions)
        write_text(Path(path), report(comparison, date.today(), drawn, self._checked(comparison)))
        return WrittenFile(Path(path))

    @one_thread()
    def render(
        self,
        path: "str | PathLike[str]",
        mode: str = "",
        *,
        view: View = "Iso",
        color: Colors = "bodies",
        background: Background = "scene",
        dark: bool = False,
        width: int = 1280,
        height: int = 720,
        amplitude: float = 1.0,
        phase: float = 0.0,
        frames: int = 36,
    ) -> WrittenFile:
        """Write a picture of a mode: PNG, GIF, MP4, or HTML that still moves, as the ending says.

        Args:
            path: of the file.
            mode: its name; "": the one that the page opens with.
            view: from where it is seen.
            color: what the colours of bodies mean.
            background: as on the page, white or transparent.
            dark: whether the scene is dark.
            width: pixels.
            height: pixels.
            amplitude: of the motion, times the usual one.
            phase: of a PNG, degrees; 0 is the largest motion.
            frames: of a cycle in a GIF or MP4.

        Raises:
            ModevizError: there is no such mode, a number is out of its range, the file cannot be
                written, or what draws is missing.
        """
        options = PictureOptions(
            mode, view, color, background, dark, width, height, amplitude, phase, frames
        )
        check_writable(Path(path))
        vehicle, conditions = self._shown(None)
        content = draw(vehicle, self.rates.by_group, conditions, Path(path), options, self._tell)
        write_bytes(Path(path), content)
        return WrittenFile(Path(path))

    def show(
        self, road: str | None = None, *, port: int = 0, dark: bool = False, height: int = 720
    ) -> Page:
        """Open the page: in a notebook in the cell, elsewhere until Ctrl+C, printing its link.

        A notebook goes on at once, and a page that it showed before is closed. Only this machine can
        reach it; `modeviz view` has more to choose.

        Args:
            road: as of `ride`.
            port: to listen on; 0 takes a free one.
            dark: whether the page is dark.
            height: in a notebook, pixels.

        Raises:
            ModevizError: the port is in use, or there is no such road.
        """
        if self._page is not None:
            self._page.close()
            self._page = None
        vehicle, conditions = self._shown(road)
        rates = self.rates.by_group
        page = open_page(vehicle, rates, conditions, port, dark, height, self._tell)
        print(f"{vehicle.name} is at {page.link}", flush=True)
        if is_notebook():
            self._page = page
            return page
        try:
            threading.Event().wait()
        except KeyboardInterrupt:
            pass
        finally:
            page.close()
        return page

    def __repr__(self) -> str:
        return "\n".join([f"Study of {self._vehicle.name}", *(f"  {line}" for line in self._lines())])

    def _repr_html_(self) -> str:
        return block(f"Study of {self._vehicle.name}", paragraphs(*self._lines()))

    def _lines(self) -> list[str]:
        """What there is to ask for."""
        vehicle = self._vehicle
        groups = ", ".join(group.name for group in vehicle.mount_groups)
        lines = [
            f"bodies: {', '.join(body.name for body in vehicle.bodies)}",
            f"mount groups: {groups}; rates: {self.rates.name}, of {', '.join(self.rates.sets)}",
            f"response points: {', '.join(self.points)}",
            f"roads: {', '.join(self.roads)}; speed: {3.6 * self._speed:.4g} km/h",
            f"problems: {', '.join(problem.name for problem in vehicle.problems)}",
            *(f"note: {note}" for note in vehicle.notes),
        ]
        return [line for line in lines if not line.endswith(": ")]

    def _modes_prepared(self) -> PreparedModes:
        """The vehicle made ready for modes at least."""
        if self._prepared is None:
            self._prepared = prepare_modes(self._vehicle)
        return self._prepared

    def _all_prepared(self) -> Prepared:
        """The vehicle made ready for modes and responses."""
        if not isinstance(self._prepared, Prepared):
            self._prepared = prepare(self._vehicle, progress=partial(self._tell, "preparing"))
        return self._prepared

    def _ride(self, road: str | None) -> Results:
        conditions = road_conditions(self._vehicle, road, self._speed)
        return solve(self._all_prepared(), self.rates.by_group, conditions)

    def _conditions(self, road: str | None) -> Conditions | None:
        """The road asked for, or the vehicle's; None for one that has none, unless it is asked for."""
        if road is None and not has_ride(self._vehicle):
            return None
        return road_conditions(self._vehicle, road, self._speed)

    def _shown(self, road: str | None) -> tuple[Vehicle, Conditions]:
        """A vehicle that can be shown, and what it drives over."""
        conditions = self._conditions(road)
        return on_even_road(self._vehicle) if conditions is None else (self._vehicle, conditions)

    def _checked(self, comparison: Comparison) -> Check | None:
        """The present rates against the full model, solved from scratch; None without a road."""
        if comparison.rides is None:
            return None
        return checked(comparison.rides[1], partial(self._tell, "checking"))
