"""Random use of an open page: whatever is there to be moved, pressed, typed into or looked at."""

import random
from collections.abc import Callable

from playwright.sync_api import Page

LEFT_OUT = r"save|record|download|export|import|report|upload|png|gif|mp4|html"
"""Buttons that write files or ask for them, which takes long."""

TYPED = ("0", "131.4", "250", "1e9", "-5", "abc", "", "99999", "0.5", "724")
KEYS = ("ArrowLeft", "ArrowRight", "PageUp", "PageDown", "Home", "End")
HOTKEYS = ("n", "p", "Space", "Control+z", "Control+Shift+z", "b")

MARK = """
([selector, leftOut, pick]) => {
  const seen = [...document.querySelectorAll(selector)].filter((element) => {
    const box = element.getBoundingClientRect();
    const text = element.textContent + (element.getAttribute("aria-label") ?? "");
    return box.width > 0 && box.height > 0 && !element.disabled && !new RegExp(leftOut, "i").test(text);
  });
  document.querySelector("[data-monkey]")?.removeAttribute("data-monkey");
  if (!seen.length) return false;
  seen[Math.floor(pick * seen.length)].setAttribute("data-monkey", "");
  return true;
}
"""
"""Marks one of the elements that can be seen."""

MARKED = "document.querySelector('[data-monkey]')"
TRACK = """
() => {
  const thumb = document.querySelector("[data-monkey]");
  thumb?.scrollIntoView({ block: "nearest" });
  const track = thumb?.parentElement?.parentElement?.getBoundingClientRect();
  const box = thumb?.getBoundingClientRect();
  return track ? [box.x + box.width / 2, box.y + box.height / 2, track.x, track.width] : null;
}
"""
CLOSE = """
() => {
  const said = [...document.querySelectorAll('.mantine-Notification-root')].map((x) => x.innerText);
  document.querySelectorAll('.mantine-Notification-closeButton, .mantine-Modal-close')
    .forEach((button) => button.click());
  return said;
}
"""


class Monkey:
    """Acts on a page at random, the same way for the same seed."""

    def __init__(self, page: Page, seed: int) -> None:
        """Takes over a page that has been loaded."""
        self._page, self._random = page, random.Random(seed)
        self._ways: list[tuple[int, Callable[[], None]]] = [
            (30, self._step_slider),
            (10, self._drag_slider),
            (10, self._type),
            (16, lambda: self._press("button")),
            (12, lambda: self._press(".mv label")),
            (8, lambda: self._press("[role=tab]")),
            (6, lambda: self._press("input[type=checkbox]")),
            (6, self._choose),
            (6, self._touch_scene),
            (4, self._hotkey),
        ]

    def act(self) -> list[str]:
        """Does one thing and closes what then stands in the way: gives the notices that were there."""
        weights, ways = zip(*self._ways, strict=True)
        (way,) = self._random.choices(ways, weights)
        way()
        return self._page.evaluate(CLOSE)

    def _mark(self, selector: str) -> bool:
        return self._page.evaluate(MARK, [selector, LEFT_OUT, self._random.random()])

    def _press(self, selector: str) -> None:
        if self._mark(selector):
            self._page.evaluate(f"{MARKED}?.click()")

    def _step_slider(self) -> None:
        if self._mark(".mantine-Slider-thumb"):
            self._page.evaluate(f"{MARKED}?.focus()")
            for _ in range(self._random.randint(1, 4)):
                self._page.keyboard.press(self._random.choice(KEYS))

    def _drag_slider(self) -> None:
        if not self._mark(".mantine-Slider-thumb"):
            return
        found = self._page.evaluate(TRACK)
        if found is None:  # it went with its panel
            return
        x, y, left, width = found
        self._page.mouse.move(x, y)
        self._page.mouse.down()
        for _ in range(self._random.randint(2, 8)):
            self._page.mouse.move(left + self._random.random() * width, y)
        self._page.mouse.up()

    def _type(self) -> None:
        if self._mark("input.mantine-NumberInput-input, input.mantine-TextInput-input"):
            self._page.evaluate(f"{MARKED}?.select()")
            self._page.keyboard.type(self._random.choice(TYPED))
            self._page.keyboard.press("Tab")

    def _choose(self) -> None:
        if self._mark("input[role=combobox], input.mantine-Select-input"):
            self._page.evaluate(f"{MARKED}?.click()")
            self._press("[role=option]")
            self._page.keyboard.press("Escape")

    def _touch_scene(self) -> None:
        canvas = self._page.locator("canvas").first.bounding_box()
        if canvas is None:
            return
        x, y = (
            canvas[corner] + self._random.uniform(0.2, 0.8) * canvas[side]
            for corner, side in (("x", "width"), ("y", "height"))
        )
        self._page.mouse.move(x, y)
        if self._random.random() < 0.5:
            self._page.mouse.click(x, y)
            return
        self._page.mouse.down()
        self._page.mouse.move(x + self._random.uniform(-60, 60), y + self._random.uniform(-60, 60))
        self._page.mouse.up()
        self._page.mouse.wheel(0, self._random.uniform(-100, 100))

    def _hotkey(self) -> None:
        self._page.evaluate("document.activeElement?.blur()")
        self._page.keyboard.press(self._random.choice(HOTKEYS))
