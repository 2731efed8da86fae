"""What hangs together is found whatever the order of the connections is."""

from dataclasses import replace

import numpy as np
from small_vehicles import tyre, wheel

from modeviz.vehicle.connections import Spring
from modeviz.vehicle.islands import Island, islands
from modeviz.vehicle.vehicle import Vehicle

A, B, C, D, E = (wheel(name, x) for x, name in enumerate("abcde"))


def spring(first: str, second: str) -> Spring:
    return Spring(f"{first}{second}", "springs", (first, second), np.zeros((2, 3)), np.ones(3))


def test_bodies_that_connections_join_hang_together_and_the_ground_joins_none():
    vehicle = Vehicle("x", (A, B, C, D, E), (spring("d", "b"), tyre(E), spring("a", "b"), tyre(A)))
    assert islands(vehicle) == (
        Island(("a", "b", "d"), True),
        Island(("c",), False),
        Island(("e",), True),
    )


def test_a_ring_of_connections_is_one_island_in_any_order():
    ring = [spring("a", "b"), spring("c", "d"), spring("b", "c"), spring("d", "a")]
    vehicle = Vehicle("x", (A, B, C, D), tuple(ring))
    for turn in range(4):
        turned = replace(vehicle, connections=tuple(ring[turn:] + ring[:turn]))
        assert islands(turned) == (Island(("a", "b", "c", "d"), False),)
