"""`modeviz optimise` finds what the same search finds in Python, and keeps what it has."""

import json
import pty
import re
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from cabin_problem import PROBLEM, cabin_search
from mounted_cabin import mounted_cabin
from rounding import SEARCHED, SEARCHED_X
from usual_signals import interrupting, usual_signals

from modeviz.cli import front as front_command
from modeviz.cli import main
from modeviz.cli import optimise as command
from modeviz.cli.interrupt import ENDINGS
from modeviz.errors import VehicleError
from modeviz.files import write_vehicle
from modeviz.files.problem_file import problem_text
from modeviz.files.rate_files import read_rates, write_rates
from modeviz.optimise.goals import prepare_goal
from modeviz.optimise.run import optimise, search_globally
from modeviz.optimise.starts import start_points
from modeviz.scatter.robust import robust
from modeviz.scatter.tolerance import Tolerance
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import DesignGroup, FrequencyWindow, Performance
from modeviz.viewer.session.planning.plan import first_plan, planned

KEYS = {
    "goal", "normalised", "percentile", "objective", "rates", "converged", "reason", "evaluations",
    "active_constraints", "exact_difference", "truncation", "fixed_ratios", "outside", "placements",
}  # fmt: skip


def written(path, *problems):
    write_vehicle(replace(mounted_cabin(), problems=problems), path)
    return str(path)


@pytest.fixture(scope="module")
def cabin(tmp_path_factory):
    second = replace(PROBLEM, name="gentle", goal="change", reference="")
    return written(tmp_path_factory.mktemp("vehicles") / "cabin", PROBLEM, second)


@pytest.fixture
def refused(capsys, tmp_path):
    """The sentence with which a search is refused; nothing is written."""

    def refused(*arguments):
        capsys.readouterr()
        assert main(["optimise", *arguments, "--output", str(tmp_path / "rates.json")]) == 2
        out, err = capsys.readouterr()
        assert not out
        assert not list(tmp_path.iterdir())
        return err.removeprefix("modeviz: ").strip()

    return refused


def found(search, n_starts=3, seed=0):
    return optimise(search, start_points(search, {}, n_starts, seed))


def test_it_finds_what_python_finds(printed_json, cabin):
    record = printed_json("optimise", cabin, "--starts", "3", "--seed", "7")
    search = cabin_search()
    best = found(search, seed=7)
    assert set(record) == KEYS
    assert record["goal"] == "accelerations"
    assert record["normalised"] is True
    assert record["percentile"] is None
    soft = search.space.vehicle.rate_sets["soft"]
    expected = {"original": 1.0, "found": best.value, "paper": search.goal.value(soft)}
    assert record["objective"] == pytest.approx(expected, rel=1e-9)
    assert record["converged"] is best.converged is True
    assert record["reason"] == "converged"
    assert 0 <= record["exact_difference"] < 1e-9
    named = {c["name"]: (c["multiplier"], c["gain"]) for c in record["active_constraints"]}
    assert list(named) == [c.name for c in best.active]
    largest = max(c.multiplier for c in best.active)
    for c in best.active:
        assert named[c.name] == pytest.approx((c.multiplier, c.gain), abs=SEARCHED_X * largest)
    vertical = record["rates"]["A"]["vertical"]
    assert vertical == pytest.approx(best.rates["A"].vertical / 1e3, rel=1e-9)


def test_robust_it_makes_the_percentile_over_parts_small(printed_json, capsys, tmp_path):
    """12 Hz can be nearly cancelled by parts as drawn, and by no others."""
    wide = MountRates(2e4, 2e4, 2e4), MountRates(5e6, 5e6, 5e6)
    changes = {
        "groups": (DesignGroup("A", bounds=wide), DesignGroup("B", bounds=wide)),
        "performance": (Performance(np.array([12.0]), roads=("flat",)),),
    }
    folder = written(tmp_path / "cabin", replace(PROBLEM, **changes))
    arguments = ["optimise", folder, "--starts", "2", "--robust", "--tolerance", "0.2"]
    path = tmp_path / "rates.json"
    record = printed_json(*arguments, "--output", str(path))
    search = cabin_search(**changes)
    goal = robust(search.goal, Tolerance(0.2))
    assert record["percentile"] == 95
    assert record["objective"]["original"] == pytest.approx(goal.value({}), rel=1e-9)
    value = goal.value(read_rates(path, mounted_cabin()))
    assert record["objective"]["found"] == pytest.approx(value, rel=1e-9)
    assert value < 0.99 * goal.value(found(search, 2).rates)
    assert record["exact_difference"] < 1e-8
    capsys.readouterr()
    assert main(arguments) == 0
    said = "95th percentile with rates within ±20 %, loss factors within ±30 %"
    assert said in capsys.readouterr().out


