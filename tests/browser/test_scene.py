from dataclasses import replace
from itertools import combinations

import numpy as np
import pytest
from pages import draw_on, wait_for, wait_until
from session_commands import altered

from modeviz.analysis.modal_results import solve_modal
from modeviz.analysis.preparation import prepare_modes
from modeviz.analysis.results import Conditions
from modeviz.shapes.motion import default_amplitude
from modeviz.shapes.surface import surface, vertex_areas
from modeviz.vehicle.bodies import Attachment, FlexibleBody, Material, MeshPart, RigidBody
from modeviz.vehicle.connections import GROUND, Mount, Tyre
from modeviz.vehicle.loads import ResponsePoint
from modeviz.vehicle.mount_group import MountGroup
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.vehicle import Vehicle
from modeviz.viewer.scene import stage
from modeviz.viewer.scene.fixed_marks import PATCH_Z
from modeviz.viewer.scene.scene import Scene
from modeviz.viewer.scene.stage import VIEWS
from modeviz.viewer.session.answers import Solved
from modeviz.viewer.session.coloring import energy_shares, largest_share
from modeviz.viewer.session.cursor import CursorForces
from modeviz.viewer.session.design import Design
from modeviz.viewer.session.followed_mode import FollowedMode
from modeviz.viewer.session.movement import Movement
from modeviz.viewer.session.named_results import Named
from modeviz.viewer.session.state import Motion, State
from modeviz.viewer.session.static_answers import SolvedStatics, StaticAnswer

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

PUT_BACK = "__viserMutable.resetCameraPose(false); __viserMutable.cameraControl.update(0)"
SEEN_FROM = """(({ camera, nodeRefFromName }) =>
  nodeRefFromName["/vehicle"].worldToLocal(camera.position.clone()).toArray()
)(__viserMutable)"""
RUBBER = "window.__viserSceneTree.getState()['/mounts/C left/rubber'].message.props.color"


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


NOT_SOLVED = StaticAnswer(None, "not solved")


def solved(modal, mode=6, **fields):
    first = State(Design({"C": RATES}), Conditions("none", 20.0), Motion(""), group="C")
    state = altered(first, **fields)
    name, shape = modal.names[mode], modal.modes.shapes[:, mode]
    f = float(modal.modes.frequency_hz[mode])
    return Solved(
        state=state,
        missing="",
        named=Named({"Original": modal}, {}),
        now=modal,
        followed=FollowedMode(modal, modal, mode, mode, name, shape, None, (), is_detailed=True),
        movement=Movement(name.name, name.name, f, "", shape, None),
        wheels={},
        static=SolvedStatics(NOT_SOLVED, NOT_SOLVED),
        cursor=CursorForces(),
        seconds=0.0,
        classic_error=None,
        findings=None,
    )


def node(page, name):
    """The properties of a node of the scene."""
    return page.evaluate("name => window.__viserSceneTree.getState()[name]?.message.props", name)


def drawn(page, body):
    """The shape the page draws, the opacity of its first material and the shade that colours it."""
    values, is_half, opacity, shade = page.evaluate(
        """name => {
          let mesh;
          const group = window.__viserMutable.nodeRefFromName[name];
          group?.traverse((object) => { if (object.geometry?.index) mesh ??= object; });
          if (!mesh?.geometry.attributes.modevizReal) return [[], false, 0, null];
          const { array } = mesh.geometry.attributes.modevizReal;
          const { opacity, vertexColors, userData } = mesh.material;
          const shade = vertexColors ? userData.shade.value : null;
          return [Array.from(array), array instanceof Uint16Array, opacity, shade];
        }""",
        body if body.startswith("/") else f"/vehicle/{body}",
    )
    shape = np.array(values, np.uint16).view(np.float16) if is_half else np.array(values)
    return shape.astype(float).reshape(-1, 3), opacity, shade


def show(scene, page, answer):
    """Draws an answer, and waits until the page has taken over the cab's shape, with which all come."""
    scene.show(answer)
    sent = scene.driver._shapes["/vehicle/cab"].real.astype(np.float16)
    wait_until(page, lambda: np.array_equal(drawn(page, "cab")[0], sent))


