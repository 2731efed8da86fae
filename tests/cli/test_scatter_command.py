"""`modeviz scatter` tells what the same vehicles do in Python."""

import json
import signal
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin
from rounding import CABIN
from usual_signals import usual_signals

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.cli import main
from modeviz.cli import scatter as command
from modeviz.cli.interrupt import ENDINGS
from modeviz.files import read_vehicle, write_vehicle
from modeviz.optimise.goals import prepare_goal
from modeviz.scatter.monte_carlo import CHUNK, scatter
from modeviz.scatter.tolerance import Tolerance, scattered_parts
from modeviz.scatter.worst_case import goals

TOLERANCE = Tolerance(0.1, 0.4)
GIVEN = ["--samples", "120", "--seed", "5", "--tolerance", "0.1", "--loss-tolerance", "0.4"]
ROAD = ["--road", "rough", "--speed", "25 m/s", "--rates", "soft"]


@pytest.fixture(scope="module")
def cabin(tmp_path_factory):
    path = tmp_path_factory.mktemp("vehicles") / "cabin"
    gentle = replace(PROBLEM, name="gentle", goal="change", reference="")
    write_vehicle(replace(mounted_cabin(), problems=(PROBLEM, gentle)), path)
    return str(path)


@pytest.fixture(scope="module")
def expected(cabin):
    vehicle = read_vehicle(Path(cabin))
    rates = vehicle.all_rates(vehicle.rate_sets["soft"])
    prepared = prepare(vehicle)
    goal = prepare_goal(vehicle, vehicle.problems[0], rates, 25.0)
    parts = scattered_parts(prepared, rates, TOLERANCE)
    return goal, parts, scatter(prepared, parts, Conditions("rough", 25.0), goal, 120, 5)


@pytest.fixture
def record(printed_json, cabin):
    return printed_json("scatter", cabin, *GIVEN, *ROAD)


def test_its_numbers_are_those_of_python(record, expected):
    goal, _, result = expected
    values = {
        "rms_lateral_g": result.rms[:, 0, 1],
        "rms_vertical_g": result.rms[:, 0, 2],
        "mean_personal_rating": result.mean_personal_rating,
        "goal": result.goal,
    }
    for name, sample in values.items():
        row = record["quantities"][name]
        assert row["mean"] == pytest.approx(sample.mean(), rel=CABIN)
        percentiles = np.percentile(sample, [5, 50, 95])
        assert [row["p5"], row["p50"], row["p95"]] == pytest.approx(percentiles, rel=CABIN)
    nominal = solve(
        prepare(mounted_cabin()), mounted_cabin().rate_sets["soft"], Conditions("rough", 25.0)
    )
    assert record["quantities"]["rms_vertical_g"]["nominal"] == pytest.approx(
        nominal.rms[0, 2], rel=1e-6
    )
    rating = nominal.rating.mean_personal_rating
    assert record["quantities"]["mean_personal_rating"]["nominal"] == pytest.approx(rating, rel=1e-6)
    assert record["quantities"]["goal"]["nominal"] == pytest.approx(
        goal.value(mounted_cabin().rate_sets["soft"]), rel=1e-9
    )


def test_its_bands_are_those_of_python(record, expected):
    _, _, result = expected
    low, high = result.psd_percentiles((5, 95))
    np.testing.assert_allclose(record["psd"]["lateral"]["p5"], low[:, 0, 1], rtol=CABIN)
    np.testing.assert_allclose(record["psd"]["vertical"]["p95"], high[:, 0, 2], rtol=CABIN)
    np.testing.assert_array_equal(record["psd"]["frequency_hz"], result.frequency_hz)


def test_its_corner_has_the_goal_of_its_parts(record, expected):
    goal, parts, result = expected
    mounts = record["worst_corner"]["mounts"]
    assert [m["mount"] for m in mounts] == list(parts.names)
    ends = np.array([[m["hardness"] for m in mounts], [m["loss_factor"] for m in mounts]])
    assert set(ends.ravel()) <= {-1, 1}
    assert record["worst_corner"]["goal"] == pytest.approx(goals(goal, parts, ends.reshape(1, -1))[0])
    assert record["worst_corner"]["goal"] > result.goal.max()


