"""A study against the functions below it and against the command line."""

import json
import signal
from dataclasses import replace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from studied_cabin import cabin_study

import modeviz as mv
from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.analysis.sensitivity import frequency_sensitivity, ride_sensitivity
from modeviz.analysis.wheel_results import solve_wheels
from modeviz.cli import main
from modeviz.errors import ModevizError, VehicleError
from modeviz.files.problem_file import problem_text
from modeviz.report.records import Record
from modeviz.study.study import Study
from modeviz.vehicle.bodies import RigidBody
from modeviz.vehicle.vehicle import Vehicle

LOAD = "front left radial force"


def assert_same(found: Record, printed: Record) -> None:
    """The same keys and words, and numbers but for rounding."""
    found = json.loads(json.dumps(found))
    if isinstance(printed, dict):
        assert found.keys() == printed.keys()
        for key in printed:
            assert_same(found[key], printed[key])
    elif isinstance(printed, list):
        assert len(found) == len(printed)
        for pair in zip(found, printed, strict=True):
            assert_same(*pair)
    elif isinstance(printed, float):
        # Files hold rates in N/mm: the last bit may be another one.
        assert found == pytest.approx(printed, rel=1e-6, abs=1e-9)
    else:
        assert found == printed


@pytest.fixture(scope="module")
def study():
    """With a rate that was changed; not to be changed by tests."""
    study = cabin_study()
    study.rates["A.lateral"] = "200 N/mm"
    return study


def test_answers_become_what_the_command_line_prints(study, cabin_folder, printed_json):
    changed = ("--set", "A.lateral=200 N/mm")
    for answer, *command in (
        (study.modes(25), "modes"),
        (study.ride("rough"), "psd", "--road", "rough"),
        (study.wheels(), "wheels"),
        (study.static(), "static"),
        (study.forces(), "forces", "--all"),
        (study.paths("seat", "lateral", LOAD), "paths", "--direction", "lateral", "--load", LOAD),
        (study.scatter(40, seed=3), "scatter", "--samples", "40", "--seed", "3"),
        (study.optimise(starts=2), "optimise", "--starts", "2"),
    ):
        name, *options = command
        printed = printed_json(name, cabin_folder, *changed, *options)
        assert_same(answer.to_dict(), printed)


def test_answers_print_what_the_command_line_prints(study, cabin_folder, capsys):
    for answer, command in (
        (study.modes(25), "modes"),
        (study.ride(), "psd"),
        (study.wheels(), "wheels"),
        (study.static(), "static"),
        (study.forces(), "forces"),
        (study.paths(), "paths"),
    ):
        capsys.readouterr()
        assert main([command, cabin_folder, "--set", "A.lateral=200 N/mm"]) == 0
        assert f"{answer!r}\n" == capsys.readouterr().out


def test_modes_iterate_are_found_and_become_arrays(study):
    modes = study.modes()
    prepared = prepare(mounted_cabin())
    results = solve(prepared, study.rates.by_group, Conditions("flat", 20.0))
    np.testing.assert_allclose(modes.frequency_hz, results.modes.frequency_hz, rtol=1e-9)
    assert [mode.frequency_hz for mode in modes] == modes.frequency_hz.tolist()
    assert modes["cab yaw"].number == modes.names.index("cab yaw") + 1
    assert modes[-1].name == modes.names[-1]
    assert modes.shapes.shape == (12, len(modes))
    np.testing.assert_array_equal(modes[2].shape, modes.shapes[:, 2])
    assert sum(modes[0].kinetic_energy.values()) == pytest.approx(1.0)
    assert modes.damped("cab yaw").damping_ratio == pytest.approx(
        modes["cab yaw"].damping_ratio, rel=0.1
    )
    assert len(study.modes(10)) == np.sum(modes.frequency_hz < 10)
    with pytest.raises(VehicleError, match="unknown mode 'cab jaw': did you mean 'cab yaw'"):
        modes["cab jaw"]


def test_modes_above_the_band_are_found_if_asked_for():
    study = cabin_study(highest_frequency=15.0)
    assert len(study.modes()) < len(study.modes(25)) == len(cabin_study().modes(25))


