"""A study's page in the cells of a real notebook: live where it is in reach, and else a still."""

import urllib.error
import urllib.request

import pytest
from mount_controls import drag, position, thumb
from notebook_server import notebook_server, printed, run, shown
from pages import wait_for, wait_until
from playwright.sync_api import Frame, Page

SHOW = """from studied_cabin import cabin_study
study = cabin_study()
page = study.show(height=600)
page.app.server.scene.configure_environment_map(None)  # half a minute of software rendering
page"""
RATE = "print(page.rates['A'].vertical)"
LINK = "print(page.link)"
AGAIN = "page.close()\npage"
ELSEWHERE = "hub.localhost"
"""A name of this machine that notebooks of this machine do not have."""


@pytest.fixture(scope="module")
def jupyter(tmp_path_factory):
    with notebook_server(tmp_path_factory.mktemp("notebooks")) as server:
        server.write("study", [SHOW, RATE, LINK, AGAIN])
        yield server


@pytest.fixture(scope="module")
def tab(browser):
    page = browser.new_page(viewport={"width": 1100, "height": 900})
    page.set_default_timeout(60_000)
    yield page
    page.close()


def bench(tab: Page) -> Frame:
    """The live page in a cell, once it is solved."""
    frame = tab.wait_for_selector("iframe[title=modeviz]").content_frame()
    assert frame
    frame.wait_for_selector(".mantine-Slider-thumb")
    return frame


def tune(tab: Page, frame: Frame) -> None:
    """Drags a slider in a cell, after which the kernel has another rate."""
    before = float(printed(tab, 1))
    slider = thumb(frame, "A", "vertical")
    slider.scroll_into_view_if_needed()
    drag(tab, slider, position(slider) + 60)
    wait_until(tab, lambda: float(printed(tab, 1)) > 1.05 * before)


def answers(link: str) -> bool:
    try:
        urllib.request.urlopen(link.partition("?")[0], timeout=20)
    except urllib.error.HTTPError:
        return True
    except urllib.error.URLError:
        return False
    return True


def test_the_bench_is_dragged_inside_the_cell(jupyter, tab):
    jupyter.open(tab, "study")
    run(tab, 0)
    frame = bench(tab)
    assert frame.url.startswith("http://localhost:")
    assert "/proxy/" not in frame.url
    tune(tab, frame)
    assert shown(tab, 0).count("http") == 1  # the link, and nothing that viser prints


def test_a_kernel_elsewhere_is_reached_through_the_notebooks_server(jupyter, tab):
    jupyter.open(tab, "study", host=ELSEWHERE)
    run(tab, 0)
    frame = bench(tab)
    assert frame.url.startswith(f"http://{ELSEWHERE}:{jupyter.port}/proxy/")
    tune(tab, frame)


def test_a_closed_page_is_a_still_which_plays_without_a_server(jupyter, tab):
    run(tab, 3)
    says = "Jupyter.notebook.get_cell(a.cell).element.find('.mv-said:visible').text().includes(a.text)"
    wait_for(tab, says, cell=3, text="does not answer")
    wait_for(tab, says, cell=0, text="was closed")  # where the live page was is its still again
    assert tab.locator(".mv-still img:visible").count() == 2
    tab.locator(".mv-play:visible").last.click()
    frame = tab.wait_for_selector("iframe[src^='data:']").content_frame()
    frame.wait_for_function("window.__viserMutable?.scene")
    assert frame.locator(".motion input[name=amplitude]").is_visible()


def test_a_notebook_that_is_not_trusted_shows_the_still_and_no_script_runs(jupyter, tab):
    html = tab.evaluate("Jupyter.notebook.get_cell(3).output_area.toJSON()")
    jupyter.write("stranger", ["page"], html)
    jupyter.open(tab, "stranger")
    picture = tab.wait_for_selector("img")
    wait_for(tab, "document.querySelector('img[alt*=\"at its largest\"]')?.naturalWidth === 960")
    assert picture.is_visible()
    assert tab.locator("iframe[title=modeviz]").count() == 0
    assert "run the cell" in tab.locator(".output").inner_text()


def test_the_end_of_the_kernel_is_the_end_of_the_server(jupyter, tab):
    jupyter.open(tab, "study")
    run(tab, 0)
    bench(tab)
    link = printed(tab, 2)
    assert answers(link)
    for kernel in jupyter.ask("GET", "kernels"):
        jupyter.ask("DELETE", f"kernels/{kernel['id']}")
    wait_until(tab, lambda: not answers(link), 10)
