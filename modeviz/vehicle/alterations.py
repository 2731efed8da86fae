"""What of a vehicle is tuned besides its rates: all that makes another vehicle of it."""

from dataclasses import dataclass, field, replace

from modeviz.vehicle.placement import Placement, Placements, check_placements, with_placements
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Alterations:
    """What is other than in a vehicle's file, as one value."""

    placements: Placements = field(default_factory=dict)
    """Of the mount groups that are moved or turned."""

    def placement(self, group: str) -> Placement:
        """Return how the mounts of a group are placed."""
        return self.placements.get(group, Placement())

    def with_placement(self, group: str, placement: Placement) -> "Alterations":
        """Return these with the mounts of a group placed otherwise."""
        placements = {**self.placements, group: placement}
        kept = {name: placed for name, placed in placements.items() if not placed.is_as_given}
        return replace(self, placements=kept)


def altered(vehicle: Vehicle, alterations: Alterations) -> Vehicle:
    """Return a vehicle with all alterations, or itself where there are none.

    Raises:
        VehicleError: it lacks what is to be altered, or cannot be altered so.
    """
    return with_placements(vehicle, alterations.placements)


def check_alterations(vehicle: Vehicle, alterations: Alterations) -> None:
    """Raises VehicleError as `altered` would, in a part of its time."""
    check_placements(vehicle, alterations.placements)
