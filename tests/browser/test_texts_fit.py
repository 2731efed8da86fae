"""Texts of the page stay in their places in windows of usual sizes, however long names are."""

from dataclasses import replace

import pytest
from apps import open_solved_cabin
from mounted_cabin import mounted_cabin
from pages import CLOSE_NOTICES, has_beside, wait_for, wait_still, wait_until

from modeviz.viewer.page.server import open_server
from modeviz.viewer.session.commands.decisions import SetRate

LONG = "Donaudampfschifffahrtsgesellschaftskapitän with a second, third and fourth name"
TABS = ("Variants", "Optimise", "View", "Pictures", "Mounts", "Energy", "Modes", "Figures", "Rigid",
    "Road", "Response", "What moves", "Motion")  # fmt: skip
SHOW = """(name) => {
  const enter = new KeyboardEvent("keydown", { key: "Enter", bubbles: true });
  document.querySelector(`[role="tab"][title="${name}"]`).dispatchEvent(enter);
}"""
TAB = '[role="tab"][title="${a.name}"]'
MISPLACED = """() => {
  const isSeen = (element) => element.offsetParent && element.getBoundingClientRect().width > 0;
  const all = (selector) => [...document.querySelectorAll(selector)].filter(isSeen);
  const nTops = (rects) => new Set(rects.map(({ top }) => Math.round(top))).size;
  const nRows = (element) => nTops([...element.children].map((e) => e.getBoundingClientRect()));
  const nLines = (element) => {
    const range = document.createRange();
    range.selectNodeContents(element);
    return nTops([...range.getClientRects()]);
  };
  const isOverContent = ({ children: [title, content] }) =>
    title.getBoundingClientRect().bottom > content.getBoundingClientRect().top + 14;
  const folders = all(".mv-rates").map((e) => e.closest(".mantine-Paper-root"));
  const found = {
    "two rows": all("[data-dock-strip], .mantine-Flex-root:has(> button)").filter((e) => nRows(e) > 1),
    "two lines": all(":has(> div > .mv-rates) .mantine-Flex-root label").filter((e) => nLines(e) > 1),
    "too wide": all(".mantine-ScrollArea-viewport").filter((e) => e.scrollWidth > e.clientWidth + 1),
    "over its folder": folders.filter(isOverContent),
  };
  return Object.entries(found).flatMap(([what, where]) => where.map((e) => [what, e.innerText]));
}"""
CUT = """() => [...document.querySelectorAll(".mv *")]
  .filter((e) => e.matches(".name") || getComputedStyle(e).textOverflow === "ellipsis")
  .filter((e) => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 2)
  .map((e) => e.innerText)"""


def long_named_cabin():
    cabin = mounted_cabin()
    bodies = tuple(replace(body, label=f"{LONG} {body.name}") for body in cabin.bodies)
    groups = tuple(replace(group, label=f"{group.label} {LONG}") for group in cabin.mount_groups)
    points = tuple(replace(point, name=f"{point.name} {LONG}") for point in cabin.response_points)
    roads = tuple(replace(road, label=f"{road.label} {LONG}") for road in cabin.roads)
    return replace(
        cabin, name=LONG, bodies=bodies, mount_groups=groups, response_points=points, roads=roads
    )


@pytest.fixture(scope="module", params=[mounted_cabin, long_named_cabin])
def app(request):
    server = open_server(port=0)
    server.scene.configure_environment_map(None)
    with open_solved_cabin(server, request.param()) as app:
        app.session.do(SetRate("A", "lateral", 2.34 * app.session.state.design.rates["A"].lateral))
        assert app.session.wait(60)
        yield app
    server.stop()


SIZES = {(1280, 720): 1280 - 300 - 380, (1920, 1080): 1920 - 376 - 484}
"""Of a window, pixels, and how much of its width is left for the vehicle."""


def test_texts_stay_in_their_places(app, open_page):
    """The scene is drawn coarsely: nothing of it is looked at."""
    page = open_page(app.server, viewport=min(SIZES), query="?fixedDpr=0.25")
    wait_for(page, "document.querySelector('.mv .title') && document.querySelector('.mv-rates')")
    page.evaluate(CLOSE_NOTICES)
    found: dict[tuple, list] = {}
    for (width, height), beside in SIZES.items():
        page.set_viewport_size({"width": width, "height": height})
        wait_until(page, lambda beside=beside: has_beside(page, beside))
        for tab in TABS:
            page.evaluate(SHOW, tab)
            wait_for(page, f"document.querySelector(`{TAB}`).ariaSelected === 'true'", name=tab)
            wait_still(page)
            found[width, tab] = page.evaluate(MISPLACED)
            if app.session.vehicle.name != LONG:
                found[width, tab] += page.evaluate(CUT)
    page.context.close()  # before its server ends
    assert not any(found.values()), {place: texts for place, texts in found.items() if texts}
