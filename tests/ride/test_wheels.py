import numpy as np
import pytest
from full_solutions import wheel_forces
from small_vehicles import WHEEL_HEIGHT, on_tyres, wheel

from modeviz.dynamics.response import direct_response
from modeviz.vehicle.loads import WheelLoad

F = np.array([5.0, 10.0, 20.0])
X, Y, Z = 0, 1, 2


def forces(kind: str, amplitude: float = 3.0, **tyre) -> np.ndarray:
    """Force and moment about the wheel's centre of gravity, (n_freqs, 6)."""
    system = on_tyres(wheel("wheel", y=-0.8), **tyre)
    loads = [WheelLoad("test", kind, "wheel tyre", amplitude)]
    return wheel_forces(system, loads, F)[:, :, 0]


def test_unbalance_is_a_force_of_constant_size_turning_with_the_wheel():
    amplitude = 3.0
    force = forces("unbalance", amplitude)
    omega = 2 * np.pi * F
    for turn in np.linspace(0, 1, 9):
        now = (force * np.exp(2j * np.pi * turn)).real
        assert np.linalg.norm(now, axis=1) == pytest.approx(amplitude * omega**2, rel=1e-12)


def test_unbalance_turns_forward_a_quarter_period_after_the_top():
    at_top, later = ((forces("unbalance") * np.exp(1j * angle)).real for angle in (0.0, np.pi / 2))
    size = 3.0 * (2 * np.pi * F) ** 2
    assert at_top[:, Z] == pytest.approx(size, rel=1e-12)
    assert later[:, X] == pytest.approx(-size, rel=1e-12)
    assert at_top[:, X] == pytest.approx(0.0, abs=1e-12)


def test_radial_force_is_vertical_at_the_wheel_center():
    center = np.array([0.1, -0.9, 0.4])
    force = forces("radial force", 31.5, wheel_center=center)
    arm = center - [0.0, -0.8, WHEEL_HEIGHT]
    expected = np.concatenate([[0, 0, 31.5], np.cross(arm, [0, 0, 31.5])])
    np.testing.assert_allclose(force, np.tile(expected, (3, 1)), atol=1e-12)


def test_lateral_force_acts_on_the_ground_behind_the_wheel():
    trail = 0.036
    force = forces("lateral force", 44.0, trail=trail)
    arm = [trail, 0.0, -WHEEL_HEIGHT]
    expected = np.concatenate([[0, 44.0, 0], np.cross(arm, [0, 44.0, 0])])
    np.testing.assert_allclose(force, np.tile(expected, (3, 1)), atol=1e-12)


def test_each_load_has_its_own_column_on_its_own_wheel():
    system = on_tyres(wheel("a"), wheel("b"))
    loads = [WheelLoad(f"load {n}", "radial force", f"{n} tyre", 1.0) for n in ("b", "a")]
    force = wheel_forces(system, loads, F)
    assert force.shape == (3, 12, 2)
    assert force[:, system.dofs["b"], 0].any()
    assert not force[:, system.dofs["a"], 0].any()
    assert force[:, system.dofs["a"], 1].any()
    assert wheel_forces(system, [], F).shape == (3, 12, 0)


def test_response_to_radial_force_falls_to_half_power_where_theory_says():
    """r² = 1 - 2ζ² ± 2ζ√(1 - ζ²): exact for the displacement of a viscously damped oscillator."""
    m, k, zeta = 40.0, 2e5, 0.1
    omega_n = np.sqrt(k / m)
    system = on_tyres(wheel("wheel", mass=m), damping=np.array([0, 0, 2 * zeta * m * omega_n]))
    peak = 1 - 2 * zeta**2
    spread = 2 * zeta * np.sqrt(1 - zeta**2)
    f = omega_n / (2 * np.pi) * np.sqrt([peak - spread, peak, peak + spread])
    load = WheelLoad("radial", "radial force", "wheel tyre", 10.0)
    heave = system.motion("wheel", np.zeros(3))[[Z]]
    x = np.abs(direct_response(system, f, wheel_forces(system, [load], f), heave)[:, 0, 0])
    assert x[1] == pytest.approx(10.0 / k / (2 * zeta * np.sqrt(1 - zeta**2)), rel=1e-12)
    assert x[[0, 2]] ** 2 == pytest.approx(x[1] ** 2 / 2, rel=1e-12)
