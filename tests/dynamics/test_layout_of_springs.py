"""The layout of a vehicle's mount springs is found once, and only while the vehicle is there."""

import gc
import weakref

from tuned_vehicle import tuned_vehicle

from modeviz.dynamics.mount_rates import are_dampers, rows_of_springs


def test_it_is_found_once():
    vehicle = tuned_vehicle()
    assert rows_of_springs(vehicle) is rows_of_springs(vehicle)


def test_it_keeps_no_vehicle():
    vehicle = tuned_vehicle()
    assert are_dampers(vehicle).any()
    ended = weakref.ref(vehicle)
    del vehicle
    gc.collect()
    assert ended() is None
