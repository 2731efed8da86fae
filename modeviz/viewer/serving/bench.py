"""A vehicle on the bench: made ready once, for all its sessions."""

import threading
from collections.abc import Callable
from functools import cached_property

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.analysis.results import Conditions
from modeviz.journal.fingerprint import Fingerprint, fingerprint_of
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.encoding.link import opening_of_link
from modeviz.viewer.session.opening import Opening
from modeviz.viewer.session.preparations import Preparations
from modeviz.viewer.session.state import first_state

Progress = Callable[[float], None]


class Bench:
    """What all sessions of a vehicle begin with."""

    def __init__(
        self, vehicle: Vehicle, rates: Rates, conditions: Conditions, link: str | None = None
    ) -> None:
        """Prepares nothing yet.

        Args:
            vehicle: with the rates that all is compared with.
            rates: of a new session.
            conditions: of a new session.
            link: what a new session shows in their place, see `opening_of_link`.

        Raises:
            ModevizError: the link is none.
        """
        self.vehicle: Vehicle = vehicle
        self.rates: Rates = rates
        self.conditions: Conditions = conditions
        self._link = link
        self._lock = threading.Lock()
        self._prepared: Prepared | None = None
        self._told: list[Progress] = []
        self.opening()

    @cached_property
    def fingerprint(self) -> Fingerprint:
        """Of the vehicle."""
        return fingerprint_of(self.vehicle)

    def opening(self, link: str | None = None) -> Opening:
        """Return what a new session opens with.

        Args:
            link: what somebody sent; see `opening_of_link`.

        Raises:
            ModevizError: the link is none.
        """
        usual, shown = first_state(self.vehicle, self.rates, self.conditions), link or self._link
        if shown is None:
            return Opening(usual)
        return opening_of_link(shown, usual, self.vehicle, self.fingerprint.digest)

    def preparations(self) -> Preparations:
        """Return how a session gets the vehicle made ready: as it is from here, altered by itself."""
        return Preparations(self.vehicle, self.prepared)

    def prepared(self, progress: Progress | None = None) -> Prepared:
        """Return the vehicle made ready; who asks while that is being done waits for it.

        Args:
            progress: told the fraction that is done.

        Raises:
            ModevizError: it cannot be prepared.
        """
        if progress:
            self._told.append(progress)
        try:
            with self._lock:
                if self._prepared is None:
                    self._prepared = prepare(self.vehicle, progress=self._tell)
                return self._prepared
        finally:
            if progress:
                self._told.remove(progress)

    @property
    def title(self) -> str:
        """Of its pages."""
        return f"{self.vehicle.name} · modeviz"

    def _tell(self, fraction: float) -> None:
        for progress in tuple(self._told):
            progress(fraction)
