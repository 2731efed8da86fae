import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from threadpoolctl import threadpool_info, threadpool_limits

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions, solve
from modeviz.cli import main
from modeviz.cli.command import Command
from modeviz.cli.export import EXPORT
from modeviz.cli.importing.command import IMPORT
from modeviz.cli.new import NEW
from modeviz.cli.parser import COMMANDS, parse
from modeviz.cli.render import RENDER
from modeviz.cli.scatter import ScatterCommandOptions
from modeviz.cli.studies.study import STUDY
from modeviz.dynamics.assembly import assemble
from modeviz.dynamics.modes import solve_modes
from modeviz.files import write_vehicle
from modeviz.vehicle.connections import Tyre
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.placement import Placement, with_placements


def test_modes_prints_a_table(capsys, folder):
    assert main(["modes", folder]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert "Hz" in lines[0]
    assert any("cab yaw" in line for line in lines)


def test_modes_json_has_its_documented_structure(printed_json, folder):
    record = printed_json("modes", folder, "--below", "60")
    assert set(record) == {"vehicle", "rates", "n_missed", "modes", "original", "components"}
    assert record["n_missed"] == 0
    assert record["vehicle"] == "cabin"
    own = {"vertical": 800.0, "lateral": 300.0, "fore_aft": 400.0, "loss_factor": 0.15}
    assert record["rates"]["A"] == own
    for number, mode in enumerate(record["modes"], start=1):
        assert mode["number"] == number
        assert set(mode) == {
            "number", "frequency_hz", "frequency_error_hz", "damping_ratio", "name", "name_score",
            "kinetic_energy", "strain_energy",
            "dissipated_energy",
        }  # fmt: skip
        assert sum(mode["kinetic_energy"].values()) == pytest.approx(1.0)
        assert sum(mode["strain_energy"].values()) == pytest.approx(1.0)
        assert set(mode["strain_energy"]) == {"A", "B", "tyres"}


def test_commands_have_one_thread_for_linear_algebra(monkeypatch, folder):
    found = []

    def note():
        found.extend(p["num_threads"] for p in threadpool_info() if p["user_api"] == "blas")

    monkeypatch.setattr("modeviz.cli.psd.check_printable", note)
    with threadpool_limits(2, user_api="blas"):
        main(["psd", folder])
    assert set(found) == {1}


def test_psd_json_is_the_solution_of_the_tuned_vehicle(printed_json, folder):
    record = printed_json(
        "psd", folder, "--rates", "soft", "--set", "B.fore-aft=131 N/mm",
        "--set", "B.loss_factor=0.3", "--road", "rough", "--speed", "90 km/h",
    )  # fmt: skip
    assert set(record) == {
        "vehicle", "rates", "road", "speed_m_per_s", "band_hz", "known_hz", "frequency_hz",
        "responses", "rating",
    }  # fmt: skip
    rates = {"A": MountRates(2e5, 1e5, 1e5), "B": MountRates(8e5, 3e5, 1.31e5, 0.3)}
    assert [record["rates"][group]["loss_factor"] for group in "AB"] == [0.15, 0.3]
    expected = solve(prepare(mounted_cabin()), rates, Conditions("rough", 25.0))
    by_direction = {r["direction"]: r for r in record["responses"]}
    assert {r["point"] for r in record["responses"]} == {"seat"}
    for direction in ("vertical", "lateral", "fore-aft"):
        psd = by_direction[direction]["psd_g2_per_hz"]
        np.testing.assert_allclose(psd, expected.response(0, direction), rtol=1e-9)
    assert by_direction["lateral"]["rms_g"] == pytest.approx(expected.rms[0, 1])
    assert record["rating"]["mean_personal_rating"] == pytest.approx(
        expected.rating.mean_personal_rating
    )


def test_modes_with_mounts_elsewhere_are_those_of_the_vehicle_with_these(capsys, printed_json, folder):
    record = printed_json("modes", folder, "--place", "A=40,20,0 mm", "--place", "A=0,30,0 deg")
    placed = {"A": Placement((0.04, 0.02, 0), (0, np.radians(30), 0))}
    expected = solve_modes(assemble(with_placements(mounted_cabin(), placed)), below_hz=40.0)
    found = [mode["frequency_hz"] for mode in record["modes"]]
    assert found == pytest.approx(expected.frequency_hz, rel=1e-9)
    given = solve_modes(assemble(mounted_cabin()), below_hz=40.0).frequency_hz
    assert np.abs(found / given - 1).max() > 1e-4
    originally = [mode["frequency_hz"] for mode in record["original"]]
    assert originally == pytest.approx(given, rel=1e-9)


def test_wheels_json_has_a_response_for_every_load(printed_json, folder):
    record = printed_json("wheels", folder)
    (load,) = record["loads"]
    assert (load["kind"], load["tyre"], load["amplitude"]) == ("radial force", "tyre 0.0 -0.7", 50.0)
    assert [r["direction"] for r in load["responses"]] == ["vertical", "lateral", "fore-aft"]
    assert len(load["responses"][0]["acceleration_g"]) == len(record["frequency_hz"])


@pytest.mark.parametrize("command", ["psd", "wheels"])
def test_tables_name_points_and_directions(capsys, folder, command):
    assert main([command, folder]) == 0
    out = capsys.readouterr().out
    assert "seat" in out
    assert "lateral" in out


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["modes", "no/such/folder"], "no/such/folder"),
        (["modes", "{}", "--rates", "hard"], "there are original, soft, or give"),
        (["modes", "{}", "--set", "C9.lateral=131 N/mm"], "unknown mount group 'C9'"),
        (["modes", "{}", "--set", "A.sideways=131 N/mm"], "unknown direction 'sideways'"),
        (["modes", "{}", "--set", "A.lateral=131"], "without a unit"),
        (["modes", "{}", "--place", "A=1,2 mm"], "expected GROUP=X,Y,Z UNIT"),
        (["modes", "{}", "--place", "C9=1,2,3 mm"], "unknown mount group 'C9'"),
        (["modes", "{}", "--set", "A.lateral=131 N/furlong"], "unit of stiffness"),
        (["modes", "{}", "--set", "A.lateral=-5 N/mm"], "zero or more"),
        (["modes", "{}", "--set", "A.lateral=nan N/mm"], "expected a number"),
        (["psd", "{}", "--road", "moon"], "unknown random load 'moon'"),
        (["psd", "{}", "--road", "ISO K"], "road 'ISO K': found 'K', expected a class from A to H"),
        (["psd", "{}", "--speed", "0 km/h"], "more than zero"),
        (["psd", "{}", "--speed", "fast"], "--speed: found 'fast'"),
        (["psd", "{}", "--speed", "9000000 km/h"], "its table holds"),
        (["modes", "{}", "--below", "nan"], "--below: found nan Hz"),
        (["modes", "{}", "--below", "inf"], "--below: found inf Hz"),
        (["view", "{}", "--port", "99999999"], "expected 0 to 65535"),
        (["view", "{}", "--port", "-1"], "expected 0 to 65535"),
        (["view", "{}", "--port", "0", "--speed", "9000000 km/h"], "its table holds"),
    ],
)
def test_what_the_user_can_put_right_is_one_message_and_status_2(capsys, folder, arguments, message):
    assert main([a.format(folder) for a in arguments]) == 2
    captured = capsys.readouterr()
    assert captured.out == ""
    assert message in captured.err
    assert captured.err.startswith("modeviz: ")
    assert captured.err.count("\n") == 1


