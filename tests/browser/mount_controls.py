"""Finding and moving the controls of mount rates on a page."""

from pages import wait_still, wait_until
from playwright.sync_api import Locator, Page

DIRECTIONS = ("vertical", "lateral", "fore-aft")


def sliders(page: Page, group: str) -> Locator:
    """The elements with the sliders of a group's rates; after each comes that with its number."""
    folder = f'div:has(> div > .mv-rates[data-group="{group}"])'
    return page.locator(f"{folder} > div:has(> .mantine-Flex-root .mantine-Slider-root)")


def row(page: Page, group: str, rate: str | int) -> Locator:
    """The slider of a rate, by its direction or its number among those of its group."""
    return sliders(page, group).nth(DIRECTIONS.index(rate) if isinstance(rate, str) else rate)


def thumb(page: Page, group: str, rate: str | int) -> Locator:
    """The handle of a rate's slider."""
    return row(page, group, rate).locator(".mantine-Slider-thumb")


def box(page: Page, group: str, rate: str | int) -> Locator:
    """The number of a rate."""
    return row(page, group, rate).locator("xpath=following-sibling::div[1]").locator("input")


def position(slider: Locator) -> int:
    return int(slider.get_attribute("aria-valuenow"))


def open_folder(page: Page, group: str) -> None:
    """Opens the folder of a group, if it is closed, and waits until it is."""

    def opened() -> bool:
        if not is_open(page, group):
            page.evaluate(TOGGLE, group)
            wait_still(page)  # the page's own script may have clicked as well
        return is_open(page, group)

    wait_until(page, opened)


TOGGLE = """(group) => document.querySelector(`.mv-rates[data-group="${group}"]`)
  .closest(".mantine-Paper-root").firstElementChild.click()"""
IS_OPEN = """(group) => {
  const marker = document.querySelector(`.mv-rates[data-group="${group}"]`);
  const folder = marker?.closest(".mantine-Paper-root");
  return Boolean(folder && folder.getBoundingClientRect().height > 55);
}"""


def is_open(page: Page, group: str) -> bool:
    return page.evaluate(IS_OPEN, group)


def drag(page: Page, slider: Locator, target: int) -> None:
    """Drags a slider with the mouse, then steps with the arrow keys to a position."""
    low, high = (int(slider.get_attribute(f"aria-value{end}")) for end in ("min", "max"))
    slider.scroll_into_view_if_needed()
    handle = slider.bounding_box()
    track = slider.locator("xpath=../..").bounding_box()
    y = handle["y"] + handle["height"] / 2
    page.mouse.move(handle["x"] + handle["width"] / 2, y)
    page.mouse.down()
    page.mouse.move(track["x"] + track["width"] * (target - low) / (high - low), y, steps=10)
    page.mouse.up()
    slider.focus()
    for _ in range(60):
        off = target - position(slider)
        if off == 0:
            return
        page.keyboard.press("ArrowRight" if off > 0 else "ArrowLeft")
    raise AssertionError(f"the slider stays at {position(slider)}, {target} was wanted")


def type_rate(page: Page, group: str, rate: str | int, text: str) -> None:
    """Types into the number of a rate, key by key, and leaves it."""
    number = box(page, group, rate)
    number.scroll_into_view_if_needed()
    number.click()
    number.press("ControlOrMeta+a")
    number.press_sequentially(text)
    number.blur()
