"""A widget and the value of a state that it shows, when both change at about the same time."""

from types import SimpleNamespace

import pytest

from modeviz.viewer.page.binding import Binding
from modeviz.viewer.page.server import open_server


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
