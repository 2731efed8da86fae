import time

import numpy as np
import pytest
from apps import listening, n_bytes
from pages import draw_on, wait_for

from modeviz.shapes.colors import Shade
from modeviz.shapes.gltf import glb
from modeviz.shapes.surface import surface
from modeviz.vehicle.bodies import Material, MeshPart
from modeviz.viewer.pictures.pictures import ImageSettings, Pose, picture
from modeviz.viewer.scene.driver import ShapeDriver
from modeviz.viewer.scene.stage import LIGHT

NAME = "/vehicle/cab"
HALF = 2.0**-11  # relative rounding of half precision
PANEL = np.array([[0.0, -1, -1], [0, 1, -1], [0, 1, 1], [0, -1, 1]])
FACES = np.array([[0, 1, 2], [0, 2, 3]])
SHAPE = np.array([[0.1, 0, 1], [0.2, 0, 1], [0, 0.3, 1], [0, 0.4j, 1]])

READ = """
(() => {
  const group = window.__viserMutable.nodeRefFromName[a.name]?.children[0];
  const meshes = [];
  group?.traverse((object) => object.geometry?.index && meshes.push(object));
  if (!meshes.length || !meshes[0].geometry.attributes.modevizReal) return null;
  const real = meshes[0].geometry.attributes.modevizReal;
  const values = (name) => Array.from(meshes[0].geometry.attributes[name]?.array ?? []);
  return {
    real: values("modevizReal"), imaginary: values("modevizImaginary"),
    position: values("position"),
    shared: meshes.every((m) => m.geometry.attributes.modevizReal === real),
    kinds: meshes.map((m) => m.type),
    materials: meshes.map((m) => ({
      colored: m.material.vertexColors, opacity: m.material.opacity,
      transparent: m.material.transparent, flat: m.material.flatShading,
      color: m.material.color.toArray(), roughness: m.material.roughness,
    })),
  };
})()
"""

MATERIAL = """
(() => {
  let found;
  window.__viserMutable.nodeRefFromName[a.name]?.traverse((object) => { found ??= object.material; });
  return found;
})()
"""


def cab():
    skin = MeshPart("panel", PANEL, FACES, Material((202, 134, 98)))
    glass = MeshPart("glass", PANEL + np.array([0.0, 4, 0]), FACES, Material((24, 32, 40), 0.8))
    lamp = MeshPart("lamp", PANEL * 0.2, FACES, Material((250, 250, 250)))
    return surface((skin, glass, lamp))


@pytest.fixture(scope="module")
def shape_driver(server):
    return ShapeDriver(server.scene)


@pytest.fixture
def driver(shape_driver, page):
    """The driver, with a new cab in the page that stands still."""
    shape_driver.add(NAME, glb(cab(), edge_color=(30, 36, 44)), 12)
    shape_driver.drive(amplitude=1.0, frequency_hz=1.0, running=False)
    wait_for(page, READ, name=NAME)
    yield shape_driver
    shape_driver.remove(NAME)
    wait_for(page, "!window.__viserMutable.nodeRefFromName[a.name]", name=NAME)


def moved(page, phase=0.0):
    """The vertices the page draws, from its own attributes and its own weights."""
    read = wait_for(page, READ, name=NAME)
    real, imaginary = (halves(read[part]) for part in ("real", "imaginary"))
    weights = page.evaluate("window.__modeviz.weights.value")
    return np.reshape(read["position"], (-1, 3)) + weights[0] * real + weights[1] * imaginary


def halves(bits):
    return np.array(bits, np.uint16).view(np.float16).astype(float).reshape(-1, 3)


def shown_real(page, expected, name=NAME):
    """Waits until the page shows a shape whose third number is `expected`, and returns it."""
    condition = f"({READ.strip()})?.real[2] === a.bits"
    wait_for(page, condition, name=name, bits=int(np.float16(expected).view(np.uint16)))
    return halves(wait_for(page, READ, name=name)["real"])


def whole(shape):
    """The shape of the panel on all three parts."""
    return np.tile(shape, (3, 1))


def test_page_draws_the_animated_positions_of_a_complex_shape(driver, page):
    driver.show({NAME: whole(SHAPE)})
    driver.drive(amplitude=0.3)
    shown_real(page, 1.0)
    for phase in (0.0, 1.0, 4.0):
        driver.seek(phase)
        wait_for(page, "Math.abs(window.__modeviz.phase - a.phase) < 1e-9", phase=phase)
        drawn = cab().vertices + 0.3 * (whole(SHAPE) * np.exp(1j * phase)).real
        assert moved(page) == pytest.approx(drawn, abs=0.3 * 2 * HALF)


