from dataclasses import replace

import numpy as np
import pytest
from full_solutions import wheel_forces
from mounted_cabin import mounted_cabin, twisted_cabin

from modeviz.analysis.driven import FEW_SPRINGS
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.results import Conditions, drive, solve
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.ride.psd import acceleration_psd
from modeviz.ride.roads import road_spectrum, track_forces
from modeviz.vehicle.mount_rates import MountRates

FLAT = Conditions("flat", 20.0)
SOFT = {"A": MountRates(2e5, 1e5, 1e5)}


@pytest.fixture(scope="module")
def results():
    return solve(prepare(mounted_cabin()), SOFT, FLAT)


def test_the_ride_is_the_direct_solution_of_the_tuned_vehicle(results):
    tuned = assemble(mounted_cabin().with_rates(SOFT))
    f = results.frequency_hz[::37]
    assert set(f) - set(tuned.vehicle.frequency_hz)
    seat = tuned.motion("cab", np.array([1.2, -0.4, 0.9]))[:3]
    H = direct_response(tuned, f, track_forces(tuned, f, 20.0), seat)
    S = road_spectrum(tuned.vehicle.random_load("flat"), f, 20.0)
    np.testing.assert_allclose(results.psd[::37, 0], acceleration_psd(f, H, S), rtol=1e-8)


LOSS = {
    "A": MountRates(2e5, 1e5, 1e5, loss_factor=0.0),
    "B": MountRates(8e5, 3e5, 4e5, loss_factor=0.3),
}


@pytest.mark.parametrize("vehicle", [mounted_cabin(), twisted_cabin()], ids=["cabin", "twisted"])
def test_loss_factors_are_those_of_the_direct_solution(vehicle):
    """Of rides, of wheel loads and, near other rates, of both."""
    f = vehicle.frequency_hz[::37]
    tuned = assemble(vehicle.with_rates(LOSS))
    seat = tuned.motion("cab", np.array([1.2, -0.4, 0.9]))[:3]
    S = road_spectrum(tuned.vehicle.random_load("flat"), f, 20.0)
    psd = acceleration_psd(f, direct_response(tuned, f, track_forces(tuned, f, 20.0), seat), S)
    forces = wheel_forces(tuned, tuned.vehicle.wheel_loads, f)
    g = (
        np.abs(direct_response(tuned, f, forces, seat)[:, :, 0])
        * (2 * np.pi * f[:, None]) ** 2
        / 9.80665
    )
    prepared = prepare(vehicle, f)
    for way in (prepared, prepared.near(LOSS), prepared.near(SOFT)):
        np.testing.assert_allclose(solve(way, LOSS, FLAT).psd[:, 0], psd, rtol=1e-9)
        np.testing.assert_allclose(solve_wheels(way, LOSS).acceleration_g[:, 0, 0], g, rtol=1e-9)
    assert np.abs(solve(prepared, SOFT, FLAT).psd[:, 0] / psd - 1).max() > 0.1


@pytest.mark.parametrize("vehicle", [mounted_cabin(), twisted_cabin()], ids=["cabin", "twisted"])
@pytest.mark.parametrize("method", ["enriched", "exact"])
def test_modal_damping_is_that_of_the_loss_factors(vehicle, method):
    modal = solve_modal(prepare_modes(vehicle), LOSS, method)
    tuned = solve_modes(assemble(vehicle.with_rates(LOSS)))
    n = len(modal.modes.frequency_hz)
    np.testing.assert_allclose(modal.modes.damping_ratio, tuned.damping_ratio[:n], rtol=1e-9)
    assert modal.vehicle.mount_group("B").loss_factor == 0.3
    assert modal.vehicle.rates["B"] == mounted_cabin().rates["B"]


def test_directions_are_told_apart(results):
    np.testing.assert_array_equal(results.response(0, "vertical"), results.psd[:, 0, 2])
    np.testing.assert_array_equal(results.response(0, "lateral"), results.psd[:, 0, 1])
    np.testing.assert_array_equal(results.response(0, "fore-aft"), results.psd[:, 0, 0])


def test_the_rating_is_of_the_first_point(results):
    _, lateral, vertical = results.rms[0]
    assert results.rating.mean_personal_rating == pytest.approx(10.9 - 80 * np.hypot(lateral, vertical))


def test_the_largest_contributor_of_a_peak_is_a_mode_near_it(results):
    highest = max(results.peaks(0, "vertical"), key=lambda p: p.level)
    f = results.modes.frequency_hz[highest.contributors[0].mode]
    assert f == pytest.approx(highest.frequency_hz, rel=0.2)
    assert highest.contributors[0].ratio == 1.0


def test_a_mode_is_found_by_its_name(results):
    i = results.mode_index("cab yaw")
    assert results.names[i].name == "cab yaw"
    assert results.mode_index("no such mode") is None


def test_wheel_loads_are_the_direct_solution():
    f = np.array([8.0, 11.0, 13.25])
    system = assemble(mounted_cabin())
    found = solve_wheels(prepare(mounted_cabin(), f), {})
    seat = system.motion("cab", np.array([1.2, -0.4, 0.9]))[:3]
    H = direct_response(system, f, wheel_forces(system, system.vehicle.wheel_loads, f), seat)[:, :, 0]
    expected = np.abs(H) * (2 * np.pi * f[:, None]) ** 2 / 9.80665
    np.testing.assert_allclose(found.acceleration_g[:, 0, 0], expected, rtol=1e-8)
    np.testing.assert_allclose(found.mean((11.0, 13.25))[0, 0], expected[1:].mean(axis=0), rtol=1e-8)


def test_a_road_that_is_not_there_is_an_error():
    with pytest.raises(VehicleError, match=r"unknown random load 'moon'.*flat, rough"):
        solve(prepare(mounted_cabin()), {}, Conditions("moon", 20.0))


def test_modes_need_no_road():
    modal = solve_modal(prepare_modes(mounted_cabin()), SOFT)
    assert len(modal.names) == len(modal.modes.frequency_hz) == 12
    assert sum(modal.kinetic_energy.values()) == pytest.approx(np.ones(12))


def test_more_springs_than_coordinates_are_solved_directly_and_alike(monkeypatch):
    cabin = mounted_cabin()
    group = cabin.mount_groups[0]
    others = [
        replace(
            group, name=name, mounts=tuple(replace(m, name=f"{name} {m.name}") for m in group.mounts)
        )
        for name in "CDEFGHIJK"
    ]
    more = replace(cabin, mount_groups=(*cabin.mount_groups, *others))
    prepared = prepare(more, cabin.frequency_hz[::20])
    assert prepared.system.n_dofs < FEW_SPRINGS < len(prepared.system.mount_motions)
    softer = {name: MountRates(2e5, 1e5, 1e5) for name in "ACDEFGHIJK"}
    asked = []

    def watched(*arguments):
        asked.append(arguments)
        return direct_response(*arguments)

    monkeypatch.setattr("modeviz.analysis.driven.direct_response", watched)
    psd = solve(prepared, softer, FLAT).psd
    assert len(asked) == 1
    H = drive(prepared, FLAT).receptances.response(prepared.mount_stiffness(softer))
    S = drive(prepared, FLAT).spectrum_at(prepared.frequency_hz)
    modified = acceleration_psd(prepared.frequency_hz, H, S)
    np.testing.assert_allclose(psd.reshape(modified.shape), modified, rtol=1e-9)
