"""Bushings put into a vehicle folder, as mount groups that are tuned, springs and dampers."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from modeviz.errors import VehicleError, listed, located, quoted
from modeviz.files.folder import VEHICLE_FILE, read_vehicle
from modeviz.files.mount_tables.bushing import Bushing
from modeviz.files.mount_tables.reading import named_directions
from modeviz.files.mount_tables.records import connection_tables
from modeviz.files.records.vehicle import VehicleRecord
from modeviz.files.schema.axes import axes_of
from modeviz.files.toml_reader import read_toml
from modeviz.formats.append import append_tables
from modeviz.formats.mounts.ends import Ends
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class Target:
    """The vehicle folder that bushings are put into."""

    folder: Path
    vehicle: Vehicle
    axes: Floats
    """(3, 3): turns what is in the axes of its file into ours."""

    @classmethod
    def of(cls, folder: Path) -> "Target":
        """Raises VehicleError if there is no vehicle in a folder."""
        path = folder / VEHICLE_FILE
        if not path.is_file():
            raise VehicleError(
                f"{folder}: has no {VEHICLE_FILE}; import the bodies first, then what joins them"
            )
        vehicle = read_vehicle(folder)
        return cls(folder, vehicle, axes_of(read_toml(path, VehicleRecord).axes))

    @property
    def named(self) -> dict[str, str]:
        """Along which of x, y and z of the file the directions of rates are."""
        return named_directions(self.axes)


def near_bushings(
    bushings: Sequence[Bushing], target: Target, note: Callable[[str], None]
) -> tuple[Bushing, ...]:
    """Return the bushings that something of a vehicle is near, or all if there is nothing near any.

    Those of an input file may be within bodies, as spot welds are; but where most are near nothing, the
    file is likely in other units or elsewhere.

    Args:
        bushings: in SI and the axes of the vehicle's file.
        target: of the vehicle.
        note: told which are left out.

    Raises:
        VehicleError: most of them are near nothing.
    """
    ends = Ends(target.vehicle, target.axes)
    far = [bushing.name for bushing in bushings if ends.is_far(bushing)]
    if not far or len(far) == len(bushings):
        return tuple(bushings)
    if 2 * len(far) > len(bushings):
        raise VehicleError(
            f"{len(far)} of {len(bushings)} springs have no attachment of a body near, such as "
            f"{listed(far[:3])}; are the units others, or does the file stand elsewhere (--pose)? "
            "Take springs within bodies out of it"
        )
    note(f"{listed(far)}: no body has an attachment near, and are left out")
    return tuple(bushing for bushing in bushings if bushing.name not in far)


def add_bushings(bushings: Sequence[Bushing], target: Target, source: str) -> Vehicle:
    """Return the vehicle of a folder into which bushings are put.

    What stands in its vehicle.toml stays to the letter; the new tables come after it.

    Args:
        bushings: in SI and the axes of the vehicle's file.
        target: what to put them into.
        source: the file that they are from.

    Raises:
        VehicleError: a name is there already, an end holds on to nothing, or mounts of a group differ;
            the folder is as it was then.
    """
    with located(source):
        _check_new(bushings, target.vehicle)
        ends = Ends(target.vehicle, target.axes)
        joined = {b.name: ends.joined(b) for b in bushings}
        tables = dict(connection_tables(bushings, joined, target.named))
    heading = f"# {len(bushings)} connections from {' '.join(source.split())}"
    return append_tables(target.folder, tables, heading)


def _check_new(bushings: Sequence[Bushing], vehicle: Vehicle) -> None:
    """Raises VehicleError for a name that the vehicle has."""
    names = {connection.name for connection in vehicle.all_connections}
    groups = {group.name for group in vehicle.mount_groups}
    bodies = {body.name for body in vehicle.bodies}
    for bushing in bushings:
        if bushing.name in names:
            raise VehicleError(
                f"{bushing.where}: the vehicle has a connection {quoted(bushing.name)} already; give "
                "this one another name, or take its table out of vehicle.toml"
            )
        if bushing.group in groups:
            raise VehicleError(
                f"{bushing.where}: the vehicle has a mount group {quoted(bushing.group)} already; to "
                "try other rates give commands a file of them with --rates"
            )
        if bushing.group in bodies:
            raise VehicleError(
                f"{bushing.where}: the group {quoted(bushing.group)} has the name of a body; take "
                "another"
            )
