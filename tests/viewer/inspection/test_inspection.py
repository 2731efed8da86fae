"""Choosing what is looked at."""

import pytest
from looked_at import heaving_and_twisting, plate

from modeviz.viewer.inspection.state import Content, Inspection
from modeviz.viewer.inspection.subject import subject_of_component


def subject(name, n_modes=2):
    shapes = heaving_and_twisting()[:, :, :n_modes]
    return subject_of_component(plate(shapes), name, None)


@pytest.fixture
def shown():
    return []


@pytest.fixture
def inspection(shown):
    content = Content("two", (subject("still", 0), subject("a"), subject("b")))
    return Inspection(content, shown.append)


def test_it_opens_with_the_first_body_that_has_modes(inspection):
    assert (inspection.state.subject, inspection.state.mode) == ("a", 1)


def test_stepping_goes_round(inspection, shown):
    inspection.step(1)
    assert inspection.state.mode == 0
    inspection.step(-1)
    assert inspection.state.mode == 1
    assert [state.mode for state in shown] == [0, 1]


def test_another_body_is_seen_in_its_first_mode_that_deforms_it(inspection):
    inspection.show_mode(0)
    inspection.look_at("b")
    assert (inspection.state.subject, inspection.state.mode) == ("b", 1)


@pytest.mark.parametrize("ask", [lambda i: i.look_at("nobody"), lambda i: i.show_mode(2)])
def test_what_is_not_there_changes_nothing(inspection, shown, ask):
    ask(inspection)
    assert shown == []


def test_a_body_without_modes_rests(inspection):
    inspection.look_at("still")
    inspection.step(1)
    assert (inspection.state.subject, inspection.state.mode) == ("still", 0)


def test_nothing_at_all_is_a_page_too(shown):
    empty = Inspection(Content("empty", ()), shown.append)
    empty.step(1)
    assert empty.state.moving is None


def test_other_content_is_shown_with_the_body_that_is_asked_for(inspection):
    inspection.replace_content(Content("new", (subject("c"), subject("d"))), "d")
    assert inspection.state.content.name == "new"
    assert inspection.state.subject == "d"
