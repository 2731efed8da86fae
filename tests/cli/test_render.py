"""`modeviz render` without a browser: what it refuses, and the file that needs none."""

import re
from contextlib import nullcontext
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from mounted_cabin import mounted_cabin
from oracles import Beam

from modeviz.analysis.results import Conditions, solve_on
from modeviz.cli import main
from modeviz.errors import ModevizError, SolveError
from modeviz.files import write_vehicle
from modeviz.report.comparison import RateSet
from modeviz.shapes.colors import stop_colors
from modeviz.vehicle.mount_rates import DIRECTIONS, MountRates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.pictures.pictures import ImageSettings, Pose, picture
from modeviz.viewer.rendering import RenderRequest, photographs
from modeviz.viewer.scene.stage import FIELD_OF_VIEW, LIGHT
from modeviz.viewer.session.coloring import ColorScale


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
    monkeypatch.setattr("modeviz.viewer.pictures.headless.find_spec", lambda name: None)
    assert main(["render", folder, "--output", str(tmp_path / f"yaw{ending}")]) == 2
    assert 'pip install "modeviz[pictures]"' in capsys.readouterr().err
    assert not list(tmp_path.iterdir())


def test_a_playwright_that_does_not_start_is_told_with_what_it_may_need(
    capsys, folder, tmp_path, monkeypatch
):
    monkeypatch.setenv("PLAYWRIGHT_NODEJS_PATH", "/bin/false")
    assert main(["render", folder, "--output", str(tmp_path / "yaw.png")]) == 2
    error = capsys.readouterr().err
    assert error.startswith("modeviz: pictures need Playwright, which does not start (")
    assert "libatomic1" in error
    assert not list(tmp_path.iterdir())


def test_missing_pyav_is_told_before_anything_is_solved(capsys, folder, tmp_path, monkeypatch):
    monkeypatch.setattr("modeviz.report.images.find_spec", lambda name: None)
    monkeypatch.setattr("modeviz.viewer.rendering.Scenery", None)
    assert main(["render", folder, "--output", str(tmp_path / "yaw.mp4")]) == 2
    assert "MP4 needs PyAV" in capsys.readouterr().err


def test_interrupting_leaves_nothing_behind(folder, tmp_path, monkeypatch):
    def interrupt(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr("modeviz.viewer.rendering.Scenery.answers", interrupt)
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


@pytest.fixture
def resonant(monkeypatch):
    """Rates with which a solve finds an undamped resonance."""
    rates = {"A": MountRates(1e5, 2e5, 3e5)}

    def solve(drive, asked):
        if asked["A"] == rates["A"]:
            raise SolveError("an undamped resonance lies on 10 Hz")
        return solve_on(drive, asked)

    monkeypatch.setattr("modeviz.viewer.session.beginnings.solve_on", solve)
    return rates


def test_why_rates_have_no_answer_is_told(capsys, folder, tmp_path, resonant):
    rates = zip(DIRECTIONS, resonant["A"].as_tuple(), strict=True)
    settings = [f"A.{direction}={rate} N/m" for direction, rate in rates]
    options = [option for setting in settings for option in ("--set", setting)]
    assert main(["render", folder, "--output", str(tmp_path / "yaw.html"), *options]) == 2
    assert capsys.readouterr().err.endswith("modeviz: an undamped resonance lies on 10 Hz\n")
    assert not list(tmp_path.iterdir())


def test_no_set_is_shown_in_place_of_one_without_an_answer(monkeypatch, resonant):
    studio = SimpleNamespace(
        client=None, look=lambda *_: None, stand=lambda _: None, follow=lambda _: None
    )
    monkeypatch.setattr("modeviz.viewer.rendering.HeadlessPage", lambda *_, **__: nullcontext(studio))
    monkeypatch.setattr("modeviz.viewer.rendering.picture", lambda *_: None)
    monkeypatch.setattr("modeviz.viewer.rendering.png_bytes", lambda _: b"")
    wish = RenderRequest("", "Iso", "bodies", amplitude=1.0, phase=0.0, n_frames=1)
    shot = ImageSettings(64, 64, "white", LIGHT, FIELD_OF_VIEW)
    sets = [RateSet("own", {}), RateSet("odd", resonant)]
    with pytest.raises(ModevizError, match="odd: an undamped resonance lies on 10 Hz"):
        photographs(mounted_cabin(), sets, Conditions("flat", 20.0), wish, shot, lambda *_: None)


class Page:
    """Stands for a page that draws what it is told."""

    client_id = 1

    def __init__(self, drawn):
        self.drawn = drawn

    def get_render(self, height, width, **_):
        return np.broadcast_to(np.array(self.drawn, np.uint8), (height, width, 4)).copy()


POSE = Pose(np.array([1.0, 0, 0, 0]), np.zeros(3))


def test_an_empty_picture_is_reported_and_not_given(monkeypatch):
    monkeypatch.setattr("modeviz.viewer.pictures.pictures.asked", lambda *_: nullcontext())
    shot = ImageSettings(64, 48, "scene", LIGHT, FIELD_OF_VIEW)
    with pytest.raises(ModevizError, match="the picture is empty: the camera looks past the vehicle"):
        picture(Page((9, 9, 9, 0)), shot, POSE)
    assert picture(Page((9, 9, 9, 255)), shot, POSE).getpixel((0, 0)) == (9, 9, 9)


def test_a_picture_says_what_its_colours_mean(monkeypatch):
    monkeypatch.setattr("modeviz.viewer.pictures.pictures.asked", lambda *_: nullcontext())
    plain = ImageSettings(640, 360, "scene", LIGHT, FIELD_OF_VIEW)
    scaled = replace(plain, scale=ColorScale("Displacement", "100 %", ""))
    for shot, colors in ((plain, False), (scaled, True), (scaled.moving("gif"), True)):
        pixels = np.asarray(picture(Page((9, 9, 9, 255)), shot, POSE)).reshape(-1, 3)
        assert all((pixels == stop).all(axis=1).any() == colors for stop in stop_colors()[[0, -1]])


def test_a_vehicle_of_which_nothing_can_be_drawn_is_refused(capsys, tmp_path):
    beam = replace(Beam(4).body("beam"), mesh=())
    write_vehicle(Vehicle("beam", (beam,), ()), tmp_path / "beam")
    file = tmp_path / "beam.png"
    assert main(["render", str(tmp_path / "beam"), "--output", str(file)]) == 2
    assert "there is nothing to draw: no body that is shown has a mesh" in capsys.readouterr().err
    assert not file.exists()


@pytest.mark.parametrize(("coloring", "told"), [("displacement", "Displacement"), ("bodies", "")])
def test_the_offline_page_says_what_its_colours_mean(folder, tmp_path, coloring, told):
    file = tmp_path / "yaw.html"
    assert main(["render", folder, "--output", str(file), "--color", coloring]) == 0
    text = file.read_text("utf-8")
    beside = text[text.index("<aside>") :]
    assert ('<div class="scale"' in beside) == bool(told)
    assert told in beside
