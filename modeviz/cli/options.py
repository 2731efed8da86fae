"""Options that several commands have, how they are read, and what they stand for."""

from argparse import ArgumentParser
from dataclasses import dataclass
from pathlib import Path

from modeviz.analysis.forces import LoadedForces
from modeviz.analysis.preparation import Prepared, prepare, prepare_modes
from modeviz.analysis.results import Conditions
from modeviz.cli.terminal import progress, remark
from modeviz.errors import ModevizError, located
from modeviz.files import builtin_vehicle, read_vehicle
from modeviz.files.place_settings import parse_placements
from modeviz.files.rate_settings import ORIGINAL, resolve_rates
from modeviz.scatter.tolerance import Tolerance
from modeviz.study.conditions import has_ride, on_even_road, road_conditions
from modeviz.study.forces import loaded_forces
from modeviz.study.searching import chosen_problem
from modeviz.units import parse
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.placement import Placements, with_placements
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, kw_only=True)
class VehicleOptions:
    """Which vehicle, with which mount rates."""

    vehicle: Path | None = None
    """Its folder; None: the pickup's."""
    rates: str = ORIGINAL
    """The name of a set of the vehicle's, or of a file."""
    settings: tuple[str, ...] = ()
    """Single rates, such as "C2.lateral=131 N/mm"."""
    places: tuple[str, ...] = ()
    """Where mounts are, such as "C2=20,0,0 mm"."""

    @property
    def placements(self) -> Placements:
        """Where mounts are to be; raises VehicleError if that cannot be read."""
        return parse_placements(self.places)

    def given(self) -> Vehicle:
        """Return the vehicle as it is in its folder; raises VehicleError if that is wrong."""
        return read_vehicle(self.vehicle or builtin_vehicle())

    def read(self) -> tuple[Vehicle, Rates]:
        """Return the vehicle with its own rates, and the rates chosen; says the notes on the vehicle.

        Raises:
            VehicleError: something is wrong in a file, there are no such rates, or mounts are to be
                where they cannot.
        """
        return self.with_rates(self.given())

    def with_rates(self, vehicle: Vehicle) -> tuple[Vehicle, Rates]:
        """Return a vehicle with mounts where they are chosen, as `read`; says the notes on it."""
        vehicle = with_placements(vehicle, self.placements)
        for note in vehicle.notes:
            remark(note)
        return vehicle, resolve_rates(vehicle, self.rates, self.settings)


@dataclass(frozen=True, kw_only=True)
class SpeedOptions:
    """How fast."""

    speed: str | None = None
    """Such as "88 km/h"; None: the vehicle's."""

    def chosen_speed(self, vehicle: Vehicle) -> float:
        """Return the speed, m/s.

        Raises:
            ModevizError: it is not a speed above zero.
        """
        if self.speed is None:
            return vehicle.speed
        with located("--speed"):
            speed = parse(self.speed, "speed")
            if speed <= 0:
                raise ModevizError(f"found {self.speed!r}, expected more than zero")
        return speed


@dataclass(frozen=True, kw_only=True)
class RoadOptions(SpeedOptions):
    """On which road, and how fast."""

    road: str | None = None
    """Name of a road or another random load, or one of ISO 8608, "ISO C"; None: the vehicle's first."""

    def conditions(self, vehicle: Vehicle) -> Conditions:
        """Return the road and the speed chosen, or the vehicle's; raises as `road_conditions`."""
        return road_conditions(vehicle, self.road, self.chosen_speed(vehicle))

    def ride(self, vehicle: Vehicle) -> Conditions | None:
        """Return the same; None for a vehicle that nothing shakes or feels, unless it is asked for."""
        is_asked_for = self.road is not None or self.speed is not None
        return self.conditions(vehicle) if is_asked_for or has_ride(vehicle) else None

    def shown(self, vehicle: Vehicle) -> tuple[Vehicle, Conditions]:
        """Return a vehicle that can be shown, and its ride: without one, on an even road unfelt."""
        chosen = self.ride(vehicle)
        return on_even_road(vehicle) if chosen is None else (vehicle, chosen)


@dataclass(frozen=True, kw_only=True)
class LoadOptions(SpeedOptions):
    """Under which load, random or harmonic, and where in the band."""

    load: str | None = None
    """Its name, or that of a road of ISO 8608; None: what usually shakes the vehicle."""
    at: float | None = None
    """Hz: the only frequency that is asked for; None: the vehicle's band."""

    def __post_init__(self) -> None:
        if self.at is not None and not 0 < self.at < float("inf"):
            raise ModevizError(f"at: found {self.at:g} Hz, expected more than zero")

    def forces(self, vehicle: Vehicle, rates: Rates) -> LoadedForces:
        """Return the forces under that load; shows on a terminal how far that is."""
        speed, tell = self.chosen_speed(vehicle), progress("solving")
        return loaded_forces(prepare_modes(vehicle), rates, self.load, speed, self.at, tell)