def test_shader_moves_what_is_seen(server, driver, page):
    """The panel rises on the screen by what the camera makes of its amplitude."""
    client = next(iter(server.get_clients().values()))
    client.camera.position, client.camera.look_at = (-10.0, 0, 0), (0.0, 0, 0)
    pose = Pose.of(client.camera)
    rise = np.zeros((12, 3))
    rise[:, 2] = 1
    driver.show({NAME: rise})
    driver.drive(amplitude=1.0)
    heights = []
    for phase in (0.0, np.pi):
        driver.seek(phase)
        wait_for(page, "Math.abs(window.__modeviz.phase - a.phase) < 1e-9", phase=phase)
        image = picture(client, ImageSettings(200, 200, "white", LIGHT, 0.5), pose)
        heights.append(np.nonzero(np.asarray(image).max(axis=-1) < 200)[0].mean())
    two_metres = 2 / (2 * 10 * np.tan(0.25)) * 200
    assert heights[1] - heights[0] == pytest.approx(two_metres, abs=1.0)


def test_all_primitives_and_edges_share_the_shape(driver, page):
    read = wait_for(page, READ, name=NAME)
    assert read["kinds"] == ["Mesh", "Mesh", "Mesh", "LineSegments"]
    assert read["shared"]
    assert [m["flat"] for m in read["materials"][:3]] == [True] * 3


def test_last_shape_wins_and_late_joiners_see_it(server, driver, page, open_page):
    for scale in (1.0, 2.0, 3.0):
        driver.show({NAME: whole(SHAPE) * scale})
    exact = whole(SHAPE).real * 3
    assert shown_real(page, 3.0) == pytest.approx(exact, rel=HALF)
    assert shown_real(open_page(server), 3.0) == pytest.approx(exact, rel=HALF)


def test_each_mesh_keeps_its_own_shape(driver, page):
    other = surface((MeshPart("panel", PANEL, FACES, Material((1, 2, 3))),))
    driver.add("/vehicle/bed", glb(other), 4)
    driver.show({NAME: whole(SHAPE) * 2})
    driver.show({"/vehicle/bed": SHAPE.real * 5})
    assert shown_real(page, 2.0) == pytest.approx(whole(SHAPE).real * 2, rel=HALF)
    bed = shown_real(page, 5.0, "/vehicle/bed")
    assert bed == pytest.approx(SHAPE.real * 5, rel=HALF)
    driver.remove("/vehicle/bed")
    wait_for(page, "!window.__viserMutable.nodeRefFromName['/vehicle/bed']")
    driver.show({NAME: whole(SHAPE) * 3})
    assert shown_real(page, 3.0) == pytest.approx(whole(SHAPE).real * 3, rel=HALF)


def test_real_shape_leaves_nothing_of_a_complex_one_before_it(server, driver, page, open_page):
    driver.show({NAME: whole(SHAPE)})
    shown_real(page, 1.0)
    assert any(wait_for(page, READ, name=NAME)["imaginary"])
    driver.show({NAME: whole(SHAPE).real * 2})
    for viewer in (page, open_page(server)):
        shown_real(viewer, 2.0)
        assert not any(wait_for(viewer, READ, name=NAME)["imaginary"])


def test_real_shape_travels_in_six_bytes_a_vertex_and_an_old_one_not_at_all(server, driver):
    buffer = server._websock_server._broadcast_buffer

    def bytes_of(shape):
        first = buffer.message_counter
        driver.show({NAME: shape})
        new = [m for i, m in buffer.message_from_id.items() if i >= first]
        return sum(len(content) for m in new for content in m.updates.values())

    driver.show({NAME: whole(SHAPE)})
    assert bytes_of(whole(SHAPE) * 2) == 12 * 12
    assert bytes_of(whole(SHAPE).real * 2) == 12 * 6
    assert bytes_of(whole(SHAPE).real * 2) == 0


def test_smooth_shape_takes_less_than_two_thirds_of_its_halves_on_the_way(server, driver):
    n = 6000
    x = np.linspace(0, 2 * np.pi, n)
    wave = np.stack([np.cos(x), np.sin(x), np.sin(3 * x)], axis=1)
    faces = np.arange(n).reshape(-1, 3)
    driver.add("/vehicle/bed", glb(surface((MeshPart("panel", wave, faces, Material((1, 2, 3))),))), n)
    with listening(server) as socket:
        driver.show({"/vehicle/bed": wave})
        assert n_bytes(socket) < 2 / 3 * 6 * n
    driver.remove("/vehicle/bed")


