"""Whether mounts stay within the travel that they have."""

from collections.abc import Iterator
from dataclasses import dataclass

from modeviz.mounting.springs import AXIS
from modeviz.mounting.statics import StaticCase, Statics


@dataclass(frozen=True)
class Travel:
    """A mount's deflection in one direction beside what it may be, m."""

    mount: str
    direction: str
    """One of `DIRECTIONS`."""
    deflection: float
    least: float
    most: float

    @property
    def margin(self) -> float:
        """What is left to the nearer limit, m; below zero beyond it."""
        return min(self.deflection - self.least, self.most - self.deflection)

    @property
    def passed(self) -> bool:
        """Whether it stays within its limits."""
        return self.margin >= 0


def travels(statics: Statics, case: StaticCase) -> Iterator[Travel]:
    """Yield the travel of every mount in the directions in which its group limits it."""
    for group in statics.prepared.vehicle.mount_groups:
        for mount in group.mounts:
            deflection = case.connections[mount.name].deflection
            for direction, (least, most) in group.travel.items():
                yield Travel(mount.name, direction, float(deflection[AXIS[direction]]), least, most)
