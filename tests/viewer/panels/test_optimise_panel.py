"""What the tab that optimises says: the problem, the search and its end."""

from dataclasses import replace

import numpy as np
import pytest
import viser
from cabin_problem import PROBLEM, cabin_search
from mounted_cabin import mounted_cabin
from session_commands import altered

from modeviz.analysis.results import Conditions
from modeviz.dynamics.truncation_gap import TruncationGap
from modeviz.optimise.active_limits import ActiveConstraint
from modeviz.optimise.run import Optimum, Progress, optimise
from modeviz.optimise.verification import Verification
from modeviz.scatter.searching import SearchOptions
from modeviz.vehicle.problem import FrequencyWindow
from modeviz.viewer.panels.optimise.fall import steps
from modeviz.viewer.panels.optimise.outcome import exactness, figures, limits, truncation, where
from modeviz.viewer.panels.optimise.panel import OptimisePanel, offered
from modeviz.viewer.panels.optimise.summary import summary
from modeviz.viewer.session.session import Session
from modeviz.viewer.session.state import first_state
from modeviz.viewer.tasks.search_task import SearchStatus, SearchTask, Sought

RATES = mounted_cabin().rates
BETTER = mounted_cabin().all_rates(mounted_cabin().rate_sets["soft"])
SOUGHT = Sought(PROBLEM, RATES, 20.0, frozenset(), SearchOptions(starts=20))
LOOK = SearchStatus(SOUGHT, has_begun=True, original=1.0, reference=0.8)
FLAT = Conditions("flat", 20.0)


@pytest.fixture(scope="module")
def optimum():
    search = cabin_search()
    return optimise(search, [np.zeros(search.space.n_variables)])


def found(optimum, **changes) -> Optimum:
    return replace(optimum, **changes)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({}, "each load case relative to the original"),
        ({"is_normalised": False}, "Squared accelerations, plain sum"),
        ({}, "Flat at 6 to 14 Hz: all points, lateral and vertical"),
        ({}, "Front left radial force at 9, 11, 13 Hz: all points, lateral and vertical, weight 2"),
        (
            {},
            "4 numbers to choose, within bounds and ratio limits; ratios stay as they are now: "
            "B lateral 0.375 and fore-aft 0.5 of vertical",
        ),
        ({"windows": (FrequencyWindow("cab yaw", high_hz=9.0),)}, "Cab yaw below 9 Hz"),
        ({"windows": (FrequencyWindow("cab yaw", 3.0),)}, "Cab yaw above 3 Hz"),
        ({"windows": (FrequencyWindow("cab yaw", 3.0, 9.0, False),)}, "Cab yaw out of 3 to 9 Hz"),
    ],
)
def test_the_problem_is_said_at_a_glance(changes, said):
    problem = replace(PROBLEM, **changes)
    assert said in summary(problem, cabin_search().space, is_robust=False)


def test_a_peak_is_said_to_be_that_of_a_range():
    wheels = replace(PROBLEM, goal="peak", performance=PROBLEM.performance[1:])
    assert "at 9 to 13 Hz" in summary(wheels, cabin_search().space, is_robust=False)
    single = replace(wheels.performance[0], frequency_hz=np.array([9.0]))
    said = summary(replace(wheels, performance=(single,)), cabin_search().space, is_robust=False)
    assert "at 9 Hz" in said


def test_the_goal_is_shown_beside_the_original_and_the_reference():
    look = replace(LOOK, progress=Progress(1234, BETTER, 0.25, 3, 20))
    assert "start 3 of 20, 1\N{THIN SPACE}234 evaluations" in where(look)
    text = figures(look)
    for part in ("Best", "0.25", "−75.0 %", "Original", "Soft", "0.8", "−20.0 %"):
        assert part in text


def test_a_set_that_could_not_be_found_is_said_to_lie_outside():
    look = replace(LOOK, progress=Progress(1234, BETTER, 0.25, 3, 20))
    outside = {"original": (), "soft": ("past A vertical: <lower> bound",)}
    text = figures(replace(look, outside=outside))
    assert "Soft lies outside of what is searched: past A vertical: &lt;lower&gt; bound" in text
    assert "Original lies" not in text


