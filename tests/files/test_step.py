"""STEP files become triangles in the unit that they say, in a process that may fail as it likes."""

import re
import subprocess
import time

import numpy as np
import pytest
from step_files import box_step

from modeviz.errors import VehicleError
from modeviz.files.mesh_formats import step
from modeviz.files.meshes import read_mesh

LOW, HIGH = (100.0, -20.0, 0.0), (500.0, 200.0, 100.0)


@pytest.fixture
def read(tmp_path):
    def reader(content: bytes, suffix: str = ".step", **how):
        (tmp_path / f"a{suffix}").write_bytes(content)
        return read_mesh(tmp_path / f"a{suffix}", **how)

    return reader


@pytest.mark.parametrize(("unit", "length"), [("mm", 1e-3), ("m", 1.0)])
def test_a_solid_is_as_large_and_where_its_file_says(read, unit, length):
    (part,) = read(box_step(LOW, HIGH, unit))
    np.testing.assert_allclose(part.vertices.min(axis=0), length * np.array(LOW), rtol=1e-6)
    np.testing.assert_allclose(part.vertices.max(axis=0), length * np.array(HIGH), rtol=1e-6)
    a, b, c = part.vertices[part.faces].transpose(1, 0, 2)
    volume = np.einsum("ij,ij->", a, np.cross(b, c)) / 6
    assert volume == pytest.approx(400 * 220 * 100 * length**3, rel=1e-6)


def test_the_other_ending_is_read_too_and_nothing_is_printed(read, capfd):
    assert len(read(box_step(LOW, HIGH), ".stp")) == 1
    assert capfd.readouterr() == ("", "")


WRONG = {
    "cut": (box_step(LOW, HIGH)[:1500], "found no solid or surface that can be drawn"),
    "nothing": (b"", "found no STEP file, which begins with 'ISO-10303-21'"),
    "another format": (b"solid a\nendsolid", "found no STEP file"),
    "a head alone": (b"ISO-10303-21;\n", "found no solid"),
    "an unknown entity": (
        box_step(LOW, HIGH).replace(b"CARTESIAN_POINT", b"CARTESIAN"),
        "found no solid",
    ),
}


@pytest.mark.parametrize("case", WRONG)
def test_a_wrong_file_is_explained_in_seconds(read, case, capfd):
    content, words = WRONG[case]
    start = time.monotonic()
    with pytest.raises(VehicleError) as caught:
        read(content)
    assert time.monotonic() - start < 10
    assert words in str(caught.value)
    assert "\n" not in str(caught.value)
    assert "\x1b" not in str(caught.value)
    assert capfd.readouterr() == ("", "")


def test_what_takes_too_long_is_given_up(read, monkeypatch):
    monkeypatch.setattr(step, "CONVERT", "import time; time.sleep(60)")
    monkeypatch.setattr(step, "LONGEST_SECONDS", 1)
    with pytest.raises(VehicleError, match="takes longer than 1 s to be made triangles"):
        read(box_step(LOW, HIGH))


def test_a_crash_is_one_sentence(read, monkeypatch):
    monkeypatch.setattr(step, "CONVERT", "import os; os.abort()")
    with pytest.raises(VehicleError, match="found no solid or surface that can be drawn"):
        read(box_step(LOW, HIGH))


def test_without_the_extra_it_is_said_what_to_install(read, monkeypatch):
    monkeypatch.setattr(step, "find_spec", lambda _: None)
    with pytest.raises(VehicleError, match=r"pip install 'modeviz\[step\]'"):
        read(box_step(LOW, HIGH))


def test_a_module_of_that_name_in_the_folder_is_not_run(read, tmp_path, monkeypatch):
    (tmp_path / "cascadio.py").write_text("raise SystemExit('run')")
    monkeypatch.chdir(tmp_path)
    assert len(read(box_step(LOW, HIGH))) == 1


def test_the_process_is_held_to_its_memory(monkeypatch, read):
    held = []
    run = subprocess.run

    def noted(command, **how):
        held.append(int(re.findall(r"RLIMIT_AS, \((\d+),", command[3])[0]))
        return run(command, **how)

    monkeypatch.setattr(step.subprocess, "run", noted)
    read(box_step(LOW, HIGH))
    assert held == [step.MOST_MEMORY]
