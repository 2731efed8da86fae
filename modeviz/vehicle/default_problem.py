"""The mount optimisation of a vehicle whose file has none."""

import numpy as np

from modeviz.errors import VehicleError
from modeviz.vehicle.arrays import Floats
from modeviz.vehicle.iso_8608 import USUAL_ROAD
from modeviz.vehicle.loads import Road, spectrum_of
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import RATE_NAMES
from modeviz.vehicle.problem import DesignGroup, Performance, Problem
from modeviz.vehicle.vehicle import Vehicle

NAME, DECOUPLED = "ride", "decoupled"

ROAD_HZ = np.linspace(6, 14, 25)
WHEEL_HZ = np.array([11.0, 13.25, 15.75])
"""The paper's frequencies."""


def problems(vehicle: Vehicle) -> tuple[Problem, ...]:
    """The problems of a vehicle, the usual one first, or else one that is made of what it has.

    Raises:
        VehicleError: it has none, and lacks what one is made of.
    """
    return vehicle.problems or (default_problem(vehicle),)


def problem_called(vehicle: Vehicle, name: str) -> Problem:
    """The one of `problems` that has a name, which one of them has."""
    return next(problem for problem in problems(vehicle) if problem.name == name)


def default_problem(vehicle: Vehicle) -> Problem:
    """Every rate that can change, for the first road and all wheel loads at every response point.

    Where the vehicle has neither, but tyres, for the usual road of ISO 8608; without these, for the RMS
    under its first random force or motion of the ground, over all of its spectrum.

    At the paper's frequencies, as far as the road's table holds them at the vehicle's speed. A vehicle
    that nothing shakes but an engine, or where nobody feels anything, is to be decoupled.

    Raises:
        VehicleError: the vehicle lacks what such a problem is made of.
    """
    groups = tuple(filter(None, map(_design_group, vehicle.mount_groups)))
    performance = _performance(vehicle)
    shaking = () if performance else _shaking(vehicle)
    if groups and vehicle.response_points and shaking:
        return Problem(NAME, groups, shaking, "rms", reference=_reference(vehicle))
    if groups and not performance and (vehicle.engines or not vehicle.response_points):
        return Problem(DECOUPLED, groups, goal="decoupling", reference=_reference(vehicle))
    lacking = {
        "a [[mount_group]] with rates above zero": groups,
        "a [[response_point]]": vehicle.response_points,
        "what shakes it: a [[tyre]] with stiffness along z, which roads move, a [[wheel_load]], a "
        "[[force]] or a [[base_motion]]": (*performance, *shaking),
    }
    missing = [what for what, found in lacking.items() if not found]
    if missing:
        raise VehicleError(
            f"nothing to optimise for: vehicle {vehicle.name!r} lacks {' and '.join(missing)}; give "
            "its vehicle.toml what is missing"
        )
    return Problem(NAME, groups, performance, reference=_reference(vehicle))


def _design_group(group: MountGroup) -> DesignGroup | None:
    """The rates of a group by which a search can go, in factors; None if there is none."""
    own, softest = (rates.of(group.fields) for rates in (group.rates, group.bounds[0]))
    free = [RATE_NAMES[field] for field in group.fields if own[field] > 0 and softest[field] > 0]
    return DesignGroup(group.name, tuple(free)) if free else None


def _reference(vehicle: Vehicle) -> str:
    """The first set of rates that is not the vehicle's own, if there is one."""
    sets = vehicle.rate_sets.items()
    return next((name for name, rates in sets if vehicle.all_rates(rates) != vehicle.rates), "")


def _performance(vehicle: Vehicle) -> tuple[Performance, ...]:
    loads = tuple(load.name for load in vehicle.harmonic_loads)
    shaken = [Performance(WHEEL_HZ, wheel_loads=loads)] if loads else []
    road = next((r for r in vehicle.roads if vehicle.is_shaken_by(r) and not r.is_even), None)
    if road is None and not shaken and vehicle.has_driven_tyres:
        road = vehicle.random_load(USUAL_ROAD)
    if isinstance(road, Road) and len(f := _held(road, vehicle.speed)):
        shaken.insert(0, Performance(f, roads=(road.name,)))
    return tuple(shaken)


def _shaking(vehicle: Vehicle) -> tuple[Performance, ...]:
    """The RMS under the first load that has a spectrum of its own, if there is one."""
    spectra = ((load.name, spectrum_of(load)) for load in vehicle.random_loads)
    found = next(((name, s) for name, s in spectra if s is not None and s.power.any()), None)
    return (Performance(found[1].frequency_hz[[0, -1]], roads=(found[0],)),) if found else ()


def _held(road: Road, speed: float) -> Floats:
    """The paper's frequencies that a road's table holds at a speed."""
    low, high = road.frequency_hz[[0, -1]] * speed / road.speed
    return ROAD_HZ[(low <= ROAD_HZ) & (high >= ROAD_HZ)]
