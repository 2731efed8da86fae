"""What is printed: letters that are there, nothing that a terminal obeys, and word of what fails."""

import io
import json
import subprocess
import sys
from dataclasses import replace

import pytest
from cabin_problem import PROBLEM
from mounted_cabin import mounted_cabin
from shared_preparations import shared_preparations

from modeviz.cli import main
from modeviz.cli.streams import CONTROL, Printed, plain, printable
from modeviz.cli.terminal import remark
from modeviz.files import write_vehicle
from modeviz.files.rate_files import read_rates
from modeviz.report.tables import table

HOSTILE = "\x1b]0;taken\x07 \x9b31m\u202e"
"""Renames the window, then colours what follows and has it read from the right."""

COMMANDS = [
    ["modes"], ["modes", "--json"], ["psd"], ["wheels"], ["scatter", "--samples", "20"],
    ["optimise", "--starts", "1"], ["optimise", "--front", "lateral against vertical", "--starts", "1"],
]  # fmt: skip


@pytest.fixture(scope="module")
def hostile(tmp_path_factory):
    """The small cabin with names in letters of all kinds and some that are none."""
    cabin = mounted_cabin()
    bodies = (replace(cabin.bodies[0], label=f"Führerhaus {HOSTILE}"), *cabin.bodies[1:])
    front, rear = cabin.mount_groups
    groups = (replace(front, label=f"vorn {HOSTILE}"), rear)
    points = tuple(replace(p, name=f"Sitz − {HOSTILE}") for p in cabin.response_points)
    vehicle = replace(
        cabin, name=f"Kabine φ {HOSTILE}", bodies=bodies, mount_groups=groups, response_points=points
    )
    folder = tmp_path_factory.mktemp("vehicles") / "cabin"
    write_vehicle(replace(vehicle, problems=(PROBLEM,)), folder)
    with shared_preparations():
        yield str(folder)


def printed(monkeypatch, encoding, *arguments):
    """What a command prints on a stream of that encoding."""
    stream = io.TextIOWrapper(io.BytesIO(), encoding=encoding)
    monkeypatch.setattr("sys.stdout", stream)
    assert main(arguments) == 0
    stream.flush()
    return stream.buffer.getvalue().decode(encoding)


@pytest.mark.parametrize("encoding", ["utf-8", "ascii", "latin-1", "cp1252"])
@pytest.mark.parametrize("command", COMMANDS, ids=" ".join)
def test_every_command_prints_with_the_letters_there_are(monkeypatch, hostile, encoding, command):
    text = printed(monkeypatch, encoding, command[0], hostile, *command[1:])
    assert len(text.splitlines()) > 2
    assert not CONTROL.search(text)


@pytest.mark.parametrize("encoding", ["utf-8", "ascii"])
def test_json_has_its_names_to_the_letter(monkeypatch, hostile, encoding):
    record = json.loads(printed(monkeypatch, encoding, "psd", hostile, "--json"))
    assert record["responses"][0]["point"] == f"Sitz − {HOSTILE}"


def test_control_characters_are_shown_as_their_codes():
    assert printable(f"a\tb\n{HOSTILE}\r") == ("a\tb\n\\u001b]0;taken\\u0007 \\u009b31m\\u202e\\u000d")
    assert printable("folder \udcff") == "folder \\udcff"


@pytest.mark.parametrize(
    ("encoding", "text"),
    [
        ("utf-8", "−3.1 % ±2 × φ² ü日 10⁻¹⁴"),
        ("ascii", "-3.1 % +/-2 x phi2 u? 10^-14"),
        ("latin-1", "-3.1 % ±2 × phi² ü? 10^-14"),
    ],
)
def test_plain_letters_stand_for_those_that_lack(encoding, text):
    assert plain("−3.1 % ±2 × φ² ü日 10⁻¹⁴", encoding) == text


@pytest.mark.parametrize(
    "arguments",
    [
        ["modes", f"no {HOSTILE}"],
        ["modes", "{}", "--rates", HOSTILE],
        ["modes", "{}", "--set", f"{HOSTILE}.lateral=1 N/mm"],
        ["optimise", "{}", "--problem", HOSTILE],
        ["render", "{}", "--output", HOSTILE],
        ["view", "{}", "--road", HOSTILE],
    ],
)
def test_errors_are_one_line_that_no_terminal_obeys(capsys, hostile, arguments):
    assert main([a.format(hostile) for a in arguments]) == 2
    error = capsys.readouterr().err
    assert error.count("\n") == 1
    assert not CONTROL.search(error)


def test_what_the_parser_refuses_is_cleaned_too(capsys):
    with pytest.raises(SystemExit):
        main(["modes", "--method", HOSTILE])
    assert not CONTROL.search(capsys.readouterr().err)