def test_robust_needs_a_goal_that_scatters(refused, cabin):
    said = refused(cabin, "--robust", "--goal", "change")
    assert said.startswith("the goal does not scatter with parts: a robust search needs")


@pytest.mark.parametrize("option", ["--tolerance", "--loss-tolerance"])
def test_tolerances_are_of_a_robust_search(refused, cabin, option):
    assert refused(cabin, option, "0.1") == (
        "--tolerance and --loss-tolerance: expected them with --robust"
    )


def test_the_rates_it_writes_are_those_it_prints(printed_json, cabin, tmp_path):
    path = tmp_path / "rates.json"
    record = printed_json("optimise", cabin, "--starts", "1", "--output", str(path))
    rates = read_rates(path, mounted_cabin())
    for group, values in record["rates"].items():
        assert rates[group].lateral == pytest.approx(1e3 * values["lateral"], rel=1e-12)
    assert cabin_search().goal.value(rates) == pytest.approx(record["objective"]["found"], rel=1e-9)


def test_the_global_search_is_that_of_python(printed_json, cabin):
    record = printed_json("optimise", cabin, "--global", "--seed", "3", "--budget", "600")
    best = search_globally(cabin_search(), seed=3, budget=600)
    assert record["objective"]["found"] == pytest.approx(best.value, rel=SEARCHED)


def test_it_starts_at_the_rates_that_are_chosen(printed_json, cabin):
    record = printed_json(
        "optimise", cabin, "--goal", "change", "--set", "B.loss_factor=0.4", "--starts", "1"
    )
    assert record["rates"]["B"]["loss_factor"] == 0.4
    assert record["evaluations"] == 1
    assert record["objective"]["found"] == pytest.approx(0, abs=1e-12)


def test_the_papers_sum_adds_up_what_the_other_normalises(printed_json, cabin):
    record = printed_json("optimise", cabin, "--plain", "--starts", "1")
    assert record["normalised"] is False
    plain = cabin_search(is_normalised=False)
    assert record["objective"]["original"] == pytest.approx(plain.goal.value({}), rel=1e-12)


def test_another_problem_and_speed_are_taken(printed_json, cabin):
    gentle = printed_json("optimise", cabin, "--problem", "gentle", "--starts", "1")
    assert gentle["goal"] == "change"
    assert gentle["objective"]["paper"] is None
    slow = printed_json("optimise", cabin, "--plain", "--speed", "36 km/h", "--starts", "1")
    fast = printed_json("optimise", cabin, "--plain", "--starts", "1")
    assert slow["objective"]["original"] < fast["objective"]["original"]


def test_a_problem_is_taken_from_a_file(printed_json, cabin, folder, refused, tmp_path_factory):
    path = tmp_path_factory.mktemp("problems") / "mine.toml"
    path.write_text(problem_text(replace(PROBLEM, is_normalised=False)))
    plain = printed_json("optimise", cabin, "--plain", "--starts", "1")
    for vehicle in (cabin, folder):  # the other one has no problem of its own
        other = printed_json("optimise", vehicle, "--problem", str(path), "--starts", "1")
        found, expected = (record["objective"]["found"] for record in (other, plain))
        assert (other["normalised"], found) == (False, pytest.approx(expected, rel=SEARCHED))
    assert "nowhere.toml" in refused(cabin, "--problem", str(path.with_name("nowhere.toml")))