def test_rigid_motion_moves_every_vertex_with_the_first_and_turns_them_about_it(driver, page):
    motion = np.array([[0.1, 0.2j, 0.3], [0.4, -0.5, 0.6j]])
    driver.show({NAME: motion})
    wait_for(page, f"({READ.strip()})?.imaginary[1] > 0.1", name=NAME)
    read = wait_for(page, READ, name=NAME)
    vertices = cab().vertices
    exact = motion[0] + np.cross(motion[1], vertices - vertices[0])
    for part, values in (("real", exact.real), ("imaginary", exact.imag)):
        largest = HALF * (0.3 + 0.6 * np.ptp(vertices, axis=0).max() * 2)
        assert np.reshape(read[part], (-1, 3)) == pytest.approx(values, abs=largest)


def test_mesh_moves_freely_again_after_a_rigid_motion(driver, page):
    driver.show({NAME: np.ones((2, 3))})
    wait_for(page, f"({READ.strip()})?.real[0] === 1", name=NAME)
    driver.show({NAME: whole(SHAPE) * 2})
    assert shown_real(page, 2.0) == pytest.approx(whole(SHAPE).real * 2, rel=HALF)


@pytest.mark.parametrize(
    ("power", "gain", "value"),
    [(1, 2.0, 0.6), (2, 2.0, 0.26)],  # of 0.3 and 0.2 at right angles: the largest, and 0.09 + 0.04
)
def test_shader_colors_by_the_measure_of_the_displacement(server, driver, page, power, gain, value):
    client = next(iter(server.get_clients().values()))
    client.camera.position, client.camera.look_at = (-10.0, 0, 0), (0.0, 0, 0)
    pose = Pose.of(client.camera)
    driver.show({NAME: np.tile([0.0, 0.3, 0.2j], (12, 1))})
    wait_for(page, f"({READ.strip()})?.imaginary[2] > 0.1", name=NAME)
    driver.drive(amplitude=0.0)
    light = server.scene.add_light_ambient("/light", intensity=2.0)

    def drawn(shade):
        driver.shade({NAME: shade})
        coded = [shade.gain, shade.power]
        shown = "(m => m?.userData.shade?.value.join() === a.coded.join() && m.vertexColors)"
        wait_for(page, f"{shown}({MATERIAL})", name=NAME, coded=coded)
        image = picture(client, ImageSettings(100, 100, "white", LIGHT, 0.5), pose)
        return np.asarray(image)[35:65, 35:65].reshape(-1, 3).mean(axis=0)

    measured = drawn(Shade(gain, power))
    assert measured == pytest.approx(drawn(Shade(value, 0)), abs=1.5)
    assert np.abs(measured - drawn(Shade(value + 0.1, 0))).max() > 5
    light.remove()


def test_colors_are_drawn_on_the_skin_only_while_asked(driver, page):
    own = wait_for(page, READ, name=NAME)["materials"]
    driver.shade({NAME: Shade(0.5, 0)})
    colored = wait_for(page, f"(s => s?.materials[0].colored && s)({READ.strip()})", name=NAME)
    assert [m["colored"] for m in colored["materials"]] == [True, False, False, False]
    assert colored["materials"][0]["color"] == [1, 1, 1]
    driver.shade({})
    plain = wait_for(page, f"(s => s && !s.materials[0].colored && s)({READ.strip()})", name=NAME)
    assert plain["materials"] == own


def test_opacity_changes_skin_and_glass_but_not_dressing(driver, page):
    driver.set_opacity(NAME, 0.5)
    seen = wait_for(page, f"(s => s?.materials[0].transparent && s)({READ.strip()})", name=NAME)
    assert [m["opacity"] for m in seen["materials"]] == pytest.approx([0.5, 0.4, 1, 1])
    driver.set_opacity(NAME, 1.0)
    wait_for(page, f"({READ.strip()})?.materials[0].transparent === false", name=NAME)


