"""The tab of a body on its mounts in a real page: its table, and lines that are drawn and move."""

import pytest
from apps import SOLVE_S, open_app
from four_cylinder import TORQUE_ROLL, four_cylinder
from pages import wait_for

from modeviz.cli.options import RoadOptions
from modeviz.viewer.session.commands.decisions import SetRate

NODE_SEEN = "window.__viserSceneTree.getState()['/axes/' + a.name]?.effectiveVisibility"
DRAWN = f"{NODE_SEEN} === true"
GONE = f"!{NODE_SEEN}"
POSE = "window.__viserMutable.nodePoseData['/axes/' + a.name]"
MOVED = f"Math.abs({POSE}.position[1] - a.before) > 1e-4"
ALONG_Z = f"""(() => {{
  const [w, x, y, z] = {POSE}.wxyz;
  return [2 * (x * z + w * y), 2 * (y * z - w * x), w * w - x * x - y * y + z * z];
}})()"""
CELLS = "[...document.querySelectorAll('.mv .axes td')]"
TRIPLES = rf"{CELLS}.filter((td) => /^\S+ \S+ \S+$/.test(td.innerText))"
SHOW = """(name) => {
  const enter = new KeyboardEvent("keydown", { key: "Enter", bubbles: true });
  document.querySelector(`[role="tab"][title="${name}"]`).dispatchEvent(enter);
}"""


@pytest.fixture(scope="module")
def app(server):
    vehicle, conditions = RoadOptions().shown(four_cylinder())
    with open_app(server, vehicle, conditions) as app:
        app.start()
        assert app.session.wait(SOLVE_S)
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    return open_page(server, viewport=(1280, 800))


def test_axes_are_drawn_once_wanted_and_follow_the_rates(app, page):
    wait_for(page, "document.querySelector('[role=tab][title=Rigid]') !== null")
    page.evaluate(SHOW, "Rigid")
    wait_for(page, "document.querySelectorAll('.mv .heat td i').length === 36")
    wait_for(page, GONE, name="torque roll axis")
    page.get_by_label("Draw axes").click()
    for name in ("torque roll axis", "elastic torque axis", "elastic centre"):
        wait_for(page, DRAWN, name=name)
    found = wait_for(page, ALONG_Z, name="torque roll axis")
    assert found == pytest.approx(TORQUE_ROLL, abs=1e-4)
    before = wait_for(page, f"{POSE}.position[1]", name="elastic centre")
    app.session.do(SetRate("M1", "vertical", 9e5))
    wait_for(page, MOVED, name="elastic centre", before=before)
    held = app.session.wait_for_answer(SOLVE_S).rigid_axes.held
    now = wait_for(page, f"{POSE}.position", name="elastic centre")
    assert now == pytest.approx(held.center.tolist(), abs=1e-5)
    wait_for(page, GONE, name="focus")


def test_on_a_usual_screen_three_numbers_are_one_line(page):
    page.set_viewport_size({"width": 1440, "height": 900})
    page.evaluate(SHOW, "Rigid")
    wait_for(page, f"{TRIPLES}.length >= 6 && {TRIPLES}.every((td) => td.clientHeight < 28)")
