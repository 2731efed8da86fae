from datetime import date

import pytest
from mounted_cabin import mounted_cabin
from PIL import Image
from playwright.sync_api import Page

from modeviz.analysis.preparation import prepare
from modeviz.analysis.results import Conditions
from modeviz.report.comparison import RateSet, compare
from modeviz.report.html import Picture, report

WIDTHS = (1280, 800)
A4 = 680
"""CSS pixels between the margins: 180 mm."""


@pytest.fixture(scope="module")
def address(tmp_path_factory) -> str:
    """A report with a picture, as a file."""
    folder = tmp_path_factory.mktemp("report")
    Image.new("RGB", (40, 30), "#2b7cc4").save(folder / "shape.png")
    vehicle = mounted_cabin()
    sets = RateSet("original", {}), RateSet("soft", vehicle.rate_sets["soft"])
    comparison = compare(prepare(vehicle), *sets, Conditions("flat", 20.0))
    text = report(
        comparison, date(2026, 11, 22), [Picture("a shape", (folder / "shape.png").read_bytes())]
    )
    (folder / "report.html").write_text(text, encoding="utf-8")
    return (folder / "report.html").as_uri()


@pytest.fixture
def page(browser, opened_pages, address):
    """The report in a page of its own, with the network off; what it asks for is an error."""
    context = browser.new_context(offline=True, viewport={"width": WIDTHS[0], "height": 800})
    page = context.new_page()
    errors = opened_pages[page] = []
    page.on("console", lambda message: errors.append(message.text))
    page.on("pageerror", lambda error: errors.append(str(error)))
    page.on("request", lambda r: r.url != address and r.url[:5] != "data:" and errors.append(r.url))
    page.goto(address)
    return page


def colors(page: Page) -> list[str]:
    """Of the paper, the text, and the curves of the first chart."""
    return page.evaluate(
        """() => {
            const style = e => getComputedStyle(e);
            const lines = [...document.querySelector('svg').querySelectorAll('polyline')];
            const body = style(document.body);
            return [body.backgroundColor, body.color, ...lines.map(l => style(l).stroke)];
        }"""
    )


def test_pictures_and_curves_are_drawn_without_a_network(page):
    assert page.evaluate("document.images[0].naturalWidth") == 40
    boxes = page.evaluate("[...document.querySelectorAll('polyline')].map(l => l.getBBox().width)")
    assert len(boxes) == 10
    assert min(boxes) > 400


@pytest.mark.parametrize("width", WIDTHS)
def test_nothing_is_wider_than_the_window(page, width):
    page.set_viewport_size({"width": width, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") == width
    inner = (
        "[...document.querySelectorAll('section')].filter(s => s.scrollWidth > s.clientWidth).length"
    )
    assert page.evaluate(inner) == 0


def test_a_dark_page_has_other_colours_and_paper_is_light(page):
    light = colors(page)
    assert light[0] == "rgb(255, 255, 255)"
    page.emulate_media(color_scheme="dark")
    dark = colors(page)
    assert all(one != other for one, other in zip(light, dark, strict=True))
    page.emulate_media(color_scheme="dark", media="print")
    assert colors(page)[0] == "rgb(255, 255, 255)"


def test_it_prints_on_a4(page):
    page.emulate_media(media="print")
    page.set_viewport_size({"width": A4, "height": 800})
    assert page.evaluate("document.documentElement.scrollWidth") == A4
    pdf = page.pdf(prefer_css_page_size=True)
    assert pdf.startswith(b"%PDF")
    assert b"/MediaBox [0 0 594.95996 841.91998]" in pdf
