"""Forces and paths as a study and the command line tell them."""

from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from mounted_machine import mounted_machine
from shaken_blocks import MASS, RATE, UP, shaken_block, stiffness_of

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.cli import main
from modeviz.errors import ModevizError, VehicleError
from modeviz.files import write_vehicle
from modeviz.study.study import Study
from modeviz.units import STANDARD_GRAVITY
from modeviz.vehicle.engine import Engine, EngineOrder
from modeviz.vehicle.loads import Force

STUDY = Study(mounted_machine())


@pytest.fixture(scope="module")
def machine_folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("vehicles") / "machine"
    write_vehicle(mounted_machine(), path)
    return str(path)


def test_rms_of_a_force_is_the_integral_of_its_psd():
    forces = STUDY.forces("noise")
    psd = forces.psd("rear", "z")
    area = np.trapezoid(psd, forces.frequency_hz)
    assert forces.rms("rear", "z") == pytest.approx(np.sqrt(area), rel=5e-3)


def test_forces_along_vehicle_axes_are_the_local_ones_turned():
    forces = STUDY.forces("firing")
    local = np.array([forces.phasor("front", m) for m in "xyz"])
    turned = np.array([forces.phasor("front", m, in_vehicle_axes=True) for m in "xyz"])
    mount = forces.found.forces.connections[0]
    np.testing.assert_allclose(turned, mount.axes.T @ local, rtol=1e-12, atol=1e-15)


def test_moments_are_those_of_mounts_with_rates_about_axes():
    forces = STUDY.forces("firing")
    record = forces.to_dict()
    front, rear = record["connections"][:2]
    assert set(front["local_axes"]) == {"x", "y", "z", "rx", "rz"}
    assert set(rear["local_axes"]) == {"x", "y", "z"}


def test_a_force_at_one_frequency_is_that_of_the_band_there():
    band = STUDY.forces("firing")
    line = 77
    alone = STUDY.forces("firing", frequency_hz=float(band.frequency_hz[line]))
    np.testing.assert_allclose(alone.phasor("rear", "z")[0], band.phasor("rear", "z")[line], rtol=1e-12)


def test_force_transmissibility_is_that_of_a_mass_on_a_spring_and_a_damper():
    """|z| / |z - ω²m|, z = k (1 + jg) + jωc."""
    push = Force("push", "block", np.zeros(3), UP, 25.0)
    forces = Study(shaken_block(push)).forces("push")
    omega = 2 * np.pi * forces.frequency_hz
    z = stiffness_of(RATE, forces.frequency_hz)
    expected = np.abs(z) / np.abs(z - omega**2 * MASS)
    np.testing.assert_allclose(forces.found.force_transmissibility, expected, rtol=1e-9)


def test_the_transmissibility_across_a_mount_is_the_ratio_of_its_ends_accelerations():
    forces = STUDY.forces("firing", frequency_hz=12.0)
    x = forces.found._motions[0, :, 0]
    system = forces.found.forces.system
    mount = forces.found.forces.connections[1]
    first, second = (system.motion(body, mount.center)[:3] @ x for body in mount.bodies)
    np.testing.assert_allclose(
        forces.transmissibility("rear")[0], np.abs(second) / np.abs(first), rtol=1e-9
    )


def test_mounts_on_ground_that_stands_still_pass_no_motion_on():
    np.testing.assert_allclose(STUDY.forces("firing").transmissibility("foot"), 0.0)
    assert STUDY.forces("floor").transmissibility("foot").min() > 0


def test_no_transmissibility_is_printed_of_ground_that_stands_still():
    push = Force("push", "block", np.zeros(3), UP, 25.0)
    told = str(Study(shaken_block(push)).forces("push"))
    assert "of / over" not in told
    assert "of the force is passed on at" in told
    assert "ground / " in str(STUDY.forces("floor"))


def test_work_is_what_is_dissipated():
    forces = STUDY.forces("road")
    total = np.sum(list(forces.dissipated.values()), axis=0)
    np.testing.assert_allclose(total, forces.work, rtol=1e-9)


def test_paths_are_of_the_response_that_the_ride_has():
    cabin = mounted_cabin()
    paths = Study(cabin).paths("seat", "lateral", "rough")
    results = solve(prepare(cabin), {}, Conditions("rough", cabin.speed))
    at = np.isin(paths.frequency_hz, results.frequency_hz)
    psd = np.interp(paths.frequency_hz[at], results.frequency_hz, results.response(0, "lateral"))
    np.testing.assert_allclose(paths.paths.level[at], psd, rtol=1e-7)
    assert sum(paths.shares("mount").values()) == pytest.approx(1.0, abs=1e-9)
    assert set(paths.shares("body")) == {"chassis"}


