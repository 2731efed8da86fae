"""What of a response of a study's vehicle comes through which connection."""

from collections.abc import Callable
from dataclasses import dataclass

from modeviz.analysis.forces import LoadedForces
from modeviz.errors import VehicleError, unknown
from modeviz.mounting.paths import By
from modeviz.report.paths import PointPaths, overall_shares, paths_record, paths_table
from modeviz.report.records import Record
from modeviz.study.conditions import need
from modeviz.study.displayed import Displayed
from modeviz.study.names import axis_of, point_number
from modeviz.study.notebook import block
from modeviz.text.markup import table, title
from modeviz.text.wording import number
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.vehicle import Vehicle


def point_paths(
    vehicle: Vehicle, point: str | None, direction: str, solve: Callable[[], LoadedForces]
) -> PointPaths:
    """Return the paths to a response.

    Args:
        vehicle: whose points.
        point: name of one; None: the driver's.
        direction: one of `DIRECTIONS`.
        solve: gives the forces, once point and direction are known.

    Raises:
        ModevizError: there is no such point or direction, or as `solve`.
    """
    need(vehicle, "response point", vehicle.response_points)
    axis = axis_of(direction)
    at = vehicle.response_points[0 if point is None else point_number(vehicle, point)]
    found = solve()
    return PointPaths(found, at, direction, found.paths(at, axis))


@dataclass(frozen=True, eq=False, repr=False)
class ResponsePaths(Displayed):
    """The paths to one response, by mount, direction, neighbouring body or mount group.

    paths = study.paths("seat track left", "lateral", "road 1")
    paths.shares("body"), paths.spectrum("C1 left")
    """

    paths: PointPaths
    """As the functions of `report` take it."""
    by: By
    """How they are told in tables."""

    @property
    def frequency_hz(self) -> Floats:
        """(n_freqs,): lines of the vehicle's band, closer where modes are sharp."""
        return self.paths.paths.frequency_hz

    def shares(self, by: By | None = None) -> dict[str, float]:
        """Return the share of each path in the mean square acceleration over the band, one in all.

        Args:
            by: "mount", "direction", "body" or "group"; None: as asked for.
        """
        return overall_shares(self.paths, by or self.by)

    def spectrum(self, path: str, by: By | None = None) -> Floats:
        """Return the share of a path at each frequency, (n_freqs,).

        Args:
            path: as `shares` calls it.
            by: as there.

        Raises:
            VehicleError: there is no such path.
        """
        how = by or self.by
        together = self.paths.paths.together(how)
        names = [each.called(how) for each in together.paths]
        if path not in names:
            raise VehicleError(unknown("path", path, names))
        return together.shares(self.paths.found.spectra)[:, names.index(path)]

    def table(self) -> str:
        """Return the shares over the band and at the highest peaks, the largest first."""
        return paths_table(self.paths, self.by)

    def to_dict(self) -> Record:
        """Return what `modeviz paths --json` prints, see `report.paths.paths_record`."""
        return paths_record(self.paths)

    def _repr_html_(self) -> str:
        shares = self.shares()
        names = sorted(shares, key=lambda name: -abs(shares[name]))
        rows = [[title(name), f"{number(100 * shares[name], 1)} %"] for name in names]
        what = f"{self.paths.direction} acceleration at {self.paths.point.name}"
        return block(f"{what}, {self.paths.found.load.name}", table(["", "Share"], rows))
