"""Orders of an engine in line against the motion of its pistons, differentiated in time."""

import numpy as np
import pytest

from modeviz.errors import VehicleError
from modeviz.vehicle.engine import InlineEngine

CRANK, CYLINDER = np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0])


def turned_by_hand(
    engine: InlineEngine, speed_hz: float, n: int = 4096
) -> tuple[np.ndarray, np.ndarray]:
    """Force along the cylinders and moment about the crank on the block over two revolutions.

    Pistons have no angular momentum about the crank, so that the block gets what the crank gives them:
    the rate of their kinetic energy by its speed.
    """
    omega, n = 2 * np.pi * speed_hz, 4096
    angle = np.arange(n) * (4 * np.pi / n)
    r = engine.stroke / 2
    rod = r / engine.rod_ratio
    force, moment = np.zeros(n), np.zeros(n)
    for i in range(engine.cylinders):
        own = angle + i * 4 * np.pi / engine.cylinders
        place = r * np.cos(own) + np.sqrt(rod**2 - (r * np.sin(own)) ** 2)
        speed = omega * np.gradient(np.r_[place[-4:], place, place[:4]], angle[1])[4:-4]
        change = omega * np.gradient(np.r_[speed[-4:], speed, speed[:4]], angle[1])[4:-4]
        force -= engine.reciprocating_mass * change
        moment += engine.reciprocating_mass * speed * change / omega
    return force, moment


def order_of(signal: np.ndarray, order: float) -> complex:
    """The phasor of an order in two revolutions."""
    return 2 * np.fft.fft(signal)[round(2 * order)] / len(signal)


@pytest.mark.parametrize("cylinders", [1, 2, 3, 4, 6])
def test_orders_are_those_of_pistons_on_rods(cylinders):
    engine = InlineEngine(cylinders=cylinders, stroke=0.09, rod_ratio=0.05, reciprocating_mass=0.6)
    speed = 13.0
    force, moment = turned_by_hand(engine, speed)
    loads = engine.loads(np.array([speed]), CRANK, CYLINDER)
    for order in (1.0, 2.0, 3.0):
        found = loads.get(order, np.zeros((1, 6), complex))[0]
        scale = engine.reciprocating_mass * 0.045 * (2 * np.pi * speed) ** 2 * cylinders
        assert abs(found[2] - order_of(force, order)) < 2e-3 * scale, order
        assert abs(found[4] - order_of(moment, order)) < 2e-3 * scale * 0.045, order
        assert found[[0, 1, 3, 5]].tolist() == [0, 0, 0, 0]


def test_a_four_shakes_at_its_second_order_alone():
    engine = InlineEngine(cylinders=4, stroke=0.09, rod_ratio=0.3, reciprocating_mass=0.6)
    loads = engine.loads(np.array([10.0, 50.0]), CRANK, CYLINDER)
    assert list(loads) == [2.0]
    omega = 2 * np.pi * np.array([10.0, 50.0])
    assert loads[2.0][:, 2].real == pytest.approx(4 * 0.6 * 0.045 * 0.3 * omega**2)


def test_gas_shakes_at_half_as_many_orders_as_there_are_cylinders_against_the_pistons():
    """At low speed gas alone; the pistons' moment has the other sign (Den Hartog)."""
    engine = InlineEngine(
        cylinders=4, stroke=0.09, rod_ratio=0.3, reciprocating_mass=0.6, firing_torque=150.0
    )
    slow, fast = engine.loads(np.array([0.1, 100.0]), CRANK, CYLINDER)[2.0][:, 4]
    assert abs(slow) == pytest.approx(150, rel=1e-4)
    pistons = 4 * 0.5 * 0.6 * 0.045**2 * (200 * np.pi) ** 2
    assert abs(fast) == pytest.approx(pistons - 150)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [({"cylinders": 0}, "cylinders"), ({"rod_ratio": 1.2}, "less than 1"), ({"stroke": 0.0}, "stroke")],
)
def test_wrong_engines_are_refused(wrong, words):
    right = {"cylinders": 4, "stroke": 0.09, "rod_ratio": 0.3, "reciprocating_mass": 0.6}
    with pytest.raises(VehicleError, match=words):
        InlineEngine(**{**right, **wrong})