def test_the_table_says_what_was_found_and_which_sum_it_is(capsys, cabin):
    assert main(["optimise", cabin, "--starts", "3"]) == 0
    lines = capsys.readouterr().out.splitlines()
    best = found(cabin_search())
    assert lines[0].split() == ["rates,", "N/mm", "original", "found", "soft"]
    vertical = next(line for line in lines if line.startswith("A vertical"))
    assert float(vertical.split()[3]) == pytest.approx(best.rates["A"].vertical / 1e3, rel=1e-3)
    assert "objective: squared accelerations, each load case relative to the original" in lines
    assert any(re.fullmatch(r"converged after \d+ evaluations in 3 searches", line) for line in lines)
    limit = next(line for line in lines if line.startswith(best.active[0].name))
    assert f"{100 * best.active[0].gain:.1f} %" in limit
    assert any(
        line.startswith("solved from scratch, the model as given differs in its objective by")
        for line in lines
    )


def test_it_says_which_ratios_it_keeps_and_what_it_could_not_have_found(printed_json, capsys, cabin):
    given = ["optimise", cabin, "--set", "B.lateral=200 N/mm", "--starts", "1"]
    record = printed_json(*given)
    assert record["fixed_ratios"]["B"] == pytest.approx({"lateral": 0.25, "fore_aft": 0.5}, rel=1e-12)
    ratio = "B lateral is 0.375 of vertical, kept at 0.25"
    assert record["outside"] == {"original": [ratio], "paper": [ratio]}
    assert main(given) == 0
    out = capsys.readouterr().out
    kept = "ratios kept as in the rates it starts from: B lateral 0.25 and fore-aft 0.5 of vertical"
    assert kept in out
    for name in ("original", "soft"):
        assert f"{name} lies outside of what is searched: {ratio}" in out


def test_the_table_names_the_plain_sum(capsys, cabin):
    assert main(["optimise", cabin, "--starts", "1", "--plain"]) == 0
    assert "objective: squared accelerations, plain sum\n" in capsys.readouterr().out


def test_the_table_says_where_the_mode_of_a_window_is(capsys, tmp_path):
    window = FrequencyWindow("cab yaw", high_hz=10.0)
    folder = written(tmp_path / "cabin", replace(PROBLEM, windows=(window,)))
    assert main(["optimise", folder, "--starts", "1"]) == 0
    said = next(line for line in capsys.readouterr().out.splitlines() if "cab yaw at" in line)
    assert float(said.split()[3]) <= 10.0
    assert said.endswith("Hz in the model as given")


@pytest.fixture(autouse=True)
def signals():
    with usual_signals():
        yield


@pytest.mark.parametrize("ending", ENDINGS)
def test_an_interrupt_keeps_the_best_so_far(monkeypatch, capsys, cabin, tmp_path, ending):
    told = []
    monkeypatch.setattr(command, "_tell", interrupting(told, ending, after=5))
    before = signal.getsignal(ending)
    path = tmp_path / "rates.csv"
    assert main(["optimise", cabin, "--output", str(path), "--json"]) == 0
    record = json.loads(capsys.readouterr().out)
    assert record["reason"] == "cancelled"
    assert record["converged"] is False
    assert record["evaluations"] == 6  # and the best design among the other starts
    assert record["objective"]["found"] == told[-1].value < 1
    assert read_rates(path, mounted_cabin())["A"].vertical == told[-1].rates["A"].vertical
    assert signal.getsignal(ending) is before


@pytest.mark.parametrize("ending", [signal.SIGTERM, signal.SIGHUP])
def test_what_batch_systems_send_keeps_the_best_in_print_and_in_a_file(cabin, tmp_path, ending):
    path = tmp_path / "rates.json"
    arguments = ["optimise", cabin, "--starts", "4", "--json", "--output", str(path)]
    with subprocess.Popen(
        [sys.executable, "-c", TELLING, *arguments], stdout=subprocess.PIPE, stderr=subprocess.PIPE
    ) as run:
        assert run.stdout
        assert run.stderr
        assert run.stderr.readline() == b"searching\n"
        run.send_signal(ending)
        record, said = json.loads(run.stdout.read()), run.stderr.read().decode()
    assert said == f"modeviz: ending; {ending.name} again ends it at once\n"
    assert (run.returncode, record["reason"]) == (0, "cancelled")
    vertical = read_rates(path, mounted_cabin())["A"].vertical
    assert vertical == pytest.approx(1e3 * record["rates"]["A"]["vertical"], rel=1e-12)


