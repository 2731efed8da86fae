"""Reading what a page holds."""

import time
from collections.abc import Callable
from typing import Any

import viser
from playwright.sync_api import Page

CLOSE_NOTICES = (
    "document.querySelectorAll('.mantine-Notification-closeButton').forEach((b) => b.click())"
)

TENTHS = "window.tenths = 0; setInterval(() => window.tenths++, 100)"
"""Counts tenths of seconds as a page has them, which are late where a machine is busy."""

NOTICE = "document.getElementById('modeviz-connection')?.textContent"
"""What a page that is not connected says of it."""


def wait_for(page: Page, expression: str, **arguments: Any) -> Any:
    """Waits until a JavaScript expression of `a`, the arguments, is true, and returns its value."""
    handle = page.wait_for_function(f"a => {expression}", arg=arguments, polling=100)
    return handle.json_value()


def said_in_time(page: Page) -> str:
    """What a page that counts `TENTHS` says is wrong, within 5 s by that."""
    said, tenths = wait_for(page, f"{NOTICE} && [{NOTICE}, window.tenths]")
    assert tenths < 50
    return said


def has_beside(page: Page, width: int) -> bool:
    """Whether that much is left for the vehicle, but for the panels' borders."""
    canvas = page.evaluate("window.__viserMutable.canvas.clientWidth")
    return width - 20 < canvas <= width


def wait_still(page: Page) -> None:
    """Waits until nothing of the page's layout has moved for ten pictures."""
    page.evaluate(STILL)


STILL = """() => new Promise((done) => {
  let last, since = 0;
  const look = () => {
    const boxes = [...document.querySelectorAll("[data-dock-root] *")].map((element) => {
      const { left, top, width, height } = element.getBoundingClientRect();
      return [left, top, width, height];
    });
    const now = JSON.stringify(boxes);
    since = now === last ? since + 1 : 0;
    last = now;
    if (since < 10) requestAnimationFrame(look); else done();
  };
  look();
})"""


def draw_on(page: Page, n_pictures: int = 20) -> None:
    """Waits while a page draws on, for what it would do by itself to be done by then."""
    page.evaluate(DRAW_ON, n_pictures)


DRAW_ON = """(left) => new Promise((done) => {
  const draw = () => (left-- > 0 ? requestAnimationFrame(draw) : done());
  draw();
})"""


def wait_until(page: Page, reached: Callable[[], Any], seconds: float = 90.0) -> None:
    """Waits until something is true here, while the page goes on."""
    deadline = time.monotonic() + seconds
    while not reached():
        assert time.monotonic() < deadline, "the page did not get there in time"
        page.wait_for_timeout(50)


def send(page: Page, widget: viser.GuiInputHandle, value: Any) -> None:
    """Sends what the page would, moved to a value."""
    page.evaluate(
        """([uuid, value]) => window.__viserMutable.sendMessage({
            type: "GuiUpdateMessage", uuid, updates: { value } })""",
        [widget._impl.uuid, value],
    )
