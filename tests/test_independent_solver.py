"""modeviz agrees with a solver that shares no line with it, on random vehicles that use every key."""

import numpy as np
import pytest
from independent_solver import Folder
from random_folders import random_folder
from shared_preparations import shared_preparations

N_VEHICLES, N_QUICK = 20, 6
"""Each of them uses every key; the others have other numbers, and are slow for being many."""

SEEDS = [
    pytest.param(seed, marks=[pytest.mark.slow] if seed >= N_QUICK else [])
    for seed in range(N_VEHICLES)
]
RTOL = 1e-8
DIRECTIONS = {"fore-aft": 0, "lateral": 1, "vertical": 2}
RANDOM = ("road", "wind", "quake", "tremor")


@pytest.fixture(scope="module", params=SEEDS)
def folder(request, tmp_path_factory):
    with shared_preparations():
        yield random_folder(tmp_path_factory.mktemp("random") / "vehicle", request.param)


@pytest.fixture(scope="module")
def solver(folder):
    return Folder(folder)


def test_modes_agree(folder, solver, printed_json):
    frequency_hz, damping_ratio = solver.modes()
    found = printed_json("modes", str(folder))["modes"]
    assert len(found) > 12
    ours = np.array([[mode["frequency_hz"], mode["damping_ratio"]] for mode in found]).T
    np.testing.assert_allclose(ours[0], frequency_hz[: len(found)], rtol=RTOL, atol=1e-5)
    moves = ours[0] > 0.05
    np.testing.assert_allclose(ours[1][moves], damping_ratio[: len(found)][moves], rtol=1e-7)


@pytest.mark.parametrize("load", RANDOM)
def test_spectra_agree(folder, solver, printed_json, load):
    found = printed_json("psd", str(folder), "--road", load)
    lines = spread(len(found["frequency_hz"]))
    expected = np.array([solver.psd(found["frequency_hz"][i], load) for i in lines])
    points = [table["name"] for table in solver.data["response_point"]]
    for response in found["responses"]:
        own = expected[:, points.index(response["point"]), DIRECTIONS[response["direction"]]]
        ours = np.array(response["psd_g2_per_hz"])[lines]
        assert np.abs(ours - own).max() < RTOL * own.max()


def test_harmonic_responses_agree(folder, solver, printed_json):
    found = printed_json("wheels", str(folder))
    lines = spread(len(found["frequency_hz"]))
    f = np.array(found["frequency_hz"])[lines]
    points = [table["name"] for table in solver.data["response_point"]]
    assert len(found["loads"]) == 6
    for load in found["loads"]:
        expected = np.array([solver.harmonic(f_i, load["load"]) for f_i in f])
        for response in load["responses"]:
            own = expected[:, points.index(response["point"]), DIRECTIONS[response["direction"]]]
            ours = np.array(response["acceleration_g"])[lines]
            assert np.abs(ours - own).max() < RTOL * own.max()


def spread(n: int, count: int = 40) -> np.ndarray:
    """Some of n lines, from the first to the last."""
    return np.unique(np.linspace(0, n - 1, count).round().astype(int))
