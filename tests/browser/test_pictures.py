"""Pictures to take away, taken by real pages."""

import base64
import io
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

import av
import numpy as np
import pytest
from builtin_truck import builtin_truck, truck_modes
from bulk_data import bulk_data
from pages import CLOSE_NOTICES, wait_for, wait_until
from PIL import Image
from session_commands import Alter
from vtk_files import read_vtu

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.results import Conditions
from modeviz.shapes.gltf import glb
from modeviz.shapes.surface import surface
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.viewer.app import App
from modeviz.viewer.page.server import open_server
from modeviz.viewer.pictures.headless import HeadlessPage
from modeviz.viewer.pictures.pictures import (
    N_CYCLES,
    Cycle,
    ImageSettings,
    Pose,
    cycle_pictures,
    picture,
)
from modeviz.viewer.scene.driver import ShapeDriver, held
from modeviz.viewer.scene.stage import FIELD_OF_VIEW, LIGHT, camera, framed_box
from modeviz.viewer.session.commands.looks import ShowMode

PANEL = np.array([[0.0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])
SIDE = 160
POSE = Pose(np.array([0.5, -0.5, 0.5, -0.5]), np.array([-10.0, 0, 0]))
"""Ten metres behind the panel, looking ahead."""
SOLVE_S = 120
RISE, DRIFT = 0.6, 0.3j
"""Of the panel up the picture and, a quarter of a cycle apart, across it, m."""
ELLIPSE = np.array([[0, DRIFT, RISE]] * 4)
"""(4, 3), m: the panel's shape."""


@pytest.fixture(scope="module")
def driver(server):
    """A panel that may run around an ellipse."""
    driver = ShapeDriver(server.scene)
    dark = MeshPart("panel", PANEL, FACES, Material((20, 20, 20)))
    driver.add("/panel", glb(surface((dark,))), 4)
    driver.show({"/panel": ELLIPSE})
    driver.drive(amplitude=1.0, frequency_hz=0.5, running=False)
    server.scene.world_axes.visible = False
    return driver


@pytest.fixture(scope="module")
def client(server, driver, page):
    wait_for(page, "window.__modeviz?.nShown === 1")
    return max(server.get_clients().items())[1]


def center(image):
    """Where the panel is, m: right (−y) and up."""
    rows, columns = np.nonzero(np.asarray(image)[..., :3].max(axis=-1) < 200)
    metres = 2 * 10 * np.tan(0.25) / SIDE
    middle = (SIDE - 1) / 2
    return (columns.mean() - middle) * metres, (middle - rows.mean()) * metres


def test_frames_of_a_cycle_are_where_their_phases_put_them(client):
    n = 8
    with held(client) as hold:
        shot = ImageSettings(SIDE, SIDE, "white", LIGHT, 0.5)
        frames = list(cycle_pictures(client, hold, shot, POSE, Cycle(n, False), [].append))
    angles = 2 * np.pi * np.arange(n) / n
    expected = np.stack([-(DRIFT * np.exp(1j * angles)).real, (RISE * np.exp(1j * angles)).real])
    pixel = 2 * 10 * np.tan(0.25) / SIDE
    assert np.transpose([center(f) for f in frames]) == pytest.approx(expected, abs=pixel)


def differing(one, other):
    """Which part of two pictures is not the same."""
    return (np.asarray(one) != np.asarray(other)).any(axis=-1).mean()


BORDERS = 0.006
"""The part of a picture that two borders of the panel take, which a rounded cosine may move."""


def test_frames_that_are_not_drawn_of_a_real_shape_are_those_that_are(client, driver, page):
    n = 6
    shot = ImageSettings(SIDE, SIDE, "white", LIGHT, 0.5)
    driver.show({"/panel": np.array([[0, DRIFT.imag, RISE]] * 4)})
    assert driver.is_real
    driver.seek(0.0)
    wait_for(page, "window.__modeviz.sought === a.sought", sought=driver.sought)
    with held(client) as hold:
        half, whole = (
            list(cycle_pictures(client, hold, shot, POSE, Cycle(n, is_real), [].append))
            for is_real in (True, False)
        )
    driver.show({"/panel": ELLIPSE})
    assert not driver.is_real
    for mirrored, frame in zip(Cycle(n, True).order, whole, strict=True):
        assert differing(half[mirrored], frame) < BORDERS
    assert differing(half[0], half[3]) > 5 * BORDERS


def test_a_whole_turn_later_is_the_same_picture(client):
    shot, pose = ImageSettings(SIDE, SIDE, "white", LIGHT, 0.5), POSE
    with held(client) as hold:
        drawn = []
        for phase in (1.0, 4.0, 1.0 + 2 * np.pi):
            hold(phase)
            drawn.append(np.asarray(picture(client, shot, pose)))
    np.testing.assert_array_equal(drawn[0], drawn[2])
    assert (drawn[0] != drawn[1]).any()


def test_a_page_goes_on_where_it_was_even_after_an_error_and_others_never_stop(
    server, driver, client, page, open_page
):
    other = open_page(server)
    wait_for(other, "window.__modeviz?.nShown === 1")
    driver.drive(running=True)
    with suppress(KeyError), held(client) as hold:
        hold(1.0)
        wait_for(page, "window.__modeviz.weights.value[0] === Math.cos(1)")
        held_at, other_at = (p.evaluate("window.__modeviz.phase") for p in (page, other))
        wait_for(other, "window.__modeviz.phase !== a.before", before=other_at)
        assert page.evaluate("window.__modeviz.phase") == held_at
        raise KeyError
    wait_for(page, "window.__modeviz.phase !== a.before", before=held_at)
    driver.drive(running=False)
    other.context.close()


def test_picture_has_the_size_asked_for_and_its_backdrop(client):
    for backdrop, corner in (
        ("scene", LIGHT.top),
        ("white", (255, 255, 255)),
        ("transparent", (0,) * 4),
    ):
        image = picture(client, ImageSettings(96, 64, backdrop, LIGHT, 0.5), POSE)
        assert image.size == (96, 64)
        assert image.getpixel((0, 0))[: len(corner)] == corner
    assert image.getpixel((48, 32))[3] == 255


def test_background_of_the_page_is_in_no_picture_and_stays_on_the_page(server, client, page):
    server.scene.set_background_image(np.full((4, 4, 3), (255, 0, 0), np.uint8), format="png")
    is_drawn = "window.__viserMutable.backgroundMaterial.uniforms.enabled.value"
    wait_for(page, is_drawn)
    image = picture(client, ImageSettings(64, 64, "transparent", LIGHT, 0.5), POSE)
    assert image.getpixel((0, 0))[3] == 0
    wait_for(page, "window.__viserMutable.backgroundMaterial.visible")
    server.scene.set_background_image(None)
    wait_for(page, f"!{is_drawn}")


@pytest.fixture(scope="module")
def app():
    """The pickup at the optimised rates, drawn without what is slow in software."""
    vehicle = builtin_truck()
    server = open_server(port=0, token="open-sesame-open")
    app = App(vehicle, vehicle.rate_sets["optimised"], Conditions("road 1", vehicle.speed), server)
    server.scene.configure_environment_map(None)
    app.scene._stage._key.cast_shadow = False
    app.start()
    app.screen.motion.animation._run(False)
    app.session.do(ShowMode("cab yaw"))
    app.session.do(Alter(ghost="none"))  # outlines at rest fight with bodies for the same pixels
    assert app.session.wait(SOLVE_S)
    yield app
    app.close()


@pytest.fixture(scope="module")
def bench(app, open_page):
    """Its page, with the pictures' tab open and a small size chosen."""
    page = open_page(app.server, viewport=(980, 640), query="?token=open-sesame-open&fixedDpr=1")
    wait_for(page, "window.__modeviz?.nShown > 0")
    page.evaluate(CLOSE_NOTICES)
    page.get_by_role("tab", name="Pictures").click()
    for label, value in (("Width", 160), ("Height", 120)):
        field = page.get_by_label(label, exact=True)
        field.fill(str(value))
        field.press("Enter")
    panel = app.screen.controls.pictures
    wait_until(page, lambda: (panel._width.value, panel._height.value) == (160, 120))
    return page


def saved(app, page, kind):
    """The content of what the page downloads."""
    app.screen.controls.pictures._kind.value = kind
    with page.expect_download(timeout=2000 * SOLVE_S) as downloading:
        page.get_by_role("button", name="Save").click()
    wait_for(page, "!document.querySelector('.mantine-Modal-content')")
    return downloading.value.suggested_filename, Path(downloading.value.path()).read_bytes()


def test_picture_is_downloaded_in_its_size_and_not_blank(app, bench):
    app.screen.controls.pictures._backdrop.value = "Transparent"
    name, content = saved(app, bench, "Picture, PNG")
    image = Image.open(io.BytesIO(content))
    assert (name, image.size, image.mode) == ("pickup-cab-yaw.png", (160, 120), "RGBA")
    alpha = np.asarray(image)[..., 3]
    assert alpha[0, 0] == 0
    assert 0.05 < (alpha > 200).mean() < 0.6
    red, _, blue, _ = np.moveaxis(np.asarray(image, float), -1, 0)
    assert ((blue - red) > 25).mean() > 0.005  # the front end
    assert ((red - blue) > 25).mean() > 0.005  # the cab


def test_loop_is_downloaded_and_its_frames_differ(app, bench, monkeypatch):
    monkeypatch.setattr("modeviz.viewer.panels.pictures.N_FRAMES", 4)
    name, content = saved(app, bench, "Loop, GIF")
    with Image.open(io.BytesIO(content)) as gif:
        assert (name, gif.size, gif.n_frames) == ("pickup-cab-yaw.gif", (160, 120), 4)
        frames = []
        for k in range(4):
            gif.seek(k)
            frames.append(np.asarray(gif.convert("RGB")).astype(int))
    assert np.abs(frames[0] - frames[2]).max() > 30
    at_ends, at_rest = (np.abs(frames[k] - frames[k + 2]).mean() for k in (0, 1))
    assert at_rest < 0.1 * at_ends


def test_film_is_downloaded_and_plays_some_cycles(app, bench, monkeypatch):
    monkeypatch.setattr("modeviz.viewer.panels.pictures.N_FRAMES", 4)
    name, content = saved(app, bench, "Film, MP4")
    with av.open(io.BytesIO(content)) as film:
        frames = [frame.to_ndarray(format="rgb24").astype(int) for frame in film.decode(video=0)]
    assert (name, len(frames), frames[0].shape) == ("pickup-cab-yaw.mp4", 4 * N_CYCLES, (120, 160, 3))
    assert np.abs(frames[0] - frames[2]).max() > 30
    np.testing.assert_array_equal(frames[0], frames[4])


def test_cancel_stops_a_loop_saves_nothing_and_the_motion_goes_on(app, bench):
    app.screen.motion.animation._run(True)
    downloads = []
    bench.on("download", lambda download: downloads.append(download))
    app.screen.controls.pictures._kind.value = "Loop, GIF"
    bench.get_by_role("button", name="Save").click()
    wait_for(bench, "window.__viserSceneTree.getState()['/_held']")
    bench.get_by_role("button", name="Cancel").click()
    wait_for(bench, "!document.querySelector('.mantine-Modal-content')")
    wait_for(bench, "!window.__viserSceneTree.getState()['/_held']")
    before = bench.evaluate("window.__modeviz.phase")
    wait_for(bench, "window.__modeviz.phase !== a.before", before=before)
    app.screen.motion.animation._run(False)
    assert not downloads


def test_whole_page_is_taken_by_a_browser_beside_with_the_same_view(app, bench):
    name, content = saved(app, bench, "Whole page, PNG")
    image = Image.open(io.BytesIO(content)).convert("RGB")
    assert name == "pickup-cab-yaw-page.png"
    assert image.height == 640
    canvas = bench.evaluate("window.__viserMutable.canvas.clientWidth")
    assert abs(image.width - 980) <= 2, canvas
    assert len(image.getcolors(maxcolors=1 << 24)) > 1000


LABELS_OFF = """() => {
  const { camera, canvas, nodeRefFromName, nodePoseData } = window.__viserMutable;
  const { places } = window.__modevizLabels;
  return Object.keys(places).map((name) => {
    const parent = nodeRefFromName[name.slice(0, name.lastIndexOf("/"))];
    const place = camera.position.clone().set(...nodePoseData[name].position);
    const at = parent.localToWorld(place).project(camera);
    const { left, right, top, bottom } = places[name];
    const [x, y] = [(at.x + 1) * canvas.clientWidth, (1 - at.y) * canvas.clientHeight];
    return Math.hypot(x - left - right, y - top - bottom) / 2;
  });
}"""
"""How far labels are from where they have been placed for the camera, pixels."""


DRAWN_NEXT = """async () => {
  const { scene, requestRender } = window.__viserMutable;
  requestRender();
  for (let i = 0; i < 2; i++) await new Promise(requestAnimationFrame);
  return scene.visible;
}"""
"""Whether a frame that is no picture shows the scene."""


def test_labels_of_a_page_beside_are_placed_for_its_camera_as_soon_as_it_stands(app):
    def photographed():
        with HeadlessPage(lambda: app.server, 600, 400, bare=True) as studio:
            seen = camera(framed_box(app.session.vehicle), "Side", 600, 400)
            studio.client.camera.position, studio.client.camera.look_at = seen
            studio.stand(1.0)
            size = studio._page.evaluate(
                "(({ width, height }) => [width, height])(__viserMutable.canvas)"
            )
            return size, studio._page.evaluate(LABELS_OFF)

    with ThreadPoolExecutor(1) as beside:  # where Playwright has no other page
        size, off = beside.submit(photographed).result()
    assert size == [600, 400]
    assert len(off) > 3
    assert max(off) < 0.5


SHADOWED = """() => {
  const widths = [];
  window.__viserMutable.scene.traverse(({ isLight, castShadow, shadow }) => {
    if (isLight && castShadow) widths.push(shadow.camera.right - shadow.camera.left);
  });
  return Math.max(...widths);
}"""
"""How wide the space is whose shadows are drawn in one map, m."""

ANEW = """() => {
  const { camera } = window.__viserMutable;
  camera._reversedDepth = false;
  camera.updateProjectionMatrix();
}"""
"""Makes the camera one that has drawn nothing yet."""


def test_a_page_that_nobody_sees_draws_only_pictures_and_the_first_as_well_as_any(app):
    shot = ImageSettings(300, 200, "white", LIGHT, FIELD_OF_VIEW)
    side, iso = (camera(framed_box(app.session.vehicle), view, 600, 400) for view in ("Side", "Iso"))

    def photographed():
        with HeadlessPage(lambda: app.server, 600, 400, bare=True) as studio:
            drawn = []
            studio._page.evaluate(ANEW)
            for seen in (side, iso, iso, iso):  # shadows follow the camera, some frames later
                pose = studio.look(*seen)
                studio.stand(1.0)
                drawn.append(np.asarray(picture(studio.client, shot, pose), int))
                is_drawn, width = map(studio._page.evaluate, (DRAWN_NEXT, SHADOWED))
            return is_drawn, width, drawn

    app.scene._stage._key.cast_shadow = True
    with ThreadPoolExecutor(1) as beside:  # where Playwright has no other page
        is_drawn, width, (_, first, *later) = beside.submit(photographed).result()
    app.scene._stage._key.cast_shadow = False
    assert not is_drawn
    assert width < 25  # viser lets shadows reach 20 m, and draws those of a kilometre without an edge
    assert (first < 250).mean() > 0.1
    for other in later:
        assert np.abs(other - first).mean() < 0.01


def test_offline_page_is_downloaded_and_moves_with_the_network_off(app, bench, browser, tmp_path):
    app.screen.motion.animation._run(True)
    name, content = saved(app, bench, "Offline page, HTML")
    app.screen.motion.animation._run(False)
    assert name == "pickup-cab-yaw.html"
    file = tmp_path / name
    file.write_bytes(content)
    context = browser.new_context(viewport={"width": 700, "height": 400})
    context.set_offline(True)
    page = context.new_page()
    page.set_default_timeout(60_000)
    asked, errors = [], []
    page.on("request", lambda request: asked.append(request.url))
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("console", lambda said: said.type == "error" and errors.append(said.text))
    page.goto(file.as_uri())
    wait_for(page, "window.__modeviz?.nShown === a.count", count=len(app.scene.driver._meshes))
    before = page.evaluate("window.__modeviz.phase")
    wait_for(page, "window.__modeviz.phase !== a.before", before=before)
    page.get_by_role("button", name="Pause").click()
    page.get_by_label("Phase").evaluate("(field) => { field.value = 90; field.oninput(); }")
    wait_for(page, "Math.abs(window.__modeviz.phase - Math.PI / 2) < 1e-9")
    page.get_by_label("Amplitude").evaluate("(field) => { field.value = 2; field.oninput(); }")
    wait_for(page, "Math.abs(Math.hypot(...window.__modeviz.weights.value) - 2) < 1e-9")
    assert page.locator("aside svg").count() >= 3
    assert not errors
    assert {url.split(":")[0] for url in asked} <= {"file", "data", "blob"}
    context.close()


def test_report_is_downloaded_with_a_picture_of_what_is_seen(app, bench):
    name, content = saved(app, bench, "Report, HTML")
    text = content.decode()
    assert name == "pickup-cab-yaw-report.html"
    assert "Pickup: Optimised against Original" in text
    (picture,) = pictures_in(text)
    assert picture.size == (160, 120)
    results = solve_modal(truck_modes(), app.session.state.design.rates)
    yaw = results.modes.frequency_hz[results.mode_index("cab yaw")]
    assert f"ab yaw, {yaw:.2f} Hz, Optimised" in text


def pictures_in(document):
    """The pictures that an HTML document carries."""
    found = re.findall(r"data:image/png;base64,([\w+/=]+)", document)
    return [Image.open(io.BytesIO(base64.b64decode(content))).convert("RGB") for content in found]


def test_report_of_the_command_line_has_a_picture_of_the_mode_with_each_set(
    tmp_path, folder, printed_json
):
    file = tmp_path / "report.html"
    program = [sys.executable, "-m", "modeviz", "report"]
    command = [*program, folder, "--rates", "soft", "--output", str(file)]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0
    assert all(line.startswith("modeviz: note: ") for line in done.stderr.splitlines())
    text = file.read_text("utf-8")
    original, soft = pictures_in(text)
    assert original.size == soft.size == (1280, 800)
    assert all(len(p.getcolors(maxcolors=1 << 24)) > 1000 for p in (original, soft))
    difference = np.abs(np.asarray(original, int) - np.asarray(soft, int))
    assert (difference.max(axis=2) > 30).mean() > 0.002  # the cab yaws about another axis
    for rates in ("original", "soft"):
        modes = printed_json("modes", folder, "--rates", rates)["modes"]
        (yaw,) = [mode["frequency_hz"] for mode in modes if mode["name"] == "cab yaw"]
        assert f"ab yaw, {yaw:.2f} Hz, {rates}" in text


def downloaded(app, page, content, kind):
    """The name and the content of a file of data that the page downloads."""
    panel = app.screen.controls.data
    panel._content.value = content
    panel._offer()
    panel._format.value = kind
    with page.expect_download(timeout=2000 * SOLVE_S) as downloading:
        page.get_by_role("button", name="Download").click()
    wait_for(page, "!document.querySelector('.mantine-Modal-content')")
    return downloading.value.suggested_filename, Path(downloading.value.path()).read_bytes()


def test_rates_on_the_screen_are_downloaded_as_cards(app, bench):
    name, content = downloaded(app, bench, "Mount rates", "Nastran cards")
    cards = bulk_data(content.decode("ascii"))
    rates = app.session.state.design.rates["C2"]
    assert name == "pickup-optimised-rates.bdf"
    assert [rate / 1000 for rate in rates.local()] in [
        card[3:6] for card in cards if card[0] == "PBUSH"
    ]
    assert bench.get_by_label("Units", exact=True).is_visible()


def test_modes_on_the_screen_are_downloaded_whole_though_they_are_megabytes(app, bench):
    name, content = downloaded(app, bench, "Modes", "ParaView, VTU")
    arrays = read_vtu(content)
    modes = app.session.answer.now.modes
    assert name == "pickup-optimised-modes.vtu"
    assert len(content) > 5_000_000
    below = modes.frequency_hz < app.session.vehicle.highest_frequency
    np.testing.assert_allclose(arrays["FieldData"]["frequency, Hz"], modes.frequency_hz[below])