def displacements(modal, shape):
    """Of the corners of cab and axle, by their rigid motions."""
    cab, axle = (shape[modal.prepared.system.dofs[body]] for body in ("cab", "axle"))
    arms = corners((0, 0, 0.3), (0.2, 1.8, 0.2)) - [0, 0, 0.3]
    return modal.vehicle.body("cab").shapes[:, :3] @ cab, axle[:3] + np.cross(axle[3:], arms)


def amplitude(modal, shapes):
    """The factor with which the displacements of cab and axle are drawn."""
    areas = [vertex_areas(surface(body.mesh)) for body in modal.vehicle.bodies]
    return default_amplitude(shapes, areas, length=4.0)


def test_bodies_are_drawn_in_proportion(scene, page, modal):
    mode = 7
    show(scene, page, solved(modal, mode, see_through=False))
    bodies = [drawn(page, body)[0] for body in ("cab", "axle")]
    exact = displacements(modal, modal.modes.shapes[:, mode])
    factor = amplitude(modal, exact)
    turn = factor * np.abs(modal.modes.shapes[modal.prepared.system.dofs["axle"], mode][3:]).max()
    assert bodies[1] == pytest.approx(factor * exact[1], abs=HALF * (0.2 + 2 * turn))
    assert bodies[0] == pytest.approx(factor * exact[0], abs=0.2 * HALF)


def test_amplitude_goes_by_what_is_drawn(scene, modal):
    system, shape = modal.prepared.system, modal.modes.shapes[:, 7]
    for hidden, largest in (("axle", "cab"), ("cab", "axle")):
        shapes = scene.show_shape(system, shape, None, hidden={hidden})
        assert np.linalg.norm(shapes[largest], axis=1).max() == pytest.approx(4.0 / 40)


def test_cab_is_seen_through_and_axle_is_not(scene, page, modal):
    show(scene, page, solved(modal, 8, see_through=True))
    wait_until(page, lambda: drawn(page, "cab")[1:] == (0.5, None))
    wait_until(page, lambda: drawn(page, "axle")[1:] == (1, None))


def test_displacement_colors_are_on_opaque_bodies(scene, page, modal):
    show(scene, page, solved(modal, 9, coloring="displacement", see_through=True))
    shade = [pytest.approx(1 / 0.1), 1]
    wait_until(page, lambda: drawn(page, "cab")[1:] == (1, shade))
    wait_until(page, lambda: drawn(page, "axle")[1:] == (1, shade))


def test_kinetic_energy_colors_the_body_that_has_most_of_it_to_the_end_of_the_scale(scene, page, modal):
    mode = 7
    answer = solved(modal, mode, coloring="kinetic energy")
    show(scene, page, answer)
    shares = {body: share[mode] for body, share in modal.kinetic_energy.items()}
    assert dict(energy_shares(answer)) == pytest.approx(shares)
    for body, share in shares.items():
        wait_until(page, lambda body=body: (drawn(page, body)[2] or [0, 0])[1] == 2)
        shape, _, (gain, _) = drawn(page, body)
        most = (shape**2).sum(axis=1).max()
        assert gain * most == pytest.approx(share / max(shares.values()), rel=4 * HALF)


def test_strain_energy_colors_mounts_on_the_scale_of_the_bodies(scene, page, modal):
    answer = solved(modal, 7, coloring="strain energy", group="")
    show(scene, page, answer)
    shares = energy_shares(answer)
    assert set(shares) == {"cab", "C"}  # no tyres: they are not drawn as what is strained
    assert largest_share(shares) == shares["C"] > shares["cab"]
    wait_until(page, lambda: drawn(page, "cab")[2] == [shares["cab"] / shares["C"], 0])
    last = "[176, 44, 52]"
    wait_for(page, f"JSON.stringify({RUBBER}) === a.last.replaceAll(' ', '')", last=last)
    scene.show(solved(modal, 7, group=""))
    wait_for(page, f"JSON.stringify({RUBBER}) === '[236,190,96]'")


