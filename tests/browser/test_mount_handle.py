"""Mounts dragged in the scene of a real page."""

from dataclasses import replace

import numpy as np
import pytest
from apps import SOLVE_S, listening, n_bytes, open_solved_cabin
from mount_controls import open_folder
from mounted_cabin import mounted_cabin
from pages import CLOSE_NOTICES, draw_on, wait_for, wait_until

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import solve
from modeviz.files import read_vehicle, write_vehicle
from modeviz.vehicle.alterations import Alterations
from modeviz.vehicle.placement import Placement
from modeviz.viewer.scene.mount_handle import SIZE_PX
from modeviz.viewer.session.commands.decisions import DragMounts

HANDLE = "/mount handle"
IS_SEEN = "window.__viserSceneTree.getState()[a.name]?.effectiveVisibility === true"
PLACE = "window.__viserMutable.nodePoseData[a.name]?.position"
ON_PAGE = """([name, along]) => {
  const { camera, canvas, nodeRefFromName } = window.__viserMutable;
  const node = nodeRefFromName[name];
  node.updateWorldMatrix(true, false);
  const vector = () => camera.position.clone();
  const root = node.getWorldPosition(vector());
  const axis = node.localToWorld(vector().set(1, 0, 0)).sub(root).normalize();
  const view = root.clone().sub(camera.position).normalize();
  const seen = Math.sqrt(1 - axis.dot(view) ** 2);
  const { left, top, width, height } = canvas.getBoundingClientRect();
  const onPage = (place) => {
    const { x, y } = place.clone().project(camera);
    return [left + (width * (1 + x)) / 2, top + (height * (1 - y)) / 2];
  };
  const [x, y] = onPage(root);
  const [to_x, to_y] = onPage(root.clone().addScaledVector(axis, 1e-3));
  const step = (along * seen) / Math.hypot(to_x - x, to_y - y);
  return [x + step * (to_x - x), y + step * (to_y - y)];
}"""
"""Where a point on the first arrow of the handle is on the page, so many pixels from its root as it is
long when it is seen from the side."""


OFF_PX = 5
"""How far beside the middle of an arrow's head a hand may take hold of it."""


@pytest.fixture(scope="module")
def app(server):
    with open_solved_cabin(server) as app:
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(1280, 800))
    wait_for(page, "document.querySelectorAll('.mv-rates').length === 2")
    page.evaluate(CLOSE_NOTICES)
    return page


def drag_along_x(page):
    """Drags the handle by its first arrow's head as far as that is long, once the camera rests."""
    before = None
    while (ends := [page.evaluate(ON_PAGE, [HANDLE, x]) for x in (0.82 * SIZE_PX, 0.0)]) != before:
        before = ends
        draw_on(page)
    tip, root = map(np.array, ends)
    aside = np.array([tip[1] - root[1], root[0] - tip[0]])
    tip = tip + OFF_PX * aside / np.linalg.norm(aside)  # no hand hits its middle
    page.mouse.move(*tip)
    page.mouse.down()
    for part in np.linspace(0, 1, 9)[1:]:
        page.mouse.move(*(tip + part * (tip - root)))
        page.wait_for_timeout(60)
    page.mouse.up()


def in_a_folder(offset, folder):
    """The cabin with its front mounts elsewhere, from a folder that has them there."""
    vehicle = mounted_cabin()
    front, rear = vehicle.mount_groups
    mounts = tuple(
        replace(mount, points=mount.points + np.multiply(offset, [1, side, 1]))
        for mount, side in zip(front.mounts, (1, -1), strict=True)
    )
    write_vehicle(replace(vehicle, mount_groups=(replace(front, mounts=mounts), rear)), folder)
    return read_vehicle(folder)


def test_mounts_dragged_in_the_scene_give_what_a_folder_with_that_place_gives(app, page, tmp_path):
    before = app.session.answer.now
    open_folder(page, "A")
    page.get_by_text("Place", exact=True).locator("visible=true").click()
    page.get_by_label("Handle", exact=True).locator("visible=true").click()
    wait_for(page, IS_SEEN, name=HANDLE)
    given = wait_for(page, PLACE, name=HANDLE)
    marker = "/mounts/A -0.5"
    assert given == pytest.approx(wait_for(page, PLACE, name=marker))
    handle = app.scene._handle
    drag_along_x(page)
    wait_until(page, lambda: app.session.can_undo and not handle._is_in_hand)
    assert app.session.can_undo
    assert app.session.wait(SOLVE_S)
    offset = app.session.state.design.alterations.placement("A").offset
    assert abs(offset[0]) > 0.02
    assert offset[1:] == pytest.approx((0, 0), abs=1e-6)
    for name in (HANDLE, marker):
        wait_for(page, f"Math.abs({PLACE}[0] - a.x) < 1e-4", name=name, x=given[0] + offset[0])
    fresh = in_a_folder(offset, tmp_path / "elsewhere")
    expected = solve(prepare(fresh), app.session.state.design.rates, before.conditions)
    now = app.session.answer.now
    assert now.modes.frequency_hz == pytest.approx(expected.modes.frequency_hz, rel=1e-9)
    np.testing.assert_allclose(now.psd, expected.psd, rtol=1e-7, atol=1e-12 * np.abs(now.psd).max())
    assert not np.allclose(now.psd, before.psd, rtol=0.01)
    wait_for(page, "document.body.textContent.includes(\"mounts 'A' are moved by\")")

    page.get_by_role("button", name="Undo", exact=True).click()
    wait_until(page, lambda: app.session.state.design.alterations == Alterations())
    assert app.session.wait(SOLVE_S)
    assert not app.session.can_undo
    assert app.session.answer.now.modes.frequency_hz == pytest.approx(before.modes.frequency_hz)
    for name in (HANDLE, marker):
        wait_for(page, f"Math.abs({PLACE}[0] - a.x) < 1e-6", name=name, x=given[0])


def test_the_handle_is_as_large_where_the_vehicle_is_far_away(app, page):
    for client in app.server.get_clients().values():
        client.camera.position = np.array(client.camera.look_at) + 6 * (
            np.array(client.camera.position) - client.camera.look_at
        )
    drag_along_x(page)
    wait_until(page, lambda: app.session.can_undo and not app.scene._handle._is_in_hand)
    offset = app.session.state.design.alterations.placement("A").offset
    assert offset[0] > 1.0  # m, of what is some 15 m away
    assert offset[1:] == pytest.approx((0, 0), abs=1e-6)
    app.session.undo()
    assert app.session.wait(SOLVE_S)


def test_a_move_is_a_small_message(app, server):
    with listening(server) as socket:
        app.session.do(DragMounts("A", Placement((0.05, 0, 0)), 0))
        assert app.session.wait(SOLVE_S)
        assert 0 < n_bytes(socket) < 200_000
    app.session.undo()
    assert app.session.wait(SOLVE_S)
