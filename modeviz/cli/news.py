"""What an import into a vehicle folder changes of what there is to say of the vehicle."""

from collections.abc import Callable, Iterable
from contextlib import suppress
from pathlib import Path

from modeviz.cli.terminal import remark
from modeviz.errors import VehicleError, quoted
from modeviz.files.folder import VEHICLE_FILE, read_vehicle
from modeviz.vehicle.vehicle import Vehicle

Find = Callable[[Vehicle], Iterable[str]]


class News:
    """Tells notes on a vehicle that its folder did not give rise to before something was put in."""

    def __init__(self, folder: Path | None, *find: Find) -> None:
        """Looks at the folder as it is.

        Args:
            folder: of the vehicle, which may not be there yet, or not be readable.
            find: what notes there are of a vehicle beside those of reading it.
        """
        self._find = find
        self._standing: frozenset[str] = frozenset()
        if folder and (folder / VEHICLE_FILE).is_file():
            with suppress(VehicleError):
                self._standing = frozenset(self._notes(read_vehicle(folder)))

    def tell(self, vehicle: Vehicle, body: str = "") -> None:
        """Tells what is new of a vehicle, and all of a body that was put in."""
        for note in self._notes(vehicle):
            if note not in self._standing or (body and f"body {quoted(body)}" in note):
                remark(note)

    def _notes(self, vehicle: Vehicle) -> tuple[str, ...]:
        return (*vehicle.notes, *(note for find in self._find for note in find(vehicle)))