def test_a_ride_has_spectra_rms_values_peaks_and_a_rating(study):
    ride = study.ride("rough")
    prepared = prepare(mounted_cabin())
    results = solve(prepared, study.rates.by_group, Conditions("rough", 20.0))
    assert ride.rms("seat", "lateral") == pytest.approx(results.rms[0, 1], rel=1e-12)
    assert ride.rms("seat", "fore-aft") == pytest.approx(results.rms[0, 0], rel=1e-12)
    np.testing.assert_allclose(ride.psd("seat", "vertical"), results.psd[:, 0, 2], rtol=1e-12)
    within = ride.rms("seat", "vertical", (5, 15)) ** 2
    around = ride.rms("seat", "vertical", (0, 5)) ** 2 + ride.rms("seat", "vertical", (15, 40)) ** 2
    assert within + around == pytest.approx(ride.rms("seat", "vertical") ** 2, rel=1e-6)
    assert ride.rating == results.rating
    highest = max(ride.peaks("seat", "lateral"), key=lambda peak: peak.level)
    assert highest.level == pytest.approx(ride.psd("seat", "lateral").max(), rel=1e-12)
    assert highest.parts[0].name in study.modes().names
    assert highest.parts[0].ratio == 1.0
    assert ride.check().error < 1e-8
    assert ride.check().is_complete
    omega = 2 * np.pi * highest.frequency_hz
    shape = ride.shape(highest.frequency_hz, "seat", "lateral")
    seat = ride.results.prepared.outputs[1] @ shape
    assert (omega**2 * seat.real / 9.80665) ** 2 == pytest.approx(highest.level, rel=1e-9)


def test_wheel_loads_have_means_and_peaks(study):
    wheels = study.wheels()
    results = solve_wheels(prepare(mounted_cabin()), study.rates.by_group)
    assert wheels.loads == (LOAD,)
    found = wheels.mean(LOAD, "seat", "lateral", band_hz=(5, 9))
    assert found == pytest.approx(results.mean((5, 9))[0, 0, 1], rel=1e-12)
    highest = max(wheels.peaks(LOAD, "seat", "vertical"), key=lambda peak: peak.level)
    assert highest.level == pytest.approx(wheels.acceleration(LOAD, "seat", "vertical").max())
    with pytest.raises(VehicleError, match="unknown harmonic load 'rear'"):
        wheels.mean("rear", "seat", "lateral")


def test_a_sensitivity_is_what_ten_percent_of_a_rate_do(study):
    found, prepared = study.sensitivity(), prepare(mounted_cabin())
    results = solve(prepared, study.rates.by_group, Conditions("flat", 20.0))
    number = found.rates.index("B.lateral")
    yaw = results.mode_index("cab yaw")
    expected = 0.1 * study.rates["B.lateral"] * frequency_sensitivity(results)[yaw, number]
    assert found.of_mode("cab yaw")["B.lateral"] == pytest.approx(expected, rel=1e-9)
    slopes = ride_sensitivity(prepared, study.rates.by_group, Conditions("flat", 20.0)).rms[0, 2]
    expected = 0.1 * study.rates["B.lateral"] * slopes[number] / results.rms[0, 2]
    assert found.of_rms("seat", "vertical")["B.lateral"] == pytest.approx(expected, rel=1e-9)
    assert set(found.of_mode("cab yaw")) == set(found.rates) <= set(study.rates)


def test_a_search_finds_better_rates_and_leaves_those_of_the_study():
    study = cabin_study()
    found = study.optimise("cabin", starts=2)
    assert found.converged
    assert found.value < found.original
    assert study.rates.name == "original"
    study.rates.use(found.rates)
    assert found.objective(study.rates.by_group) == pytest.approx(found.value, rel=1e-9)
    assert found.history[-1, 1] == pytest.approx(found.value, rel=1e-12)
    assert (np.diff(found.history, axis=0)[:, 1] < 0).all()
    assert found.exact_difference < 1e-6
    assert found.limits


def test_a_search_everywhere_and_a_robust_one_find_something():
    study = cabin_study()
    everywhere = study.optimise(everywhere=True, budget=80)
    assert everywhere.value < everywhere.original
    robust = study.optimise(starts=1, budget=8, robust=mv.Tolerance(0.1, 0.1))
    assert robust.to_dict()["percentile"] == 95