TELLING = """
import sys, time
from itertools import count
from modeviz.cli import main
from modeviz.cli import optimise

n = count()

def tell(token, progress):
    if next(n) == 3:
        print("searching", file=sys.stderr, flush=True)
        patience = time.monotonic() + 60
        while not token.is_cancelled and time.monotonic() < patience:
            time.sleep(0.01)

optimise._tell = tell
sys.exit(main())
"""
"""The command, which goes on after a few steps only when it is told to end."""


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_signal_that_is_ignored_stays_so(monkeypatch, printed_json, cabin, ending):
    monkeypatch.setattr(command, "_tell", lambda *_: signal.raise_signal(ending))
    before = signal.signal(ending, signal.SIG_IGN)
    try:
        assert printed_json("optimise", cabin, "--starts", "1")["reason"] == "converged"
    finally:
        signal.signal(ending, before)


def test_a_signal_while_results_are_written_waits(monkeypatch, printed_json, cabin, tmp_path):
    def interrupted(*arguments):
        signal.raise_signal(signal.SIGTERM)
        write_rates(*arguments)

    monkeypatch.setattr(command, "write_rates", interrupted)
    path = tmp_path / "rates.json"
    record = printed_json("optimise", cabin, "--starts", "1", "--output", str(path))
    assert record["converged"]
    assert read_rates(path, mounted_cabin())


@pytest.mark.parametrize("options", [[], ["--front", "lateral against vertical"]])
def test_what_cannot_be_written_at_the_end_is_printed(monkeypatch, capsys, cabin, tmp_path, options):
    def full(path, *_):
        raise VehicleError(f"{path}: cannot be written (No space left on device)")

    monkeypatch.setattr(command, "write_rates", full)
    monkeypatch.setattr(front_command, "write_text", full)
    path = tmp_path / "rates.json"
    arguments = ["optimise", cabin, "--starts", "1", *options, "--json", "--output", str(path)]
    assert main(arguments) == 2
    out, err = capsys.readouterr()
    assert "rates" in json.loads(out).get("designs", [json.loads(out)])[0]
    assert err == f"modeviz: {path}: cannot be written (No space left on device)\n"


def test_an_interrupt_before_the_robust_search_keeps_the_best_as_drawn(
    monkeypatch, printed_json, cabin
):
    told = []
    monkeypatch.setattr(command, "_tell", interrupting(told, signal.SIGINT))
    record = printed_json("optimise", cabin, "--robust")
    assert record["reason"] == "cancelled"
    assert record["percentile"] is None
    assert record["objective"]["found"] == told[-1].value


def test_a_second_interrupt_ends_the_program_and_writes_nothing(monkeypatch, capsys, cabin, tmp_path):
    def interrupt(_, __):
        signal.raise_signal(signal.SIGINT)
        signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(command, "_tell", interrupt)
    assert main(["optimise", cabin, "--output", str(tmp_path / "rates.json")]) == 130
    said = capsys.readouterr().err.splitlines()
    assert said == ["modeviz: ending; Ctrl+C again ends it at once", "modeviz: interrupted"]
    assert not list(tmp_path.iterdir())


def on_a_terminal(monkeypatch, *arguments):
    """What a command says there, line for line; each takes the place of the one before."""
    reader, writer = pty.openpty()
    with open(reader, "rb", buffering=0) as terminal, open(writer, "w") as errors:
        monkeypatch.setattr("sys.stderr", errors)
        assert main(list(arguments)) == 0
        said = b""
        while not said.endswith(b"\r\x1b[K"):  # it comes bit by bit, at last an empty line
            said += terminal.read(4096)
    return [line.removesuffix("\x1b[K") for line in said.decode().split("\r")[1:-1]]


def test_a_terminal_is_told_of_the_search_and_of_the_check(monkeypatch, cabin):
    told = on_a_terminal(monkeypatch, "optimise", cabin, "--starts", "1", "--json")
    assert told[0].startswith("search   1 of 1, objective")
    assert told[-1] == "solving the model as given from scratch"


