"""`modeviz optimise --front` finds what the same search finds in Python."""

import csv
import json
import re
from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin
from rounding import SEARCHED_X
from usual_signals import interrupting, usual_signals

from modeviz.cli import front as command
from modeviz.cli import main
from modeviz.cli.interrupt import ENDINGS
from modeviz.files import write_vehicle
from modeviz.optimise.pareto import find_front
from modeviz.optimise.trade_off import prepare_trade_off, sides

OFFER = "lateral against vertical"
KEYS = {
    "goal", "normalised", "between", "original", "designs", "converged", "reason", "evaluations",
    "exact_difference", "fixed_ratios", "outside",
}  # fmt: skip


@pytest.fixture(scope="module")
def cabin(tmp_path_factory):
    path = tmp_path_factory.mktemp("vehicles") / "cabin"
    write_vehicle(replace(mounted_cabin(), problems=(PROBLEM,)), path)
    return str(path)


@pytest.fixture
def refused(capsys, cabin):
    def refused(*arguments):
        assert main(["optimise", cabin, *arguments]) == 2
        return capsys.readouterr().err.removeprefix("modeviz: ").strip()

    return refused


def expected(seed=0):
    vehicle = mounted_cabin()
    pair = sides(vehicle, PROBLEM)[OFFER]
    trade_off = prepare_trade_off(vehicle, PROBLEM, pair, vehicle.rates, vehicle.speed)
    return find_front(trade_off, [vehicle.rates], n_starts=1, seed=seed)


def test_its_designs_are_those_of_python(printed_json, cabin, tmp_path):
    path = tmp_path / "front.json"
    arguments = ["--front", OFFER, "--starts", "1", "--seed", "2", "--output", str(path)]
    record = printed_json("optimise", cabin, *arguments)
    assert set(record) == KEYS
    assert record == json.loads(path.read_text())
    front = expected(seed=2)
    assert record["between"] == ["lateral", "vertical"]
    assert record["original"] == pytest.approx([1, 1], rel=1e-12)
    assert len(front.designs) > 2
    values = np.array([d["values"] for d in record["designs"]])
    np.testing.assert_allclose(values, [d.values for d in front.designs], rtol=SEARCHED_X)
    for found, design in zip(record["designs"], front.designs, strict=True):
        assert found["truncation"] is None
        vertical = found["rates"]["A"]["vertical"]
        assert vertical == pytest.approx(design.rates["A"].vertical / 1e3, rel=SEARCHED_X)
    assert record["converged"] is True
    assert 0 <= record["exact_difference"] < 1e-9


def test_its_tables_say_the_same_in_print_and_in_a_file(capsys, cabin, tmp_path):
    path = tmp_path / "front.csv"
    assert main(["optimise", cabin, "--front", OFFER, "--starts", "1", "--output", str(path)]) == 0
    lines = capsys.readouterr().out.splitlines()
    front = expected()
    assert lines[0].split() == ["lateral", "vertical"]
    first = next(line.split() for line in lines if line.startswith("design 1 "))
    assert float(first[2]) == pytest.approx(front.designs[0].values[0], rel=1e-3)
    assert any(re.fullmatch(r"converged after \d+ evaluations", line) for line in lines)
    assert any(
        line.startswith("solved from scratch, the model as given differs in its goals by a part of")
        for line in lines
    )
    header, *rows = csv.reader(path.read_text().splitlines())
    assert header[:4] == ["design", "lateral", "vertical", "A vertical, N/mm"]
    values = [d.values[1] for d in front.designs]
    assert [float(row[2]) for row in rows] == pytest.approx(values, rel=SEARCHED_X)
    printed = next(line.split() for line in lines if line.startswith("B fore-aft"))
    column = [float(row[header.index("B fore-aft, N/mm")]) for row in rows]
    fore_aft = [d.rates["B"].fore_aft / 1e3 for d in front.designs]
    assert column == pytest.approx(fore_aft, rel=SEARCHED_X)
    assert [float(text) for text in printed[2:]] == pytest.approx(column, rel=1e-3)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_signal_to_end_keeps_the_designs_so_far(monkeypatch, printed_json, cabin, ending):
    told = []
    monkeypatch.setattr(command, "_tell", interrupting(told, ending))
    with usual_signals():
        record = printed_json("optimise", cabin, "--front", OFFER, "--starts", "1")
    assert record["reason"] == "cancelled"
    assert record["converged"] is False
    assert len(record["designs"]) == 1
    assert record["exact_difference"] < 1e-9


def test_what_cannot_be_is_refused_in_a_sentence(refused):
    assert refused("--front", "laterally against vertical") == (
        "--front: unknown trade-off 'laterally against vertical': did you mean 'lateral against "
        "vertical'? there are lateral against vertical"
    )
    assert refused("--front", OFFER, "--global").endswith("expected it without --global")
    assert refused("--front", OFFER, "--robust").endswith("expected it without --robust")
    assert "has no points and directions to trade" in refused("--front", OFFER, "--goal", "rating")