def test_phasors_of_paths_add_up_to_the_response():
    record = STUDY.paths("head", "vertical", "firing", frequency_hz=9.0).to_dict()
    phasors = [
        path["phasor"]["amplitude_g"][0] * np.exp(1j * np.radians(path["phasor"]["phase_deg"][0]))
        for path in record["paths"]
    ]
    assert abs(sum(phasors)) == pytest.approx(record["response"][0], rel=1e-9)
    x = STUDY.forces("firing", frequency_hz=9.0).found._motions[0, :, 0]
    point = STUDY.vehicle.response_points[1]
    moved = STUDY.forces("firing").found.forces.system.motion(point.body, point.position)[2] @ x
    expected = (2 * np.pi * 9.0) ** 2 * abs(moved) / STANDARD_GRAVITY
    assert record["response"][0] == pytest.approx(expected, rel=1e-9)


@pytest.mark.parametrize(
    ("ask", "words"),
    [
        (lambda: STUDY.forces("thunder"), "unknown load 'thunder'"),
        (lambda: STUDY.forces("firing").rms("rear", "z"), "is harmonic: ask for phasor"),
        (lambda: STUDY.forces("noise").phasor("rear", "z"), "has a spectrum: ask for rms or psd"),
        (lambda: STUDY.forces("noise").rms("rear", "w"), "unknown motion 'w'"),
        (lambda: STUDY.forces("noise").rms("raer", "z"), "unknown connection 'raer'"),
        (lambda: STUDY.paths("tail"), "unknown response point 'tail'"),
        (lambda: STUDY.paths(direction="up"), "unknown direction 'up'"),
        (lambda: STUDY.paths("head").spectrum("raer"), "unknown path 'raer'"),
    ],
)
def test_what_is_asked_for_wrongly_is_said_in_a_sentence(ask, words):
    with pytest.raises((ModevizError, VehicleError), match=words):
        ask()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["forces", "--load", "thunder"], "unknown load 'thunder'"),
        (["forces", "--at", "0"], "--at: found 0 Hz, expected more than zero"),
        (["forces", "--at", "900", "--load", "road"], "its table holds"),
        (["paths", "--point", "tail"], "unknown response point 'tail'"),
    ],
)
def test_the_command_line_refuses_it_with_status_2(arguments, words, machine_folder, capsys):
    command, *options = arguments
    assert main([command, machine_folder, *options]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert words in captured.err
    assert captured.err.count("\n") == 1


@pytest.mark.parametrize("load", ["road", "firing", "floor", "unbalance"])
def test_tables_name_mounts_and_what_is_dissipated(load, machine_folder, capsys):
    assert main(["forces", machine_folder, "--load", load, "--all"]) == 0
    printed = capsys.readouterr().out
    assert all(name in printed for name in ("front", "local rz", "bolt", "frame / engine", "damper"))
    for by in ("mount", "direction", "body", "group"):
        assert main(["paths", machine_folder, "--load", load, "--by", by]) == 0
        assert "100.0 %" in capsys.readouterr().out


def test_a_vehicle_without_loads_is_told_what_to_give(tmp_path, capsys):
    machine = mounted_machine()
    untyred = tuple(c for c in machine.connections if c.name != "tyre")
    quiet = replace(machine, connections=untyred, forces=(), base_motions=(), roads=(), wheel_loads=())
    write_vehicle(quiet, tmp_path / "quiet")
    assert main(["forces", str(tmp_path / "quiet")]) == 2
    assert "has no load: give its vehicle.toml an [[engine]], a [[force]]" in capsys.readouterr().err


def test_an_order_is_refused_where_the_engine_does_not_run():
    speeds = np.array([10.0, 15.0])
    order = EngineOrder("four order 2", "four", 2.0, 2 * speeds, np.full((2, 6), 5.0 + 0j))
    block = shaken_block(Force("push", "block", np.zeros(3), UP, 25.0))
    engine = Engine("four", "block", np.zeros(3), speeds, 10.0, (order,))
    study = Study(replace(block, engines=(engine,)))
    assert study.forces("four order 2", frequency_hz=20.0).found.forces.force.any()
    with pytest.raises(VehicleError, match="found 19 Hz, expected 20 to 30 Hz, where the engine runs"):
        study.forces("four order 2", frequency_hz=19.0)