@pytest.mark.parametrize(
    ("module", "options", "before"),
    [
        (command, [], "search   1 of 20, objective"),
        (front_command, ["--front", "lateral against vertical"], "searching, 1 designs on the front"),
    ],
)
def test_word_of_an_interrupt_stays_on_a_terminal(monkeypatch, cabin, module, options, before):
    tell = module._tell

    def interrupt(token, progress):
        tell(token, progress)
        if not token.is_cancelled:
            signal.raise_signal(signal.SIGINT)

    monkeypatch.setattr(module, "_tell", interrupt)
    told = on_a_terminal(monkeypatch, "optimise", cabin, *options, "--json")
    assert told[-1] == "ending; Ctrl+C again ends it at once"
    assert told[-2].startswith(before)


def test_what_cannot_be_is_refused_in_a_sentence(refused, cabin):
    assert refused(cabin, "--problem", "cabim") == (
        "unknown problem 'cabim': did you mean 'cabin'? there are cabin, gentle"
    )
    assert "unknown goal 'speed': there are accelerations" in refused(cabin, "--goal", "speed")
    assert refused(cabin, "--starts", "0") == "--starts: found 0, expected 1 to 1000"
    assert refused(cabin, "--budget", "0") == "--budget: found 0, expected 1 or more"
    assert refused(cabin, "--seed", "-1") == "--seed: found -1, expected 0 or more"
    assert refused(cabin, "--speed", "0 km/h").startswith("--speed: found '0 km/h'")


def test_a_vehicle_without_a_problem_gets_the_one_that_the_page_shows(printed_json, folder, tmp_path):
    path = tmp_path / "rates.json"
    record = printed_json("optimise", folder, "--starts", "1", "--output", str(path))
    cabin = mounted_cabin()
    goal = prepare_goal(cabin, planned(cabin, first_plan(cabin)), {}, cabin.speed)
    found = goal.value(read_rates(path, cabin))
    assert record["objective"]["found"] == pytest.approx(found, rel=1e-9)
    assert record["objective"]["paper"] == pytest.approx(goal.value(cabin.rate_sets["soft"]), rel=1e-9)


def test_a_vehicle_with_nothing_to_optimise_for_says_what_its_file_needs(refused, tmp_path_factory):
    bare = tmp_path_factory.mktemp("vehicles") / "bare"
    write_vehicle(replace(mounted_cabin(), roads=(), wheel_loads=(), connections=()), bare)
    assert "lacks what shakes it: a [[tyre]] with stiffness along z" in refused(str(bare))


def test_limits_that_contradict_each_other_are_both_named(refused, tmp_path):
    narrow = DesignGroup(
        "A", bounds=(MountRates(1e6, 1e5, 1e5), MountRates(2e6, 2e5, 2e6)), ratio_limits=(0.5, 0.8)
    )
    folder = written(tmp_path.parent / f"{tmp_path.name}-cabin", replace(PROBLEM, groups=(narrow,)))
    assert refused(folder) == (
        f"problem {PROBLEM.name!r}: A: vertical is at least 1000 N/mm, but lateral is at most 200 N/mm "
        "and at least 0.5 of vertical, which asks for vertical at most 400 N/mm; widen the bounds or "
        "the ratio limits"
    )


def test_a_window_that_no_design_keeps_is_an_error(refused, tmp_path):
    window = FrequencyWindow("cab yaw", high_hz=1.0)
    folder = written(tmp_path.parent / f"{tmp_path.name}-cabin", replace(PROBLEM, windows=(window,)))
    assert refused(folder, "--starts", "2").startswith(
        "no design was found that keeps the frequency windows"
    )


@pytest.mark.parametrize("name", ["rates.txt", "missing/rates.json"])
def test_a_file_that_cannot_be_written_is_refused_before_the_search(
    monkeypatch, capsys, cabin, tmp_path, name
):
    monkeypatch.setattr(command, "prepare_search", None)
    assert main(["optimise", cabin, "--output", str(tmp_path / name)]) == 2
    assert name in capsys.readouterr().err


@pytest.mark.bitwise
def test_the_same_seed_finds_the_same(printed_json, cabin):
    first, again = (printed_json("optimise", cabin, "--starts", "2", "--seed", "5") for _ in range(2))
    assert first == again
    other = printed_json("optimise", cabin, "--starts", "2", "--seed", "6")
    assert np.isfinite(other["objective"]["found"])
    assert other["evaluations"] != first["evaluations"]
