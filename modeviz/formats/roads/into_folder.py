"""A measured road put into a vehicle folder, as a table of spectra along it."""

from pathlib import Path

import numpy as np

from modeviz.errors import VehicleError, quoted
from modeviz.files.disk import file_stems
from modeviz.files.folder import VEHICLE_FILE, read_vehicle
from modeviz.files.records.loads import RoadRecord
from modeviz.files.spectra import write_spectrum_table
from modeviz.formats.append import append_tables
from modeviz.formats.roads.tracks import TrackSpectra
from modeviz.vehicle.vehicle import Vehicle

COLUMNS = (
    "spatial_frequency (cycles/m)",
    "left (m³)",
    "right (m³)",
    "cross_real (m³)",
    "cross_imag (m³)",
)


def vehicle_of(folder: Path) -> Vehicle:
    """Return the vehicle of a folder; raises VehicleError if there is none."""
    if not (folder / VEHICLE_FILE).is_file():
        raise VehicleError(
            f"{folder}: has no {VEHICLE_FILE}; import the bodies first, then the roads they are on"
        )
    return read_vehicle(folder)


def add_road(spectra: TrackSpectra, name: str, folder: Path, vehicle: Vehicle, source: str) -> Vehicle:
    """Return the vehicle of a folder into which a road is put.

    Args:
        spectra: of its tracks.
        name: of the road.
        folder: of the vehicle.
        vehicle: that is in it.
        source: the file that the road is from.

    Raises:
        VehicleError: the vehicle has something of that name; the folder is as it was then.
    """
    names = [load.name for load in vehicle.random_loads]
    if name in names:
        raise VehicleError(
            f"{folder}: has a road {quoted(name)} already; give this one another name with --name"
        )
    file = f"roads/{file_stems([*names, name])[name]}.csv"
    S = spectra.spectrum
    cross = S[:, 0, 1]
    values = (spectra.spatial_frequency, S[:, 0, 0].real, S[:, 1, 1].real, cross.real, cross.imag)

    def write(new: Path) -> None:
        if (new / file).exists():
            raise VehicleError(f"{folder / file}: is there already; give the road another name")
        (new / "roads").mkdir(exist_ok=True)
        write_spectrum_table(new / file, COLUMNS, [np.asarray(column) for column in values])

    heading = f"# {spectra.length:.5g} m of road from {' '.join(source.split())}"
    return append_tables(folder, {"road": [RoadRecord(name=name, file=file)]}, heading, write)
