"""Doubts about mounts where the vehicle stands under its weight."""

from collections.abc import Iterator

from modeviz.dynamics.assembly import assemble
from modeviz.errors import ModevizError
from modeviz.mounting.static_system import prepare_statics
from modeviz.mounting.statics import solve_statics
from modeviz.mounting.travel import travels
from modeviz.vehicle.load_cases import STANDING
from modeviz.vehicle.vehicle import Vehicle


def static_doubts(vehicle: Vehicle) -> Iterator[str]:
    """Yield sentences on mounts that stand beyond their travel or beyond the points of their curves."""
    if not any(group.travel or group.curves for group in vehicle.mount_groups):
        return
    try:
        statics = solve_statics(prepare_statics(assemble(vehicle), (STANDING,)), {})
    except ModevizError as error:
        yield f"mounts: where they stand under the vehicle's weight cannot be told: {error}"
        return
    (case,) = statics.cases
    for travel in travels(statics, case):
        if not travel.passed:
            yield (
                f"mount {travel.mount!r}: stands {1e3 * travel.deflection:.3g} mm off "
                f"({travel.direction}) under the vehicle's weight, beyond its travel of "
                f"{1e3 * travel.least:.3g} to {1e3 * travel.most:.3g} mm"
            )
    yield from case.notes
