from contextlib import ExitStack
from pathlib import Path

import pytest
from pages import TENTHS, wait_for
from playwright.sync_api import Browser, Page

from modeviz.viewer.page.server import open_server
from modeviz.viewer.pictures import headless

TIMEOUT_MS = 60_000
SCENE_ALONE = ("--disable-gpu-rasterization", "--disable-gpu-compositing")


def pytest_collection_modifyitems(items):
    for item in items:
        if Path(__file__).parent in item.path.parents:
            item.add_marker(pytest.mark.browser)


@pytest.fixture(scope="session")
def browser():
    """One that has Mesa draw the scene alone, for in software it draws the rest of a page slowly."""
    with ExitStack() as opened:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(headless, "FLAGS", (*headless.FLAGS, *SCENE_ALONE))
            browser = opened.enter_context(headless.chromium())
        yield browser


@pytest.fixture(scope="module")
def server():
    server = open_server(port=0)
    server.scene.configure_default_lights(cast_shadow=False)
    server.scene.configure_environment_map(None)  # half a minute of software rendering
    yield server
    server.stop()


@pytest.fixture(scope="module")
def opened_pages(browser: Browser):
    """The errors of every page opened in this module, by page; it closes the pages."""
    pages: dict[Page, list[str]] = {}
    yield pages
    for page in pages:
        page.context.close()


@pytest.fixture(scope="module")
def open_page(browser: Browser, opened_pages):
    """Opens a page on a server and waits for its scene."""

    def open_page(server, viewport=(480, 360), query="?fixedDpr=1", scale=1) -> Page:
        size = {"width": viewport[0], "height": viewport[1]}
        page = browser.new_context(viewport=size, device_scale_factor=scale).new_page()
        errors = opened_pages[page] = []
        page.set_default_timeout(TIMEOUT_MS)
        page.on("pageerror", lambda error: errors.append(f"page error: {error}"))
        page.on("console", lambda message: message.type == "error" and errors.append(message.text))
        page.goto(f"http://127.0.0.1:{server.get_port()}/{query}")
        wait_for(page, "window.__viserMutable?.scene && window.__viserSceneTree")
        return page

    return open_page


@pytest.fixture
def show(browser: Browser):
    """Opens an address in a browser without cookies, where nothing is waited for."""
    contexts = []

    def show(address: str) -> Page:
        size = {"width": 480, "height": 360}
        contexts.append(browser.new_context(viewport=size, ignore_https_errors=True))
        page = contexts[-1].new_page()
        page.set_default_timeout(TIMEOUT_MS)
        page.add_init_script(TENTHS)
        page.goto(address)
        return page

    yield show
    for context in contexts:
        context.close()


@pytest.fixture(scope="module")
def page(server, open_page):
    """The page that the tests of a module share, because loading one takes seconds."""
    return open_page(server)


@pytest.fixture(autouse=True)
def no_errors(opened_pages):
    """Fails a test in which a page reported an error; one that expects some takes them."""

    def taken(page: Page) -> list[str]:
        return [opened_pages[page].pop() for _ in list(opened_pages[page])][::-1]

    yield taken
    assert not [error for page in opened_pages for error in taken(page)]
