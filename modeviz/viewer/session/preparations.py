"""A vehicle made ready as it is altered: each way once, as long as somebody wants it."""

from collections.abc import Callable, Collection

from modeviz.analysis.preparation import Prepared, prepare
from modeviz.vehicle.alterations import Alterations, altered
from modeviz.vehicle.vehicle import Vehicle

Preparing = Callable[[Callable[[float], None] | None], Prepared]


class Preparations:
    """Makes a vehicle ready with alterations, which takes long, and keeps it."""

    def __init__(self, vehicle: Vehicle, unaltered: Preparing | None = None) -> None:
        """Prepares nothing.

        Args:
            vehicle: without alterations.
            unaltered: makes it ready as it is, where others want that too; told whom to tell how far
                that is.
        """
        self.vehicle: Vehicle = vehicle
        self._unaltered = unaltered
        self._kept: list[tuple[Alterations, Prepared]] = []

    def copied(self) -> "Preparations":
        """Return others that have what is ready here."""
        others = Preparations(self.vehicle, self._unaltered)
        others._kept = [*self._kept]
        return others

    def get(
        self, alterations: Alterations, progress: Callable[[float], None] | None = None
    ) -> Prepared:
        """Return the vehicle made ready with some alterations.

        Args:
            alterations: of the vehicle.
            progress: told the fraction that is done, if it is not ready yet; what it raises ends that.

        Raises:
            ModevizError: it cannot be altered so, or not be prepared.
        """
        known = self._known(alterations)
        if known is not None:
            return known
        if self._unaltered and alterations == Alterations():
            prepared = self._unaltered(progress)
        else:
            prepared = prepare(altered(self.vehicle, alterations), progress=progress)
        self._kept.append((alterations, prepared))
        return prepared

    def has(self, alterations: Alterations) -> bool:
        """Return whether the vehicle is ready with some alterations."""
        return self._known(alterations) is not None

    def _known(self, alterations: Alterations) -> Prepared | None:
        return next((prepared for each, prepared in self._kept if each == alterations), None)

    def keep(self, wanted: Collection[Alterations]) -> None:
        """Forgets what is not wanted any more."""
        self._kept = [each for each in self._kept if each[0] in wanted]
