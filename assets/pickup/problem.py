"""What the paper optimises the mounts for: its section "Optimization procedure"."""

from collections.abc import Sequence

from modeviz.vehicle.default_problem import ROAD_HZ, WHEEL_HZ
from modeviz.vehicle.loads import Road, WheelLoad
from modeviz.vehicle.problem import DesignGroup, Performance, Problem

BODY_MOUNTS = ("F", "C1", "C2")
POWERTRAIN_MOUNTS = ("E", "T")
"""Of which the paper keeps the ratios of rates."""


def paper_problem(road: Road, wheel_loads: Sequence[WheelLoad]) -> Problem:
    """Every response point, lateral and vertical, on a road and under wheel loads; all targets are zero
    and all weights one. Bounds and ratio limits are the mount groups'.
    """
    return Problem(
        "paper",
        groups=(
            *(DesignGroup(name) for name in BODY_MOUNTS),
            *(DesignGroup(name, fixed_ratios=True) for name in POWERTRAIN_MOUNTS),
        ),
        performance=(
            Performance(ROAD_HZ, roads=(road.name,)),
            Performance(WHEEL_HZ, wheel_loads=tuple(load.name for load in wheel_loads)),
        ),
        reference="optimised",
    )
