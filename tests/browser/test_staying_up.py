"""A page whose network, browser and server go away in turn: it comes back with everything in place."""

import pytest
from mount_controls import box, open_folder, position, thumb
from pages import NOTICE, wait_for, wait_until
from serving_cabin import key_of, serving

from modeviz.journal.keys import digest_of
from modeviz.viewer.app import App
from modeviz.viewer.serving import open_session

STATUS = "[...document.querySelectorAll('.mv .status')].map(e => getComputedStyle(e).display)"


@pytest.fixture(autouse=True)
def quick_to_draw(monkeypatch):
    """Pages of sessions that software draws soon."""

    class Quick(App):
        def __init__(self, *given, **named):
            super().__init__(*given, **named)
            self.server.scene.configure_environment_map(None)
            self.scene._stage._key.cast_shadow = False
            self.screen.motion.animation._run(False)

    monkeypatch.setattr(open_session, "App", Quick)


class Visit:
    """A page in a browser of its own, and its session."""

    def __init__(self, browser, port, directory, state=None):
        size = {"width": 1100, "height": 760}
        self.context = browser.new_context(viewport=size, storage_state=state)
        self.page, self._directory = self.context.new_page(), directory
        self.page.set_default_timeout(60_000)
        self.page.goto(f"http://127.0.0.1:{port}/?fixedDpr=1")
        self.name = digest_of(key_of(self.page.url))
        self.open()

    def open(self):
        """Waits for the slider."""
        wait_until(self.page, lambda: self._directory.sessions.get(("cabin", self.name)))
        wait_until(self.page, lambda: self.session.answer)
        wait_for(self.page, "document.querySelectorAll('.mv-rates').length > 0")
        open_folder(self.page, "A")

    def serve(self, directory):
        self._directory = directory

    @property
    def server(self):
        return self._directory.sessions.open["cabin", self.name].server

    @property
    def session(self):
        return self._directory.sessions.open["cabin", self.name].app.session

    @property
    def rate(self):
        return self.session.state.design.rates["A"].vertical

    def agrees(self):
        """Whether slider, number and answer are of the session's rate."""
        shown = box(self.page, "A", "vertical").input_value() == f"{self.rate / 1e3:g}"
        answer = self.session.answer
        return shown and answer.state.design.rates["A"].vertical == self.rate

    def cut(self):
        """Cuts the network, without a word."""
        server = self.server._websock_server
        for each in [*server._live_connections.values()]:
            server._background_event_loop.call_soon_threadsafe(each.transport.abort)

    def drag(self, shift, is_cut=False):
        """Drags the slider with the mouse, whose network is cut on the way; it is let go at the end."""
        area = thumb(self.page, "A", "vertical").bounding_box()
        x, y = area["x"] + area["width"] / 2, area["y"] + area["height"] / 2
        mouse = self.page.mouse
        mouse.move(x, y)
        mouse.down()
        mouse.move(x + shift / 2, y, steps=5)
        if is_cut:
            connected = {*self.server.get_clients()}
            self.cut()
            mouse.move(x + 0.7 * shift, y, steps=5)
            wait_until(self.page, lambda: {*self.server.get_clients()} - connected)
        mouse.move(x + shift, y, steps=5)
        mouse.up()
        app = self._directory.sessions.open["cabin", self.name].app
        slider = app.screen.controls.mounts._folders["A"]._rows["vertical"]._slider
        wait_until(self.page, lambda: slider.value == position(thumb(self.page, "A", "vertical")))


def test_a_page_comes_back_from_a_cut_network_a_killed_browser_and_a_restarted_server(
    browser, tmp_path
):
    study = tmp_path / "cabin.modeviz"
    with serving(study) as (front, directory):
        port, visit = front.get_port(), Visit(browser, front.get_port(), directory)
        before = visit.rate
        visit.drag(40, is_cut=True)
        wait_until(visit.page, visit.agrees)
        visit.drag(30)
        wait_until(visit.page, lambda: visit.rate != before and visit.agrees())
        left, name = visit.rate, visit.name
        state = visit.context.storage_state()
        visit.context.close()
        visit = Visit(browser, port, directory, state)
        assert visit.name == name
        wait_until(visit.page, lambda: visit.rate == left and visit.agrees())
        place = position(thumb(visit.page, "A", "vertical"))
        assert visit.page.evaluate(STATUS) == ["block"]
    assert "modeviz was stopped" in wait_for(visit.page, NOTICE)
    assert visit.page.evaluate(STATUS) == ["none"]
    with serving(study, port=port) as (_, directory):
        visit.serve(directory)
        wait_for(visit.page, f"!{NOTICE}")
        visit.open()
        assert visit.page.evaluate(STATUS) == ["block"]
        assert visit.rate == left
        assert visit.session.can_undo
        wait_until(visit.page, visit.agrees)
        assert position(thumb(visit.page, "A", "vertical")) == place
        visit.drag(-30)
        wait_until(visit.page, lambda: visit.rate < left and visit.agrees())
        visit.context.close()
