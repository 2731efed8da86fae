"""Mounts optimised in the page."""

import re
from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from apps import SOLVE_S, open_solved_cabin
from held_search import hold_searches
from mounted_cabin import mounted_cabin
from pages import CLOSE_NOTICES, wait_for, wait_until
from session_commands import Alter, AlterPlan

from modeviz.files.problem_file import problem_text, read_problem
from modeviz.text.wording import significant
from modeviz.vehicle.default_problem import problems
from modeviz.vehicle.mount_rates import MountRates
from modeviz.vehicle.problem import Problem
from modeviz.viewer.session.commands.decisions import Load, SetRate
from modeviz.viewer.session.planning.plan import first_plan, planned
from modeviz.viewer.tasks import front_task

TEXT = "document.body.textContent"
BEST = "document.querySelector('.mv .goals b')?.textContent"
CHART = "document.querySelectorAll('.uplot').length"


@pytest.fixture(scope="module")
def app(server):
    """The cabin with its usual problem, and one that is made of no accelerations."""
    (usual,) = problems(mounted_cabin())
    rated = Problem("rating", usual.groups, goal="rating")
    with open_solved_cabin(server, replace(mounted_cabin(), problems=(usual, rated))) as app:
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 1000))
    page.get_by_role("tab", name="Optimise").click()
    wait_for(page, f"{TEXT}.includes('each load case relative to the original')")
    return page


@pytest.fixture(autouse=True)
def original(app, page):
    """Every test starts with the vehicle's own rates and problem, and leaves no search behind."""
    app.session.do(Load("Original"))
    plan = replace(first_plan(app.session.vehicle), n_starts=2)
    app.session.do(Alter(variants={}, plan=plan))
    assert app.session.wait(SOLVE_S)
    yield
    app.tasks.search.close()


@pytest.fixture
def held(monkeypatch):
    return hold_searches(monkeypatch)


