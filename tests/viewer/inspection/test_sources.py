"""Which folders open as a vehicle, which body by body, and what these say is missing."""

import shutil

import pytest
from mounted_cabin import mounted_cabin
from network_files import network_unv

from modeviz.cli import main
from modeviz.errors import VehicleError
from modeviz.files import builtin_vehicle, write_vehicle
from modeviz.viewer.inspection.sources import ResultFiles, VehicleFolder, finished_vehicle


@pytest.fixture
def imported(tmp_path):
    """A folder with one body that was just imported."""
    file = tmp_path / "network.unv"
    file.write_text(network_unv(), encoding="utf-8")
    folder = tmp_path / "imported"
    arguments = ["--output", str(folder), "--units", "mm-t-s", "--attach", "corner=11"]
    assert main(["import", str(file), *arguments]) == 0
    return folder


def test_a_vehicle_with_connections_is_finished(tmp_path):
    write_vehicle(mounted_cabin(), tmp_path / "cabin")
    assert finished_vehicle(tmp_path / "cabin") is not None


def test_bodies_that_nothing_connects_are_looked_at(imported):
    assert finished_vehicle(imported) is None
    content = VehicleFolder(imported).read()
    (subject,) = content.subjects
    assert [mark.name for mark in subject.marks] == ["corner"]
    words = " ".join(content.missing)
    assert "[[mount_group]]" in words
    assert "[[response_point]]" in words


def test_a_vehicle_with_a_mistake_is_looked_at_and_the_mistake_is_said(tmp_path):
    folder = tmp_path / "truck"
    shutil.copytree(builtin_vehicle(), folder)
    file = folder / "vehicle.toml"
    file.write_text(file.read_text("utf-8").replace("at = [", "ta = [", 1), encoding="utf-8")
    assert finished_vehicle(folder) is None
    content = VehicleFolder(folder).read()
    assert len(content.subjects) > 5
    assert content.missing[0].startswith("vehicle.toml")
    assert "'ta'" in content.missing[0]


def test_a_missing_file_of_modes_leaves_the_other_bodies(tmp_path):
    folder = tmp_path / "truck"
    shutil.copytree(builtin_vehicle(), folder)
    (folder / "bodies" / "cab.npz").unlink()
    names = {subject.name for subject in VehicleFolder(folder).read().subjects}
    assert "frame" in names
    assert "cab" not in names


def test_an_empty_folder_waits_for_files(tmp_path):
    assert finished_vehicle(tmp_path) is None
    content = VehicleFolder(tmp_path).read()
    assert content.subjects == ()
    assert "drop" in content.missing[0]


@pytest.mark.parametrize("text", [None, "name = ", 'name = "nothing"\n[units]\nlength = "m"\n'])
def test_without_a_body_it_is_an_error(tmp_path, text):
    folder = tmp_path / "none"
    folder.mkdir()
    (folder / "notes.txt").write_text("hello", encoding="utf-8")
    if text is not None:
        (folder / "vehicle.toml").write_text(text, encoding="utf-8")
    with pytest.raises(VehicleError, match=r"vehicle\.toml"):
        finished_vehicle(folder)


def test_files_say_how_they_become_a_vehicle(tmp_path):
    file = tmp_path / "network.unv"
    file.write_text(network_unv(), encoding="utf-8")
    content = ResultFiles((file,)).read()
    assert "modeviz import network.unv --output" in content.missing[0]
    assert content.subjects[0].modes[6].frequency_hz > 0


def test_a_finished_vehicle_says_how_it_is_tuned(tmp_path):
    write_vehicle(mounted_cabin(), tmp_path / "cabin")
    content = VehicleFolder(tmp_path / "cabin").read()
    assert content.missing[0] == f"All is there: modeviz view {tmp_path / 'cabin'} opens it for tuning."


def test_nothing_is_put_into_the_truck_that_comes_along():
    assert VehicleFolder(builtin_vehicle(), is_ours=True).folder is None