def test_a_problem_is_itself_its_name_a_file_or_the_usual_one(tmp_path):
    study = cabin_study()
    problem = replace(study.vehicle.problems[0], name="own", goal="rms")
    assert study.optimise(problem, starts=1, budget=3).problem is problem
    with pytest.raises(VehicleError, match="unknown problem 'paper': there are cabin"):
        study.optimise("paper")
    with pytest.raises(ModevizError, match=r"none\.toml"):
        study.optimise(tmp_path / "none.toml")


def test_a_front_has_designs_between_two_goals():
    study = cabin_study()
    front = study.front("lateral against vertical", starts=1, budget=300)
    first, second = front.values.T
    assert (np.diff(first) > 0).all()
    assert (np.diff(second) < 0).all()
    assert len(front) == len(list(front)) == len(front.values)
    study.rates.use(front[0])
    with pytest.raises(ModevizError, match=r"unknown trade-off 'up against down': .*lateral against"):
        study.front("up against down")


def test_scatter_gives_each_vehicle():
    study = cabin_study()
    scattered = study.scatter(60, tolerance=mv.Tolerance(0.1, 0.2), seed=1)
    assert len(scattered) == len(scattered.rms("seat", "lateral")) == 60
    low, high = (scattered.psd_percentile(p, "seat", "lateral") for p in (5, 95))
    assert (low <= high).all()
    assert scattered.worst_goal >= scattered.goal.max()
    assert scattered.contributions == {}  # of too few samples
    shares = study.scatter(100, seed=1).contributions
    assert set(shares) == {mount.name for mount in study.vehicle.mounts}
    assert sum(map(sum, shares.values())) <= 1


def test_progress_is_told_what_is_done_and_how_far():
    told: list[tuple[str, float]] = []
    study = Study(cabin_study().vehicle, progress=lambda what, done: told.append((what, done)))
    study.ride()
    study.optimise(starts=2)
    study.scatter(20)
    words = {what.split(",")[0] for what, _ in told}
    assert {"preparing", "search 1 of 2", "search 2 of 2", "scattering"} <= words
    assert all(0 <= done <= 1 for _, done in told)


def test_ctrl_c_keeps_the_best_so_far(capfd):
    def interrupt(what: str, done: float) -> None:
        if what.startswith("search 3"):
            signal.raise_signal(signal.SIGINT)

    before = signal.getsignal(signal.SIGINT)
    found = Study(cabin_study().vehicle, progress=interrupt).optimise(starts=8)
    assert found.reason == "cancelled"
    assert found.value < found.original
    assert len(found.optimum.descents) < 8
    assert signal.getsignal(signal.SIGINT) is before
    assert "Ctrl+C again" in capfd.readouterr().err


def test_a_second_ctrl_c_interrupts():
    def interrupt(what: str, done: float) -> None:
        if what.startswith("search"):
            signal.raise_signal(signal.SIGINT)
            signal.raise_signal(signal.SIGINT)

    with pytest.raises(KeyboardInterrupt):
        Study(cabin_study().vehicle, progress=interrupt).optimise(starts=2)


def test_speed_is_a_number_or_a_text_and_tells_in_the_ride():
    study = cabin_study()
    slow = study.ride().rms("seat", "vertical")
    study.speed = "144 km/h"
    assert study.speed == pytest.approx(40.0)
    assert study.ride().speed == study.speed
    assert study.ride().rms("seat", "vertical") != pytest.approx(slow, rel=0.01)
    for wrong in (0, "0 km/h", float("inf"), "40 furlongs"):
        with pytest.raises(ModevizError, match=r"speed: found|speed: unknown unit"):
            study.speed = wrong


