"""A cab on springs with dampers, of which rates of every kind are tuned."""

from dataclasses import replace

from modeviz.files.folder import read_vehicle
from modeviz.files.new_vehicle import new_vehicle
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates

NOTHING = MountRates(0.0, 0.0, 0.0)
DAMPING, LEAST, MOST = 1900.0, 400.0, 8000.0
"""N s/m, of each of the rear dampers, and its bounds."""

ABOUT_Z = 800.0
"""N m/rad, of each of the rear springs, between a quarter of that and four times."""


def cab_on_struts(folder):
    """The cab of a new folder: struts F in front as they come, whose dampers are tuned, rear springs R,
    which are also about z, and dampers D beside these.
    """
    cab = read_vehicle(new_vehicle("cab", folder))
    front, rear = cab.mount_groups
    rates = (rear.rates, *rear.bounds)
    springs = [
        replace(own, damping_vertical=0.0, rz=part * ABOUT_Z)
        for own, part in zip(rates, (1.0, 0.25, 4.0), strict=True)
    ]
    dampers = [replace(NOTHING, damping_vertical=c) for c in (DAMPING, LEAST, MOST)]
    places = tuple(replace(m, name=m.name.replace("rear", "damper")) for m in rear.mounts)
    groups = (
        front,
        replace(rear, rates=springs[0], bounds=(springs[1], springs[2])),
        MountGroup("D", "rear dampers", dampers[0], 0.0, (dampers[1], dampers[2]), places),
    )
    return replace(cab, mount_groups=groups)
