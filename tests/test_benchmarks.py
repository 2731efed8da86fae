"""That the benchmarks measure what they say; never how fast anything is."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from benchmarks import compare, from_matrices, imported, measure
from benchmarks.large_component import NODE_MASS, Box, write_op2
from benchmarks.scaled_vehicle import MASS, Size, scaled_vehicle
from benchmarks.work import largest_difference
from modeviz.dynamics.assembly import assemble
from modeviz.files import read_vehicle

CHECKOUT = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def road_train():
    return scaled_vehicle(Size(n_wagons=3, n_modes=40, n_mounts=2))


def test_scaled_vehicle_has_the_size_that_was_asked_for(road_train):
    system = assemble(road_train)
    assert system.n_dofs == 3 * 40
    assert system.mount_motions.shape == (3 * 2 * 2, 3 * 40)


@pytest.mark.bitwise
def test_scaled_vehicle_is_the_same_every_time(road_train):
    again = assemble(scaled_vehicle(Size(n_wagons=3, n_modes=40, n_mounts=2)))
    np.testing.assert_array_equal(again.stiffness, assemble(road_train).stiffness)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_wagon_moves_rigidly_with_its_mass(road_train, axis):
    for wagon in road_train.bodies:
        motions = np.vstack([a.shapes for a in wagon.attachments])
        unit = np.zeros((len(wagon.attachments), 6))
        unit[:, axis] = 1.0
        q, *_ = np.linalg.lstsq(motions[:, : wagon.N_RIGID], unit.ravel())
        np.testing.assert_allclose(motions[:, : wagon.N_RIGID] @ q, unit.ravel(), atol=1e-12)
        assert q @ q == pytest.approx(MASS, rel=1e-12)


def test_elastic_modes_of_a_wagon_carry_no_momentum(road_train):
    for wagon in road_train.bodies:
        momentum = wagon.shapes[:, :3, wagon.N_RIGID :].mean(axis=0) * np.sqrt(MASS)
        # Its lumps weigh the same; shapes are kept in single precision.
        assert np.abs(momentum).max() < 1e-5


def test_wagons_hang_together_and_stand_on_the_ground(road_train):
    system = assemble(road_train)
    assert np.linalg.eigvalsh(system.stiffness)[0] > 0


def test_methods_take_turns_in_alternating_order(monkeypatch):
    monkeypatch.setattr(measure, "TURN_S", 1e-9)
    turns = []
    calls = {name: lambda name=name: turns.append(name) for name in "abc"}
    assert list(measure.medians(calls, n_rounds=2)) == list(calls)
    assert "".join(turns) == "abccba"


def test_call_in_its_own_process_has_a_memory_of_its_own():
    assert measure.in_own_process(os.getpid) != os.getpid()
    held = np.ones(40_000_000)
    assert measure.in_own_process(measure.peak_bytes) < measure.peak_bytes() - held.nbytes / 2


def test_difference_is_relative_to_the_largest_response_of_the_output():
    reference = np.array([[[1.0 + 0j], [100.0]], [[2.0], [-400.0]]])
    H = reference + np.array([[[0.1], [0.0]], [[0.0], [4j]]])
    assert largest_difference(H, reference) == pytest.approx(0.05)


def test_missing_library_is_named_and_the_others_go_on(monkeypatch):
    def missing(work):
        raise ImportError("No module named 'peer'")

    monkeypatch.setattr(compare, "METHODS", {"peer": missing, "ours": lambda work: work})
    assert compare._installed("call") == ({"ours": "call"}, {"peer": "No module named 'peer'"})


@pytest.fixture(scope="module")
def quick(tmp_path_factory):
    """What a quick run prints and writes."""
    file = tmp_path_factory.mktemp("benchmarks") / "figures.json"
    command = [sys.executable, "-m", "benchmarks", "--quick", "--json", str(file)]
    run = subprocess.run(command, cwd=CHECKOUT, capture_output=True, text=True, check=True)
    return run.stdout, json.loads(file.read_text())


@pytest.mark.slow
def test_figures_are_written_in_the_documented_structure(quick):
    _, report = quick
    assert set(report) == {"machine", "comparison", "modeviz", "scatter", "optimise", "scaling"}
    assert set(report["scatter"]) == {"samples", "seconds", "peak_mb", "psd_error"}
    assert all(value > 0 for value in report["scatter"].values())
    searched = {"variables", "one_start_s", "starts", "starts_s", "evaluations", "found"}
    assert set(report["optimise"]) == searched
    assert report["optimise"]["variables"] == 15
    assert 0 < report["optimise"]["found"] < 1
    for row in report["comparison"]:
        assert set(row) == {
            "method",
            "median_ms",
            "times_slower_than_modeviz",
            "max_relative_difference",
        }
    documented = {"event_ms", "batch_per_s", "prepare_s", "peak_mb", "gemm_floor_ratio"}
    assert set(report["modeviz"]) == documented | {"websocket_ms", "server_ms"}
    assert all(value > 0 for value in report["modeviz"].values())
    assert [row["n_dofs"] for row in report["scaling"]] == [430, 60]
    assert all(value > 0 for row in report["scaling"] for value in row.values())
    assert all(library["num_threads"] == 1 for library in report["machine"]["blas"])


@pytest.mark.slow
def test_readme_documents_every_figure(quick):
    _, report = quick
    readme = (CHECKOUT / "README.md").read_text()
    (documented,) = re.findall(r'^\{"machine".*?^```', readme, re.DOTALL | re.MULTILINE)
    rows = [*report["comparison"], *report["scaling"]]
    parts = [report, report["machine"], report["modeviz"], report["scatter"], *rows]
    parts.append(report["optimise"])
    assert set(re.findall(r'"(\w+)"', documented)) == set().union(*parts)


@pytest.mark.slow
def test_every_method_gives_the_same_answer(quick):
    table, report = quick
    differences = {r["method"]: r["max_relative_difference"] for r in report["comparison"]}
    assert {"modeviz", "numpy direct", "FBS as in pyFBS"} <= set(differences)
    for method, difference in differences.items():
        assert method in table
        # Superposed modes leave out what the others add statically.
        assert difference < (1e-2 if "modes" in method else 1e-9)
    for method, reason in report["machine"]["not_installed"].items():
        assert f"{method}: {reason}" in table


def test_large_component_is_a_free_body_of_its_mass_and_makes_a_vehicle(tmp_path, capsys):
    box = Box(nodes=(6, 4, 3), n_modes=10)
    path, folder = tmp_path / "frame.op2", tmp_path / "vehicle"
    write_op2(path, box)
    imported.imported(path, folder, box)
    said = capsys.readouterr().err.splitlines()
    assert said
    assert all(line.startswith("modeviz: note: body 'frame'") for line in said)  # of its few modes
    vehicle = read_vehicle(folder)
    frame = vehicle.bodies[0]
    assert frame.mass == pytest.approx(1000 * NODE_MASS * box.n_nodes, rel=1e-5)
    hertz = [box.frequency_hz(mode) for mode in range(6, 10)]
    np.testing.assert_allclose(frame.natural_frequency_hz[6:], hertz, rtol=1e-6)
    assert len(vehicle.tyres) == 4
    assert len(vehicle.mounts) == 3


@pytest.mark.parametrize(("size", "n_dofs"), [((5, 4, 3), 180), (4, 270)])
def test_models_of_matrices_are_free_bodies_of_their_mass(tmp_path, size, n_dofs, capsys):
    from_matrices.write_model(tmp_path, size)
    assert from_matrices.imported(tmp_path).n_dofs == n_dofs
    body = read_vehicle(tmp_path / "vehicle").bodies[0]
    if isinstance(size, int):
        assert body.mass == pytest.approx(7850 * 0.0015 * 2.0, rel=0.2)  # and what the vault adds
    else:
        assert body.mass == pytest.approx(7850 * 0.08 * 0.06 * 0.04, rel=1e-6)
    assert len(body.attachments) == 4
    assert body.n_residuals > 0