def test_a_folder_a_vehicle_and_nothing_are_studied(cabin_folder, tmp_path):
    assert Study(cabin_folder).vehicle.name == Study(mounted_cabin()).vehicle.name == "cabin"
    assert mv.Study().vehicle.name == mv.read_vehicle(mv.builtin_vehicle()).name
    with pytest.raises(VehicleError, match="nothing-here"):
        Study(tmp_path / "nothing-here")


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda study: study.ride(), "has no road: give its vehicle.toml a"),
        (lambda study: study.wheels(), "has no response point"),
        (lambda study: study.scatter(), "has no mount group"),
        (lambda study: study.sensitivity(), "has no mount group"),
        (lambda study: study.optimise(), "nothing to optimise for"),
        (lambda study: study.modes(-1), "below_hz: found -1"),
        (lambda study: study.render("yaw.txt"), "expected a name that ends in .png"),
        (lambda study: study.render("yaw.png", amplitude=11), "amplitude: found 11"),
    ],
)
def test_what_a_vehicle_lacks_is_said(ask, sentence, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    block = RigidBody("block", "frame", "block", 1.0, np.zeros(3), np.eye(3))
    with pytest.raises(ModevizError) as lacking:
        ask(Study(Vehicle("block", (block,), ())))
    assert sentence in str(lacking.value)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize(
    ("ask", "sentence"),
    [
        (lambda study: study.optimise(starts=0), "starts: found 0, expected 1 to "),
        (lambda study: study.optimise(budget=0), "budget: found 0, expected 1 or more"),
        (lambda study: study.optimise(seed=-1), "seed: found -1, expected 0 or more"),
        (lambda study: study.scatter(1), "samples: found 1, expected 2 to 1000000"),
        (lambda study: study.scatter(9, point="roof"), "unknown response point 'roof'"),
        (lambda study: study.ride("gravel"), "unknown random load 'gravel': there are flat, rough"),
        (lambda study: study.ride().rms("roof", "lateral"), "unknown response point 'roof'"),
        (lambda study: study.ride().rms("seat", "sideways"), "unknown direction 'sideways'"),
    ],
)
def test_what_is_asked_for_wrongly_is_said(study, ask, sentence):
    with pytest.raises(ModevizError) as refused:
        ask(study)
    assert sentence in str(refused.value)


def test_a_report_compares_the_present_rates(study, tmp_path):
    written = study.report(tmp_path / "report.html", against="soft", pictures=False)
    html = written.path.read_text()
    assert "original, changed against soft" in html
    assert "Acceleration at seat" in html
    with pytest.raises(VehicleError, match="unknown rates 'none'"):
        study.report(tmp_path / "other.html", against="none")


def test_a_study_says_what_there_is_to_ask_for(study):
    words = repr(study)
    for word in (
        "cabin",
        "A, B",
        "original, changed, of original, soft",
        "seat",
        "flat, rough",
        "72 km/h",
    ):
        assert word in words


def test_a_method_that_is_not_there_is_refused_with_those_there_are():
    with pytest.raises(
        ModevizError, match=r"unknown method 'exat'.*there are enriched, classic, exact"
    ):
        cabin_study().modes(method="exat")


def test_a_vehicle_and_a_problem_are_written_and_read_by_paths_in_words(tmp_path):
    folder, file = str(tmp_path / "cabin"), tmp_path / "problem.toml"
    vehicle = cabin_study().vehicle
    mv.write_vehicle(vehicle, folder)
    assert mv.read_vehicle(folder).rates == vehicle.rates
    file.write_text(problem_text(vehicle.problems[0]), encoding="utf-8")
    assert mv.read_problem(str(file), vehicle).name == vehicle.problems[0].name


def test_an_absorber_is_tuned_to_a_mode_and_becomes_a_group_of_the_study():
    study = cabin_study()
    f = study.modes()["cab lateral"].frequency_hz
    roof = study.tuned_absorber(
        "roof", "cab", (0.2, 0, 1.4), 5.0, mode="cab lateral", directions=("lateral",)
    )
    assert 0.8 * f < roof.frequency_hz < f
    tuned = mv.Study(mv.with_absorbers(study.vehicle, [roof]))
    assert tuned.rates["roof.lateral"] == pytest.approx(5.0 * (2 * np.pi * roof.frequency_hz) ** 2)
    assert "roof lateral" in tuned.modes().names
    with pytest.raises(VehicleError, match="unknown mode 'cab roll over'"):
        study.tuned_absorber("roof", "cab", (0.2, 0, 1.4), 5.0, mode="cab roll over")