def test_its_contributions_sum_to_one(record):
    shares = [[c["hardness"], c["loss_factor"]] for c in record["contributions"]]
    assert np.sum(shares) + record["rest"] == pytest.approx(1, rel=1e-12)
    assert np.min(shares) >= 0


def test_few_samples_have_no_contributions(printed_json, cabin, capsys):
    record = printed_json("scatter", cabin, "--samples", "20")
    assert record["contributions"] is None
    assert main(["scatter", cabin, "--samples", "20"]) == 0
    assert "too few samples to tell which mounts make the spread" in capsys.readouterr().out


def test_its_table_says_what_its_json_says(record, cabin, capsys):
    assert main(["scatter", cabin, *GIVEN, *ROAD]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[0] == "120 vehicles on rough, rates within ±10 %, loss factors within ±40 %"
    (row,) = [line.split() for line in lines if line.startswith("rms vertical g")]
    numbers = record["quantities"]["rms_vertical_g"]
    assert [float(text) for text in row[3:]] == [
        pytest.approx(numbers[name], rel=1e-3) for name in ("nominal", "mean", "p5", "p50", "p95")
    ]
    mounts = [line for line in lines if line.startswith(("A ", "B "))]
    assert ["soft" in line for line in mounts] == [
        m["hardness"] < 0 for m in record["worst_corner"]["mounts"]
    ]


def test_a_vehicle_without_a_problem_gets_the_one_that_the_page_shows(printed_json, folder):
    record = printed_json("scatter", folder, "--samples", "10")
    assert record["goal"] == "squared accelerations, each load case relative to the original"
    assert record["quantities"]["goal"]["nominal"] == pytest.approx(1)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_signal_ends_it_with_the_vehicles_so_far(monkeypatch, capsys, cabin, ending):
    def telling(what):
        return lambda done: signal.raise_signal(ending) if what == "scattering" else None

    monkeypatch.setattr(command, "progress", telling)
    with usual_signals():
        assert main(["scatter", cabin, "--samples", "5000", "--json"]) == 0
    out, err = capsys.readouterr()
    assert json.loads(out)["samples"] == CHUNK
    assert f"modeviz: note: ended after {CHUNK} of 5000 vehicles\n" in err


@pytest.mark.parametrize(("samples", "driven"), [(5000, CHUNK), (20, 20)])
def test_ended_before_it_has_vehicles_it_drives_a_few(
    monkeypatch, capsys, cabin, expected, samples, driven
):
    def ended(vehicle):
        signal.raise_signal(signal.SIGTERM)
        return prepare(vehicle)

    monkeypatch.setattr(command, "prepare_telling", ended)
    with usual_signals():
        assert main(["scatter", cabin, "--samples", str(samples), *ROAD, "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["samples"] == driven
    nominal = record["quantities"]["rms_vertical_g"]["nominal"]
    assert nominal == pytest.approx(expected[2].nominal_rms[0, 2], rel=1e-6)


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["--samples", "1"], "--samples: found 1, expected 2 to 1000000"),
        (["--samples", "99999999999"], "--samples: found 99999999999, expected 2 to 1000000"),
        (["--seed", "-1"], "--seed: found -1, expected 0 or more"),
        (["--tolerance", "1"], "tolerance of rates: found 1, expected a fraction from 0 to below 1"),
        (["--loss-tolerance", "-1"], "tolerance of loss factor: found -1, expected a fraction"),
        (["--tolerance", "0", "--loss-tolerance", "0"], "tolerance: found 0 for all"),
        (["--point", "seet"], "unknown response point 'seet': did you mean 'seat'?"),
        (["--problem", "papr"], "unknown problem 'papr'"),
        (["--problem", "gentle"], "problem 'gentle': its goal, change, does not scatter"),
        (["--scheduler", "tcp://127.0.0.1:9"], "scheduler 'tcp://127.0.0.1:9': nobody answers there"),
    ],
)
def test_what_is_wrong_is_one_sentence(cabin, capsys, arguments, sentence):
    assert main(["scatter", cabin, *arguments]) == 2
    out, err = capsys.readouterr()
    assert not out
    assert err.startswith(f"modeviz: {sentence}")
    assert len(err.splitlines()) == 1
