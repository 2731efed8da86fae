"""A command to a tuning session."""

from abc import ABC, abstractmethod
from collections.abc import Hashable

from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.session.history import MERGE_WITHIN
from modeviz.viewer.session.state import State


class Command(ABC):
    """Something that is asked of a session, as a value."""

    @property
    def step(self) -> Hashable:
        """Commands of one step, such as those of a drag, are undone together; None: alone."""
        return None

    @property
    def within(self) -> float:
        """The longest time between two of them for that, s."""
        return MERGE_WITHIN

    @abstractmethod
    def apply(self, state: State, vehicle: Vehicle) -> State:
        """Return the state that is asked for; called while nobody else changes it.

        Args:
            state: the present one.
            vehicle: of the session.

        Raises:
            VehicleError: it asks for what the vehicle does not have.
        """
