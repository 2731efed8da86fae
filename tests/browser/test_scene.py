import numpy as np
import pytest
from pages import wait_for, wait_until

from modeviz.tuning.preparation import prepare_modes
from modeviz.tuning.results import Conditions, solve_modal
from modeviz.vehicle.bodies import Attachment, FlexibleBody, Material, MeshPart, RigidBody
from modeviz.vehicle.connections import GROUND, Mount, MountGroup, MountRates, Tyre
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.answers import Solved
from modeviz.viewer.movement import Movement
from modeviz.viewer.scene import Scene
from modeviz.viewer.state import State

HALF = 2.0**-11  # relative rounding of half precision
QUADS = np.array([[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]])
FACES = QUADS[:, [0, 1, 2, 0, 2, 3]].reshape(-1, 3)
CENTER = np.array([0.0, 0.0, 1.0])
RATES = MountRates(2e5, 1e5, 5e4)


def corners(center, size):
    cube = np.array([[x, y, z] for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)])
    return np.asarray(center) + cube * size


def cab():
    """A cab of 400 kg that only moves rigidly, in mass-normalised coordinates."""
    nodes = corners(CENTER, (4.0, 1.6, 0.8))
    scale = np.array([20.0, 20, 20, 10, 25, 25])  # √m, and √I of a plausible block

    def rigid(position):
        motion = np.eye(6)
        motion[:3, 3:] = np.stack([np.cross(e, position - CENTER) for e in np.eye(3)], axis=1)
        return motion / scale

    mesh = (MeshPart("paint", nodes, FACES, Material((202, 134, 98))),)
    attachments = tuple(
        Attachment(name, np.array(at), rigid(np.array(at)))
        for name, at in (("left", (0.0, -0.7, 0.6)), ("right", (0.0, 0.7, 0.6)))
    )
    shapes = np.stack([rigid(node) for node in nodes])
    return FlexibleBody("cab", "cabin", "cab", np.zeros(6), 0, 0.0, attachments, nodes, shapes, mesh)


def axle():
    mesh = (MeshPart("steel", corners((0, 0, 0.3), (0.2, 1.8, 0.2)), FACES, Material((92, 96, 102))),)
    return RigidBody("axle", "unsprung", "axle", 100.0, np.array([0, 0, 0.3]), 20 * np.eye(3), mesh)


# Where the first of two nodes is on the page, once the camera looks along the line through both.
PLACES = """
(() => {
  const { camera, canvas, nodeRefFromName } = window.__viserMutable;
  const onPicture = (name) =>
    nodeRefFromName[name]?.getWorldPosition(camera.position.clone()).project(camera);
  const [near, far] = a.names.map(onPicture);
  if (!near || !far || Math.abs(near.x - far.x) > 0.01) return null;
  const box = canvas.getBoundingClientRect();
  return [box.left + ((near.x + 1) / 2) * box.width, box.top + ((1 - near.y) / 2) * box.height];
})()
"""


@pytest.fixture(scope="module")
def vehicle():
    mounts = tuple(
        Mount(f"C {side}", "C", ("cab", "axle"), np.tile([0.0, y, 0.6], (2, 1)))
        for side, y in (("left", -0.7), ("right", 0.7))
    )
    bounds = (MountRates(1.0, 1.0, 1.0), MountRates(1e6, 1e6, 1e6))
    ground = np.tile([0.0, -0.8, 0.0], (2, 1))
    tyre = Tyre("tyre", "tyres", ("axle", GROUND), ground, np.array([1e5, 1e5, 2e5]))
    return Vehicle(
        "small",
        (cab(), axle()),
        (tyre,),
        (MountGroup("C", "cab", RATES, 0.1, bounds, mounts),),
        response_points=(ResponsePoint("seat", "cab", np.array([0.0, -0.7, 0.6])),),
    )


@pytest.fixture(scope="module")
def modal(vehicle):
    return solve_modal(prepare_modes(vehicle), {})


@pytest.fixture(scope="module")
def chosen():
    return []


@pytest.fixture(scope="module")
def scene(server, vehicle, chosen):
    # loading an environment map takes half a minute of software rendering
    server.scene.configure_environment_map = lambda *_, **__: None
    return Scene(server, vehicle, False, chosen.append)


@pytest.fixture(scope="module")
def page(server, scene, open_page):
    return open_page(server, viewport=(900, 400))  # the control panel leaves the middle free


def solved(modal, mode=6, **fields):
    state = State({"C": RATES}, Conditions("none", 20.0), "", **({"group": "C"} | fields))
    name, shape = modal.names[mode], modal.modes.shapes[:, mode]
    f = float(modal.modes.frequency_hz[mode])
    return Solved(
        state=state,
        named={"Original": modal},
        now=modal,
        track=None,
        mode=mode,
        name=name,
        shape=shape,
        movement=Movement(name.name, f, "", shape, None),
        wheels={},
        seconds=0.0,
        rest=None,
        classic_error=None,
        is_detailed=True,
    )


def node(page, name):
    """The properties of a node of the scene."""
    return page.evaluate("name => window.__viserSceneTree.getState()[name]?.message.props", name)


def drawn(page, body):
    """The shape the page draws, the opacity of its first material and whether that has colours."""
    bits, opacity, colored = page.evaluate(
        """name => {
          let mesh;
          const group = window.__viserMutable.nodeRefFromName[name];
          group?.traverse((object) => { if (object.geometry?.index) mesh ??= object; });
          if (!mesh?.geometry.attributes.modevizReal) return [[], 0, false];
          const shape = Array.from(mesh.geometry.attributes.modevizReal.array);
          return [shape, mesh.material.opacity, mesh.material.vertexColors];
        }""",
        f"/vehicle/{body}",
    )
    return np.array(bits, np.uint16).view(np.float16).astype(float).reshape(-1, 3), opacity, colored