@dataclass(frozen=True, kw_only=True)
class ProblemOptions:
    """What is to become small."""

    problem: str | None = None
    """Name of a problem of the vehicle's, or of a .toml file; None: the usual one."""

    def chosen_problem(self, vehicle: Vehicle) -> Problem:
        """Return that problem; raises as `modeviz.study.searching.chosen_problem`."""
        return chosen_problem(vehicle, self.problem)


@dataclass(frozen=True, kw_only=True)
class ToleranceOptions:
    """How far parts may be from their drawing."""

    tolerance: float | None = None
    """A fraction of every mount's hardness, up and down; None: the usual one."""
    loss_tolerance: float | None = None
    """A fraction of every mount's loss factor; None: the usual one."""

    @property
    def has_tolerance(self) -> bool:
        """Whether one was given."""
        return (self.tolerance, self.loss_tolerance) != (None, None)

    def chosen_tolerance(self) -> Tolerance:
        """Return the tolerance, as far as it is given, or else the usual one; raises as `Tolerance`."""
        given = {"rates": self.tolerance, "loss_factor": self.loss_tolerance}
        return Tolerance(**{name: value for name, value in given.items() if value is not None})


@dataclass(frozen=True, kw_only=True)
class JsonOptions:
    """How a result is printed."""

    json: bool = False
    """As a record and not as a table."""


def add_vehicle(command: ArgumentParser) -> None:
    """Reads `VehicleOptions`."""
    add_folder(command)
    add_rates(command)


def add_folder(command: ArgumentParser) -> None:
    """Reads the folder of `VehicleOptions`."""
    command.add_argument(
        "vehicle",
        nargs="?",
        default=None,  # what is suppressed here would be read as a path
        type=Path,
        metavar="VEHICLE",
        help="vehicle folder (default: the pickup)",
    )


def add_rates(command: ArgumentParser) -> None:
    """Reads the rates of `VehicleOptions`."""
    command.add_argument(
        "--rates",
        metavar="NAME|FILE",
        help="a set of the vehicle's, such as original or optimised, or a JSON or CSV file",
    )
    command.add_argument(
        "--set",
        action="append",
        metavar="RATE",
        dest="settings",
        help='one rate or loss factor, such as "C2.lateral=131 N/mm" or C2.loss_factor=0.2; may be '
        "repeated",
    )
    command.add_argument(
        "--place",
        action="append",
        metavar="PLACE",
        dest="places",
        help='where the mounts of a group are moved, "C2=20,0,-10 mm", or turned, "C2=0,5,0 deg", '
        "along and about the vehicle's axes, those on the other side as in a mirror; may be repeated",
    )


def add_speed(command: ArgumentParser) -> None:
    """Reads `SpeedOptions`."""
    command.add_argument("--speed", metavar="SPEED", help='such as "88 km/h" (default: the vehicle\'s)')


def add_road(command: ArgumentParser) -> None:
    """Reads `RoadOptions`."""
    command.add_argument(
        "--road",
        metavar="NAME",
        help='or another random load, or a road of ISO 8608: "ISO C", "ISO 100 cm³, waviness 2.3"; '
        "default: the vehicle's first, or else ISO C",
    )
    add_speed(command)


def add_load(command: ArgumentParser) -> None:
    """Reads `LoadOptions`."""
    command.add_argument(
        "--load",
        metavar="NAME",
        help='a road, another random load or a harmonic one, or a road of ISO 8608, "ISO C"; default: '
        "the random load that usually shakes the vehicle, else its first harmonic one",
    )
    command.add_argument(
        "--at", type=float, metavar="HZ", help="the only frequency (default: the vehicle's band)"
    )
    add_speed(command)


def add_problem(command: ArgumentParser, what: str = "") -> None:
    """Reads `ProblemOptions`; `what` it is for begins its help."""
    command.add_argument(
        "--problem",
        metavar="NAME|FILE",
        help=f"{what}a .toml file that the page saved is one, too (default: the vehicle's first)",
    )


def add_tolerances(command: ArgumentParser) -> None:
    """Reads `ToleranceOptions`."""
    usual = Tolerance()
    command.add_argument(
        "--tolerance",
        type=float,
        metavar="PART",
        help=f"of every mount's hardness, up and down; default {usual.rates:g}",
    )
    command.add_argument(
        "--loss-tolerance",
        type=float,
        metavar="PART",
        help=f"of every mount's loss factor; default {usual.loss_factor:g}",
    )


def add_seed(command: ArgumentParser) -> None:
    """Reads a field `seed`."""
    command.add_argument("--seed", type=int, metavar="N", help="random seed")


def add_scheduler(command: ArgumentParser) -> None:
    """Reads a field `scheduler`."""
    command.add_argument(
        "--scheduler",
        metavar="ADDRESS",
        help="compute on the dask cluster there, as tcp://10.0.0.1:8786 (default: here)",
    )


def add_json(command: ArgumentParser) -> None:
    """Reads `JsonOptions`."""
    command.add_argument("--json", action="store_true", help="print JSON instead of a table")


def prepare_telling(vehicle: Vehicle) -> Prepared:
    """Return a vehicle made ready; shows on a terminal how far that is."""
    return prepare(vehicle, progress=progress("preparing"))
