"""What the truck carries, what shakes its wheels, and where its people feel it."""

from modeviz.vehicle.bodies import AddedMass
from modeviz.vehicle.loads import ResponsePoint, WheelLoad
from pickup import cab
from pickup.parameters import Parameters
from pickup.sides import SIDES, on_side

OCCUPANT = (1.50, 0.40, 0.90)
TANK = (2.25, 0.62, 0.46)
BATTERY = (-0.30, 0.66, 0.90)
STEERING_BOX = (-0.16, 0.42, 0.50)

FOOTPRINTS = {
    "driver": [on_side((x, y, 0.60), "left") for x, y in cab.SEAT_FOOTPRINT],
    "passenger": [on_side((x, y, 0.60), "right") for x, y in cab.SEAT_FOOTPRINT],
    "fuel tank": [(1.90, 0.47, 0.45), (2.30, 0.47, 0.50), (2.62, 0.47, 0.60)],
    "battery": [(-0.42, 0.64, 0.83), (-0.42, 0.95, 0.83), (-0.14, 0.64, 0.83), (-0.14, 0.95, 0.83)],
    "steering box": [(-0.16, -0.30, 0.42), (-0.25, -0.37, 0.50), (0.0, -0.38, 0.50)],
}
"""Where each added mass is held; it follows the least-squares rigid motion of these points."""

RADIAL_FORCE = {"front": 24.3, "rear": 39.1}
LATERAL_FORCE = {"front": 43.9, "rear": 73.1}
"""Peak force variation of a tyre, N, flat in frequency: fitted to the levels of Tables 5 and 6."""
UNBALANCE = 0.015 * 0.19
"""kg m: 15 g at the rim, what a wheel balanced in service is left with."""


def added_masses(p: Parameters) -> tuple[AddedMass, ...]:
    """What hangs on the bodies to one side or the other."""
    return (
        AddedMass("driver", "cab", on_side(OCCUPANT, "left"), p.driver_mass),
        AddedMass("passenger", "cab", on_side(OCCUPANT, "right"), p.passenger_mass),
        AddedMass("fuel tank", "frame", on_side(TANK, "right"), p.tank_mass),
        AddedMass("battery", "front end", on_side(BATTERY, "right"), 10.0),
        AddedMass("steering box", "frame", on_side(STEERING_BOX, "left"), 12.0),
    )


def response_points(p: Parameters) -> tuple[ResponsePoint, ...]:
    """The driver's seat track first: it is the one that is rated."""
    seat, toe = (p.seat_x, p.seat_y, cab.HEIGHTS[0]), (p.toe_x, p.toe_y, p.toe_z)
    return tuple(
        ResponsePoint(f"{name} {side}", "cab", on_side(place, side))
        for name, place in (("seat track", seat), ("toe panel", toe))
        for side in SIDES
    )


def wheel_loads() -> tuple[WheelLoad, ...]:
    """Twelve cases: every wheel with each kind of load."""
    loads = []
    for axle in ("front", "rear"):
        for side in SIDES:
            tyre = f"{axle} {side}"
            loads += [
                WheelLoad(f"{tyre} unbalance", "unbalance", tyre, UNBALANCE),
                WheelLoad(f"{tyre} radial force", "radial force", tyre, RADIAL_FORCE[axle]),
                WheelLoad(f"{tyre} lateral force", "lateral force", tyre, LATERAL_FORCE[axle]),
            ]
    return tuple(loads)
