"""The whole vehicle with its present rates, as a vehicle folder in one file."""

import io
from pathlib import Path
from tempfile import TemporaryDirectory
from zipfile import ZIP_DEFLATED, ZipFile, ZipInfo

from modeviz.files.folder import write_vehicle
from modeviz.text.wording import file_name
from modeviz.vehicle.vehicle import Vehicle


def zipped_folder(vehicle: Vehicle) -> bytes:
    """Return the folder that `write_vehicle` writes, zipped; the same bytes for the same vehicle."""
    root = file_name(vehicle.name, "").rstrip(".")
    content = io.BytesIO()
    with TemporaryDirectory() as parent, ZipFile(content, "w") as archive:
        folder = Path(parent) / root
        write_vehicle(vehicle, folder)
        for path in sorted(folder.rglob("*")):
            if path.is_file():
                entry = ZipInfo(path.relative_to(parent).as_posix())  # of 1980, whenever it is written
                archive.writestr(entry, path.read_bytes(), ZIP_DEFLATED)
    return content.getvalue()
