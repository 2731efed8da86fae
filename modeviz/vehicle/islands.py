"""Which bodies of a vehicle hang together, and which of them hold on to the ground."""

from dataclasses import dataclass

from modeviz.vehicle.connections import GROUND
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True)
class Island:
    """Bodies that connections join to each other, and to none else."""

    bodies: tuple[str, ...]
    """In the order of the vehicle's."""
    is_held: bool
    """Whether a connection joins one of them to the ground."""


def islands(vehicle: Vehicle) -> tuple[Island, ...]:
    """Return the bodies of a vehicle by what hangs together, the one with most bodies first."""
    group = {body.name: {body.name} for body in vehicle.bodies}
    held: set[str] = set()
    for first, second in (connection.bodies for connection in vehicle.all_connections):
        if second == GROUND:
            held.add(first)
        elif group[first] is not group[second]:
            group[first] |= group[second]
            group.update(dict.fromkeys(group[second], group[first]))
    found = {id(names): names for names in group.values()}.values()
    every = [
        Island(tuple(b.name for b in vehicle.bodies if b.name in names), bool(names & held))
        for names in found
    ]
    return tuple(sorted(every, key=lambda island: -len(island.bodies)))
