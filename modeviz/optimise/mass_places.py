"""What may be sought while the mass of an absorber is moved."""

from collections.abc import Iterator

from modeviz.errors import VehicleError
from modeviz.vehicle.carried_mass import CarriedMass, carried_mass
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import Problem
from modeviz.vehicle.vehicle import Vehicle


def check_masses(vehicle: Vehicle, problem: Problem) -> None:
    """Raises VehicleError where the place of an absorber does what no probe tells of."""
    for group, carried in _moved(vehicle, problem):
        where = f"offset and angles of {group!r}"
        if problem.deflections:
            raise VehicleError(
                f"{where}: its weight would go along, and deflections of mounts with it; expected no "
                "[[problem.deflection]] where an absorber is moved"
            )
        targets = problem.mounts or (MountTarget(),)
        if problem.goal == "transmissibility" and any(
            not target.mounts or group in target.mounts for target in targets
        ):
            raise VehicleError(
                f"{where}: what is felt at the ends of {group!r} would be felt elsewhere; name other "
                "mounts in a [[problem.mount]]"
            )
        if any(asked.body == carried.body.name for asked in problem.decoupling):
            raise VehicleError(
                f"{where}: modes of {carried.body.name!r}, which is moved, are to be decoupled; name "
                "another body in a [[problem.decoupling]]"
            )


def _moved(vehicle: Vehicle, problem: Problem) -> Iterator[tuple[str, CarriedMass]]:
    """The groups that may place an absorber otherwise, and its mass."""
    for group in problem.groups:
        if group.offsets or group.angles:
            carried = carried_mass(vehicle, vehicle.mount_group(group.group))
            if carried is not None:
                yield group.group, carried