def test_a_robust_search_says_that_it_goes_by_a_percentile():
    assert "choosing starts" in where(LOOK)
    look = replace(LOOK, is_robust=True)
    assert "95th percentile" in where(look)
    look = replace(look, progress=Progress(7, RATES, 0.4, 1, 1))
    assert "95th percentile, 7 evaluations" in where(look)
    look = replace(look, progress=Progress(1, RATES, 0.4, 1, 1))
    assert "95th percentile, 1 evaluation<" in where(look)
    said = summary(PROBLEM, cabin_search().space, is_robust=True)
    assert "95th percentile of parts, rates within ±15 %" in said


def test_without_a_reference_there_is_none():
    progress = Progress(1, BETTER, 0.25, 1, 1)
    assert "Soft" not in figures(replace(LOOK, progress=progress, reference=np.nan))


def test_limits_that_cost_nothing_are_counted_only(optimum):
    names = ("A vertical: upper bound", "A lateral: lower ratio limit")
    active = (ActiveConstraint(names[0], 0.1, 0.058), ActiveConstraint(names[1], 0.0, 0.0))
    text = limits(found(optimum, active=active))
    assert names[0] in text
    assert "−5.8 %" in text
    assert names[1] not in text
    assert "1 more" in text
    assert "No limit" in limits(found(optimum, active=()))


def test_what_the_full_model_says_is_bad_where_it_does_not_agree(optimum):
    def said(difference, are_kept=True, impossible=""):
        check = Verification(1.0, difference, np.zeros(0), are_kept, impossible)
        return exactness(found(optimum, verification=check))

    assert said(1e-12).startswith('<span class="dim">Solved from scratch, the model as given has')
    assert 'class="bad"' in said(1e-3)
    assert "out of its band" in said(0.0, are_kept=False)
    assert "Not checked: too stiff" in said(np.nan, impossible="too stiff")


def test_what_truncation_does_at_the_rates_found_is_told_where_it_matters(optimum):
    def said(change):
        gap = TruncationGap(("cab",), change, 9.5, 30.0, 2.0)
        return truncation(found(optimum, verification=replace(optimum.verification, gap=gap)))

    assert said(0.1).startswith(
        '<span class="bad">At these rates frequencies below 30 Hz are too high by'
    )
    assert "10 % (at 9.5 Hz;" in said(0.1)
    assert said(1e-3) == truncation(optimum) == ""


def test_the_fall_is_a_staircase_to_the_last_evaluation():
    progress = Progress(9, BETTER, 0.3, 1, 1, history=((1, 1.0), (4, 0.5), (6, 0.3)))
    x, best = steps(replace(LOOK, progress=progress))
    np.testing.assert_array_equal(x, [1, 4, 4, 6, 6, 9])
    np.testing.assert_array_equal(best, [1, 1, 0.5, 0.5, 0.3, 0.3])


def test_only_what_can_be_done_is_offered(optimum):
    vehicle = mounted_cabin()
    state = first_state(vehicle, vehicle.rates, FLAT)
    assert offered(None, state) == ("Start",)
    assert offered(LOOK, state) == ("Pause", "Cancel")
    assert offered(replace(LOOK, phase="paused"), state) == ("Resume", "Cancel")
    ended = replace(LOOK, phase="ended", found=optimum)
    assert offered(ended, state) == ("Start", "Accept")
    there = altered(state, rates=optimum.rates)
    assert offered(ended, there) == ("Start", "Accept", "Go back")
    assert offered(
        ended, replace(there, design=there.design.with_variant("Optimised 1", optimum.rates))
    ) == ("Start",)


def test_a_vehicle_without_response_points_says_what_it_lacks():
    vehicle = replace(mounted_cabin(), response_points=())
    session = Session(vehicle, first_state(vehicle, vehicle.rates, FLAT), print)
    server = viser.ViserServer(port=0, verbose=False)
    texts = []
    add, server.gui.add_html = server.gui.add_html, texts.append
    try:
        OptimisePanel(server.gui, session, SearchTask(session, print, print), dark=False)
    finally:
        server.gui.add_html = add
        session.close()
        server.stop()
    assert len(texts) == 1
    assert "lacks a [[response_point]]" in texts[0]
