"""What tests allow for rounding is what the equations lose at most, and little more than they lose."""

import numpy as np
from builtin_truck import builtin_truck
from mounted_cabin import mounted_cabin
from rounding import CABIN, TRUCK, of_powers

from modeviz.dynamics.assembly import assemble

BAND_HZ = np.linspace(0.5, 40, 80)


def test_coordinates_in_any_order_have_the_same_response_but_for_what_is_allowed():
    system, random, worst = assemble(mounted_cabin()), np.random.default_rng(2), 0.0
    for f in BAND_HZ:
        w = 2 * np.pi * f
        Z = system.stiffness + 1j * system.structural_damping + 1j * w * system.damping
        Z = Z - w**2 * system.mass
        order = random.permutation(len(Z))
        found = np.empty((len(Z), 3), complex)
        found[order] = np.linalg.solve(Z[np.ix_(order, order)], np.eye(len(Z))[order][:, :3])
        expected = np.linalg.solve(Z, np.eye(len(Z))[:, :3])
        worst = max(worst, np.abs(found - expected).max() / np.abs(expected).max())
    assert 0 < worst < CABIN / 2
    assert CABIN < 1e-10


def test_the_trucks_equations_lose_no_more_than_is_allowed():
    assert of_powers(assemble(builtin_truck()), np.array([6.0, 10.0, 14.0])) < TRUCK