def show(scene, page, answer):
    """Draws an answer, and waits until the page has taken over every body's shape."""
    scene.show(answer)
    for body in ("cab", "axle"):
        sent = scene.driver._shapes[f"/vehicle/{body}"].astype(np.float16)
        wait_until(page, lambda body=body, sent=sent: np.array_equal(drawn(page, body)[0], sent))


def test_shape_is_drawn_in_proportion_with_its_largest_at_a_fortieth_of_the_length(scene, page, modal):
    mode = 7
    show(scene, page, solved(modal, mode, see_through=False))
    bodies = [drawn(page, body)[0] for body in ("cab", "axle")]
    assert max(np.linalg.norm(b, axis=1).max() for b in bodies) == pytest.approx(4.0 / 40, rel=HALF)
    q = modal.modes.shapes[modal.prepared.system.dofs["axle"], mode]
    exact = q[:3] + np.cross(q[3:], corners((0, 0, 0.3), (0.2, 1.8, 0.2)) - [0, 0, 0.3])
    cab_q = modal.modes.shapes[modal.prepared.system.dofs["cab"], mode]
    cab_exact = modal.vehicle.body("cab").shapes[:, :3] @ cab_q
    factor = 0.1 / max(np.linalg.norm(exact, axis=1).max(), np.linalg.norm(cab_exact, axis=1).max())
    assert bodies[1] == pytest.approx(factor * exact, abs=0.1 * HALF)
    assert bodies[0] == pytest.approx(factor * cab_exact, abs=0.1 * HALF)


def test_cab_is_seen_through_and_axle_is_not(scene, page, modal):
    show(scene, page, solved(modal, 8, see_through=True))
    wait_until(page, lambda: drawn(page, "cab")[1:] == (0.5, False))
    wait_until(page, lambda: drawn(page, "axle")[1:] == (1, False))


def test_displacement_colors_are_on_opaque_bodies(scene, page, modal):
    show(scene, page, solved(modal, 9, coloring="displacement", see_through=True))
    wait_until(page, lambda: drawn(page, "cab")[1:] == (1, True))
    wait_until(page, lambda: drawn(page, "axle")[1:] == (1, True))


def test_outlines_at_rest_are_those_of_the_cab_and_can_be_put_away(scene, page, modal):
    visible = "window.__viserSceneTree.getState()['/ghost/cab'].visibility === a.wanted"
    for ghost in ("none", "rest"):
        scene.show(solved(modal, ghost=ghost))
        wait_for(page, visible, wanted=ghost == "rest")
    assert node(page, "/ghost/axle") is None


def test_card_says_what_the_selected_group_is_and_does(scene, page, modal):
    mode = 8
    scene.show(solved(modal, mode))
    share = modal.strain_energy["C"][mode]
    text = (
        "C  cab, left + right\nvertical 200  lateral 100  fore-aft 50 N/mm\n"
        f"{100 * share:.0f} % of strain energy in {modal.names[mode].name}"
    )
    wait_for(
        page, "window.__viserSceneTree.getState()['/card'].message.props.text === a.text", text=text
    )
    assert page.evaluate("window.__viserSceneTree.getState()['/mounts/C left/ring'].visibility")
    scene.show(solved(modal, mode, group=""))
    wait_for(page, "!window.__viserSceneTree.getState()['/card'].visibility")
    assert not page.evaluate("window.__viserSceneTree.getState()['/mounts/C left/ring'].visibility")


def test_markers_stand_at_the_mounts_and_points(scene, page):
    positions = page.evaluate(
        """names => names.map((name) => window.__viserMutable.nodePoseData[name].position)""",
        ["/mounts/C left", "/mounts/C right", "/points/seat", "/patches/tyre"],
    )
    expected = [[0, -0.7, 0.6], [0, 0.7, 0.6], [0, -0.7, 0.6], [0, -0.8, 0.004]]
    assert np.array(positions) == pytest.approx(np.array(expected), abs=1e-6)


def test_view_stays_framed_when_the_page_narrows_until_somebody_moves_the_camera(server, scene, page):
    client = next(iter(server.get_clients().values()))

    def distance():
        return np.linalg.norm(client.camera.position - client.camera.look_at)

    def resize(width):
        page.set_viewport_size({"width": width, "height": 400})
        wait_until(page, lambda: client.camera.image_width == width)

    try:
        scene.look(client, "Iso")
        wide = distance()
        resize(200)
        wait_until(page, lambda: distance() == pytest.approx(wide * 0.98 / 0.5, rel=1e-3))
        resize(900)
        wait_until(page, lambda: distance() == pytest.approx(wide, rel=1e-3))
        page.mouse.move(450, 200)
        page.mouse.wheel(0, 300)
        wait_until(page, lambda: distance() > 1.02 * wide)
        page.wait_for_timeout(1000)  # the wheel's motion runs out
        moved = distance()
        resize(200)
        page.wait_for_timeout(1000)  # nothing is to happen
        assert distance() == pytest.approx(moved, rel=1e-3)
    finally:
        resize(900)


def test_clicking_a_mount_selects_its_group(server, scene, page, chosen):
    client = next(iter(server.get_clients().values()))
    scene.look(client, "Side")
    seen = wait_for(page, PLACES, names=["/mounts/C left/rubber", "/mounts/C right/rubber"])
    page.mouse.move(*seen)
    page.mouse.click(*seen)
    wait_until(page, lambda: chosen)
    assert chosen == ["C"]
