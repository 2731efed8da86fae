"""What may be sought while mounts are moved and turned."""

from collections.abc import Iterator

from modeviz.errors import VehicleError
from modeviz.vehicle.carried_mass import CarriedMass, carried_mass
from modeviz.vehicle.mount_target import MountTarget
from modeviz.vehicle.problem import UNSHAKEN, Problem
from modeviz.vehicle.vehicle import Vehicle


def check_places(vehicle: Vehicle, problem: Problem) -> None:
    """Raises VehicleError where a place does what no probe tells of.

    So it is with dampers of single modes, which are others where mounts are elsewhere, and with what is
    felt on an absorber.
    """
    if vehicle.mode_damping and not is_undamped(problem):
        for group in problem.groups:
            if group.offsets or group.angles:
                raise VehicleError(
                    f"offset and angles of {group.group!r}: modes of the vehicle have a damping of "
                    "their own, which would change with them; expected a goal that no damping enters, "
                    f"{', '.join(UNSHAKEN)}, or a vehicle without [[mode_damping]]"
                )
    for group, carried in moved_masses(vehicle, problem):
        where = f"offset and angles of {group!r}"
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


def is_undamped(problem: Problem) -> bool:
    """Return whether damping has no part in what a problem wants."""
    return problem.goal in UNSHAKEN


def moved_masses(vehicle: Vehicle, problem: Problem) -> Iterator[tuple[str, CarriedMass]]:
    """Yield the groups that may place an absorber otherwise, and its mass."""
    for group in problem.groups:
        if group.offsets or group.angles:
            carried = carried_mass(vehicle, vehicle.mount_group(group.group))
            if carried is not None:
                yield group.group, carried
