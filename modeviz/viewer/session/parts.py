"""The vehicle of a session with the parts that a state adds to it, and no mount moved."""

import threading
from collections.abc import Sequence

from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.state import State


class Parts:
    """Adds parts to a vehicle, which stays the same one as long as the parts do."""

    def __init__(self, vehicle: Vehicle, absorbers: Sequence[Absorber] = ()) -> None:
        """Adds the first ones.

        Args:
            vehicle: as in its file.
            absorbers: that a session opens with.

        Raises:
            VehicleError: it cannot have them.
        """
        self._vehicle = vehicle
        self._lock = threading.Lock()
        self._last = tuple(absorbers), with_absorbers(vehicle, absorbers)

    def of(self, state: State) -> Vehicle:
        """Return the vehicle with the parts of a state.

        Raises:
            VehicleError: as `with_absorbers`.
        """
        wanted = state.design.alterations.absorbers
        with self._lock:
            absorbers, vehicle = self._last
        if absorbers != wanted:
            vehicle = with_absorbers(self._vehicle, wanted)
            with self._lock:
                self._last = wanted, vehicle
        return vehicle
