"""Mounts optimised in the page."""

from dataclasses import replace
from functools import partial

import pytest
from apps import SOLVE_S, open_solved_cabin
from held_search import hold_searches
from mounted_cabin import mounted_cabin
from pages import wait_for, wait_until

from modeviz.export.wording import significant
from modeviz.viewer import trader

TEXT = "document.body.textContent"
BEST = "document.querySelector('.mv .goals b')?.textContent"
CHART = "document.querySelectorAll('.uplot').length"


@pytest.fixture(scope="module")
def app(server):
    with open_solved_cabin(server) as app:
        yield app


@pytest.fixture(scope="module")
def page(app, server, open_page):
    page = open_page(server, viewport=(980, 1000))
    page.get_by_role("tab", name="Optimise").click()
    wait_for(page, f"{TEXT}.includes('each load case relative to the original')")
    return page


@pytest.fixture(autouse=True)
def original(app, page):
    """Every test starts with the vehicle's own rates, and leaves no search behind."""
    app.session.load("Original")
    app.session.update(lambda state: replace(state, variants={}, plan=replace(state.plan, n_starts=2)))
    assert app.session.wait(SOLVE_S)
    yield
    app.optimiser.close()


@pytest.fixture
def held(monkeypatch):
    return hold_searches(monkeypatch)


def press(page, name):
    page.get_by_role("button", name=name, exact=True).click()


def search(app, page):
    """Searches to the end; gives what was found."""
    press(page, "Start")
    wait_until(page, lambda: app.optimiser.look and app.optimiser.look.optimum)
    wait_for(page, f"{TEXT}.includes('Converged')")
    return app.optimiser.look.optimum


def test_a_search_shows_how_the_goal_falls_and_moves_the_page_after_it(app, page):
    charts = page.evaluate(CHART)
    before = app.shown.now.psd
    found = search(app, page)
    wait_for(page, f"{BEST} === a.best", best=significant(found.value))
    assert page.evaluate(CHART) == charts + 1
    wait_until(page, lambda: app.shown.now.rates == found.rates)
    assert (app.shown.now.psd != before).any()
    wait_for(page, f"{TEXT}.includes('The full model has the same goal within')")
    chart = app._optimise._fall._chart
    assert chart.data[1][-1] == pytest.approx(found.value, rel=1e-6)
    assert chart.data[0][-1] == found.evaluations


def test_it_is_paused_goes_on_and_is_cancelled_with_the_best_design(app, page, held):
    press(page, "Start")
    wait_until(page, lambda: app.optimiser.look and app.optimiser.look.falls)
    press(page, "Pause")
    wait_for(page, f"{TEXT}.includes('Paused')")
    held.set()
    at = app.optimiser.look.progress.evaluations
    press(page, "Resume")
    wait_until(page, lambda: app.optimiser.look.progress.evaluations > at)


def test_cancel_keeps_the_best_design(app, page, held):
    press(page, "Start")
    wait_until(page, lambda: app.optimiser.look and app.optimiser.look.falls)
    press(page, "Cancel")
    wait_for(page, f"{TEXT}.includes('Cancelled')")
    look = app.optimiser.look
    assert app.session.state.rates == look.optimum.rates == look.progress.rates


def test_the_result_is_accepted_under_a_name_of_its_own(app, page):
    found = search(app, page)
    press(page, "Accept")
    wait_until(page, lambda: "Optimised 1" in app.session.state.variants)
    assert app.session.state.variants["Optimised 1"].rates == app.session.state.rates == found.rates
    page.get_by_role("button", name="Accept", exact=True).wait_for(state="detached")
    page.get_by_role("button", name="Undo", exact=True).click()
    wait_until(page, lambda: app.session.state.rates == mounted_cabin().rates)
    assert not app.session.state.variants


def test_one_goes_back_to_the_rates_before(app, page):
    search(app, page)
    press(page, "Go back")
    wait_until(page, lambda: app.session.state.rates == mounted_cabin().rates)


def test_the_problem_is_changed_on_the_page(app, page):
    own = app.session.state.plan
    page.get_by_label("Normalised").uncheck()
    wait_for(page, f"{TEXT}.includes('plain sum')")
    page.locator(".mv .pills label", has_text="B").click()
    wait_for(page, f"{TEXT}.includes('3 numbers to choose')")
    page.get_by_role("combobox", name="Hold mode").click()
    page.get_by_role("option", name="Cab yaw", exact=True).click()
    box = page.get_by_label("To, Hz")
    box.fill("9")
    wait_for(page, f"{TEXT}.includes('Cab yaw below 9 Hz')")
    wanted = replace(own, is_normalised=False, groups=frozenset("A"), mode="cab yaw", high_hz=9)
    assert app.session.state.plan == wanted
    for _ in range(4):
        press(page, "Undo")
    wait_until(page, lambda: app.session.state.plan == own)
    wait_for(page, f"{TEXT}.includes('6 numbers to choose')")


def test_what_cannot_be_searched_is_said_and_starts_nothing(app, page):
    app.session.update(lambda state: replace(state, plan=replace(state.plan, groups=frozenset())))
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
    chart = app._response._charts._plots[0]._chart
    assert not chart.bands
    press(page, "Scatter")
    wait_until(page, lambda: app.scatterer.job and app.scatterer.job.found)
    wait_for(page, f"{TEXT}.includes('1000 vehicles')")
    wait_until(page, lambda: chart.bands)
    low, high, *_, now, _ = chart.data[1:]
    assert ((low < now) & (now < high)).mean() > 0.9
    app.session.set_rate("A", "vertical", 3e5)
    wait_for(page, f"{TEXT}.includes('other rates or road')")
    wait_until(page, lambda: not chart.bands)


def test_a_click_on_a_front_loads_its_design(app, page, monkeypatch):
    monkeypatch.setattr(trader, "find_front", partial(trader.find_front, n_designs=4))
    monkeypatch.setattr(trader, "N_STARTS", 1)
    press(page, "Find front")
    wait_until(page, lambda: app.trader.job and app.trader.job.phase == "ended", seconds=120)
    points = "document.querySelectorAll('.mv .front > div')"
    designs = app.trader.job.found
    wait_for(page, f"{points}.length === a.n", n=len(designs))
    page.locator(".mv .front label").nth(1).click()
    wait_until(page, lambda: app.session.state.rates == designs[1].rates)
    wait_for(page, f"{points}[1].className === 'on'")