@pytest.mark.parametrize(
    ("command", "field", "message"),
    [
        ("psd", "response_points", "has no response point"),
        ("wheels", "response_points", "has no response point"),
        ("wheels", "wheel_loads", "has no wheel load: give its vehicle.toml a [[wheel_load]]"),
    ],
)
def test_a_vehicle_without_what_a_command_shows_is_refused(tmp_path, capsys, command, field, message):
    write_vehicle(replace(mounted_cabin(), **{field: ()}), tmp_path / "bare")
    assert main([command, str(tmp_path / "bare")]) == 2
    assert message in capsys.readouterr().err


@pytest.mark.parametrize("arguments", [[], ["--road", "ISO A"]])
def test_a_vehicle_without_roads_is_driven_over_those_of_iso_8608(tmp_path, printed_json, arguments):
    """Class C, unless asked otherwise, whose spectra are 16 times those of class A."""
    write_vehicle(replace(mounted_cabin(), roads=()), tmp_path / "bare")
    usual = printed_json("psd", str(tmp_path / "bare"), "--road", "ISO 8608 256 cm³")
    found = printed_json("psd", str(tmp_path / "bare"), *arguments)
    assert found["road"] == (arguments[-1] if arguments else "ISO C")
    ratio = 0.25 if arguments else 1.0
    for response, expected in zip(found["responses"], usual["responses"], strict=True):
        assert response["rms_g"] == pytest.approx(ratio * expected["rms_g"], rel=1e-6)


def test_a_vehicle_without_tyres_is_told_what_it_needs_to_be_driven(tmp_path, capsys):
    cabin = mounted_cabin()
    rest = tuple(c for c in cabin.connections if not isinstance(c, Tyre))
    write_vehicle(replace(cabin, roads=(), wheel_loads=(), connections=rest), tmp_path / "bare")
    assert main(["psd", str(tmp_path / "bare"), "--road", "ISO C"]) == 2
    assert "has no road: give its vehicle.toml a [[tyre]]" in capsys.readouterr().err