def press(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def start(app, page, reached):
    """Starts a search and waits until something is true of how it stands."""
    before = app.tasks.search.job  # of one that has ended: nothing of it changes any more
    press(page, "Start")
    wait_until(page, lambda: app.tasks.search.job is not before and reached(app.tasks.search.job))


def search(app, page):
    """Searches to the end; gives what was found."""
    start(app, page, lambda job: job.found)
    found = app.tasks.search.job.found
    wait_for(page, f"{BEST} === a.best && {TEXT}.includes('Converged')", best=significant(found.value))
    return found


def test_a_search_shows_how_the_goal_falls_and_moves_the_page_after_it(app, page):
    charts = page.evaluate(CHART)
    before = app.session.answer.now.psd
    found = search(app, page)
    wait_for(page, f"{CHART} === a.n", n=charts + 1)
    wait_until(page, lambda: app.session.answer.now.rates == found.rates)
    assert not np.array_equal(app.session.answer.now.psd, before)
    wait_for(page, f"{TEXT}.includes('the model as given has the same goal within')")
    chart = app.screen.controls.optimise._fall._chart
    assert chart.data[1][-1] == pytest.approx(found.value, rel=1e-6)
    assert chart.data[0][-1] == found.evaluations


def test_it_is_paused_goes_on_and_is_cancelled_with_the_best_design(app, page, held):
    start(app, page, lambda job: job.history)
    press(page, "Pause")
    wait_for(page, f"{TEXT}.includes('Paused')")
    held.set()
    at = app.tasks.search.job.progress.evaluations
    press(page, "Resume")
    wait_until(page, lambda: app.tasks.search.job.progress.evaluations > at)


def test_cancel_keeps_the_best_design(app, page, held):
    start(app, page, lambda job: job.history)
    press(page, "Cancel")
    wait_for(page, f"{TEXT}.includes('Cancelled')")
    look = app.tasks.search.job
    assert app.session.state.design.rates == look.found.rates == look.progress.rates


def test_the_result_is_accepted_under_a_name_of_its_own(app, page):
    found = search(app, page)
    press(page, "Accept")
    wait_until(page, lambda: "Optimised 1" in app.session.state.design.variants)
    assert (
        app.session.state.design.variants["Optimised 1"].rates
        == app.session.state.design.rates
        == found.rates
    )
    page.get_by_role("button", name="Accept", exact=True).wait_for(state="detached")
    page.get_by_role("button", name="Undo", exact=True).click()
    wait_until(page, lambda: app.session.state.design.rates == mounted_cabin().rates)
    assert not app.session.state.design.variants


def test_one_goes_back_to_the_rates_before(app, page):
    search(app, page)
    press(page, "Go back")
    wait_until(page, lambda: app.session.state.design.rates == mounted_cabin().rates)


def unfold(page, folder, label):
    """Opens a folder unless a label in it can be seen."""
    if not page.locator(f"xpath=//label[normalize-space()='{label}']").is_visible():
        page.get_by_text(folder).click()


def boxes(page, label):
    """The boxes beside a label; viser names only the first, and none of a text."""
    row = "ancestor::div[contains(@class, 'mantine-Flex-root')][1]"
    return page.locator(f"xpath=//label[normalize-space()='{label}']/{row}//input")


def test_bounds_and_ratios_of_a_group_are_changed_on_the_page(app, page):
    unfold(page, "Bounds and ratios", "Mounts")
    page.get_by_label("Mounts", exact=True).click()
    page.get_by_role("option", name="B rear", exact=True).click()
    wait_until(page, lambda: app.session.state.design.plan.shown_group == "B")
    boxes(page, "Lateral, N/mm").nth(0).fill("20")
    wait_until(page, lambda: app.session.state.design.plan.group.softest == MountRates(1e4, 2e4, 1e4))
    boxes(page, "Lateral, N/mm").nth(1).fill("5")
    wait_for(page, f"{TEXT}.includes('lateral: found 20 to 5 N/mm, expected the lower one first')")
    boxes(page, "Lateral, N/mm").nth(1).fill("5000")
    wait_until(page, lambda: app.session.state.design.plan.group.stiffest.lateral == 5e6)
    page.get_by_label("Ratios", exact=True).click()
    page.get_by_role("option", name="Within limits", exact=True).click()
    boxes(page, "Limits").nth(0).fill("0.5")
    wait_until(page, lambda: app.session.state.design.plan.group.ratio_limits == (0.5, 0.8))
    page.locator(".mv .pills label", has_text="Fore-aft").nth(0).click()
    wait_for(page, f"{TEXT}.includes('5 numbers to choose')")
    found = search(app, page)
    b = found.rates["B"]
    assert np.clip(b.lateral, 2e4, 5e6) == pytest.approx(b.lateral, rel=1e-9)
    assert np.clip(b.lateral / b.vertical, 0.5, 0.8) == pytest.approx(b.lateral / b.vertical, rel=1e-9)
    assert b.fore_aft == 4e5


def test_mounts_are_moved_by_a_search_within_bounds_of_the_page(app, page):
    app.session.do(AlterPlan(n_starts=1))
    unfold(page, "Places of these mounts", "Move z, mm")
    boxes(page, "Move z, mm").nth(0).fill("-20")
    boxes(page, "Move z, mm").nth(1).fill("30")
    wait_until(page, lambda: app.session.state.design.plan.group.offsets[2] == (-0.02, 0.03))
    name = app.session.state.design.plan.shown_group
    found = search(app, page)
    wait_until(page, lambda: app.session.answer.now.rates == found.rates)
    own, given = (v.mount_group(name).mounts for v in (app.session.answer.now.vehicle, mounted_cabin()))
    moved = own[0].points[0, 2] - given[0].points[0, 2]
    assert moved == pytest.approx(found.placements[name].offset[2])
    assert -0.02 - 1e-12 <= moved <= 0.03 + 1e-12
    assert abs(moved) > 1e-4
    press(page, "Go back")
    wait_until(page, lambda: not app.session.state.design.alterations.placements)


def test_accelerations_are_changed_on_the_page(app, page):
    own = app.session.state.design.plan
    assert len(own.loads) == 2
    unfold(page, "Loads and points", "Terms")
    press(page, "Remove")
    wait_until(page, lambda: app.session.state.design.plan.loads == own.loads[1:])
    at = boxes(page, "At, Hz")
    wait_until(page, lambda: at.input_value() == own.loads[1].frequencies)
    at.fill("7 to 9 by")
    wait_for(page, f"{TEXT}.includes('found \\'7 to 9 by\\', expected numbers and ranges in Hz')")
    at.fill("7 to 9 by 1/4")
    wait_for(page, f"{TEXT}.includes('at 7 to 9 Hz: all points, lateral and vertical')")
    page.locator(".mv .pills label", has_text="Rough").click()
    page.locator(".mv .pills label", has_text="Front left radial force").click()
    wait_for(page, f"{TEXT}.includes('Rough at 7 to 9 Hz')")
    press(page, "Add")
    wait_until(page, lambda: app.session.state.design.plan.shown_load == 1)
    page.get_by_label("Weight").fill("3")
    page.get_by_label("Target").fill("0.5")
    wait_for(page, f"{TEXT}.includes('to 0.5, weight 3')")
    first, second = app.session.state.design.plan.loads
    assert (first.roads, first.wheel_loads, first.weight) == ({"rough"}, frozenset(), 1)
    assert second == replace(first, weight=3, target=0.5)


def test_a_problem_without_accelerations_gets_some_if_asked(app, page):
    page.get_by_label("Problem", exact=True).click()
    page.get_by_role("option", name="Rating", exact=True).click()
    wait_for(page, f"{TEXT}.includes('Combined mean square at the driver')")
    assert not app.session.state.design.plan.loads
    unfold(page, "Loads and points", "Terms")
    at = boxes(page, "At, Hz")
    at.wait_for(state="detached")
    press(page, "Add")
    wait_until(page, lambda: at.count() and at.input_value() == "6 to 14 by 1/3")
    assert app.session.wait(SOLVE_S)


def test_a_front_of_what_cannot_be_is_refused_with_a_word(app, page):
    app.session.do(AlterPlan(free=frozenset()))
    wait_for(page, f"{TEXT}.includes('no group of mounts may change')")
    press(page, "Find front")
    page.locator(".mantine-Notification-root", has_text="no group of mounts may change").wait_for()
    page.evaluate(CLOSE_NOTICES)


def test_the_problem_is_changed_on_the_page(app, page):
    own = app.session.state.design.plan
    page.get_by_label("Normalised").uncheck()
    wait_for(page, f"{TEXT}.includes('plain sum')")
    page.locator(".mv .pills label", has_text=re.compile("^B$")).click()
    wait_for(page, f"{TEXT}.includes('3 numbers to choose')")
    page.get_by_role("combobox", name="Hold mode").click()
    page.get_by_role("option", name="Cab yaw", exact=True).click()
    boxes(page, "From, to, Hz").nth(1).fill("9.5")
    wait_for(page, f"{TEXT}.includes('Cab yaw below 9.5 Hz')")
    wanted = replace(own, is_normalised=False, free=frozenset("A"), mode="cab yaw", high_hz=9.5)
    assert app.session.state.design.plan == wanted
    for _ in range(4):
        press(page, "Undo")
    wait_until(page, lambda: app.session.state.design.plan == own)
    wait_for(page, f"{TEXT}.includes('6 numbers to choose')")


def test_a_changed_problem_is_saved_as_a_file_that_is_read_again(app, page, tmp_path):
    app.session.do(AlterPlan(is_normalised=False))
    with page.expect_download() as downloaded:
        press(page, "Save problem")
    path = tmp_path / downloaded.value.suggested_filename
    downloaded.value.save_as(path)
    assert path.name == "cabin-ride-problem.toml"
    problem = read_problem(path, app.session.vehicle)
    assert not problem.is_normalised
    assert problem_text(problem) == problem_text(
        planned(app.session.vehicle, app.session.state.design.plan)
    )


def test_what_cannot_be_searched_is_said_and_starts_nothing(app, page):
    app.session.do(AlterPlan(free=frozenset()))
    complaint = "no group of mounts may change"
    wait_for(page, f"{TEXT}.includes(a.complaint)", complaint=complaint)
    press(page, "Start")
    wait_for(
        page,
        """Array.from(document.querySelectorAll('.mantine-Notification-root'))
            .some(n => n.textContent.includes(a.complaint))""",
        complaint=complaint,
    )
    app.session.undo()


def test_nothing_in_the_tab_is_wider_than_its_column(app, page):
    search(app, page)
    too_wide = """[...document.querySelectorAll('[role=tabpanel] .mv, [role=tabpanel] .mv *')]
        .filter(e => !e.closest('svg') && e.scrollWidth > e.clientWidth + 1 && e.clientWidth > 0)
        .map(e => e.outerHTML.slice(0, 80))"""
    assert page.evaluate(too_wide) == []


def test_scattered_parts_shade_the_charts_until_a_rate_moves(app, page):
    chart = app.screen.results.response._charts._plots[0]._chart
    assert not chart.bands
    press(page, "Scatter")
    wait_until(page, lambda: app.tasks.scatter.job and app.tasks.scatter.job.found)
    wait_for(page, f"{TEXT}.includes('1000 vehicles')")
    wait_until(page, lambda: chart.bands)
    low, high, *_, now, _ = chart.data[1:]
    assert ((low < now) & (now < high)).mean() > 0.9
    app.session.do(SetRate("A", "vertical", 3e5))
    wait_for(page, f"{TEXT}.includes('other rates or road')")
    wait_until(page, lambda: not chart.bands)


def test_a_click_on_a_front_loads_its_design(app, page, monkeypatch):
    monkeypatch.setattr(front_task, "find_front", partial(front_task.find_front, n_designs=4))
    monkeypatch.setattr(front_task, "N_STARTS", 1)
    press(page, "Find front")
    wait_until(page, lambda: app.tasks.front.job and app.tasks.front.job.phase == "ended", seconds=120)
    points = "document.querySelectorAll('.mv .front > div')"
    designs = app.tasks.front.job.found
    wait_for(page, f"{points}.length === a.n", n=len(designs))
    page.locator(".mv .front label").nth(1).click()
    wait_until(page, lambda: app.session.state.design.rates == designs[1].rates)
    wait_for(page, f"{points}[1].className === 'on'")
