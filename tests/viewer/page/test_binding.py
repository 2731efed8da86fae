"""A widget and the value of a state that it shows, when both change at about the same time."""

from threading import Barrier, Thread
from types import SimpleNamespace

import pytest

from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.server import open_server

SOON = 20.0


@pytest.fixture(scope="module")
def gui():
    server = open_server(port=0)
    yield server.gui
    server.stop()


class Owner:
    """Of a state that is one value; keeps what was written."""

    def __init__(self, state):
        self.state, self.written = state, []

    def write(self, value):
        self.state = value
        self.written.append(value)


@pytest.fixture
def bound(gui):
    """A dropdown that is bound to a state of its own."""

    def bound(*options):
        owner, dropdown = Owner(options[0]), gui.add_dropdown("Shows", options)
        return owner, dropdown, Binding(dropdown, owner, lambda state: state, owner.write)

    return bound


def choose(dropdown, value):
    """A page's choice comes in; its event is heard later, by another thread."""
    dropdown._impl.value = value
    return SimpleNamespace(client=SimpleNamespace(), target=dropdown)


def test_a_choice_is_kept_where_an_answer_comes_before_it_is_heard(bound):
    owner, dropdown, binding = bound("mode", "damped mode")
    event = choose(dropdown, "damped mode")
    binding.show()
    binding._changed(event)
    assert owner.written == ["damped mode"]
    assert dropdown.value == "damped mode"


def test_a_state_that_others_changed_is_shown(bound):
    owner, dropdown, binding = bound("mode", "damped mode")
    owner.state = "damped mode"
    binding.show()
    assert dropdown.value == "damped mode"
    assert owner.written == []


def test_what_options_changed_is_put_back(bound):
    """viser chooses the first of new options, which may not be what the state says."""
    owner, dropdown, binding = bound("b", "a")
    dropdown.options = ("c", "d")
    dropdown.options = ("a", "b", "c")
    binding.show()
    assert dropdown.value == owner.state == "b"


def test_a_choice_may_show_all_that_is_bound_also_what_is_being_chosen(gui, bound):
    owner, dropdown, binding = bound("mode", "damped mode")
    other = gui.add_checkbox("Also", False)
    also = Binding(other, owner, lambda state: state == "damped mode", lambda _: None)
    written, write = [], owner.write

    def write_and_show(value):
        write(value)
        for each in (binding, also):
            each.show()
        written.append(value)

    binding._write = write_and_show
    thread = Thread(target=binding._changed, args=(choose(dropdown, "damped mode"),), daemon=True)
    thread.start()
    thread.join(SOON)
    assert written == ["damped mode"]
    assert (dropdown.value, other.value) == ("damped mode", True)


def test_choices_that_show_each_other_at_once_both_end(gui):
    """As two values of one form, each of which brings the other after it."""
    meeting, owner = Barrier(2, timeout=SOON), Owner("")
    widgets = [gui.add_text(name, "") for name in ("one", "two")]
    bindings = []

    def write(value):
        owner.write(value)
        meeting.wait()
        for each in bindings:
            each.show()

    bindings += [Binding(widget, owner, lambda state: state, write) for widget in widgets]
    chosen = zip(bindings, widgets, ("a", "b"), strict=True)
    threads = [
        Thread(target=binding._changed, args=(choose(widget, value),), daemon=True)
        for binding, widget, value in chosen
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(SOON)
    assert not any(thread.is_alive() for thread in threads)
    assert {widget.value for widget in widgets} == {owner.state}
