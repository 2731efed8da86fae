import threading
from types import SimpleNamespace

import pytest
from visitors import wait_until

from modeviz.viewer.page.widgets import write_back as settle
from modeviz.viewer.page.widgets.write_back import WriteBack
from modeviz.viewer.page.wire.turns import page_heard


class Page:
    """Keeps what is written back, and says when that has come."""

    def __init__(self):
        self.written = []
        self.came, self.second_came = threading.Event(), threading.Event()

    def queue_message(self, message):
        self.written.append((message.uuid, message.updates["value"]))
        (self.second_came if len(self.written) == 2 else self.came).set()

    def widget(self, uuid, value):
        api = SimpleNamespace(_websock_interface=self)
        return SimpleNamespace(value=value, _impl=SimpleNamespace(uuid=uuid, gui_api=api))


@pytest.fixture
def page(monkeypatch):
    monkeypatch.setattr(settle, "DELAY", 0.5)
    return Page()


def test_a_drag_is_written_back_once_with_its_last_value(page):
    slider, write_back = page.widget("a", 0.0), WriteBack()
    for value in range(4):
        slider.value = value
        write_back.touch(slider)
        assert not page.came.wait(0.2)  # longer in all than the delay after the first touch
    assert page.came.wait(5)
    assert page.written == [("a", 3)]


def test_every_widget_touched_is_written_back_and_later_again(page):
    first, second, write_back = page.widget("a", 1.0), page.widget("b", 2.0), WriteBack()
    write_back.touch(first)
    write_back.touch(second)
    assert page.came.wait(5)
    assert page.second_came.wait(5)
    assert page.written == [("a", 1.0), ("b", 2.0)]
    page.came.clear()
    first.value = 3.0
    write_back.touch(first)
    assert page.came.wait(5)
    assert page.written[2:] == [("a", 3.0)]


def test_a_widget_in_which_somebody_types_is_not_written_to_but_acted_on_once(page):
    box, write_back, acted = page.widget("a", 1.0), WriteBack(), threading.Event()
    calls = []
    for digit in range(3):
        write_back.touch(box, lambda digit=digit: (calls.append(digit), acted.set()))
    assert acted.wait(5)
    assert calls == [2]
    assert page.written == []


def test_what_is_done_once_a_value_rests_is_done_for_the_page_that_was_heard(page):
    heard = []
    page_heard.set("a page")
    WriteBack().touch(page.widget("a", 0.0), lambda: heard.append(page_heard.get()))
    page_heard.set(None)
    wait_until(lambda: heard)
    assert heard == ["a page"]
