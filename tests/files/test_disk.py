import os
from pathlib import Path

import pytest

from modeviz.errors import VehicleError
from modeviz.files.disk import check_writable, read_bytes, write_bytes, write_text


def test_a_file_is_written_anew_and_nothing_stays_beside_it(tmp_path):
    path = tmp_path / "out.html"
    path.write_bytes(b"old and longer")
    write_text(path, "φ\n")
    assert path.read_bytes() == "φ\n".encode()
    assert os.listdir(tmp_path) == ["out.html"]


def test_a_write_that_fails_leaves_what_was_there(tmp_path, monkeypatch):
    path = tmp_path / "out.html"
    path.write_text("old")

    def full(self, content):
        raise OSError("no space left")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(VehicleError, match=r"out\.html: cannot be written \(no space left\)"):
        write_bytes(path, b"new")
    assert path.read_text() == "old"
    assert os.listdir(tmp_path) == ["out.html"]


def test_what_a_link_points_to_is_written_and_the_link_stays(tmp_path):
    (tmp_path / "link").symlink_to(tmp_path / "file")
    write_text(tmp_path / "link", "new")
    assert (tmp_path / "link").is_symlink()
    assert (tmp_path / "file").read_text() == "new"


def test_a_new_file_has_the_permissions_that_any_has(tmp_path):
    (tmp_path / "any").touch()
    write_text(tmp_path / "new", "")
    assert (tmp_path / "new").stat().st_mode == (tmp_path / "any").stat().st_mode


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ("", "found a folder or device"),
        ("no/such/out.html", "there is no folder"),
        ("file/out.html", "there is no folder"),
        ("x" * 300, "cannot be written"),
    ],
)
def test_what_cannot_be_written_is_known_beforehand(tmp_path, place, message):
    (tmp_path / "file").touch()
    for attempt in (check_writable, lambda path: write_bytes(path, b"new")):
        with pytest.raises(VehicleError, match=message):
            attempt(tmp_path / place)
    assert os.listdir(tmp_path) == ["file"]


def test_a_device_is_not_replaced_by_a_file():
    with pytest.raises(VehicleError, match="found a folder or device"):
        write_bytes(Path(os.devnull), b"new")
    assert not Path(os.devnull).is_file()


def test_a_refusal_names_no_scratch_folder():
    with pytest.raises(VehicleError) as caught:
        check_writable(Path("/proc/rates.json"))
    assert str(caught.value) == "/proc/rates.json: cannot be written (No such file or directory)"


def test_a_file_that_is_missing_is_not_taken_for_another_of_its_kind(tmp_path):
    for name in ("frame.npz", "cap.npz"):
        (tmp_path / name).touch()
    with pytest.raises(VehicleError, match=r"no such file; did you mean 'cap\.npz'\?"):
        read_bytes(tmp_path / "cab.npz", 9)
    (tmp_path / "cap.npz").unlink()
    with pytest.raises(VehicleError, match=r"there is no such file$"):
        read_bytes(tmp_path / "cab.npz", 9)
