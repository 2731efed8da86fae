from dataclasses import replace

import pytest
from mounted_cabin import mounted_cabin
from session_commands import altered

from modeviz.analysis.results import Conditions
from modeviz.journal.changes import LONGEST
from modeviz.viewer.session import history
from modeviz.viewer.session.author import Author
from modeviz.viewer.session.design import Variant
from modeviz.viewer.session.history import History
from modeviz.viewer.session.state import first_state


@pytest.fixture
def clock(monkeypatch):
    """The time that a history sees, to be set."""
    now = [0.0]
    monkeypatch.setattr(history.time, "monotonic", lambda: now[0])
    return now


class Bench:
    """A history of one rate, and of how one looks at it."""

    def __init__(self, lateral=0):
        vehicle = mounted_cabin()
        first = first_state(vehicle, vehicle.rates, Conditions("flat", 20.0))
        self.history = History(self._with(first, lateral))

    @property
    def value(self):
        return self.history.state.design.rates["A"].lateral

    @property
    def state(self):
        return self.history.state

    def put(self, value, step=None, **options):
        self.history.put(self._with(self.state, value), step, **options)

    def look(self, **fields):
        self.history.put(altered(self.state, **fields))

    def _with(self, state, value):
        rates = state.design.rates
        return altered(state, rates={**rates, "A": replace(rates["A"], lateral=value)})


def test_what_is_undone_comes_back_until_something_else_is_done():
    bench = Bench(1)
    bench.put(2)
    bench.put(3)
    assert bench.history.undo()
    assert bench.history.undo()
    assert bench.value == 1
    assert not bench.history.undo()
    assert bench.history.redo()
    assert bench.value == 2
    bench.put(9)
    assert not bench.history.can_redo
    assert bench.history.undo()
    assert bench.value == 2


def test_many_quick_changes_of_one_step_are_undone_together(clock):
    bench = Bench(0)
    for value in range(1, 6):
        clock[0] += 0.2
        bench.put(value, "a")
    bench.put(7, "b")
    assert bench.history.undo()
    assert bench.value == 5
    assert bench.history.undo()
    assert bench.value == 0


def test_slow_changes_of_one_step_are_undone_one_by_one(clock):
    bench = Bench(0)
    for value in (1, 2):
        clock[0] += 1.5
        bench.put(value, "a")
    assert bench.history.undo()
    assert bench.value == 1


def test_a_change_right_after_an_undo_can_be_undone(clock):
    bench = Bench(0)
    bench.put(1, "a")
    bench.put(2, "b")
    bench.history.undo()
    bench.put(3, "a")
    bench.history.undo()
    assert bench.value == 1


def test_nothing_new_is_no_step():
    bench = Bench(1)
    bench.put(1)
    assert not bench.history.can_undo


def test_a_long_history_forgets_its_beginning():
    bench = Bench(0)
    for value in range(1, 2 * LONGEST):
        bench.put(value)
    steps = 0
    while bench.history.undo():
        steps += 1
    assert steps == LONGEST


def test_changes_may_follow_each_other_slowly_if_that_is_said(clock):
    bench = Bench(0)
    for value in (1, 2):
        clock[0] += 100
        bench.put(value, "a", within=1000)
    assert bench.history.undo()
    assert bench.value == 0


def test_changes_of_one_step_that_lead_all_the_way_back_leave_no_step(clock):
    bench = Bench(0)
    bench.put(1)
    for value in (2, 3, 1):
        bench.put(value, "a")
    bench.history.undo()
    assert bench.value == 0
    assert not bench.history.can_undo


@pytest.mark.parametrize(
    "looks",
    [
        {"mode": "cab roll"},
        {"conditions": Conditions("rough", 25.0)},
        {"units": {"stiffness": "lbf/in"}, "group": "B"},
        {"coloring": "displacement", "hidden": frozenset({"cab"})},
        {"load": "front left radial force", "decibels": False},
        {"against": "Soft", "overlaid": frozenset({"Soft"})},
    ],
)
def test_how_one_looks_at_it_is_no_step_and_stays_when_a_rate_is_undone(looks):
    bench = Bench(0)
    bench.look(**looks)
    assert not bench.history.can_undo
    bench.put(1)
    bench.history.undo()
    assert bench.state == altered(bench.state, **looks)
    bench.look(operating_hz=12.0)
    bench.history.redo()
    assert bench.value == 1
    assert bench.state == altered(bench.state, **looks)


def test_a_look_in_the_midst_of_a_drag_neither_parts_it_nor_is_undone_with_it(clock):
    bench = Bench(0)
    bench.put(1, "a")
    bench.look(mode="cab roll", coloring="displacement")
    bench.put(2, "a")
    bench.history.undo()
    assert bench.value == 0
    assert (bench.state.motion.mode, bench.state.look.coloring) == ("cab roll", "displacement")
    assert not bench.history.can_undo


def test_looks_after_a_decision_that_changed_them_stay_when_it_is_undone_and_done_again():
    bench = Bench(0)
    bench.look(against="Soft")
    gone = altered(bench.state, variants={"Mine": Variant({}, 0)}, against="Original")
    bench.history.put(gone)
    bench.look(against="Stiff")
    bench.history.undo()
    assert bench.state.against == "Stiff"
    bench.look(units={"stiffness": "lbf/in"})
    bench.history.redo()
    assert (bench.state.against, bench.state.units) == ("Stiff", {"stiffness": "lbf/in"})


def test_what_a_decision_changed_of_the_looks_is_undone_with_it_unless_it_was_changed_again():
    bench = Bench(0)
    pinned = altered(bench.state, variants={"Mine": Variant({}, 0)}, against="Mine", group="B")
    bench.history.put(pinned)
    bench.look(group="A", decibels=False)
    bench.history.undo()
    state = bench.state
    assert not state.design.variants
    assert (state.against, state.group, state.charts.decibels) == ("Original", "A", False)


ANNA, BEN = Author("Anna", "2"), Author("Ben", "3")


def test_a_change_keeps_its_author_when_it_is_undone_and_redone():
    bench = Bench(0)
    bench.put(1, author=ANNA)
    bench.put(2, author=BEN)
    assert bench.history.undone_next.author == BEN
    bench.history.undo()
    assert bench.history.undone_next.author == ANNA
    assert bench.history.redone_next.author == BEN
    bench.history.redo()
    assert bench.history.undone_next.author == BEN
    assert Bench(0).history.undone_next is None
    assert Bench(0).history.redone_next is None


def test_one_step_is_of_one_author(clock):
    bench = Bench(0)
    bench.put(1, "a", author=ANNA)
    bench.put(2, "a", author=BEN)
    bench.put(3, "a", author=BEN)
    bench.history.undo()
    assert bench.value == 1
    assert bench.history.undone_next.author == ANNA


def test_an_author_is_the_same_under_another_name():
    assert Author("Anna Berg", "2") == ANNA
    assert Author("Anna", "3") != ANNA