def test_a_line_end_in_a_message_makes_no_second_line(capsys):
    assert main(["modes", "there\nmodeviz: all is well"]) == 2
    assert capsys.readouterr().err.count("\n") == 1


def test_a_line_end_in_a_name_makes_no_row_of_its_own():
    rows = table(["a", "b"], [["x\ny", "1"]]).splitlines()
    assert [line.split() for line in rows] == [["a", "b"], ["------"], ["x", "y", "1"]]


def test_a_line_end_in_a_note_makes_no_second_line(capsys):
    remark("body 'a\nmodeviz: all is well'")
    assert capsys.readouterr().err == "modeviz: note: body 'a modeviz: all is well'\n"


def shell(line, *arguments):
    """A shell that runs modeviz in such a line."""
    command = line.replace("MODEVIZ", f"'{sys.executable}' -m modeviz \"$@\"")
    return subprocess.run(["sh", "-c", command, "sh", *arguments], capture_output=True, text=True)


@pytest.mark.parametrize(
    ("line", "why"),
    [("MODEVIZ > /dev/full", "No space left on device"), ("MODEVIZ >&-", "it is closed")],
)
def test_what_cannot_be_printed_is_said_and_what_can_be_written_is(tmp_path, hostile, line, why):
    path = tmp_path / "rates.json"
    run = shell(line, "optimise", hostile, "--starts", "1", "--output", str(path))
    assert run.returncode == 2
    table, sentence = run.stderr.rstrip("\n").rsplit("\n", 1)
    assert sentence == f"modeviz: standard output cannot be written ({why})"
    assert "objective" in table
    assert read_rates(path, mounted_cabin())


@pytest.fixture
def full():
    """A stream that takes nothing."""
    with open("/dev/full", "w", encoding="utf-8") as full:
        yield full


@pytest.mark.parametrize("command", ["modes", "psd", "wheels", "scatter", "optimise"])
def test_what_has_nowhere_to_be_printed_is_not_computed(monkeypatch, capsys, full, command):
    for stream, why in ((full, "No space left on device"), (None, "it is closed")):
        monkeypatch.setattr("sys.stdout", stream)
        assert main([command, "no vehicle is looked at"]) == 2
        sentence = f"modeviz: standard output cannot be written ({why})\n"
        assert capsys.readouterr().err == sentence


@pytest.mark.parametrize("options", [[], ["--json"]], ids=["table", "json"])
def test_what_cannot_be_printed_at_the_end_goes_where_errors_go(tmp_path, hostile, capsys, options):
    line = f"ulimit -f 0; MODEVIZ > '{tmp_path}/result'"
    run = shell(line, "modes", hostile, *options)
    assert main(["modes", hostile, *options]) == 0
    sentence = "modeviz: standard output cannot be written (File too large)\n"
    assert (run.returncode, run.stderr) == (2, capsys.readouterr().out + sentence)


def test_results_do_not_need_somewhere_for_errors(monkeypatch, capsys, full, hostile):
    for stream in (full, None):
        monkeypatch.setattr("sys.stderr", stream)
        assert main(["modes", hostile]) == 0
        assert "Hz" in capsys.readouterr().out


def test_an_error_that_nobody_can_read_is_still_a_status(monkeypatch, capsys, full, tmp_path):
    for stream in (full, None):
        monkeypatch.setattr("sys.stderr", stream)
        assert main(["modes", str(tmp_path)]) == 2
        assert capsys.readouterr().out == ""


@pytest.mark.parametrize(
    ("line", "folder", "status"), [("MODEVIZ 2>&-", "{}", 0), ("MODEVIZ >&- 2>&-", "nowhere", 2)]
)
def test_a_program_without_a_stream_for_errors_has_its_status(hostile, line, folder, status):
    run = shell(line, "modes", folder.format(hostile))
    assert (run.returncode, run.stderr) == (status, "")
    assert ("Hz" in run.stdout) == (status == 0)


def test_the_line_of_the_server_is_cleaned_too(hostile):
    command = [sys.executable, "-u", "-m", "modeviz", "view", hostile, "--port", "0"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as run:
        assert run.stdout
        line = run.stdout.readline()
        run.kill()
    assert line.startswith("Kabine φ \\u001b]0;taken")
    assert "http://127.0.0.1:" in line
    assert not CONTROL.search(line.removesuffix("\n"))


def test_a_stream_says_which_letters_it_has():
    assert Printed(io.TextIOWrapper(io.BytesIO(), encoding="ascii")).encoding == "ascii"
    assert Printed(None).encoding == "utf-8"
    assert not Printed(None).isatty()