def test_bodies_are_left_out_one_by_one_with_what_hangs_only_on_them(scene, page, modal):
    def shown(*hidden):
        scene.show(solved(modal, hidden=frozenset(hidden)))
        names = ["/vehicle/cab", "/ghost/cab", "/vehicle/axle", "/mounts/C left", "/points/seat"]
        names.append("/patches/tyre")
        read = "a.names.map((n) => window.__viserSceneTree.getState()[n].effectiveVisibility)"
        return lambda: page.evaluate(f"a => {read}", {"names": names})

    found = shown("cab")
    wait_until(page, lambda: found() == [False, False, True, True, False, True])
    found = shown("cab", "axle")
    wait_until(page, lambda: found() == [False] * 6)
    found = shown()
    wait_until(page, lambda: found() == [True] * 6)


def test_complex_shape_is_drawn_with_both_parts_and_its_outlines_with_another(scene, page, modal):
    first, second = modal.modes.shapes[:, 7], modal.modes.shapes[:, 8]
    answer = solved(modal, 7, ghost="compared")
    movement = Movement("Damped", "damped", 1.0, "", first + 1j * second, second)
    show(scene, page, replace(answer, movement=movement))
    (cab, axle), (beside, _) = displacements(modal, movement.shape), displacements(modal, second)
    factor = amplitude(modal, (cab, axle))
    assert drawn(page, "cab")[0] == pytest.approx(factor * cab.real, abs=0.2 * HALF)
    ghost = drawn(page, "/ghost/cab")[0]
    assert ghost == pytest.approx(factor * beside, rel=HALF, abs=0.2 * HALF)
    scene.show(solved(modal, 7, ghost="rest"))
    wait_until(page, lambda: not drawn(page, "/ghost/cab")[0].any())


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
        page,
        "window.__viserSceneTree.getState()['/card/text'].message.props.text === a.text",
        text=text,
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
    expected = [[0, -0.7, 0.6], [0, 0.7, 0.6], [0, -0.7, 0.6], [0, -0.8, PATCH_Z * 4.0]]
    assert np.array(positions) == pytest.approx(np.array(expected), abs=1e-6)


COME_TO_REST = """() => new Promise((done) => {
  const { camera, requestRender } = window.__viserMutable;
  let last, since = 0;
  const look = () => {
    requestRender();
    const now = camera.matrixWorld.elements.join();
    since = now === last ? since + 1 : 0;
    last = now;
    if (since < 20) requestAnimationFrame(look); else done();
  };
  look();
})"""

SNAP = 2e-5
"""Twice the 1e-5 by which the page's camera jumps to rest without telling the server."""

DISTANCE = """(() => {
  const { camera, cameraControl } = window.__viserMutable;
  return camera.position.distanceTo(cameraControl.getTarget(camera.position.clone()));
})()"""


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
        wait_until(page, lambda: distance() > 1.5 * wide)
        resize(900)
        wait_until(page, lambda: distance() == pytest.approx(wide, rel=1e-3))
        page.mouse.move(450, 200)
        page.mouse.wheel(0, 300)
        wait_until(page, lambda: distance() > 1.02 * wide)
        page.evaluate(COME_TO_REST)  # the wheel's motion runs out
        own = page.evaluate(DISTANCE)
        wait_until(page, lambda: distance() == pytest.approx(own, abs=SNAP))
        moved = distance()
        resize(200)
        draw_on(page)  # nothing is to happen
        assert distance() == pytest.approx(moved, rel=1e-3)
    finally:
        resize(900)


def test_view_is_framed_again_when_viser_has_put_the_camera_where_pages_begin(server, scene, page):
    client = next(iter(server.get_clients().values()))
    scene.look(client, "Side")
    framed = client.camera.position
    wait_until(page, lambda: page.evaluate(SEEN_FROM) == pytest.approx(framed, abs=1e-3))
    begin = page.evaluate(f"() => {{ {PUT_BACK}; return {SEEN_FROM}; }}")
    assert begin == pytest.approx(server.initial_camera.position, abs=1e-3)
    wait_until(page, lambda: page.evaluate(SEEN_FROM) == pytest.approx(framed, abs=1e-3))