def test_a_reader_that_has_enough_is_no_error(folder):
    command = [sys.executable, "-m", "modeviz", "psd", folder, "--json"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        assert run.stdout
        assert run.stderr
        run.stdout.readline()
        run.stdout.close()
        assert run.stderr.read() == ""
    assert run.returncode == 0


INTERRUPTED_IMPORT = """
import runpy, signal, sys

class Interrupt:
    def find_spec(self, name, path=None, target=None):
        if name == module:
            signal.raise_signal(signal.SIGINT)

module = sys.argv.pop(1)
sys.meta_path.insert(0, Interrupt())
runpy.run_module("modeviz", run_name="__main__", alter_sys=True)
"""


@pytest.mark.parametrize("module", ["modeviz.cli.parser", "numpy", "scipy.optimize", "viser"])
def test_an_interrupt_of_imports_ends_the_program_quietly(folder, module):
    command = [sys.executable, "-c", INTERRUPTED_IMPORT, module, "view", folder]
    run = subprocess.run(command, capture_output=True, text=True)
    assert (run.returncode, run.stdout, run.stderr) == (130, "", "modeviz: interrupted\n")


def test_the_program_ends_with_that_status_and_no_traceback(folder):
    command = [sys.executable, "-m", "modeviz", "modes", folder, "--rates", "hard"]
    run = subprocess.run(command, capture_output=True, text=True)
    assert run.returncode == 2
    assert "Traceback" not in run.stderr


def test_what_a_command_cannot_do_without_is_status_2_too(capsys):
    with pytest.raises(SystemExit) as end:
        main(["render"])
    assert end.value.code == 2


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["optimize", "X"], "unknown command 'optimize': did you mean 'optimise'? there are view, "),
        (
            ["import", "x.op2", "--attch", "1"],
            "unknown option '--attch': did you mean '--attach'?",
        ),
        (["import", "--unit=mm-t-s", "x.op2"], "unknown option '--unit': did you mean '--units'?"),
        (["import", "x.op2", "--nam", "cab"], "unknown option '--nam': did you mean '--name'?"),
        (["modes", "--no-such-option"], "modes: unknown option '--no-such-option': there are --help, "),
        (["--prot", "0"], "modeviz view: unknown option '--prot': did you mean '--port'?"),
        (["check", "nosuch"], "nosuch: there is no such folder"),
        (["modes", "nosuch"], "nosuch: there is no such folder"),
        (["check", "x.op2"], "x.op2: is a file, expected the folder of a vehicle; modeviz view looks"),
        (["modes", "vehicle.toml"], "vehicle.toml: is a file, expected the folder of a vehicle; give"),
        (["view", "x.frd"], "x.frd: found '.frd', expected one of .unv"),
        (["check", "x.f06"], "x.f06: is a file, expected the folder of a vehicle; modeviz view looks"),
        (["view", "x.stl"], "x.stl: is a mesh, which has no modes"),
    ],
)
def test_what_is_likely_meant_is_said(tmp_path, monkeypatch, capsys, arguments, message):
    monkeypatch.chdir(tmp_path)
    for name in ("x.op2", "x.f06", "x.frd", "x.stl", "vehicle.toml"):
        (tmp_path / name).touch()
    assert main(arguments) == 2
    said = capsys.readouterr()
    assert message in said.out + said.err


def test_a_folder_that_is_called_like_a_command_is_opened(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "mode").mkdir()
    (tmp_path / "mode" / "vehicle.toml").write_text("name = 3")
    assert main(["mode"]) == 2
    assert "vehicle.toml" in capsys.readouterr().err


NEEDED = {
    RENDER.name: (["--output", "x.png"], {"output": Path("x.png")}),
    IMPORT.name: (["x.unv"], {"files": (Path("x.unv"),)}),
    EXPORT.name: (["x.csv"], {"files": (Path("x.csv"),)}),
    NEW.name: (["cab", "x"], {"kind": "cab", "folder": Path("x")}),
    "serve": (["x"], {"folders": (Path("x"),)}),
    "study note": (["x", "soft"], {"study": Path("x"), "text": "soft"}),
    "study export": (["x", "y.json"], {"study": Path("x"), "file": Path("y.json")}),
    "study diff": (["x", "y"], {"first": Path("x"), "second": Path("y")}),
    "study backup": (["x", "y"], {"study": Path("x"), "to": Path("y")}),
}
"""What a command cannot do without, as it is typed and as an option."""


def test_what_is_not_given_is_as_the_options_of_a_command_say():
    alone = [(each.name, each) for each in COMMANDS if isinstance(each, Command)]
    behind = [(f"{STUDY.name} {each.name}", each) for each in STUDY.commands]
    for words, command in (*alone, *behind):
        given, needed = NEEDED.get(words, ([], {}))
        assert parse([*words.split(), *given]).args == (command.options(**needed),)


def test_a_command_that_a_group_does_not_have_is_said_with_the_one_that_is_meant(capsys):
    assert main(["study", "lgo"]) == 2
    expected = "unknown command of study 'lgo': did you mean 'log'? there are log, note, export"
    assert expected in capsys.readouterr().err
    assert main(["study", "log", "--sesion", "1"]) == 2
    assert "modeviz study log: unknown option '--sesion'" in capsys.readouterr().err


def test_options_are_read_by_the_names_and_types_of_their_fields():
    given = "cabin --set A.lateral=1 --set B.lateral=2 --speed 20 --samples 30 --point seat --json"
    (options,) = parse(["scatter", *given.split()]).args
    expected = ScatterCommandOptions(
        vehicle=Path("cabin"),
        settings=("A.lateral=1", "B.lateral=2"),
        speed="20",
        samples=30,
        point="seat",
        json=True,
    )
    assert options == expected
