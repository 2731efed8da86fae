"""What a page is called, the guide, and the keys, on the smallest vehicle."""

import pytest
from apps import open_app
from mounted_cabin import mounted_cabin
from pages import draw_on, wait_for, wait_until
from session_commands import Alter, Become

from modeviz.analysis.results import Conditions
from modeviz.viewer.session.commands.decisions import Load

SOLVE_S = 60
CAMERA = "__viserMutable.camera.matrixWorld.elements"
GUIDE = "!!document.querySelector('.mv .keys')"


@pytest.fixture(scope="module")
def app(server):
    with open_app(server, mounted_cabin(), Conditions("flat", 20.0)) as app:
        app.screen.guide.welcome_first()
        app.start()
        assert app.session.wait(SOLVE_S)
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    """The first page of the session."""
    return open_page(server, viewport=(980, 640))


def test_the_guide_welcomes_the_first_page_and_no_other(app, server, page, open_page):
    wait_for(page, GUIDE)
    page.get_by_role("button", name="Start").click()
    wait_for(page, f"!{GUIDE}")
    second = open_page(server, viewport=(980, 640))
    wait_for(second, "document.title.includes('Original')")  # that comes last when a page connects
    assert not second.evaluate(GUIDE)


def test_the_guide_comes_back_on_the_page_that_asks_with_all_keys(app, page):
    page.get_by_role("button", name="What can I do here?").click()
    wait_for(page, GUIDE)
    keys = page.evaluate("Array.from(document.querySelectorAll('.keys kbd'), (k) => k.textContent)")
    assert keys == [key for hotkey in app.screen.hotkeys.listed for key in hotkey.keys]
    page.keyboard.press("h")  # opens no second one
    page.get_by_role("button", name="Start").click()
    wait_for(page, f"!{GUIDE}")


def test_keys_do_nothing_behind_the_guide(app, page):
    page.get_by_role("button", name="What can I do here?").click()
    wait_for(page, GUIDE)
    before, camera = app.session.state, page.evaluate(CAMERA)
    for key in ("n", "p", "b", "Control+z", "w", "ArrowLeft", "Tab"):
        page.keyboard.press(key, delay=100)
    page.locator(".mv .keys").click()  # the focus goes from the button to nothing at all
    page.keyboard.press("n")
    page.keyboard.press("Space")
    draw_on(page)
    assert app.session.state == before
    assert page.evaluate(CAMERA) == camera
    assert not app.scene.driver._running
    page.get_by_role("button", name="Start").focus()
    page.keyboard.press("Space")  # closes it
    wait_for(page, f"!{GUIDE}")
    page.keyboard.press("n")
    wait_until(page, lambda: app.session.state != before)
    app.session.do(Become(before))
    assert app.session.wait(SOLVE_S)


def test_escape_closes_the_guide(app, page):
    for has_focus in (True, False):
        page.keyboard.press("h")
        wait_for(page, GUIDE)
        if not has_focus:
            page.locator(".mv .keys").click()
        page.keyboard.press("Escape")
        wait_for(page, f"!{GUIDE}")
    page.keyboard.press("h")
    wait_for(page, GUIDE)
    page.get_by_role("button", name="Start").click()
    wait_for(page, f"!{GUIDE}")


def test_the_title_names_vehicle_and_variant(app, page):
    wait_for(page, "document.title === 'cabin · Original · modeviz'")
    app.session.do(Load("Soft"))
    wait_for(page, "document.title === 'cabin · Soft · modeviz'")
    app.session.undo()
    wait_for(page, "document.title === 'cabin · Original · modeviz'")


def test_keys_show_the_next_mode_and_the_one_before(app, page):
    names = [name.name for name in app.session.answer.now.names]
    app.session.do(Alter(mode=names[6]))
    page.keyboard.press("n")
    wait_until(page, lambda: app.session.state.motion.mode == names[7])
    assert app.session.wait(SOLVE_S)
    page.keyboard.press("p")
    wait_until(page, lambda: app.session.state.motion.mode == names[6])


def test_the_space_bar_plays_and_stops_once_even_on_the_button_that_was_clicked(app, page):
    driver = app.scene.driver
    page.get_by_role("button", name="Play", exact=True).click()
    wait_until(page, lambda: driver._running)
    page.keyboard.press("Space")
    wait_until(page, lambda: not driver._running)
    draw_on(page)  # a second press would come by now
    assert not driver._running


def test_keys_do_nothing_while_somebody_types(app, page):
    before = app.session.state
    page.locator("input[inputmode=decimal]:visible").first.focus()
    page.keyboard.press("n")
    page.keyboard.press("Space")
    page.keyboard.press("Escape")
    page.locator("body").click(position={"x": 490, "y": 20})
    page.keyboard.press("p")
    wait_until(page, lambda: app.session.state != before)
    app.session.do(Become(before))
    assert app.session.state == before
    assert not app.scene.driver._running
