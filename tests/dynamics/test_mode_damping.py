"""Damping ratios that are stated mode by mode are those of the modes, and act in these alone."""

from dataclasses import replace

import numpy as np
import pytest
from full_solutions import receptances
from mounted_cabin import mounted_cabin

from modeviz.analysis.exact_check import check_exactly
from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare, prepare_modes
from modeviz.analysis.results import Conditions, solve
from modeviz.cli import main
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.mode_damping import with_mode_damping
from modeviz.dynamics.modes import solve_modes
from modeviz.dynamics.response import direct_response
from modeviz.errors import VehicleError
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.mode_damping import ModeDamping
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle

CABIN = mounted_cabin()
OWN = solve_modal(prepare_modes(CABIN), {})


def damped(*stated: ModeDamping) -> Vehicle:
    return replace(CABIN, mode_damping=stated)


def undamped() -> Vehicle:
    """No damping anywhere."""
    tyres = tuple(replace(t, damping=np.zeros(3)) for t in CABIN.tyres)
    groups = tuple(replace(g, loss_factor=0.0) for g in CABIN.mount_groups)
    return replace(CABIN, connections=tyres, mount_groups=groups)


def test_a_mode_has_the_ratio_stated_and_others_keep_theirs():
    yaw = OWN.mode_index("cab yaw")
    found = solve_modal(prepare_modes(damped(ModeDamping(0.2, "cab yaw"))), {}).modes
    expected = OWN.modes.damping_ratio.copy()
    expected[yaw] = 0.2
    np.testing.assert_allclose(found.damping_ratio, expected, rtol=1e-9)
    np.testing.assert_allclose(found.frequency_hz, OWN.modes.frequency_hz, rtol=1e-12)


def test_a_mode_is_named_by_its_number_too_and_all_others_by_none():
    found = solve_modal(prepare_modes(damped(ModeDamping(0.3, 2), ModeDamping(0.25))), {}).modes
    expected = np.maximum(OWN.modes.damping_ratio, 0.25)
    expected[1] = 0.3
    np.testing.assert_allclose(found.damping_ratio, expected, rtol=1e-9)


def test_the_response_is_that_of_modes_damped_one_by_one():
    """Without other damping, H = Σ φ φᵀ / (ω_r² - ω² + 2jζ_r ω_r ω), also right on a resonance."""
    vehicle = replace(undamped(), mode_damping=(ModeDamping(0.02), ModeDamping(0.05, 3)))
    system = with_mode_damping(assemble(vehicle), 60.0)
    modes = solve_modes(system)
    zeta = np.full(12, 0.02)
    zeta[2] = 0.05
    f = np.sort(np.r_[modes.frequency_hz[2], 1.0, 7.0, 33.0])
    omega, omega_r = 2 * np.pi * f[:, None], 2 * np.pi * modes.frequency_hz
    rows = system.motion("cab", np.array([1.2, -0.4, 0.9]))[:3]
    phi = rows @ modes.shapes
    q = 1 / (omega_r**2 - omega**2 + 2j * zeta * omega_r * omega)
    expected = np.einsum("ir,fr,jr->fij", phi, q, phi)
    np.testing.assert_allclose(receptances(system, f, rows), expected, rtol=1e-7, atol=1e-15)
    forces = np.repeat(rows.T[None].astype(complex), len(f), axis=0)
    np.testing.assert_allclose(
        direct_response(system, f, forces, rows), expected, rtol=1e-7, atol=1e-15
    )


def test_the_live_answer_is_the_exact_one_at_other_rates_too():
    prepared = prepare(damped(ModeDamping(0.2, "cab yaw")), np.array([2.0, 5.0, 9.0, 12.0]))
    rates = {"A": MountRates(2e5, 1e5, 1e5), "B": MountRates(3e6, 9e5, 2e5)}
    results = solve(prepared, rates, Conditions("flat", 20.0))
    *_, check = check_exactly(results)
    assert check.is_complete
    assert check.error < 1e-6


@pytest.mark.parametrize(
    ("stated", "words"),
    [
        (ModeDamping(0.2, "cab yew"), "mode damping: unknown mode 'cab yew': did you mean 'cab yaw'"),
        (ModeDamping(0.2, 13), "found mode 13, expected 1 to 12"),
        (ModeDamping(0.2, 0), "found mode 0, expected 1 to 12"),
        (ModeDamping(1e-4, "cab yaw"), "connections and mounts damp it with 0.0"),
    ],
)
def test_damping_that_no_mode_can_have_is_refused(tmp_path, capsys, stated, words):
    write_vehicle(damped(stated), tmp_path / "v")
    for command in ("modes", "psd"):
        assert main([command, str(tmp_path / "v")]) == 2
        said = capsys.readouterr().err
        assert said.startswith(f"modeviz: {tmp_path / 'v' / 'vehicle.toml'}: mode damping")
        assert words in said


def test_a_mode_that_moves_freely_has_no_damping_to_state():
    free = replace(undamped(), connections=(), mode_damping=(ModeDamping(0.1, 1),), wheel_loads=())
    with pytest.raises(VehicleError, match="mode damping of 'mode 1': it moves freely"):
        prepare_modes(free)


def test_one_mode_has_one_damping():
    with pytest.raises(VehicleError, match="mode damping of 'cab yaw' is there twice"):
        damped(ModeDamping(0.2, "cab yaw"), ModeDamping(0.3, "cab yaw"))
    with pytest.raises(VehicleError, match=r"damping_ratio: found 1\.5, expected a fraction"):
        ModeDamping(1.5)


def test_it_comes_back_from_a_folder(tmp_path):
    stated = (ModeDamping(0.2, "cab yaw"), ModeDamping(0.3, 2), ModeDamping(0.25))
    write_vehicle(damped(*stated), tmp_path / "v")
    assert read_vehicle(tmp_path / "v").mode_damping == stated


def test_mounts_have_what_their_group_has_unless_they_have_their_own(tmp_path):
    front, rear = CABIN.mount_groups
    left, right = front.mounts
    own = np.array([1.0, 2.0, 3.0])
    shared = {
        "rotational_stiffness": np.array([300.0, 200.0, 100.0]),
        "damping": np.array([10.0, 20.0, 30.0]),
        "rotational_damping": np.array([0.3, 0.2, 0.1]),
    }
    group = replace(front, mounts=(replace(left, rotational_stiffness=own), right), **shared)
    write_vehicle(replace(CABIN, mount_groups=(group, rear)), tmp_path / "v")
    for found in (group, read_vehicle(tmp_path / "v").mount_groups[0]):
        assert found.mounts[0].rotational_stiffness.tolist() == own.tolist()
        assert found.mounts[1].rotational_stiffness.tolist() == [300.0, 200.0, 100.0]
        assert {m.damping[2] for m in found.mounts} == {30.0}
        assert {m.rotational_damping[0] for m in found.mounts} == {0.3}
    text = (tmp_path / "v/vehicle.toml").read_text()
    assert text.count("rotational_damping = [0.3, 0.2, 0.1]") == 1