def test_camera_glides_to_the_mounts_that_are_followed_and_back(server, scene, page, modal, vehicle):
    camera = next(iter(server.get_clients().values())).camera
    scene.look(next(iter(server.get_clients().values())), "Side")
    framed, offset = camera.look_at, camera.position - camera.look_at
    scene.show(solved(modal, follow=True))
    step = np.array([0, 0, 0.6]) - stage.box(vehicle).middle
    wait_until(page, lambda: np.allclose(camera.look_at, framed + step, atol=1e-3))
    assert camera.position - camera.look_at == pytest.approx(offset, abs=1e-3)
    scene.show(solved(modal, follow=False))
    wait_until(page, lambda: np.allclose(camera.look_at, framed, atol=1e-3))
    assert camera.position - camera.look_at == pytest.approx(offset, abs=1e-3)


@pytest.mark.parametrize("moved", [False, True])
def test_a_body_alone_fills_the_picture(server, scene, page, modal, vehicle, moved):
    client = next(iter(server.get_clients().values()))
    camera = client.camera
    scene.show(solved(modal))
    scene.look(client, "Side")
    whole, framed = stage.box(vehicle), camera.position
    if moved:
        camera.position = away = framed + np.array([0.2, -0.3, 0.1])
        wait_until(page, lambda: page.evaluate(SEEN_FROM) == pytest.approx(away, abs=1e-3))
        wait_until(page, lambda: camera.position == pytest.approx(away, abs=1e-3))
    distance = np.linalg.norm(camera.position - camera.look_at)
    shown = solved(modal)
    scene.show(replace(shown, movement=replace(shown.movement, bodies=frozenset({"cab"}))))
    cab = stage.bodies_box([vehicle.body("cab")])
    if moved:
        wait_until(page, lambda: np.allclose(camera.look_at, cab.middle, atol=1e-3))
        left = np.linalg.norm(camera.position - camera.look_at)
        assert left == pytest.approx(distance * cab.length / whole.length, rel=1e-3)
    else:
        seen = stage.camera(cab, "Side", camera.image_width, camera.image_height)
        wait_until(page, lambda: np.allclose(camera.position, seen[0], atol=1e-3))
    scene.show(shown)
    scene.look(client, "Side")
    wait_until(page, lambda: np.allclose(camera.position, framed, atol=1e-3))


@pytest.mark.parametrize("view", VIEWS)
def test_labels_are_apart_from_each_other_in_every_view(server, scene, page, modal, view):
    scene.show(solved(modal))
    scene.look(next(iter(server.get_clients().values())), view)

    def are_apart():
        places = page.evaluate("Object.values(window.__modevizLabels.places)")
        return len(places) >= 2 and all(
            a["right"] <= b["left"]
            or b["right"] <= a["left"]
            or a["bottom"] <= b["top"]
            or b["bottom"] <= a["top"]
            for a, b in combinations(places, 2)
        )

    wait_for(page, "window.__modevizLabels.places['/card/text']")
    wait_until(page, are_apart)


def test_clicking_a_mount_selects_its_group(server, scene, page, chosen):
    client = next(iter(server.get_clients().values()))
    scene.look(client, "Side")
    there = client.camera.position
    wait_until(page, lambda: page.evaluate(SEEN_FROM) == pytest.approx(there, abs=1e-3))
    seen = wait_for(page, PLACES, names=["/mounts/C left/rubber", "/mounts/C right/rubber"])
    page.mouse.move(*seen)
    page.mouse.click(*seen)
    wait_until(page, lambda: chosen)
    assert chosen == ["C"]


def test_clicking_a_label_selects_the_group_of_its_mount(server, scene, page, modal, chosen):
    scene.show(solved(modal, group=""))
    scene.look(next(iter(server.get_clients().values())), "Iso")
    chosen.clear()

    def is_chosen():  # by a click where the label is now: the camera may still be on its way
        place = wait_for(page, "window.__modevizLabels.places['/mounts/C left/name']")
        canvas = page.evaluate("window.__viserMutable.canvas.getBoundingClientRect().toJSON()")
        x = canvas["left"] + (place["left"] + place["right"]) / 2
        page.mouse.click(x, canvas["top"] + (place["top"] + place["bottom"]) / 2)
        return chosen

    wait_until(page, is_chosen)
    assert set(chosen) == {"C"}
    chosen.clear()
