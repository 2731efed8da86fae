"""The vehicles of a study whose mounts are not as drawn, computed."""

from functools import partial
from pathlib import Path

from modeviz.scatter.driving import ScatterOptions, drive_many
from modeviz.study.conditions import need, road_conditions
from modeviz.study.scatter import ScatterResult
from modeviz.study.searching import chosen_problem
from modeviz.study.telling import Tell, cancelled_by_ctrl_c
from modeviz.study.tuned_vehicle import TunedVehicle
from modeviz.vehicle.problem import Problem


def scattered(
    tuned: TunedVehicle,
    problem: "str | Path | Problem | None",
    road: str | None,
    options: ScatterOptions,
    tell: Tell,
) -> ScatterResult:
    """Return what vehicles do with mounts like those of one; errors as of `Study.scatter`.

    Args:
        tuned: with the rates that the mounts have as drawn.
        problem: as of `chosen_problem`.
        road: as of `road_conditions`.
        options: how many vehicles, and how far from that.
        tell: told how far it is.
    """
    vehicle = tuned.vehicle
    need(vehicle, "mount group", vehicle.mount_groups)
    conditions = road_conditions(vehicle, road, tuned.speed)
    chosen, follow = chosen_problem(vehicle, problem), partial(tell, "scattering")
    with cancelled_by_ctrl_c() as token:
        return ScatterResult(
            drive_many(
                vehicle,
                tuned.prepared,
                tuned.rates.by_group,
                conditions,
                chosen,
                options,
                token,
                follow,
            )
        )
