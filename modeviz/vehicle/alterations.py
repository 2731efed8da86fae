"""What of a vehicle is tuned besides its rates: all that makes another vehicle of it."""

from dataclasses import dataclass, field, replace

from modeviz.vehicle.absorber import Absorber
from modeviz.vehicle.absorbers import with_absorbers
from modeviz.vehicle.placement import Placement, Placements, with_placements
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Alterations:
    """What is other than in a vehicle's file, as one value."""

    placements: Placements = field(default_factory=dict)
    """Of the mount groups that are moved or turned."""
    absorbers: tuple[Absorber, ...] = ()
    """Those that the file does not have, the newest last."""

    def placement(self, group: str) -> Placement:
        """Return how the mounts of a group are placed."""
        return self.placements.get(group, Placement())

    def placed(self, placements: Placements) -> "Alterations":
        """Return these with all mounts placed so."""
        return replace(self, placements=placements)

    def with_placement(self, group: str, placement: Placement) -> "Alterations":
        """Return these with the mounts of a group placed otherwise."""
        placements = {**self.placements, group: placement}
        kept = {name: placed for name, placed in placements.items() if not placed.is_as_given}
        return replace(self, placements=kept)

    def absorber(self, name: str) -> Absorber | None:
        """Return the absorber of that name that was added; None if there is none."""
        return next((absorber for absorber in self.absorbers if absorber.name == name), None)

    def with_absorber(self, absorber: Absorber) -> "Alterations":
        """Return these with an absorber, which takes the place of one of its name."""
        if self.absorber(absorber.name) is None:
            return replace(self, absorbers=(*self.absorbers, absorber))
        changed = (absorber if old.name == absorber.name else old for old in self.absorbers)
        return replace(self, absorbers=tuple(changed))

    def without_absorber(self, name: str) -> "Alterations":
        """Return these without the absorber of that name, nor how it was placed."""
        left = tuple(absorber for absorber in self.absorbers if absorber.name != name)
        placements = {group: placed for group, placed in self.placements.items() if group != name}
        return replace(self, absorbers=left, placements=placements)


def altered(vehicle: Vehicle, alterations: Alterations) -> Vehicle:
    """Return a vehicle with all alterations, or itself where there are none.

    Raises:
        VehicleError: it lacks what is to be altered, or cannot be altered so.
    """
    added = {absorber.name: absorber for absorber in alterations.absorbers}
    own = {name: placed for name, placed in alterations.placements.items() if name not in added}
    absorbers = [a.placed(alterations.placement(name)) for name, a in added.items()]
    placed = with_placements(vehicle, own)
    if not absorbers:
        return placed
    told = (
        f"absorber {absorber.name!r}, {absorber.mass:g} kg on {absorber.body!r}, is not in the file"
        for absorber in absorbers
    )
    return replace(with_absorbers(placed, absorbers), notes=(*placed.notes, *told))
