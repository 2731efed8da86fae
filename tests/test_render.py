"""`modeviz render` without a browser: what it refuses, and the file that needs none."""

import re

import pytest
from mounted_cabin import mounted_cabin

from modeviz.cli import main
from modeviz.vehicle.files import write_vehicle


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("vehicles") / "cabin"
    write_vehicle(mounted_cabin(), path)
    return str(path)


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        (["--output", "yaw.bmp"], "expected a name that ends in .png, .gif, .mp4, .html"),
        (["--output", "no-folder/yaw.png"], "there is no folder"),
        (["--output", "yaw.png", "--width", "5"], "width: found 5, expected 16 to 4096 pixels"),
        (["--output", "yaw.png", "--height", "9999"], "height: found 9999"),
        (["--output", "yaw.png", "--amplitude", "nan"], "--amplitude: found nan, expected 0 to 10"),
        (["--output", "yaw.gif", "--frames", "1"], "--frames: found 1, expected 2 to 240"),
        (["--output", "yaw.png", "--phase", "inf"], "--phase: found inf"),
        (["--output", "yaw.html", "--mode", "cab jaw"], "unknown mode 'cab jaw': there are "),
        (["--output", "yaw.html", "--rates", "hard"], "there are original, soft, or give"),
    ],
)
def test_what_cannot_be_drawn_is_one_message_and_leaves_nothing(
    capsys, folder, tmp_path, monkeypatch, arguments, message
):
    monkeypatch.chdir(tmp_path)
    assert main(["render", folder, *arguments]) == 2
    error = capsys.readouterr().err
    assert error.startswith("modeviz: ")
    assert error.count("\n") == 1
    assert message in error
    assert not list(tmp_path.iterdir())


def test_a_folder_in_the_way_is_refused(capsys, folder, tmp_path):
    (tmp_path / "yaw.png").mkdir()
    assert main(["render", folder, "--output", str(tmp_path / "yaw.png")]) == 2
    assert "found a folder" in capsys.readouterr().err


@pytest.mark.parametrize("ending", [".png", ".gif"])
def test_missing_chromium_or_playwright_is_told_with_what_to_install(
    capsys, folder, tmp_path, monkeypatch, ending
):
    monkeypatch.setattr("modeviz.viewer.headless.find_spec", lambda name: None)
    assert main(["render", folder, "--output", str(tmp_path / f"yaw{ending}")]) == 2
    assert 'pip install "modeviz[pictures]"' in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_missing_pyav_is_told_before_anything_is_solved(capsys, folder, tmp_path, monkeypatch):
    monkeypatch.setattr("modeviz.export.images.find_spec", lambda name: None)
    monkeypatch.setattr("modeviz.viewer.rendering.App", None)
    assert main(["render", folder, "--output", str(tmp_path / "yaw.mp4")]) == 2
    assert "MP4 needs PyAV" in capsys.readouterr().err


def test_interrupting_leaves_nothing_behind(folder, tmp_path, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("modeviz.viewer.rendering._show", interrupt)
    assert main(["render", folder, "--output", str(tmp_path / "yaw.html")]) == 130
    assert not list(tmp_path.iterdir())


def test_offline_page_names_what_it_shows_and_needs_no_network(folder, tmp_path):
    file = tmp_path / "yaw.html"
    assert main(["render", folder, "--output", str(file), "--mode", "cab yaw", "--rates", "soft"]) == 0
    text = file.read_text("utf-8")
    beside = text[text.index("<aside>") :]
    assert "Cab yaw" in beside
    assert beside.count("<svg") >= 3
    assert re.search("<title>cabin: ~?Cab yaw</title>", text)
    for outside in ("src=", "@import", "<link "):
        assert outside not in beside
    assert [p.name for p in tmp_path.iterdir()] == ["yaw.html"]
