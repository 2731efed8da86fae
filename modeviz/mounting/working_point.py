"""Where progressive mounts work: as stiff as their curves where the vehicle stands under its weight."""

from dataclasses import dataclass, replace

import numpy as np

from modeviz.dynamics.assembly import assemble
from modeviz.errors import SolveError
from modeviz.mounting.static_system import PreparedStatics, prepare_statics
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.load_cases import STANDING
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import Rates
from modeviz.vehicle.vehicle import Vehicle


@dataclass(frozen=True, eq=False)
class WorkingPoint:
    """The mounts of a vehicle that stands under its weight, at any rates."""

    standing: PreparedStatics | None
    """None of a vehicle whose mounts are all straight, or which nothing holds: these work unloaded."""

    def tangents(self, rates: Rates) -> Floats | float:
        """Return how many times as stiff each mount spring is there as unloaded, (n_springs,).

        Args:
            rates: of the groups that differ from the vehicle's own.

        Raises:
            VehicleError: a group that the vehicle does not have.
            SolveError: the mounts do not settle.
        """
        if self.standing is None:
            return 1.0
        settling = self.standing.settling(rates)
        unmoved = self.standing.stretched[:, 0]
        q = settling.settled(unmoved, STANDING.name, self.standing.spring_names)
        return settling.laws.tangent(unmoved + settling.between @ q)

    def vehicle(self, vehicle: Vehicle, rates: Rates) -> Vehicle:
        """Return the vehicle with other rates and mounts as stiff as there; raises as `tangents`."""
        return at_work(vehicle, rates, self.tangents(rates))


def working_point(vehicle: Vehicle) -> WorkingPoint:
    """Return where the mounts of a vehicle work."""
    if not any(group.curves for group in vehicle.mount_groups):
        return WorkingPoint(None)
    try:
        return WorkingPoint(prepare_statics(assemble(vehicle), (STANDING,)))
    except SolveError:
        return WorkingPoint(None)


def at_work(vehicle: Vehicle, rates: Rates, tangents: Floats | float) -> Vehicle:
    """Return a vehicle with other rates and so many times as stiff mounts.

    Args:
        vehicle: any.
        rates: of the groups that differ from the vehicle's own.
        tangents: (n_springs,) or more, or one for all.

    Raises:
        VehicleError: a group that the vehicle does not have.
    """
    tuned = vehicle.with_rates(rates)
    if not isinstance(tangents, np.ndarray):
        return tuned
    along = tangents[: 3 * len(vehicle.mounts)].reshape(-1, 3)
    of_mounts = dict(zip((mount.name for mount in vehicle.mounts), along, strict=True))
    return replace(tuned, mount_groups=tuple(_at_work(g, of_mounts) for g in tuned.mount_groups))


def _at_work(group: MountGroup, tangents: dict[str, Floats]) -> MountGroup:
    return replace(group, mounts=tuple(replace(m, tangent=tangents[m.name]) for m in group.mounts))