def test_phase_advances_while_running_and_is_held_while_paused(driver, page):
    driver.drive(amplitude=1.0, frequency_hz=0.5, running=True)
    wait_for(page, "window.__modeviz.phase > 0.5")
    driver.drive(running=False)
    wait_for(page, "window.__viserMutable.nodePoseData['/_driver'].position[1] === 0")
    held = page.evaluate("window.__modeviz.phase")
    draw_on(page)
    assert page.evaluate("window.__modeviz.phase") == held
    started = time.monotonic()
    driver.drive(frequency_hz=0.01, running=True)
    wait_for(page, "window.__modeviz.phase !== a.held", held=held)
    turned = (page.evaluate("window.__modeviz.phase") - held) % (2 * np.pi)
    longest = time.monotonic() - started + 0.25  # a frame may have begun before
    assert 0 < turned < 2 * np.pi * 0.01 * longest


def test_amplitude_changes_without_breaking_the_phase(driver, page):
    driver.seek(1.0)
    wait_for(page, "window.__modeviz.phase === 1")
    driver.drive(amplitude=2.5)
    weights = wait_for(
        page, "Math.hypot(...window.__modeviz.weights.value) > 2 && window.__modeviz.weights.value"
    )
    assert weights == pytest.approx([2.5 * np.cos(1), -2.5 * np.sin(1)])


def test_same_phase_can_be_sought_again(driver, page):
    driver.seek(1.0)
    wait_for(page, "window.__modeviz.phase === 1")
    driver.drive(frequency_hz=1.0, running=True)
    wait_for(page, "window.__modeviz.phase !== 1")
    driver.drive(running=False)
    driver.seek(1.0)
    wait_for(page, "Math.abs(window.__modeviz.phase - 1) < 1e-9")


def test_removed_and_added_mesh_with_other_vertices_shows_its_new_shape(driver, page):
    driver.remove(NAME)
    wait_for(page, "!window.__viserMutable.nodeRefFromName[a.name]", name=NAME)
    wait_for(page, "!window.__viserSceneTree.getState()['/_shape' + a.name]", name=NAME)
    small = surface((MeshPart("panel", PANEL, FACES, Material((1, 2, 3))),))
    driver.add(NAME, glb(small), 4)
    driver.show({NAME: SHAPE * 7})
    assert shown_real(page, 7.0) == pytest.approx(SHAPE.real * 7, rel=HALF)


def test_mesh_replaced_in_place_shows_its_new_shape(driver, page):
    small = surface((MeshPart("panel", PANEL, FACES, Material((1, 2, 3))),))
    driver.add(NAME, glb(small), 4)
    driver.show({NAME: SHAPE * 7})
    assert shown_real(page, 7.0) == pytest.approx(SHAPE.real * 7, rel=HALF)


def test_page_shows_its_shapes_again_after_a_reconnect(server, driver, page):
    driver.show({NAME: whole(SHAPE)})
    shown_real(page, 1.0)
    page.evaluate("window.__modeviz.turn.first = true")
    server._websock_server.disconnect_all_clients()
    wait_for(page, "!window.__modeviz.turn.first")
    driver.show({NAME: whole(SHAPE) * 2})
    assert shown_real(page, 2.0) == pytest.approx(whole(SHAPE).real * 2, rel=HALF)


def test_many_shapes_leave_no_more_to_replay_than_one(server, driver):
    buffer = server._websock_server._broadcast_buffer
    driver.show({NAME: whole(SHAPE) * 100})
    n_messages = len(buffer.message_from_id)
    for scale in range(50):
        driver.show({NAME: whole(SHAPE) * scale})
        driver.drive(amplitude=scale)
    assert len(buffer.message_from_id) == n_messages


def test_page_that_cannot_be_patched_says_so(server, driver, open_page, no_errors):
    page = open_page(server)
    wait_for(page, READ, name=NAME)
    page.evaluate(
        """name => {
          const materials = [];
          const group = window.__viserMutable.nodeRefFromName[name];
          group.traverse((object) => object.material && materials.push(object.material));
          materials[0].onBeforeCompile({ uniforms: {}, vertexShader: "#include <common>" });
        }""",
        NAME,
    )
    assert page.evaluate("window.__modeviz.error") == "three.js has no begin_vertex"
    assert page.get_by_text("The shapes in this page do not move").is_visible()
    assert no_errors(page) == ["modeviz: three.js has no begin_vertex"]


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        (np.zeros((5, 3)), "expected"),
        (np.full((12, 3), np.nan), "not finite"),
        (np.full((12, 3), 1e5), "not finite or beyond 65504"),
        (np.full((12, 3), 1j * np.inf), "not finite"),
    ],
)
def test_shape_that_cannot_be_sent_is_refused(driver, shape, said):
    with pytest.raises(ValueError, match=said):
        driver.show({NAME: shape})
